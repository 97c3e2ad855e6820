//! Contact of a rigid tip: the closed forms of the half-space.
//!
//! Flat tip of radius a, depth d: slip F = 2 a E d / (1 − ν²) (6.1); stick (bonded)
//! F = 4 G a d ln(3 − 4ν) / (1 − 2ν) [Spence 1968]; tangential 8 G a u / (2 − ν) [Mindlin 1949].
//! Sphere of radius ρ: F = 4/3 E/(1 − ν²) √ρ d^(3/2) [Hertz 1881].
//!
//! *How we know*: `analytic::flat_tip_is_linear_in_depth`, `analytic::sphere_is_hertz`.
//!
//! *Limits*: the side of a flat tip does not touch; a surface that is curved otherwise in one direction than in the other
//! touches as one of the mean curvature; a sphere that sticks has the normal force of one
//! that slips (they differ by under 2 % at ν ≥ 0.3 [Spence 1975]).

mod rounded;

pub use rounded::{RoundedProfile, rounded_force};

use std::f64::consts::FRAC_2_PI;

use crate::LinearElastic;

/// The end of a tool that touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tip {
    /// A flat face of this radius [m].
    Flat {
        /// Radius of the face [m].
        radius: f64,
    },
    /// A sphere of this radius [m].
    Sphere {
        /// Radius of the sphere [m].
        radius: f64,
    },
}

/// The tangential boundary condition of a rigid surface that touches tissue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Friction {
    /// Tissue stays where it was first touched: the surface carries it along.
    Bonded,
    /// Tissue slides: no tangential force.
    Frictionless,
}

/// The law of friction between tissue and an indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionLaw {
    /// As [`Friction::Bonded`].
    Bonded,
    /// As [`Friction::Frictionless`].
    Frictionless,
    /// Coulomb's, with this coefficient μ [-], finite and not negative: tissue sticks where the tangential force is below μ
    /// times the normal force, and slips where it is equal to that.
    Coulomb(f64),
}

impl From<Friction> for FrictionLaw {
    fn from(friction: Friction) -> Self {
        match friction {
            Friction::Bonded => Self::Bonded,
            Friction::Frictionless => Self::Frictionless,
        }
    }
}

/// Force per depth of a flat tip on a half-space [N/m].
pub fn half_space_stiffness(law: &LinearElastic, radius: f64, bond: Friction) -> f64 {
    let nu = law.poissons_ratio();
    match bond {
        Friction::Frictionless => 2.0 * radius * law.youngs_modulus() / (1.0 - nu * nu), // (6.1)
        Friction::Bonded => 4.0 * law.shear_modulus() * radius * bonded_factor(nu),
    }
}

/// Tangential force per displacement of a bonded flat tip on a half-space [N/m].
pub fn half_space_tangential_stiffness(law: &LinearElastic, radius: f64) -> f64 {
    8.0 * law.shear_modulus() * radius / (2.0 - law.poissons_ratio())
}

/// Hertz's force [N] of a sphere of `radius` [m] at `depth` [m] in a half-space.
pub fn hertz_force(law: &LinearElastic, radius: f64, depth: f64) -> f64 {
    let nu = law.poissons_ratio();
    4.0 / 3.0 * law.youngs_modulus() / (1.0 - nu * nu) * radius.sqrt() * depth.max(0.0).powf(1.5)
}

/// The force [N] of a cone without friction, `half_angle` [rad] between its axis and its side, at `depth` [m] in a
/// half-space: (2/π) E/(1 − ν²) tan α d² [Sneddon 1965].
pub fn sneddon_force(law: &LinearElastic, half_angle: f64, depth: f64) -> f64 {
    let nu = law.poissons_ratio();
    let modulus = law.youngs_modulus() / (1.0 - nu * nu);
    FRAC_2_PI * modulus * half_angle.tan() * depth.max(0.0).powi(2)
}

/// ln(3 − 4ν)/(1 − 2ν), which is 0/0 at ν = ½ and 2 in the limit.
fn bonded_factor(nu: f64) -> f64 {
    let away = 1.0 - 2.0 * nu;
    if away < 1e-6 {
        2.0 - 2.0 * away
    } else {
        (2.0 * away).ln_1p() / away
    }
}

/// Least curvature of a sphere relative to the hollow that it is pressed into, in parts of its own [-]: Hertz's
/// surfaces touch in a small part of theirs.
const MIN_CURVATURE: f64 = 0.25;

impl Tip {
    /// The tip that touches a plane as this one touches a surface of the mean curvature `curvature` [1/m], positive
    /// where it bulges out: a sphere of the radius 1/(1/ρ + κ) [Hertz 1881], at most four times its own.
    pub fn on_curved_surface(&self, curvature: f64) -> Self {
        match *self {
            Self::Flat { .. } => *self,
            Self::Sphere { radius } => Self::Sphere {
                radius: radius / (1.0 + radius * curvature).max(MIN_CURVATURE),
            },
        }
    }

    /// Radius of the touching area [m] at `depth` [m].
    pub fn contact_radius(&self, depth: f64) -> f64 {
        match *self {
            Self::Flat { radius } => radius,
            Self::Sphere { radius } => (radius * depth.max(0.0)).sqrt().min(radius),
        }
    }

    /// Relative change of that radius with depth, (da/dd)/a [1/m].
    pub fn contact_radius_growth(&self, depth: f64) -> f64 {
        match *self {
            Self::Sphere { radius } if depth > 0.0 && depth < radius => 0.5 / depth,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonded_meets_slipping_when_incompressible() {
        let law = LinearElastic::new(1e4, 0.499_999_99).unwrap();
        let stick = half_space_stiffness(&law, 1e-3, Friction::Bonded);
        let slip = half_space_stiffness(&law, 1e-3, Friction::Frictionless);
        // Both tend to 8 G a; the difference is of the order of 1 − 2ν.
        assert!((stick / slip - 1.0).abs() < 1e-7);
    }
}
