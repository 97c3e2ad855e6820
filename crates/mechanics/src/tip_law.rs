//! The normal force of a tip on an organ, of linear tissue or not.
//!
//! On a half-space F(s) = r(s/a) F₀(s), where F₀ is the closed form at small strain, a the tip's radius
//! and r the tissue's [`Stiffening`]. An organ is not a half-space; its model finds a contact stiffness
//! k at small strain where the half-space has k₀. The difference is a compliance c = 1/k − 1/k₀ in
//! series: d = s + c F(s), solved by Newton's method, and dF/dd = F′/(1 + c F′) is the consistent
//! linearization that goes on to whoever foresees the force. Where the organ is the stiffer one (c < 0)
//! the series has no answer once F′ > −1/c; there F = (k/k₀) F(d), which is the same at small depth.
//!
//! *How we know*: `analytic::flat_tip_is_linear_in_depth`, `analytic::sphere_is_hertz`; of nonlinear
//! tissue against full runs on other bodies, `stiffening::…`.
//!
//! *Limits*: what surrounds the tip answers as at small strain.

use nalgebra::{Matrix2, Matrix3};

use crate::contact::{
    Bond, Tip, half_space_stiffness, half_space_tangential_stiffness, hertz_force,
};
use crate::finite_elements::indentation::Stiffening;
use crate::{LinearElastic, Material, Vec3};

/// How a tissue answers a tip.
#[derive(Debug, Clone, PartialEq)]
pub struct TipLaw {
    tip: Tip,
    bond: Bond,
    at_rest: LinearElastic,
    stiffening: Stiffening,
}

/// Force of a tip and its change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalForce {
    /// Force [N].
    pub force: f64,
    /// Change of the force with depth [N/m].
    pub stiffness: f64,
}

impl NormalForce {
    /// Of a tip that does not touch.
    pub const NONE: Self = Self {
        force: 0.0,
        stiffness: 0.0,
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
}

/// Newton steps of which none is expected to be needed.
const MOST_STEPS: usize = 50;

/// How many times as stiff as a half-space an organ can be [-]: an anchor right under the tip, of which no
/// model here knows the distance well.
const STIFFEST: f64 = 20.0;

impl TipLaw {
    /// A tissue that answers at every depth as at small strain.
    pub fn linear(tip: Tip, bond: Bond, at_rest: LinearElastic) -> Self {
        let stiffening = Stiffening::none();
        Self {
            tip,
            bond,
            at_rest,
            stiffening,
        }
    }

    /// A tissue with the stiffening that was found for this tip and bond.
    pub fn stiffening(tip: Tip, bond: Bond, tissue: &Material, stiffening: Stiffening) -> Self {
        Self {
            tip,
            bond,
            at_rest: tissue.at_rest,
            stiffening,
        }
    }

    /// Depth [m] down to which the stiffening is known; beyond, force goes on along its tangent.
    pub fn deepest(&self) -> f64 {
        self.stiffening.deepest() * self.radius()
    }

    /// Normal force at `depth` [m] where a flat tip of the same touching area meets the stiffness
    /// `stiffness` [N/m] at small strain.
    pub fn normal_force(&self, depth: f64, stiffness: f64) -> NormalForce {
        let area_radius = self.tip.contact_radius(depth);
        if depth <= 0.0 || area_radius == 0.0 {
            return NormalForce::NONE;
        }
        let half_space = half_space_stiffness(&self.at_rest, area_radius, self.bond);
        self.normal_force_before(depth, 1.0 / stiffness - 1.0 / half_space)
    }

    /// Normal force at `depth` [m] where the organ around the tip yields by `further` [m/N] more than a
    /// half-space does.
    pub fn normal_force_before(&self, depth: f64, further: f64) -> NormalForce {
        let area_radius = self.tip.contact_radius(depth);
        if depth <= 0.0 || area_radius == 0.0 {
            return NormalForce::NONE;
        }
        if further > 0.0 {
            return self.in_series(depth, further);
        }
        let half_space = half_space_stiffness(&self.at_rest, area_radius, self.bond);
        let here = self.on_half_space(depth);
        let times = 1.0 / (1.0 + further * half_space).max(1.0 / STIFFEST);
        NormalForce {
            force: times * here.force,
            stiffness: times * here.stiffness,
        }
    }

