use std::f64::consts::{FRAC_2_PI, PI};

use super::interpolation::{Interpolation, SurfacePoint, alike, smooth_step};
use crate::Vec3;
use crate::contact::Tip;
use crate::finite_spheres::quartic;

/// Reach of a dimple's closed form, in radii of influence and in radii of the tip: wide enough that what it
/// leaves is smooth on the coarse mesh [-].
const REACH: f64 = 2.0;

/// How far over a coarse triangle a curved or finer surface may lie, in radii of influence [-].
const CURVED: f64 = 0.25;

/// A tip in contact: its contact point, shape and displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// The contact point at rest.
    pub at: SurfacePoint,
    /// The tip that touches.
    pub tip: Tip,
    /// Displacement of the contact point [m].
    pub displacement: Vec3,
    /// Its half-space part [m]: the dimple, which the coarse triangles do not resolve.
    pub own: Vec3,
}

/// The surface of a half-space at `distance` [m] from the middle of a tip whose contact has `radius` [m], in
/// parts of the displacement there [-]: a flat punch, or a sphere [Johnson 1985].
pub fn profile(tip: &Tip, radius: f64, distance: f64) -> f64 {
    let outward = distance / radius;
    match tip {
        Tip::Flat { .. } if outward <= 1.0 => 1.0,
        Tip::Flat { .. } => FRAC_2_PI * outward.recip().asin(),
        Tip::Sphere { .. } if outward <= 1.0 => 1.0 - 0.5 * outward * outward,
        Tip::Sphere { .. } => {
            let square = outward * outward;
            ((2.0 - square) * outward.recip().asin() + (square - 1.0).sqrt()) / PI
        }
    }
}

/// The closed form of a press, faded out so that it ends on its side of the organ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dimple {
    place: Vec3,
    normal: Vec3,
    tip: Tip,
    /// Radius of the contact [m].
    radius: f64,
    /// Nothing is left at this distance from the contact [m].
    reach: f64,
    /// A point this far below or above the contact is still at it [m].
    height_tolerance: f64,
}

impl Dimple {
    /// `influence` is the nodes' radius there [m].
    pub(super) fn new(interpolation: &Interpolation, press: &Press, influence: f64) -> Self {
        let normal = interpolation.normal(&press.at);
        let radius = press.tip.contact_radius(press.displacement.norm());
        Self {
            place: interpolation.place(&press.at),
            normal,
            tip: press.tip,
            radius,
            reach: REACH * (influence + radius),
            height_tolerance: radius.hypot(CURVED * influence),
        }
    }

    /// Part of the contact's displacement at `place` [m] with the unit `normal` [-].
    pub(super) fn at(&self, place: &Vec3, normal: &Vec3) -> f64 {
        let away = place - self.place;
        let distance = away.norm();
        if distance >= self.reach || self.radius <= 0.0 {
            return 0.0;
        }
        let beyond = (distance - self.radius).max(0.0) / (self.reach - self.radius);
        profile(&self.tip, self.radius, distance)
            * quartic(beyond)
            * alike(normal, &self.normal)
            * self.same_side(&away)
    }

    /// Whether a point lies on the same side as the contact rather than below it, as the far side of a
    /// lumen does, which faces the same way: one up to 30° down, zero from 60° on [-].
    fn same_side(&self, away: &Vec3) -> f64 {
        let down = away.dot(&self.normal);
        let square = away.norm_squared() + self.height_tolerance.powi(2);
        smooth_step(1.5 - 2.0 * down * down / square)
    }
}
