use std::f64::consts::FRAC_2_PI;

use super::super::mismatch::Mismatch;
use crate::contact::FrictionLaw;

/// What the side of a flat punch does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// Touches, with this friction.
    Touches(FrictionLaw),
    /// Is not there: right only until tissue would enter the punch.
    Absent,
}

/// The part of an indenter that meets the tissue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum IndenterShape {
    /// The flat end of a cylinder, with a sharp edge.
    Flat {
        /// What its side does.
        side: Side,
    },
    /// A sphere.
    Sphere,
    /// A cone with a sharp apex.
    Cone {
        /// Angle between its axis and its side [rad], above 0 and below π/2.
        half_angle: f64,
    },
}

/// A rigid indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indenter {
    /// Its shape.
    pub shape: IndenterShape,
    /// Radius of the cylinder, of the sphere, or of the base of the cone, which tissue must not reach [m].
    pub radius: f64,
    /// What its face, the sphere or the cone does.
    pub face: FrictionLaw,
}

impl Indenter {
    pub(super) fn check(&self) -> Result<(), Mismatch> {
        let impossible = |coefficient: &f64| !(coefficient.is_finite() && *coefficient >= 0.0);
        match self.coefficients().find(impossible) {
            Some(coefficient) => Err(Mismatch::FrictionOutOfRange { coefficient }),
            None => Ok(()),
        }
    }

    /// Radius of the touched circle at `depth` on a half-space, at small strain [m]: of a sphere [Hertz 1881], of a
    /// cone [Sneddon 1965].
    pub fn contact_radius(&self, depth: f64) -> f64 {
        match self.shape {
            IndenterShape::Flat { .. } => self.radius,
            IndenterShape::Sphere => (self.radius * depth).sqrt().min(self.radius),
            IndenterShape::Cone { half_angle } => FRAC_2_PI * depth * half_angle.tan(),
        }
    }

    /// The length that meshes and steps of a run to the depth `deepest` [m] are made for [m].
    pub(super) fn scale(&self, deepest: f64) -> f64 {
        match deepest > 0.0 {
            true => self.contact_radius(deepest),
            false => self.radius,
        }
    }
}
