//! The force of a rigid tip on an organ, of linear tissue or not, and its consistent tangent.
//!
//! On a half-space F₀(s) = r(s/a) H(s), where H is the closed form at small strain, a the tip's radius and
//! r the [`Stiffening`] of tissue and tip. An organ is not a half-space: its model finds a contact stiffness k at
//! small strain where the half-space has k₀. The difference c = 1/k − 1/k₀ is the structural compliance,
//! in series with the tip's own:
//!
//! ```text
//! c ≥ 0:   d = s + c F,   F = F₀(s)              ∂F/∂d = F₀′/(1 + c F₀′)     ∂F/∂c = −F F₀′/(1 + c F₀′)
//! c < 0:   F = q F₀(d),   q = 1/(1 + c k₁(d))    ∂F/∂d = q F₀′ − q² c k₁′ F₀  ∂F/∂c = −q² k₁ F₀
//! ```
//!
//! The series has no answer for c < 0 once F₀′ > −1/c; the second form is the same at small depth, and
//! force and stiffness pass continuously from one into the other. k₁ = F₀/d under a flat tip and 3/2 F₀/d under a
//! sphere, which at small depth is k₀ and like it grows with the touching area. c is constant in the derivative: it
//! depends on tissue far from the tip. With the whole organ c does not depend on the touching area; with the local
//! model it changes slowly with it.
//!
//! *How we know*: `analytic::flat_tip_is_linear_in_depth`, `analytic::sphere_is_hertz`; the tangent by
//! differences of the force, `tip_tangent::…`; of a sphere and of nonlinear tissue against full runs on other bodies,
//! `stiffening::…`.
//!
//! *Limits*: what surrounds the tip answers as at small strain. With the local model the stiffness under a
//! sphere lacks the change of c: 1.3 % where the touching area has a tenth of the organ's radius, 1.9 % at
//! a fifth. q is at most `STIFFEST`; an answer reports where that acts. ∂F/∂c jumps at c = 0 in
//! nonlinear tissue, which the stiffness sees only where normal and tangent couple under a sphere that
//! sticks.

use std::sync::Arc;

use nalgebra::{Matrix2, Matrix3, Vector2};

use crate::contact::{
    Friction, Tip, half_space_stiffness, half_space_tangential_stiffness, hertz_force,
};
use crate::finite_elements::indentation::Stiffening;
use crate::{Limit, Limits, LinearElastic, Material, Reached, Vec3};

/// The response of a tissue to a tip.
#[derive(Debug, Clone, PartialEq)]
pub struct TipLaw {
    tip: Tip,
    bond: Friction,
    at_rest: LinearElastic,
    stiffening: Arc<Stiffening>,
    /// Radius of the tool, the unit of depth of the stiffening [m]; the tip's own against a plane.
    radius: f64,
}

/// Normal force of a tip and its change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalForce {
    /// Force [N].
    pub force: f64,
    /// Change of the force with depth [N/m].
    pub stiffness: f64,
    /// Change of the force with the structural compliance [N²/m].
    pub by_compliance: f64,
    /// The bound on the stiffness, where it acted [half-spaces].
    pub limited: Option<Reached>,
    /// The bound on the depth, where the tip is deeper than its force is known [m].
    pub beyond: Option<Reached>,
}

impl NormalForce {
    /// Of a tip that does not touch.
    pub const NONE: Self = Self {
        force: 0.0,
        stiffness: 0.0,
        by_compliance: 0.0,
        limited: None,
        beyond: None,
    };

    /// Of a model without an answer, which the caller reports.
    const UNKNOWN: Self = Self {
        force: f64::NAN,
        stiffness: f64::NAN,
        by_compliance: f64::NAN,
        limited: None,
        beyond: None,
    };
}

/// Force on a tip in all directions, and its change, in the frame of the contact: two tangents and the
/// outward normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipForce {
    /// Force on the tip [N].
    pub force: Vec3,
    /// Change of the force when the tip moves inward, against the axes [N/m].
    pub stiffness: Matrix3<f64>,
    /// Change of the force with the structural compliance along the normal [N²/m].
    pub by_compliance: Vec3,
    /// Bounds that changed them.
    pub limits: Limits,
}

