use nalgebra::{Matrix3, UnitQuaternion};
use palpate_files::Pose;
use palpate_geometry::{TriangleId, Vec3};
use palpate_mechanics::enhance::SurfacePoint;
use palpate_mechanics::surface_response::TouchId;

use super::{GraspedPlace, Swept};
use crate::tool::Tool;

/// Largest numbers of independently moving parts, and of triangles in all of them, that one tool can hold.
pub(crate) const MAX_PARTS: usize = 16;
pub(crate) const MAX_TRIANGLES: usize = 64;

/// Tissue between jaws: it moves rigidly with the tool, except for its slip.
#[derive(Debug, Clone)]
pub(crate) struct Grasp {
    /// The tip [m] and the tool's rotation, at the start of the grasp and now.
    began: (Vec3, UnitQuaternion<f64>),
    now: (Vec3, UnitQuaternion<f64>),
    /// Slip of the tissue along the jaws, in the tool's frame [m].
    slid: Vec3,
    /// Area of a face that presses on it [m²].
    pub(crate) area: f64,
    /// Thickness of the tissue between the jaws, uncompressed [m].
    pub(crate) thickness: f64,
    pub(crate) grasped: Grasped,
    pub(crate) displayed: DisplayedGrasp,
}

/// The held tissue, by model.
#[derive(Debug, Clone)]
#[expect(
    clippy::large_enum_variant,
    reason = "a step that takes hold allocates nothing"
)]
pub(crate) enum Grasped {
    /// A patch of the organ-scale model.
    Patch(GraspedPatch),
    /// A place of the local model.
    Place(GraspedPlace),
    /// An area of the nonlinear model.
    Area(GraspedArea),
}

/// Held tissue of an organ that bends, bonded as to a flat tip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GraspedArea {
    /// Two tangents and the normal of the surface at rest there [-].
    pub(crate) frame: Matrix3<f64>,
    /// Offset of the jaws from the held tissue at the start of the grasp, under the tip's force [m], in the tool's
    /// frame.
    pub(crate) offset: Vec3,
    /// That force, on the held tissue [N], in the tool's frame.
    pub(crate) force: Vec3,
}

/// Held triangles of the mechanical surface, in a few parts: small triangles share a part, and bear its force by their
/// areas. A part's position is the mean of theirs.
#[derive(Debug, Clone)]
pub(crate) struct GraspedPatch {
    parts: [GraspedPart; MAX_PARTS],
    count: usize,
    /// Sorted by part.
    triangles: [GraspedTriangle; MAX_TRIANGLES],
}

/// A part of a patch.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct GraspedPart {
    /// The end index of its triangles.
    pub(crate) end: usize,
    /// Its position at rest, and at the start of the grasp [m].
    pub(crate) rest: Vec3,
    pub(crate) at: Vec3,
    /// Share of the patch's area [-].
    pub(crate) share: f64,
}

/// A triangle of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GraspedTriangle {
    pub(crate) touch: TouchId,
    /// Share of its part's area [-].
    pub(crate) weight: f64,
}

/// The point of the displayed surface that represents the held tissue.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DisplayedGrasp {
    /// Its triangle, and its position at rest [m].
    pub(crate) triangle: TriangleId,
    pub(crate) place: Vec3,
    /// The same on the mechanical surface; none in the local model.
    pub(crate) at: Option<SurfacePoint>,
    /// Its displacement from there at the start of the grasp [m].
    pub(crate) displaced: Vec3,
}

impl Grasp {
    pub(crate) fn new(
        swept: &Swept,
        area: f64,
        thickness: f64,
        held: Grasped,
        displayed: DisplayedGrasp,
    ) -> Self {
        let began = (swept.tip, swept.turned);
        Self {
            began,
            now: began,
            slid: Vec3::zeros(),
            area,
            thickness,
            grasped: held,
            displayed,
        }
    }

    /// Moves with its tool.
    pub(super) fn follow(&mut self, tool: &Tool, pose: &Pose) {
        let tip = Vec3::from(pose.position_m);
        let known = tool.trocar.is_some() || pose.orientation.is_some();
        let turned = match known {
            true => {
                crate::orientation::orientation(&tip, tool.trocar.as_ref(), pose.orientation, None)
            }
            // The rotation of the tool is unknown.
            false => self.now.1,
        };
        self.now = (tip, turned);
    }

