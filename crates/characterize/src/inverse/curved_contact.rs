//! A sphere or a cone on a curved surface.
//!
//! Near the contact the gap between indenter and organ decides: that of the indenter on a plane and κ r²/2 more, κ the mean
//! curvature of the organ, positive where it bulges out. At small strain depth and force follow from the gap and the radius
//! a of the contact [Sneddon 1965]. So at each force the depth on the organ follows from that on a plane, of every law.
//! Where the organ curves unequally, a pair of circular bodies with as much force stands for the pair [Hertz 1881].
//!
//! *How we know*: Hertz's integrals, here; `organ::…`: a hemisphere by axisymmetric elements at finite strain.

use std::f64::consts::FRAC_PI_2;

use palpate_mechanics::finite_elements::indentation::{Indenter, IndenterShape};

use crate::Error;

/// A round indenter where an organ has a mean curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CurvedContact {
    shape: Round,
    curvature: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Round {
    Sphere {
        radius: f64,
    },
    /// Its profile rises by this much for each length [-].
    Cone {
        slope: f64,
    },
}

/// Least curvature of the gap relative to that on a plane [-]: in a hollow that fits closer the contact is no small part of
/// the sphere.
const MIN_CURVATURE: f64 = 0.25;
/// The same under a cone: at 0.55 the force that a plane gives at the deepest contact is reached at no depth, for the force
/// in the gap, π/2 t a² − 4/3 κ a³ with its slope t, is largest at a = π t/(4 κ).
const MIN_CURVATURE_OF_CONE: f64 = 0.6;
/// By what part of the squared inequality q of the curvatures of the gap, (κ₁ − κ₂)/(κ₁ + κ₂), a pair of unequal ones is
/// stiffer than a circular pair of the same mean [-], to second order of q [Hertz 1881].
const UNEQUAL: f64 = 1.0 / 3.0;