/// Newton steps of which none is expected to be needed.
const MAX_STEPS: usize = 50;

/// Largest stiffness of an organ relative to a half-space [-]: with an anchor right under the tip, whose
/// distance no model here resolves well.
const STIFFEST: f64 = 20.0;

impl TipLaw {
    /// A tissue that is linear at every depth.
    pub fn linear(tip: Tip, bond: Friction, at_rest: LinearElastic) -> Self {
        let stiffening = Stiffening::linear(tip, bond, at_rest.poissons_ratio());
        Self::of(tip, bond, at_rest, stiffening)
    }

    /// A tissue with the stiffening that was found for this tip and bond.
    pub fn stiffening(tip: Tip, bond: Friction, tissue: &Material, stiffening: Stiffening) -> Self {
        Self::of(tip, bond, tissue.at_rest, stiffening)
    }

    fn of(tip: Tip, bond: Friction, at_rest: LinearElastic, stiffening: Stiffening) -> Self {
        let (Tip::Flat { radius } | Tip::Sphere { radius }) = tip;
        Self {
            tip,
            bond,
            at_rest,
            stiffening: Arc::new(stiffening),
            radius,
        }
    }

    /// The law of the same tool on a surface of the mean curvature `curvature` [1/m], positive where it bulges out; see
    /// [`Tip::on_curved_surface`]. The stiffening is that against a plane at the same depth.
    pub fn on_curved_surface(&self, curvature: f64) -> Self {
        Self {
            tip: self.tip.on_curved_surface(curvature),
            ..self.clone()
        }
    }

    /// The law of the same sphere on layers: areas of these radii [m], which ascend, touch so many times deeper, with so many times
    /// the force [-].
    pub fn on_layers(&self, areas: impl Iterator<Item = (f64, [f64; 2])>) -> Self {
        let radius = self.radius;
        let of_radius = areas.map(|(area, times)| ((area / radius).powi(2), times));
        Self {
            stiffening: Arc::new(self.stiffening.on_layers(of_radius)),
            ..self.clone()
        }
    }

    /// Depth [m] down to which the force is known; beyond, it goes on along its tangent.
    pub fn deepest(&self) -> f64 {
        self.stiffening.deepest() * self.radius
    }

    fn beyond(&self, depth: f64) -> Option<Reached> {
        let known = self.deepest();
        (depth > known).then_some(Reached {
            unbounded: depth,
            used: known,
        })
    }

    /// Normal force at `depth` [m] where a flat tip of the touching area at this depth meets the stiffness
    /// `stiffness` [N/m] at small strain. The change with depth holds the structural compliance
    /// c = 1/k − 1/k₀: k follows the touching area as k₀ does.
    pub fn normal_force(&self, depth: f64, stiffness: f64) -> NormalForce {
        let area_radius = self.tip.contact_radius(depth);
        if depth <= 0.0 || area_radius == 0.0 {
            return NormalForce::NONE;
        }
        let half_space = half_space_stiffness(&self.at_rest, area_radius, self.bond);
        self.normal_force_in_series(depth, 1.0 / stiffness - 1.0 / half_space)
    }

    /// Normal force at `depth` [m] where the organ has the structural `compliance` [m/N], which is below
    /// zero where the organ is stiffer than a half-space.
    pub fn normal_force_in_series(&self, depth: f64, compliance: f64) -> NormalForce {
        if depth.is_nan() || compliance.is_nan() {
            return NormalForce::UNKNOWN;
        }
        let area_radius = self.tip.contact_radius(depth);
        if depth <= 0.0 || area_radius == 0.0 {
            return NormalForce::NONE;
        }
        if compliance > 0.0 {
            return self.softer(depth, compliance);
        }
        let (force, stiffness) = self.on_half_space(depth);
        let exponent = match self.tip {
            Tip::Flat { .. } => 1.0,
            Tip::Sphere { .. } => 1.5,
        };
        let slope = exponent * force / depth;
        let growth = stiffness / force - 1.0 / depth;
        let ratio = bounded_ratio(1.0, compliance * slope, growth);
        NormalForce {
            force: ratio.value * force,
            stiffness: ratio.value * stiffness + ratio.change * force,
            by_compliance: ratio.by_compliance * slope * force,
            limited: ratio.limited,
            beyond: self.beyond(depth),
        }
    }