    /// The force on a tip that is displaced by `moved` [m] where the organ around it yields by `further`
    /// [m/N] more than a half-space does, both in the frame of the contact. With d = −moved, A the
    /// compliance along the surface and C the further one,
    ///
    /// ```text
    /// F_t = A⁻¹ (d_t − C_tn F_n),   A = 1/k_t + C_tt
    /// d_n − C_nt A⁻¹ d_t = s + (C_nn − C_nt A⁻¹ C_tn) F_n(s)
    /// ```
    pub fn force_before(&self, moved: &Vec3, further: &Matrix3<f64>) -> TipForce {
        let radius = self.tip.contact_radius(-moved.z);
        let along = match self.bond {
            Bond::Stick if radius > 0.0 => {
                let own = 1.0 / half_space_tangential_stiffness(&self.at_rest, radius);
                let all = further.fixed_view::<2, 2>(0, 0) + own * Matrix2::identity();
                all.try_inverse().unwrap_or_default()
            }
            _ => Matrix2::zeros(),
        };
        let down = further.fixed_view::<2, 1>(0, 2);
        let up = further.fixed_view::<1, 2>(2, 0);
        let sideways = -moved.xy();
        let depth = -moved.z - (up * along * sideways).x;
        let normal = self.normal_force_before(depth, further[(2, 2)] - (up * along * down).x);
        let tangential = along * (sideways - down * normal.force);

        let mut stiffness = Matrix3::zeros();
        let coupled = -along * down * normal.stiffness;
        stiffness[(2, 2)] = normal.stiffness;
        stiffness.fixed_view_mut::<2, 1>(0, 2).copy_from(&coupled);
        let back = -normal.stiffness * up * along;
        stiffness.fixed_view_mut::<1, 2>(2, 0).copy_from(&back);
        let beside = along - coupled * up * along;
        stiffness.fixed_view_mut::<2, 2>(0, 0).copy_from(&beside);
        TipForce {
            force: Vec3::new(tangential.x, tangential.y, normal.force),
            stiffness,
        }
    }

    /// Solves d = s + c F(s). F rises, so the root lies between 0 and d.
    fn in_series(&self, depth: f64, compliance: f64) -> NormalForce {
        let (mut low, mut high) = (0.0, depth);
        let mut s = depth;
        let mut here = self.on_half_space(s);
        for _ in 0..MOST_STEPS {
            let value = s + compliance * here.force - depth;
            if value > 0.0 {
                high = s;
            } else {
                low = s;
            }
            let newton = s - value / (1.0 + compliance * here.stiffness);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let step = (next - s).abs();
            s = next;
            here = self.on_half_space(s);
            if step <= 1e-14 * depth {
                break;
            }
        }
        NormalForce {
            stiffness: here.stiffness / (1.0 + compliance * here.stiffness),
            ..here
        }
    }

    /// Force on a half-space, r F₀, and its change.
    fn on_half_space(&self, depth: f64) -> NormalForce {
        let radius = self.radius();
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
        NormalForce {
            force: ratio * force,
            stiffness: ratio * stiffness + change / radius * force,
        }
    }

