use nalgebra::Matrix3;
use palpate_geometry::TriangleId;

use super::parts::{ResponseParts, TouchableTriangle};
use crate::boundary_elements::Precision;
use crate::{Error, LinearElastic, Vec3};

/// Forces whose displacements are added in one pass: the field is read and written once for all of them, and
/// each has three streams that processors read ahead.
const AT_A_TIME: usize = 4;

/// The response of the surface of a linear solid to forces on it. It is valid: see [`Self::new`].
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
    /// The response with these `parts`.
    ///
    /// # Errors
    /// When they are invalid: lengths that do not fit, values that are not finite, a triangle that
    /// moves against the force on it.
    pub fn new(parts: ResponseParts<T>) -> Result<Self, Error> {
        LinearElastic::new(1.0, parts.poissons_ratio)?;
        match parts.fault() {
            Some(fault) => Err(Error::InvalidResponse { fault }),
            None => Ok(Self { parts }),
        }
    }

    /// Its data.
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

    /// Whether a triangle of the mesh is fixed.
    pub fn is_fixed(&self, triangle: TriangleId) -> bool {
        self.parts.fixed.binary_search(&triangle).is_ok()
    }

    /// Displacement of `moved` from a unit force on `loaded`, times E [1/m], as it was solved.
    ///
    /// # Panics
    /// When either is no triangle of this response; see [`Self::find`].
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
    ///
    /// # Panics
    /// When `loaded` is no triangle of this response, or `field` has fewer numbers.
    pub fn add_field(&self, loaded: TouchId, force: &Vec3, field: &mut [T]) {
        self.add_sum(&[(loaded, *force)], field);
    }

    /// The same of many forces.
    pub fn add_fields(&self, forces: impl IntoIterator<Item = (TouchId, Vec3)>, field: &mut [T]) {
        let mut waiting = [(TouchId(0), Vec3::zeros()); AT_A_TIME];
        let mut count = 0;
        for force in forces {
            waiting[count] = force;
            count += 1;
            if count == AT_A_TIME {
                self.add_sum(&waiting, field);
                count = 0;
            }
        }
        for &one in &waiting[..count] {
            self.add_sum(&[one], field);
        }
    }

    /// In one pass over `field`.
    fn add_sum<const N: usize>(&self, forces: &[(TouchId, Vec3); N], field: &mut [T]) {
        let rows = 3 * self.parts.triangles;
        let columns = forces.map(|(loaded, _)| {
            let columns = &self.parts.displacements[3 * rows * loaded.index()..][..3 * rows];
            [0, 1, 2].map(|axis| &columns[axis * rows..][..rows])
        });
        let forces = forces.map(|(_, force)| [force.x, force.y, force.z].map(T::of));
        for (row, place) in field[..rows].iter_mut().enumerate() {
            for ([x, y, z], [fx, fy, fz]) in columns.iter().zip(forces) {
                *place += fx * x[row] + fy * y[row] + fz * z[row];
            }
        }
    }
}