    /// The force on a tip that is displaced by `displacement` [m] where a flat tip of the same touching area
    /// meets the `stiffness` [N/m] at small strain, whose tangents do not couple to the normal; all in the
    /// frame of the contact. The change with depth holds the structural compliances.
    pub fn force(&self, displacement: &Vec3, stiffness: &Matrix3<f64>) -> TipForce {
        let depth = -displacement.z;
        let normal = self.normal_force(depth, stiffness[(2, 2)]);
        let mut tip = TipForce::along_normal(&normal);
        let radius = self.tip.contact_radius(depth);
        if self.bond == Friction::Bonded && radius > 0.0 {
            let along = stiffness.fixed_view::<2, 2>(0, 0).into_owned();
            let own = half_space_tangential_stiffness(&self.at_rest, radius);
            let growth = self.tip.contact_radius_growth(depth);
            let change = along * along * (growth / own);
            tip.put_tangents(&along, &change, &-displacement.xy());
        }
        tip
    }

    /// The force on a tip that is displaced by `displacement` [m] where the organ has the structural
    /// `compliance` C [m/N], symmetric; both in the frame of the contact. With d = −displacement, k_t the
    /// half-space's stiffness along the surface and G the stiffness of both along it,
    ///
    /// ```text
    /// F_t = G (d_t − C_tn F_n),   G = (1/k_t(d_n) 1 + C_tt)⁻¹
    /// F_n = F(D, c),   D = d_n − C_nt G d_t,   c = C_nn − C_nt G C_tn
    /// ```
    ///
    /// Under a sphere k_t, and with it G, D and c, depend on d_n, and the stiffness contains that.
    pub fn force_in_series(&self, displacement: &Vec3, compliance: &Matrix3<f64>) -> TipForce {
        let inward = -displacement.z;
        let sideways = -displacement.xy();
        let shear = self.shear(inward, compliance);
        let along = &shear.stiffness;
        let down = compliance.fixed_view::<2, 1>(0, 2).into_owned();
        let up = compliance.fixed_view::<1, 2>(2, 0).into_owned();
        let depth = inward - (up * along * sideways).x;
        let effective = compliance[(2, 2)] - (up * along * down).x;
        let normal = self.normal_force_in_series(depth, effective);

        let by_inward = normal.stiffness * (1.0 - (up * shear.change * sideways).x)
            - normal.by_compliance * (up * shear.change * down).x;
        let by_sideways = -normal.stiffness * up * along;
        let mut tip = TipForce::along_normal(&normal);
        tip.put_tangents(along, &shear.change, &(sideways - down * normal.force));
        tip.stiffness[(2, 2)] = by_inward;
        tip.stiffness
            .fixed_view_mut::<1, 2>(2, 0)
            .copy_from(&by_sideways);
        let coupled = along * down;
        for row in 0..2 {
            tip.stiffness[(row, 2)] -= coupled[row] * by_inward;
            for column in 0..2 {
                tip.stiffness[(row, column)] -= coupled[row] * by_sideways[column];
            }
        }
        tip.by_compliance = Vec3::new(-coupled.x, -coupled.y, 1.0) * normal.by_compliance;
        if let Some(reached) = shear.limited {
            tip.limits.add(Limit::TipShearStiffness, reached);
        }
        tip
    }