    fn radius(&self) -> f64 {
        match self.tip {
            Tip::Flat { radius } | Tip::Sphere { radius } => radius,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the two terms of the series, put together by hand.
    #[test]
    fn a_softer_organ_shares_the_depth() {
        let law = LinearElastic::new(1e4, 0.3).unwrap();
        let tip = Tip::Sphere { radius: 5e-3 };
        let depth = 1e-3;
        let half_space = half_space_stiffness(&law, tip.contact_radius(depth), Bond::Slip);
        let sphere = TipLaw::linear(tip, Bond::Slip, law);
        let hertz = hertz_force(&law, 5e-3, depth);
        let same = sphere.normal_force(depth, half_space);
        assert!((same.force / hertz - 1.0).abs() < 1e-12);

        let stiffness = 0.9 * half_space;
        let softer = sphere.normal_force(depth, stiffness).force;
        let back = (softer / hertz).powf(2.0 / 3.0) * depth;
        let further = (1.0 / 0.9 - 1.0) / half_space * softer;
        assert!((back + further - depth).abs() < 1e-12 * depth);
        assert!(softer < hertz);
    }

    /// Judge: central differences of the force, at a compliance that does not change with depth.
    #[test]
    fn stiffness_is_the_slope_of_the_force() {
        let law = LinearElastic::new(1e4, 0.45).unwrap();
        let flat = TipLaw::linear(Tip::Flat { radius: 1e-3 }, Bond::Stick, law);
        let half_space = half_space_stiffness(&law, 1e-3, Bond::Stick);
        for stiffness in [0.7 * half_space, 1.2 * half_space] {
            let at = |depth| flat.normal_force(depth, stiffness);
            let slope = (at(1.001e-3).force - at(0.999e-3).force) / 2e-6;
            assert!((at(1e-3).stiffness / slope - 1.0).abs() < 1e-9);
        }
    }

    fn further() -> Matrix3<f64> {
        Matrix3::new(8.0, 0.3, 1.0, 0.3, 9.0, -2.0, 1.0, -2.0, 5.0) * 1e-3
    }

    /// Judge: linear tissue is a matrix of compliances, solved at once.
    #[test]
    fn a_linear_tip_is_in_series_with_the_organ() {
        let law = LinearElastic::new(1e4, 0.3).unwrap();
        let flat = TipLaw::linear(Tip::Flat { radius: 1e-3 }, Bond::Stick, law);
        let normal = half_space_stiffness(&law, 1e-3, Bond::Stick);
        let tangential = half_space_tangential_stiffness(&law, 1e-3);
        let own = Vec3::new(1.0 / tangential, 1.0 / tangential, 1.0 / normal);
        let all = further() + Matrix3::from_diagonal(&own);
        let moved = Vec3::new(3e-4, -1e-4, -1e-3);
        let expected = all.try_inverse().unwrap();
        let found = flat.force_before(&moved, &further());
        // Rounding.
        assert!((found.stiffness - expected).norm() < 1e-12 * expected.norm());
        assert!((found.force + expected * moved).norm() < 1e-12 * found.force.norm());
    }

    /// Judge: central differences.
    #[test]
    fn the_stiffness_of_a_tip_is_the_slope_of_its_force() {
        let law = LinearElastic::new(1e4, 0.45).unwrap();
        let tissue = Material::from_tissue(
            &palpate_files::Tissue::parse(
                "format = 1\n[tissue]\ndensity_kg_m3 = 1000.0\nlaw = \"neo_hookean\"\nc10_pa = 1000.0",
                "tissue.toml",
            )
            .unwrap(),
        )
        .unwrap();
        let tip = Tip::Flat { radius: 1e-3 };
        let curve = Stiffening::neo_hookean(tip, Bond::Stick);
        for flat in [
            TipLaw::linear(tip, Bond::Stick, law),
            TipLaw::stiffening(tip, Bond::Stick, &tissue, curve),
        ] {
            let moved = Vec3::new(2e-4, 1e-4, -2e-3);
            let found = flat.force_before(&moved, &further()).stiffness;
            for axis in 0..3 {
                let step = 1e-8 * Vec3::ith(axis, 1.0);
                let ends = [step, -step].map(|by| flat.force_before(&(moved + by), &further()));
                let slope = -(ends[0].force - ends[1].force) / 2e-8;
                let off = (slope - found.column(axis)).norm() / found.norm();
                // Second differences of a step of 10 nm in 2 mm.
                assert!(off < 1e-6, "{axis}: {off}");
            }
        }
    }
}
