use palpate_geometry::{AabbTree, NodeId, Surface};

use super::field::SurfaceField;
use super::interpolation::{Interpolation, SurfacePoint};
use super::weights::Weights;
use crate::Vec3;

/// Points that are embedded in a coarse surface. Their weights are computed once.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EmbeddedDisplayPoints {
    places: Vec<Vec3>,
    normals: Vec<Vec3>,
    weights: Weights,
}

impl EmbeddedDisplayPoints {
    /// The vertices of the coarse surface itself.
    pub fn of_vertices(interpolation: &Interpolation) -> Self {
        let surface = interpolation.surface();
        let mut carrier = Self::default();
        for node in 0..surface.mesh().vertices().len() {
            let at = SurfacePoint::vertex(surface, NodeId(node as u32));
            carrier.push(interpolation, &at, interpolation.place(&at));
        }
        carrier
    }

    /// The vertices of a `finer` surface of the same organ, each from the nearest place of the coarse one
    /// that faces as it does.
    pub fn of_surface(interpolation: &Interpolation, finer: &Surface) -> Self {
        let tree = AabbTree::new(interpolation.surface().mesh());
        let mut carrier = Self::default();
        for (place, normal) in finer.mesh().vertices().iter().zip(finer.vertex_normals()) {
            let at = interpolation.nearest_facing(&tree, place, normal);
            carrier.push(interpolation, &at, *place);
        }
        carrier
    }

    /// Positions of the points at rest [m].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }

    /// The rows that carry them.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Displacements of the points [m]. Allocates nothing.
    ///
    /// # Panics
    /// When `displacements` has not the length of [`EmbeddedDisplayPoints::places`].
    pub fn interpolate(&self, field: &SurfaceField, displacements: &mut [Vec3]) {
        assert_eq!(displacements.len(), self.places.len(), "one per point");
        for (row, displacement) in displacements.iter_mut().enumerate() {
            *displacement = field.at(&self.places[row], &self.normals[row], &self.weights, row);
        }
    }

    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.normals.clear();
        self.weights.clear();
    }

    /// One more point, at rest at `place` [m], which follows the coarse surface at `at`.
    pub(super) fn push(&mut self, interpolation: &Interpolation, at: &SurfacePoint, place: Vec3) {
        self.places.push(place);
        self.normals.push(interpolation.normal(at));
        interpolation.write_row(at, &mut self.weights);
    }
}
