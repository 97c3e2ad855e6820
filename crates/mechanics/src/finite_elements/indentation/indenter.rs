use std::f64::consts::FRAC_2_PI;

use super::super::mismatch::Mismatch;
use super::super::supports::RigidSurface;
use super::contact::Part;
use crate::contact::{FrictionLaw, RoundedProfile};

/// The side of a flat punch.
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
        /// Its side.
        side: Side,
    },
    /// The flat end of a cylinder whose edge is rounded; face, edge and side are one surface.
    RoundedPunch {
        /// Radius of the edge [m], above 0 and below that of the cylinder.
        edge_radius: f64,
    },
    /// A sphere.
    Sphere,
    /// A cone.
    Cone {
        /// Angle between its axis and its side [rad], above 0 and below π/2.
        half_angle: f64,
        /// Radius to which its apex is rounded [m]; 0 is a sharp apex.
        apex_radius: f64,
    },
}

/// A rigid indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indenter {
    /// Its shape.
    pub shape: IndenterShape,
    /// Radius of the cylinder, of the sphere, or of the base of the cone, which tissue must not reach [m].
    pub radius: f64,
    /// Friction on its face, or on all of a shape without a sharp edge.
    pub face: FrictionLaw,
}

impl Indenter {
    pub(super) fn check(&self) -> Result<(), Mismatch> {
        let impossible = |coefficient: &f64| !(coefficient.is_finite() && *coefficient >= 0.0);
        if let Some(coefficient) = self.coefficients().find(impossible) {
            return Err(Mismatch::FrictionOutOfRange { coefficient });
        }
        match self.surface(Part::of(self.shape), 0.0) {
            RigidSurface::Revolved { shape, .. } if !shape.exists() => {
                Err(Mismatch::IndenterOutOfRange { shape })
            }
            _ => Ok(()),
        }
    }

    /// Radius of the touched circle at `depth` on a half-space, without friction and at small strain [m]: of a sphere
    /// [Hertz 1881], of a cone and of what is rounded [Sneddon 1965].
    pub fn contact_radius(&self, depth: f64) -> f64 {
        match (self.shape, self.rounded_profile()) {
            (_, Some(profile)) => profile.contact_radius(depth),
            (IndenterShape::Sphere, None) => (self.radius * depth).sqrt().min(self.radius),
            (IndenterShape::Cone { half_angle, .. }, None) => FRAC_2_PI * depth * half_angle.tan(),
            (IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. }, None) => self.radius,
        }
    }

    /// The profile of a punch or a cone that is rounded; none of another shape.
    pub fn rounded_profile(&self) -> Option<RoundedProfile> {
        match self.shape {
            IndenterShape::RoundedPunch { edge_radius } => Some(RoundedProfile::Punch {
                radius: self.radius,
                edge_radius,
            }),
            IndenterShape::Cone {
                half_angle,
                apex_radius,
            } if apex_radius > 0.0 => Some(RoundedProfile::Cone {
                half_angle,
                apex_radius,
            }),
            _ => None,
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
