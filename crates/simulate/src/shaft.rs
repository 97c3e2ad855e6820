//! The shaft of a tool: a straight rod behind its tip.

use nalgebra::UnitQuaternion;
use palpate_files::Pose;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::Tip;

use crate::orientation::orientation;
use crate::tool::Tool;

/// Length of a shaft without a trocar [m].
const LENGTH: f64 = 0.3;

/// A rod that begins at the tip: all points within its radius of its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shaft {
    /// The reference point of the tip [m].
    pub(crate) tip: Vec3,
    /// Unit direction of the axis, from the tip to the hand [-].
    pub(crate) along: Vec3,
    /// From the tip to the trocar, or to the end [m].
    pub(crate) length: f64,
    pub(crate) radius: f64,
    /// Whether it turns about a trocar.
    pub(crate) is_in_trocar: bool,
}

impl Shaft {
    /// That of `tool` at `pose`; none if its direction is not known.
    pub(crate) fn of(tool: &Tool, pose: &Pose) -> Option<Self> {
        let trocar = tool.trocar.as_ref();
        if trocar.is_none() && pose.orientation.is_none() {
            return None;
        }
        let tip = Vec3::from(pose.position_m);
        let turned = orientation(&tip, trocar, pose.orientation, None);
        Some(Self {
            tip,
            along: turned * Vec3::z(),
            length: trocar.map_or(LENGTH, |trocar| (trocar - tip).norm()),
            radius: tool.shaft_radius(),
            is_in_trocar: trocar.is_some(),
        })
    }

    /// The jaws of `tool` at `pose`, if they are `turned` so, or only its tip.
    pub(crate) fn of_jaws(tool: &Tool, pose: &Pose, turned: Option<&UnitQuaternion<f64>>) -> Self {
        let jaws = tool.jaws.map_or(0.0, |jaws| jaws.length_m);
        Self {
            tip: Vec3::from(pose.position_m),
            along: turned.map_or_else(Vec3::z, |turned| turned * Vec3::z()),
            length: turned.map_or(0.0, |_| jaws),
            radius: tool.shaft_radius(),
            is_in_trocar: false,
        }
    }

    /// The ends [m] of its axis farther than `from` [m] from the tip; none if it is shorter.
    pub(crate) fn axis(&self, from: f64) -> Option<[Vec3; 2]> {
        let is_tip_alone = self.length == 0.0 && from == 0.0;
        (self.length > from || is_tip_alone)
            .then(|| [from, self.length].map(|at| self.tip + self.along * at))
    }

    /// Coordinate of a `place` [m] along its axis: from the tip [m].
    pub(crate) fn at(&self, place: &Vec3) -> f64 {
        self.along.dot(&(place - self.tip)).clamp(0.0, self.length)
    }
}

impl Tool {
    /// Where the shaft begins behind the tip if the tip is in contact [m]: the part in front of it is in the dimple of
    /// the tip, and jaws act on the tissue between them.
    pub(crate) fn shaft_begins(&self) -> f64 {
        let dimple = 2.0 * self.patches.radius();
        self.jaws.map_or(dimple, |jaws| dimple.max(jaws.length_m))
    }

    /// The same if the tip is not in contact: its round end does not protrude beyond the tip.
    pub(crate) fn shaft_ends(&self) -> f64 {
        match self.tip {
            Tip::Flat { radius } => radius,
            Tip::Sphere { .. } => 0.0,
        }
    }
}