impl CurvedContact {
    /// Of `indenter`; none of a flat one, which is as wide on every organ. `curvatures` are the principal ones of the
    /// organ [1/m], `radius` that of the deepest contact [m].
    ///
    /// # Errors
    /// When the organ is too hollow for it.
    pub(super) fn of(
        indenter: &Indenter,
        curvatures: [f64; 2],
        radius: f64,
    ) -> Result<Option<Self>, Error> {
        let shape = match indenter.shape {
            IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. } => return Ok(None),
            IndenterShape::Sphere => Round::Sphere {
                radius: indenter.radius,
            },
            IndenterShape::Cone { half_angle, .. } => Round::Cone {
                slope: 1.0 / half_angle.tan(),
            },
        };
        let (own, part) = match shape {
            Round::Sphere { radius } => (1.0 / radius, MIN_CURVATURE),
            Round::Cone { slope } => (slope / radius, MIN_CURVATURE_OF_CONE),
        };
        let least = curvatures[0].min(curvatures[1]);
        if own + least < part * own {
            return Err(Error::OrganTooHollow {
                radius: -1.0 / least,
                least: 1.0 / ((1.0 - part) * own),
            });
        }
        let mean = own + 0.5 * (curvatures[0] + curvatures[1]);
        let unequal = 0.5 * (curvatures[0] - curvatures[1]) / mean;
        // The force of a sphere goes with the root of its radius.
        let curvature = mean / (1.0 + UNEQUAL * unequal.powi(2)).powi(2) - own;
        Ok(Some(Self { shape, curvature }))
    }

    /// Depth on the organ [m] at the force on a plane at `depth` [m].
    pub(super) fn depth(&self, depth: f64) -> f64 {
        self.depth_at_force_of(&self.on_plane(), depth)
    }

    /// Depth on a plane [m] at the force on the organ at `depth` [m].
    pub(super) fn depth_on_plane(&self, depth: f64) -> f64 {
        self.on_plane().depth_at_force_of(self, depth)
    }

    fn on_plane(&self) -> Self {
        Self {
            curvature: 0.0,
            ..*self
        }
    }

    /// Depth [m] at the force that `other` has at `depth` [m].
    fn depth_at_force_of(&self, other: &Self, depth: f64) -> f64 {
        let force = other.force_of(other.radius_at(depth, Self::depth_of));
        self.depth_of(self.radius_at(force, Self::force_of))
    }

    /// Change of the depth on the organ with that on a plane [-].
    pub(super) fn depth_slope(&self, depth: f64) -> f64 {
        let step = 1e-4 * depth;
        (self.depth(depth + step) - self.depth(depth - step)) / (2.0 * step)
    }

    /// Relative change of the force with that of the depth, at small strain [-].
    pub(super) fn exponent(&self) -> f64 {
        match self.shape {
            Round::Sphere { .. } => 1.5,
            Round::Cone { .. } => 2.0,
        }
    }

    /// Depth at which the contact has a radius `a` [m] [Sneddon 1965].
    fn depth_of(&self, a: f64) -> f64 {
        let of_indenter = match self.shape {
            Round::Sphere { radius } => a * (a / radius).atanh(),
            Round::Cone { slope } => FRAC_PI_2 * slope * a,
        };
        of_indenter + self.curvature * a * a
    }

    /// Force at that radius over E/(1 − ν²) [m²].
    fn force_of(&self, a: f64) -> f64 {
        let of_indenter = match self.shape {
            // (a² + R²) artanh(a/R) − a R, without the difference of nearly equal numbers.
            Round::Sphere { radius } => {
                let x = a / radius;
                match x < 0.1 {
                    true => {
                        let terms = (1..6).map(|k| {
                            let k = f64::from(k);
                            x.powf(2.0 * k + 1.0) * (1.0 / (2.0 * k - 1.0) + 1.0 / (2.0 * k + 1.0))
                        });
                        radius * radius * terms.sum::<f64>()
                    }
                    false => (a * a + radius * radius) * x.atanh() - a * radius,
                }
            }
            Round::Cone { slope } => FRAC_PI_2 * slope * a * a,
        };
        of_indenter + 4.0 / 3.0 * self.curvature * a.powi(3)
    }

    /// The radius of the contact [m] at which a quantity that grows with it has a `value`, by bisection.
    fn radius_at(&self, value: f64, of: fn(&Self, f64) -> f64) -> f64 {
        let mut outer = match self.shape {
            Round::Sphere { radius } => radius * (1.0 - 1e-12),
            // Beyond it the quantity falls, in a hollow.
            Round::Cone { slope } if self.curvature < 0.0 => {
                0.25 * std::f64::consts::PI * slope / -self.curvature
            }
            Round::Cone { slope } => {
                let of_cone = value / (FRAC_PI_2 * slope);
                of_cone.max(of_cone.sqrt())
            }
        };
        let mut inner = 0.0;
        for _ in 0..100 {
            let middle = 0.5 * (inner + outer);
            match of(self, middle) < value {
                true => inner = middle,
                false => outer = middle,
            }
        }
        0.5 * (inner + outer)
    }
}

#[cfg(test)]
mod tests {
    use palpate_mechanics::contact::FrictionLaw;

    use super::*;

    const RADIUS: f64 = 5e-3;

    fn sphere() -> Indenter {
        Indenter {
            shape: IndenterShape::Sphere,
            radius: RADIUS,
            face: FrictionLaw::Frictionless,
        }
    }

