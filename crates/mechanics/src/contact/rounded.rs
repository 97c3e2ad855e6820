//! Punches and cones that are rounded, pressed without friction into a half-space [Sneddon 1965].
//!
//! With the slope f'(r) of a body of revolution, a contact of radius a has the depth and the force
//!   d = a ∫ f'(a sin θ) dθ,  F = 2 E/(1 − ν²) a² ∫ f'(a sin θ) sin²θ dθ,  θ from 0 to π/2.
//!
//! *How we know*: `tests::…` (a sphere's closed form, a sharp cone's, dF/dd = 2 a E/(1 − ν²)).

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use crate::LinearElastic;
use crate::gauss::gauss_points;

/// A body of revolution that begins flat and ends steep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RoundedProfile {
    /// The flat end of a cylinder with a rounded edge.
    Punch {
        /// Radius of the cylinder [m].
        radius: f64,
        /// Radius of its edge [m], at most that of the cylinder.
        edge_radius: f64,
    },
    /// A cone with a rounded apex.
    Cone {
        /// Angle between its axis and its side [rad], above 0 and below π/2.
        half_angle: f64,
        /// Radius of its apex [m].
        apex_radius: f64,
    },
}

/// Points of Gauss on each side of the circle where the profile begins or ends to be round.
const POINTS: usize = 48;

impl RoundedProfile {
    /// Slope of the profile at the radius `r` [-].
    fn slope(&self, r: f64) -> f64 {
        let arc = |x: f64, radius: f64| x / (radius * radius - x * x).sqrt();
        match *self {
            Self::Punch { edge_radius, .. } if r > self.transition() => {
                arc(r - self.transition(), edge_radius)
            }
            Self::Punch { .. } => 0.0,
            Self::Cone { apex_radius, .. } if r < self.transition() => arc(r, apex_radius),
            Self::Cone { half_angle, .. } => 1.0 / half_angle.tan(),
        }
    }

    /// Radius of the circle where the curvature jumps [m].
    fn transition(&self) -> f64 {
        match *self {
            Self::Punch {
                radius,
                edge_radius,
            } => radius - edge_radius,
            Self::Cone {
                half_angle,
                apex_radius,
            } => apex_radius * half_angle.cos(),
        }
    }

    /// The depth [m] of a contact of the radius `a` [m], and its force over 2 E/(1 − ν²) [m²].
    fn of_contact(&self, a: f64) -> (f64, f64) {
        let middle = (self.transition() / a).min(1.0).asin();
        let mut sums = (0.0, 0.0);
        for (from, to) in [(0.0, middle), (middle, FRAC_PI_2)] {
            for (x, weight) in gauss_points(POINTS) {
                let sine = (from + x * (to - from)).sin();
                let part = weight * (to - from) * self.slope(a * sine);
                sums.0 += part;
                sums.1 += part * sine * sine;
            }
        }
        (a * sums.0, a * a * sums.1)
    }

    /// Radius of the contact at `depth` [m].
    pub fn contact_radius(&self, depth: f64) -> f64 {
        let (mut low, mut high) = match *self {
            Self::Punch { radius, .. } => (self.transition(), radius),
            // The apex is blunter than the side, so that a sharp cone touches less, and a longer one more.
            Self::Cone {
                half_angle,
                apex_radius,
            } => {
                let cut = apex_radius * (1.0 / half_angle.sin() - 1.0);
                let sharp = |depth: f64| FRAC_2_PI * depth * half_angle.tan();
                (0.0, sharp(depth + cut) + apex_radius)
            }
        };
        if depth <= 0.0 {
            return low;
        }
        // To the last bit but a few.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match self.of_contact(middle).0 < depth {
                true => low = middle,
                false => high = middle,
            }
        }
        0.5 * (low + high)
    }
}

/// The force [N] of a rounded body without friction at `depth` [m] in a half-space.
pub fn rounded_force(law: &LinearElastic, profile: &RoundedProfile, depth: f64) -> f64 {
    if depth <= 0.0 {
        return 0.0;
    }
    let nu = law.poissons_ratio();
    let modulus = law.youngs_modulus() / (1.0 - nu * nu);
    2.0 * modulus * profile.of_contact(profile.contact_radius(depth)).1
}

#[cfg(test)]
mod tests {
    use super::super::sneddon_force;
    use super::*;

    fn law() -> LinearElastic {
        LinearElastic::new(1e4, 0.3).unwrap()
    }

    const MODULUS: f64 = 1e4 / (1.0 - 0.09);

    /// Judge: the closed form of a sphere of radius R [Sneddon 1965], d = a/2 ln((R + a)/(R − a)) and
    /// F = E*/2 ((a² + R²) ln((R + a)/(R − a)) − 2 a R), to the rounding of the bisection.
    #[test]
    fn a_punch_that_is_all_edge_is_a_sphere() {
        let radius: f64 = 0.01;
        let profile = RoundedProfile::Punch {
            radius,
            edge_radius: radius,
        };
        for part in [0.05, 0.3, 0.7] {
            let a: f64 = part * radius;
            let log = ((radius + a) / (radius - a)).ln();
            let depth = 0.5 * a * log;
            let force = 0.5 * MODULUS * ((a * a + radius * radius) * log - 2.0 * a * radius);
            assert!((profile.contact_radius(depth) / a - 1.0).abs() < 1e-9);
            assert!((rounded_force(&law(), &profile, depth) / force - 1.0).abs() < 1e-9);
        }
    }

    /// Judge: the sharp cone, which a rounded one becomes with the square of apex over contact.
    #[test]
    fn a_cone_that_is_hardly_rounded_is_sharp() {
        let (half_angle, depth) = (1.2, 1e-3);
        let off = [1e-4, 1e-5].map(|apex_radius| {
            let profile = RoundedProfile::Cone {
                half_angle,
                apex_radius,
            };
            let force = rounded_force(&law(), &profile, depth);
            force / sneddon_force(&law(), half_angle, depth) - 1.0
        });
        println!("{off:?}");
        assert!(off[1].abs() < 1e-2 && off[1].abs() < 0.2 * off[0].abs());
    }

    /// Judge: the work of a contact, dF/dd = 2 a E/(1 − ν²), which holds for every profile; differences of the force are
    /// exact to the square of their step.
    #[test]
    fn force_grows_with_the_radius_of_the_contact() {
        for profile in [
            RoundedProfile::Punch {
                radius: 5e-3,
                edge_radius: 1e-3,
            },
            RoundedProfile::Cone {
                half_angle: 1.2,
                apex_radius: 1e-3,
            },
        ] {
            for depth in [2e-4, 1e-3, 3e-3] {
                let step = 1e-3 * depth;
                let [up, down] =
                    [depth + step, depth - step].map(|at| rounded_force(&law(), &profile, at));
                let slope = (up - down) / (2.0 * step);
                let expected = 2.0 * MODULUS * profile.contact_radius(depth);
                assert!(
                    (slope / expected - 1.0).abs() < 1e-5,
                    "{profile:?} {depth}: {slope} {expected}"
                );
            }
        }
    }

    #[test]
    fn what_does_not_touch_has_no_force() {
        let profile = RoundedProfile::Punch {
            radius: 5e-3,
            edge_radius: 1e-3,
        };
        assert_eq!(rounded_force(&law(), &profile, -1e-3), 0.0);
        assert_eq!(profile.contact_radius(0.0), 4e-3);
    }
}
