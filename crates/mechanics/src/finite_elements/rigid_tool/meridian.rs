//! Distances to bodies of revolution, in a half-plane through their axis.

use super::shape::{RigidDistance, RigidShape};
use crate::Vec3;

/// Signed distance of a point of the half-plane to a surface of revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct MeridianDistance {
    /// Signed distance [m], positive outside.
    pub(in super::super) distance: f64,
    /// Its gradient [-]: radial and axial component.
    pub(in super::super) normal: [f64; 2],
    /// Curvature of the level line of the distance through the point, in the half-plane [1/m].
    pub(in super::super) curvature: f64,
}

impl RigidShape {
    /// Signed distance of the point at radius `r` and height `z` [m] of its frame, if it is a body of revolution about
    /// the third axis.
    pub(in super::super) fn meridian(&self, r: f64, z: f64) -> Option<MeridianDistance> {
        match *self {
            Self::Sphere { radius } => Some(MeridianDistance::around(r, z).rounded(radius)),
            Self::FlatPunch {
                radius,
                edge_radius,
            } => {
                let (out, below) = (r - (radius - edge_radius), edge_radius - z);
                let core = if out > 0.0 && below > 0.0 {
                    MeridianDistance::around(out, -below)
                } else if out > below {
                    MeridianDistance::straight(out, [1.0, 0.0])
                } else {
                    MeridianDistance::straight(below, [0.0, -1.0])
                };
                Some(core.rounded(edge_radius))
            }
            Self::Cone {
                half_angle,
                apex_radius,
            } => {
                let (sine, cosine) = half_angle.sin_cos();
                let up = z - apex_radius;
                let core = if r * sine + up * cosine < 0.0 {
                    MeridianDistance::around(r, up)
                } else {
                    MeridianDistance::straight(r * cosine - up * sine, [cosine, -sine])
                };
                Some(core.rounded(apex_radius))
            }
            Self::Plate => Some(MeridianDistance::straight(-z, [0.0, -1.0])),
            Self::Cylinder { .. } | Self::Bar { .. } => None,
        }
    }
}

impl MeridianDistance {
    /// To a straight line.
    pub(in super::super) fn straight(distance: f64, normal: [f64; 2]) -> Self {
        Self {
            distance,
            normal,
            curvature: 0.0,
        }
    }

    /// To a point, from which this one is `r` and `z` [m] away.
    fn around(r: f64, z: f64) -> Self {
        let distance = r.hypot(z);
        if distance == 0.0 {
            return Self::straight(0.0, [0.0, -1.0]);
        }
        Self {
            distance,
            normal: [r / distance, z / distance],
            curvature: 1.0 / distance,
        }
    }

    /// To all within `radius` [m].
    fn rounded(self, radius: f64) -> Self {
        Self {
            distance: self.distance - radius,
            ..self
        }
    }

    /// Components of a vector (r, z) along the normal and along the tangent (−n_z, n_r).
    pub(in super::super) fn components(&self, vector: [f64; 2]) -> [f64; 2] {
        let (n, [r, z]) = (self.normal, vector);
        [n[0] * r + n[1] * z, n[0] * z - n[1] * r]
    }

    /// Around the third axis, at `point`.
    pub(super) fn turned_about_axis(&self, point: &Vec3) -> RigidDistance {
        let out = point.x.hypot(point.y);
        let [away, up] = self.normal;
        let outward = match out > 0.0 {
            true => Vec3::new(point.x / out, point.y / out, 0.0),
            false => Vec3::x(),
        };
        let around = Vec3::z().cross(&outward);
        let along = away * Vec3::z() - up * outward;
        let hoop = match out > 0.0 {
            true => away / out,
            // On the axis a smooth surface bends alike in all directions, and a sharp one not at all.
            false if away == 0.0 => self.curvature,
            false => 0.0,
        };
        RigidDistance {
            distance: self.distance,
            normal: away * outward + up * Vec3::z(),
            curvature: self.curvature * along * along.transpose()
                + hoop * around * around.transpose(),
        }
    }
}