    /// Complete elliptic integrals of the first and second kind by the arithmetic-geometric mean.
    fn elliptic(parameter: f64) -> [f64; 2] {
        let (mut a, mut b, mut c) = (1.0, (1.0 - parameter).sqrt(), parameter.sqrt());
        let (mut sum, mut power) = (0.5 * c * c, 1.0);
        while c > 1e-15 {
            (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
            sum += power * c * c;
            power *= 2.0;
        }
        let first = FRAC_PI_2 / a;
        [first, first * (1.0 - sum)]
    }

    /// Depth at a unit force over that of two circular bodies, by the integrals of Hertz, where the curvatures of the
    /// gap are 1 − q and 1 + q.
    fn hertz(unequal: f64) -> f64 {
        let ratio = |parameter: f64| {
            let [first, second] = elliptic(parameter);
            (second / (1.0 - parameter) - first) / (first - second)
        };
        let wanted = (1.0 + unequal) / (1.0 - unequal);
        let [mut low, mut high] = [1e-6, 1.0 - 1e-9];
        for _ in 0..100 {
            let middle: f64 = 0.5 * (low + high);
            match ratio(middle) < wanted {
                true => low = middle,
                false => high = middle,
            }
        }
        let [first, second] = elliptic(low);
        // Of the longer half axis at a depth of one, then of the force there.
        let axis = (2.0 / (1.0 - unequal) * (first - second) / (first * low)).sqrt();
        let force = std::f64::consts::TAU / 3.0 * axis / first;
        (force / (4.0 / 3.0)).powf(-2.0 / 3.0)
    }

    /// Judge: Hertz's integrals. Tolerance: the fourth power of the inequality, with the factor 0.2 of the series.
    #[test]
    fn unequal_curvatures_are_as_stiff_as_hertz_has_it() {
        // A sphere on a cylinder, a saddle and a hollow on one side.
        for curvatures in [[0.1, 0.0], [0.2, -0.2], [0.3, -0.1]].map(|k| k.map(|k| k / RADIUS)) {
            let depth = 1e-6 * RADIUS;
            let contact = CurvedContact::of(&sphere(), curvatures, 1e-3 * RADIUS);
            let ours = contact.unwrap().unwrap().depth(depth) / depth;
            let mean = 1.0 + 0.5 * RADIUS * (curvatures[0] + curvatures[1]);
            let unequal = 0.5 * RADIUS * (curvatures[0] - curvatures[1]) / mean;
            let theirs = hertz(unequal) * mean.cbrt();
            let off = (ours / theirs - 1.0).abs();
            assert!(
                off < 0.2 * unequal.powi(4) + 1e-5,
                "{curvatures:?}: {ours} {theirs}"
            );
        }
    }

    #[test]
    fn depths_on_plane_and_organ_are_inverse() {
        let cone = Indenter {
            shape: IndenterShape::Cone {
                half_angle: 1.2,
                apex_radius: 0.0,
            },
            ..sphere()
        };
        for indenter in [sphere(), cone] {
            for curvature in [30.0, -20.0] {
                let contact = CurvedContact::of(&indenter, [curvature; 2], 0.5 * RADIUS);
                let contact = contact.unwrap().unwrap();
                let depth = 0.3 * RADIUS;
                let back = contact.depth_on_plane(contact.depth(depth));
                assert!((back / depth - 1.0).abs() < 1e-9, "{contact:?} {back}");
                assert_eq!(contact.depth(depth) > depth, curvature > 0.0);
            }
        }
    }

    /// In the closest hollow that is fitted, a cone still reaches the force that a plane gives.
    #[test]
    fn a_cone_in_the_closest_hollow_is_inverted() {
        let (half_angle, radius) = (1.2_f64, 0.5 * RADIUS);
        let slope = 1.0 / half_angle.tan();
        let cone = Indenter {
            shape: IndenterShape::Cone {
                half_angle,
                apex_radius: 0.0,
            },
            ..sphere()
        };
        let closest = -0.399 * slope / radius;
        let contact = CurvedContact::of(&cone, [closest; 2], radius);
        let contact = contact.unwrap().unwrap();
        let depth = FRAC_PI_2 * slope * radius;
        let back = contact.depth_on_plane(contact.depth(depth));
        assert!((back / depth - 1.0).abs() < 1e-9, "{back} {depth}");
        assert!(CurvedContact::of(&cone, [1.01 * closest; 2], radius).is_err());
    }

    #[test]
    fn a_close_hollow_is_refused() {
        let refused = CurvedContact::of(&sphere(), [0.0, -0.8 / RADIUS], 0.1 * RADIUS);
        let sentence = refused.unwrap_err().to_string();
        assert!(sentence.contains("6.250 mm"), "{sentence}");
    }
}
