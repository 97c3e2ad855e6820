//! The points of the boundary for contact with shafts.

use std::ops::Range;

use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_mechanics::nonlinear::{NonlinearModel, TOOL_POINTS};

use super::soft::Piece;

/// Largest spacing of points that touch a shaft [radii], if the number of points permits it.
const APART: f64 = 0.6;

/// All points of a face.
pub(super) const POINTS: usize = TOOL_POINTS[0] + TOOL_POINTS[1];

/// The points of the boundary for contact with shafts, [`POINTS`] of each face.
#[derive(Debug, Clone)]
pub(super) struct ShaftSkin {
    /// At rest, on the displayed surface [m].
    pub(super) places: Vec<Vec3>,
    pub(super) faces: Vec<SkinFace>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct SkinFace {
    /// Largest distance of a point from the first [m].
    pub(super) extent: f64,
    /// [m²]
    area: f64,
    pub(super) piece: usize,
}

impl ShaftSkin {
    pub(super) fn new(
        model: &NonlinearModel,
        shown: &Surface,
        tree: &AabbTree,
        pieces: &[Piece],
    ) -> Self {
        let on = model
            .tool_points()
            .iter()
            .map(|point| tree.nearest(shown.mesh(), &point.place));
        let on: Vec<_> = on.collect();
        let faces = on
            .chunks(POINTS)
            .zip(model.boundary().areas())
            .map(|(own, area)| {
                let first = &own[0];
                let apart = own
                    .iter()
                    .map(|point| (point.on.position - first.on.position).norm());
                SkinFace {
                    extent: apart.fold(0.0, f64::max),
                    area,
                    piece: Piece::with(pieces, first.triangle.0),
                }
            });
        Self {
            faces: faces.collect(),
            places: on.iter().map(|own| own.on.position).collect(),
        }
    }
}

impl ShaftSkin {
    /// The area of a point [m²], and its piece.
    pub(super) fn around(&self, point: u32) -> (f64, usize) {
        let [few, many] = TOOL_POINTS;
        let face = &self.faces[point as usize / POINTS];
        let count = if (point as usize % POINTS) < few {
            few
        } else {
            many
        };
        (face.area / count as f64, face.piece)
    }
}

impl SkinFace {
    /// Which of its points are used for a shaft of this radius [m].
    pub(super) fn points(&self, radius: f64) -> Range<usize> {
        let [few, _] = TOOL_POINTS;
        match self.area < few as f64 * (APART * radius).powi(2) {
            true => 0..few,
            false => few..POINTS,
        }
    }
}

/// The normal of a face some of whose points have these positions [m]. They are sorted by rows: of four in rows of two
/// and one, of sixteen in rows of four to one, and then those between.
pub(super) fn outward(set: Range<usize>, place: impl Fn(usize) -> Vec3) -> Vec3 {
    let [across, along] = match set.len() == TOOL_POINTS[0] {
        true => [1, 2],
        false => [3, 9],
    };
    let [corner, across, along] = [0, across, along].map(|k| place(set.start + k));
    let normal = (along - corner).cross(&(across - corner));
    normal.try_normalize(0.0).unwrap_or_default()
}
