use nalgebra::{Matrix3, UnitQuaternion};
use palpate_files::Pose;
use palpate_geometry::{TriangleId, Vec3};
use palpate_mechanics::enhance::SurfacePoint;
use palpate_mechanics::surface_response::TouchId;

use super::{HeldPlace, Swept};
use crate::tool::Tool;

/// Parts that move each for itself, and triangles in all of them, that one tool can hold.
pub(crate) const MOST_PARTS: usize = 16;
pub(crate) const MOST_TRIANGLES: usize = 64;

/// Tissue between jaws: a rigid body of their tool, but for what it has slid.
#[derive(Debug, Clone)]
pub(crate) struct Hold {
    /// The tip [m] and the tool's rotation, when it took hold and now.
    began: (Vec3, UnitQuaternion<f64>),
    now: (Vec3, UnitQuaternion<f64>),
    /// Way of the tissue along the jaws, in the tool's frame [m].
    slid: Vec3,
    /// Of a face that presses on it [m²].
    pub(crate) area: f64,
    /// Of what is between the jaws, unpressed [m].
    pub(crate) thickness: f64,
    pub(crate) held: Held,
    pub(crate) seen: SeenHold,
}

/// What is held.
#[derive(Debug, Clone)]
#[expect(
    clippy::large_enum_variant,
    reason = "a step that takes hold allocates nothing"
)]
pub(crate) enum Held {
    /// Of the whole organ.
    Patch(HeldPatch),
    /// The local model's.
    Place(HeldPlace),
    /// The nonlinear model's.
    Area(HeldArea),
}

/// What is held of an organ that bends, as a bonded flat tip holds it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldArea {
    /// Two tangents and the normal of the surface at rest there [-].
    pub(crate) frame: Matrix3<f64>,
    /// What the jaws were beyond what they held when they took hold of it under the tip's force [m], in the tool's frame.
    pub(crate) offset: Vec3,
    /// That force, on what they hold [N], in the tool's frame.
    pub(crate) force: Vec3,
}

/// Triangles of the mechanical surface, in a few parts: where triangles are small, several in one, each of which
/// bears by its area. A part's place is the mean of theirs.
#[derive(Debug, Clone)]
pub(crate) struct HeldPatch {
    parts: [HeldPart; MOST_PARTS],
    count: usize,
    /// Those of the first part, then those of the next.
    triangles: [HeldTriangle; MOST_TRIANGLES],
}

/// A part of a patch.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldPart {
    /// The end of its triangles among all.
    pub(crate) end: usize,
    /// Where it is at rest, and where it was taken hold of [m].
    pub(crate) rest: Vec3,
    pub(crate) at: Vec3,
    /// Of the patch's area [-].
    pub(crate) share: f64,
}

/// A triangle of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldTriangle {
    pub(crate) touch: TouchId,
    /// Of its part's area [-].
    pub(crate) weight: f64,
}

/// The point of the shown surface that shows where the tissue is held.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeenHold {
    /// Its triangle, and its place at rest [m].
    pub(crate) triangle: TriangleId,
    pub(crate) place: Vec3,
    /// The same on the mechanical surface; none where the local model answers.
    pub(crate) at: Option<SurfacePoint>,
    /// How far it was from there when it was taken hold of [m].
    pub(crate) displaced: Vec3,
}

impl Hold {
    pub(crate) fn new(
        swept: &Swept,
        area: f64,
        thickness: f64,
        held: Held,
        seen: SeenHold,
    ) -> Self {
        let began = (swept.tip, swept.turned);
        Self {
            began,
            now: began,
            slid: Vec3::zeros(),
            area,
            thickness,
            held,
            seen,
        }
    }

    /// Goes with its tool.
    pub(super) fn follow(&mut self, tool: &Tool, pose: &Pose) {
        let tip = Vec3::from(pose.position_m);
        let known = tool.trocar.is_some() || pose.orientation.is_some();
        let turned = match known {
            true => {
                crate::orientation::orientation(&tip, tool.trocar.as_ref(), pose.orientation, None)
            }
            // Nobody says that it has turned.
            false => self.now.1,
        };
        self.now = (tip, turned);
    }

    /// Where held tissue is now that was at `place` [m] when it was taken hold of.
    pub(crate) fn carried(&self, place: &Vec3) -> Vec3 {
        let within = self.began.1.inverse() * (place - self.began.0);
        self.now.0 + self.now.1 * (within + self.slid)
    }

    /// Where the tissue would be now that the jaws took hold of at the point that shows it, had it not slipped [m].
    pub(crate) fn carried_without_slip(&self) -> Vec3 {
        let within =
            self.began.1.inverse() * (self.seen.place + self.seen.displaced - self.began.0);
        self.now.0 + self.now.1 * within
    }

    /// A vector of the tool's frame in the scene.
    pub(crate) fn in_scene(&self, vector: &Vec3) -> Vec3 {
        self.now.1 * vector
    }

    /// How far the jaws have turned since they took hold [rad].
    pub(crate) fn has_turned(&self) -> f64 {
        self.began.1.angle_to(&self.now.1)
    }

    /// The tool's rotation.
    pub(crate) fn turned(&self) -> &UnitQuaternion<f64> {
        &self.now.1
    }

    /// How far the tissue has slid since [m], in the tool's frame.
    pub(crate) fn slid(&self) -> &Vec3 {
        &self.slid
    }

    /// Slides `by` [m] more, in the tool's frame.
    pub(super) fn slide(&mut self, by: &Vec3) {
        self.slid += by;
    }

    /// Where the tissue is held, at rest [m].
    pub(crate) fn place(&self) -> Vec3 {
        self.seen.place
    }

    /// How far the point that shows it is from its rest now [m].
    pub(crate) fn displaced(&self) -> Vec3 {
        self.carried(&(self.seen.place + self.seen.displaced)) - self.seen.place
    }

    /// What it holds of the whole organ; none where the local model answers.
    pub(crate) fn patch(&self) -> Option<&HeldPatch> {
        match &self.held {
            Held::Patch(patch) => Some(patch),
            Held::Place(_) | Held::Area(_) => None,
        }
    }
}

impl HeldPatch {
    /// Of so many parts with so many triangles, which are still to be filled in; none without any.
    pub(crate) fn new(
        parts: impl Iterator<Item = HeldPart>,
        triangles: impl Iterator<Item = (usize, HeldTriangle)>,
    ) -> Option<Self> {
        let none = HeldTriangle {
            touch: TouchId(0),
            weight: 0.0,
        };
        let mut patch = Self {
            parts: [HeldPart::default(); MOST_PARTS],
            count: 0,
            triangles: [none; MOST_TRIANGLES],
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
    pub(crate) fn parts(&self) -> impl Iterator<Item = (&HeldPart, &[HeldTriangle])> + Clone {
        (0..self.count).map(move |number| {
            let start = number
                .checked_sub(1)
                .map_or(0, |before| self.parts[before].end);
            let part = &self.parts[number];
            (part, &self.triangles[start..part.end])
        })
    }

    /// Its parts, to be put in their places.
    pub(crate) fn parts_mut(&mut self) -> &mut [HeldPart] {
        &mut self.parts[..self.count]
    }

    /// Its triangles.
    pub(crate) fn triangles(&self) -> &[HeldTriangle] {
        let end = self
            .count
            .checked_sub(1)
            .map_or(0, |last| self.parts[last].end);
        &self.triangles[..end]
    }

    /// Holds only the first half of its parts, those that were chosen first; false where there is but one.
    pub(crate) fn halve(&mut self) -> bool {
        let more = self.count > 1;
        self.count = self.count.div_ceil(2);
        more
    }
}
