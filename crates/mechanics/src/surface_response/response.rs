use nalgebra::Matrix3;
use palpate_geometry::TriangleId;

use super::parts::{ResponseParts, TouchableTriangle};
use crate::boundary_elements::Precision;
use crate::{Error, LinearElastic, Vec3};

/// How the surface of a linear solid answers forces on it. All of it is sound: see [`Self::new`].
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceResponse<T = f32> {
    parts: ResponseParts<T>,
}

/// A touchable triangle, by its place among them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TouchId(pub u32);

impl TouchId {
    /// As an index into the touchable triangles.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl<T: Precision> SurfaceResponse<T> {
    /// The response that `parts` are.
    ///
    /// # Errors
    /// When they are none: lengths that do not fit, values that are not finite, a triangle that moves
    /// against the force on it.
    pub fn new(parts: ResponseParts<T>) -> Result<Self, Error> {
        LinearElastic::new(1.0, parts.poissons_ratio)?;
        match parts.fault() {
            Some(fault) => Err(Error::UnsoundResponse { fault }),
            None => Ok(Self { parts }),
        }
    }

    /// What it consists of.
    pub fn parts(&self) -> &ResponseParts<T> {
        &self.parts
    }

    /// The triangles that can be loaded.
    pub fn touchable(&self) -> &[TouchableTriangle] {
        &self.parts.touchable
    }

    /// The place of a triangle of the mesh among the touchable ones, if it is one.
    pub fn find(&self, triangle: TriangleId) -> Option<TouchId> {
        let found = self
            .parts
            .touchable
            .binary_search_by_key(&triangle, |t| t.triangle);
        found.ok().map(|index| TouchId(index as u32))
    }

    /// Whether a triangle of the mesh is held.
    pub fn holds(&self, triangle: TriangleId) -> bool {
        self.parts.held.binary_search(&triangle).is_ok()
    }

    /// Displacement of `moved` from a unit force on `loaded`, times E [1/m], as it was solved.
    pub fn influence(&self, moved: TouchId, loaded: TouchId) -> Matrix3<f64> {
        let rows = 3 * self.parts.triangles;
        let moved = self.parts.touchable[moved.index()].triangle;
        let start = 3 * rows * loaded.index() + 3 * moved.index();
        let at = |a: usize, b: usize| self.parts.displacements[start + rows * b + a].into();
        Matrix3::from_fn(at)
    }

    /// The same with the reciprocity that an elastic solid has (and collocation misses by some percent):
    /// the mean of the influence and of the transposed one the other way. A contact that is computed with
    /// it makes no energy.
    pub fn compliance(&self, moved: TouchId, loaded: TouchId) -> Matrix3<f64> {
        let there = self.influence(moved, loaded);
        let back = self.influence(loaded, moved);
        0.5 * (there + back.transpose())
    }

    /// Adds to `field`, three numbers for each triangle, the displacements times E [N/m] from `force` [N] on
    /// `loaded`.
    pub fn add_field(&self, loaded: TouchId, force: &Vec3, field: &mut [T]) {
        let rows = 3 * self.parts.triangles;
        let columns = &self.parts.displacements[3 * rows * loaded.index()..][..3 * rows];
        let (x, rest) = columns.split_at(rows);
        let (y, z) = rest.split_at(rows);
        let [fx, fy, fz] = [force.x, force.y, force.z].map(T::of);
        for (((place, &x), &y), &z) in field.iter_mut().zip(x).zip(y).zip(z) {
            *place += fx * x + fy * y + fz * z;
        }
    }
}