    /// Current position of held tissue that was at `place` [m] at the start of the grasp.
    pub(crate) fn carried(&self, place: &Vec3) -> Vec3 {
        let within = self.began.1.inverse() * (place - self.began.0);
        self.now.0 + self.now.1 * (within + self.slid)
    }

    /// Position of the displayed point if the tissue had not slipped [m].
    pub(crate) fn carried_without_slip(&self) -> Vec3 {
        let within = self.began.1.inverse()
            * (self.displayed.place + self.displayed.displaced - self.began.0);
        self.now.0 + self.now.1 * within
    }

    /// Rotates a vector of the tool's frame to the scene.
    pub(crate) fn in_scene(&self, vector: &Vec3) -> Vec3 {
        self.now.1 * vector
    }

    /// Rotation of the jaws since the start of the grasp [rad].
    pub(crate) fn has_turned(&self) -> f64 {
        self.began.1.angle_to(&self.now.1)
    }

    /// The tool's rotation.
    pub(crate) fn turned(&self) -> &UnitQuaternion<f64> {
        &self.now.1
    }

    /// Slip of the tissue so far [m], in the tool's frame.
    pub(crate) fn slid(&self) -> &Vec3 {
        &self.slid
    }

    /// Adds a slip of `by` [m], in the tool's frame.
    pub(super) fn slide(&mut self, by: &Vec3) {
        self.slid += by;
    }

    /// Rest position of the held tissue [m].
    pub(crate) fn place(&self) -> Vec3 {
        self.displayed.place
    }

    /// Displacement of the displayed point from its rest position [m].
    pub(crate) fn displaced(&self) -> Vec3 {
        self.carried(&(self.displayed.place + self.displayed.displaced)) - self.displayed.place
    }

    /// Its patch of the organ-scale model; none in the local model.
    pub(crate) fn patch(&self) -> Option<&GraspedPatch> {
        match &self.grasped {
            Grasped::Patch(patch) => Some(patch),
            Grasped::Place(_) | Grasped::Area(_) => None,
        }
    }
}

impl GraspedPatch {
    /// A patch with these numbers of parts and triangles, to be filled in; none without any.
    pub(crate) fn new(
        parts: impl Iterator<Item = GraspedPart>,
        triangles: impl Iterator<Item = (usize, GraspedTriangle)>,
    ) -> Option<Self> {
        let none = GraspedTriangle {
            touch: TouchId(0),
            weight: 0.0,
        };
        let mut patch = Self {
            parts: [GraspedPart::default(); MAX_PARTS],
            count: 0,
            triangles: [none; MAX_TRIANGLES],
        };
        for (own, part) in patch.parts.iter_mut().zip(parts) {
            *own = part;
            patch.count += 1;
        }
        for (number, (own, (part, triangle))) in
            patch.triangles.iter_mut().zip(triangles).enumerate()
        {
            *own = triangle;
            patch.parts[part].end = number + 1;
        }
        (patch.count > 0).then_some(patch)
    }

    /// Its parts, with the triangles of each.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (&GraspedPart, &[GraspedTriangle])> + Clone {
        (0..self.count).map(move |number| {
            let start = number
                .checked_sub(1)
                .map_or(0, |before| self.parts[before].end);
            let part = &self.parts[number];
            (part, &self.triangles[start..part.end])
        })
    }

    /// Its parts, mutable, to set their positions.
    pub(crate) fn parts_mut(&mut self) -> &mut [GraspedPart] {
        &mut self.parts[..self.count]
    }

    /// Its triangles.
    pub(crate) fn triangles(&self) -> &[GraspedTriangle] {
        let end = self
            .count
            .checked_sub(1)
            .map_or(0, |last| self.parts[last].end);
        &self.triangles[..end]
    }

    /// Keeps only the first half of its parts, those that were chosen first; false if there is only one.
    pub(crate) fn halve(&mut self) -> bool {
        let more = self.count > 1;
        self.count = self.count.div_ceil(2);
        more
    }
}