    /// G at the depth `inward` [m]. C_tt is a multiple of the identity along each of its principal axes,
    /// which do not turn with depth.
    fn shear(&self, inward: f64, compliance: &Matrix3<f64>) -> Shear {
        let radius = self.tip.contact_radius(inward);
        if self.bond == Friction::Frictionless || radius == 0.0 {
            return Shear::NONE;
        }
        let own = half_space_tangential_stiffness(&self.at_rest, radius);
        let growth = self.tip.contact_radius_growth(inward);
        let mean = 0.5 * (compliance[(0, 0)] + compliance[(1, 1)]);
        let half = 0.5 * (compliance[(0, 0)] - compliance[(1, 1)]);
        let cross = 0.5 * (compliance[(0, 1)] + compliance[(1, 0)]);
        let spread = half.hypot(cross);
        let (cosine, sine) = match spread > 0.0 {
            true => (half / spread, cross / spread),
            false => (1.0, 0.0),
        };
        let turned = 0.5 * Matrix2::new(cosine, sine, sine, -cosine);
        let mut shear = Shear::NONE;
        for sign in [1.0, -1.0] {
            let onto = Matrix2::from_diagonal_element(0.5) + turned * sign;
            let ratio = bounded_ratio(own, (mean + sign * spread) * own, growth);
            shear.stiffness += onto * ratio.value;
            shear.change += onto * (ratio.value * growth + ratio.change);
            let worse = |known: &Reached| {
                ratio
                    .limited
                    .is_some_and(|new| new.unbounded > known.unbounded)
            };
            if shear.limited.is_none_or(|known| worse(&known)) {
                shear.limited = ratio.limited;
            }
        }
        shear
    }

    /// Solves d = s + c F₀(s). F₀ rises, so the root lies between 0 and d.
    fn softer(&self, depth: f64, compliance: f64) -> NormalForce {
        let (mut low, mut high) = (0.0, depth);
        let mut s = depth;
        let (mut force, mut stiffness) = self.on_half_space(s);
        for _ in 0..MAX_STEPS {
            let value = s + compliance * force - depth;
            if value > 0.0 {
                high = s;
            } else {
                low = s;
            }
            let newton = s - value / (1.0 + compliance * stiffness);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let step = (next - s).abs();
            s = next;
            (force, stiffness) = self.on_half_space(s);
            if step <= 1e-14 * depth {
                break;
            }
        }
        let both = stiffness / (1.0 + compliance * stiffness);
        NormalForce {
            force,
            stiffness: both,
            by_compliance: -force * both,
            limited: None,
            beyond: self.beyond(s),
        }
    }

    /// Force on a half-space [N], r H, and its change [N/m].
    fn on_half_space(&self, depth: f64) -> (f64, f64) {
        let radius = self.radius;
        let (force, stiffness) = match self.tip {
            Tip::Flat { radius } => {
                let stiffness = half_space_stiffness(&self.at_rest, radius, self.bond);
                (stiffness * depth, stiffness)
            }
            Tip::Sphere { radius } => {
                let force = hertz_force(&self.at_rest, radius, depth);
                (
                    force,
                    if depth > 0.0 {
                        1.5 * force / depth
                    } else {
                        0.0
                    },
                )
            }
        };
        let (ratio, change) = self.stiffening.ratio(depth / radius);
        (ratio * force, ratio * stiffness + change / radius * force)
    }
}

impl TipForce {
    fn along_normal(normal: &NormalForce) -> Self {
        let mut limits = Limits::NONE;
        if let Some(reached) = normal.limited {
            limits.add(Limit::TipStiffness, reached);
        }
        if let Some(reached) = normal.beyond {
            limits.add(Limit::TipDepth, reached);
        }
        let mut stiffness = Matrix3::zeros();
        stiffness[(2, 2)] = normal.stiffness;
        Self {
            force: Vec3::new(0.0, 0.0, normal.force),
            stiffness,
            by_compliance: Vec3::new(0.0, 0.0, normal.by_compliance),
            limits,
        }
    }

    /// Sets the force along the surface: its stiffness and the change of that with depth, times `way` [m].
    fn put_tangents(&mut self, along: &Matrix2<f64>, change: &Matrix2<f64>, way: &Vector2<f64>) {
        let force = along * way;
        (self.force.x, self.force.y) = (force.x, force.y);
        self.stiffness.fixed_view_mut::<2, 2>(0, 0).copy_from(along);
        self.stiffness
            .fixed_view_mut::<2, 1>(0, 2)
            .copy_from(&(change * way));
    }
}

