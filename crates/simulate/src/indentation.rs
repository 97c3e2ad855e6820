//! A motion that indents an organ with a tip along its normal, as deep as an indenter indented a specimen.
//!
//! At depth d the tip's reference point, the centre of a flat face or of a sphere of radius r, is at x + (r − d) n or x
//! − d n: x is a point of the organ at rest and n its outward normal there, averaged over the tip.
//!
//! *How we know*: `indentation::…`: the session's depth is the requested one.
//!
//! *Limits*: where the organ is thin, or its surface turns within a few radii of the tip, the contact depth is not the
//! depth along the normal; a session records it.

use palpate_files::motion::{MotionRow, ToolMotion};
use palpate_files::{Motion, Pose};
use palpate_geometry::Vec3;

use crate::{Simulation, Tool};

/// A point of an organ at rest, with its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// The point [m].
    pub point: Vec3,
    /// The outward normal, of length 1 [-].
    pub normal: Vec3,
}

impl Simulation {
    /// The point of the organ at rest that is closest to a given point [m], for `tool`; without one, the point closest
    /// to the middle of the top (+z) of the organ's bounding box.
    pub fn site(&self, tool: &Tool, near: Option<Vec3>) -> Site {
        let (low, high) = self.surface.mesh().bounds();
        let top = Vec3::new(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), high.z);
        let (nearest, _) = self
            .surface
            .signed_distance(&self.tree, &near.unwrap_or(top));
        let on = nearest.on;
        let patch = tool
            .patches
            .at(&self.surface, nearest.triangle, &on.barycentric);
        Site {
            point: on.position,
            normal: patch.normal,
        }
    }
}

impl Site {
    /// The motion of `tool` that is `depths` [m] deep here at `times` [s]; a negative depth is above the organ.
    ///
    /// # Errors
    /// When there are no times, they do not grow, or a number is not finite.
    pub fn indented(
        &self,
        tool: &Tool,
        times: &[f64],
        depths: &[f64],
    ) -> Result<Motion, palpate_files::Error> {
        let row = |(time_s, depth): (&f64, &f64)| MotionRow {
            time_s: *time_s,
            pose: Pose {
                position_m: (self.point + (tool.overhang() - depth) * self.normal).into(),
                orientation: None,
                grip: 0.0,
                cut: false,
            },
        };
        let rows = times.iter().zip(depths).map(row).collect();
        Motion::new(vec![ToolMotion::new(&tool.name, rows)?])
    }
}