/// Stiffness along the surface [N/m], and its change with depth [N/m²].
struct Shear {
    stiffness: Matrix2<f64>,
    change: Matrix2<f64>,
    limited: Option<Reached>,
}

impl Shear {
    const NONE: Self = Self {
        stiffness: Matrix2::new(0.0, 0.0, 0.0, 0.0),
        change: Matrix2::new(0.0, 0.0, 0.0, 0.0),
        limited: None,
    };
}

/// q k with q = 1/(1 + c k) ≤ `STIFFEST`, where c does not depend on depth and k does.
struct Ratio {
    value: f64,
    /// Part of its change with depth that is q's [1/m].
    change: f64,
    /// ∂q/∂c over k.
    by_compliance: f64,
    limited: Option<Reached>,
}

/// For the stiffness `scale` · k, of relative growth `growth` [1/m] with depth, and `product` = c k [-].
fn bounded_ratio(scale: f64, product: f64, growth: f64) -> Ratio {
    let divisor = 1.0 + product;
    if divisor < 1.0 / STIFFEST {
        let unbounded = if divisor > 0.0 {
            1.0 / divisor
        } else {
            f64::INFINITY
        };
        return Ratio {
            value: scale * STIFFEST,
            change: 0.0,
            by_compliance: 0.0,
            limited: Some(Reached {
                unbounded,
                used: STIFFEST,
            }),
        };
    }
    let q = 1.0 / divisor;
    Ratio {
        value: scale * q,
        change: -scale * q * q * product * growth,
        by_compliance: -scale * q * q,
        limited: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the two terms of the series, added by hand.
    #[test]
    fn a_softer_organ_shares_the_depth() {
        let law = LinearElastic::new(1e4, 0.3).unwrap();
        let tip = Tip::Sphere { radius: 5e-3 };
        let depth = 1e-3;
        let half_space =
            half_space_stiffness(&law, tip.contact_radius(depth), Friction::Frictionless);
        let sphere = TipLaw::linear(tip, Friction::Frictionless, law);
        let same = sphere.normal_force(depth, half_space).force;
        let on_half_space = |depth: f64| sphere.on_half_space(depth).0;
        assert!((same / on_half_space(depth) - 1.0).abs() < 1e-12);

        let softer = sphere.normal_force(depth, 0.9 * half_space).force;
        let structural = (1.0 / 0.9 - 1.0) / half_space * softer;
        assert!((softer / on_half_space(depth - structural) - 1.0).abs() < 1e-12);
        assert!(softer < same);
    }

    /// Judge: linear tissue is a matrix of compliances, solved at once.
    #[test]
    fn a_linear_tip_is_in_series_with_the_organ() {
        let law = LinearElastic::new(1e4, 0.3).unwrap();
        let flat = TipLaw::linear(Tip::Flat { radius: 1e-3 }, Friction::Bonded, law);
        let normal = half_space_stiffness(&law, 1e-3, Friction::Bonded);
        let tangential = half_space_tangential_stiffness(&law, 1e-3);
        let own = Vec3::new(1.0 / tangential, 1.0 / tangential, 1.0 / normal);
        let compliance = Matrix3::new(8.0, 0.3, 1.0, 0.3, 9.0, -2.0, 1.0, -2.0, 5.0) * 1e-3;
        let all = compliance + Matrix3::from_diagonal(&own);
        let displacement = Vec3::new(3e-4, -1e-4, -1e-3);
        let expected = all.try_inverse().unwrap();
        let found = flat.force_in_series(&displacement, &compliance);
        // Rounding.
        assert!((found.stiffness - expected).norm() < 1e-12 * expected.norm());
        assert!((found.force + expected * displacement).norm() < 1e-12 * found.force.norm());
        assert!(found.limits.is_empty());
    }
}
