use palpate_geometry::{Surface, TriangleId};

use crate::boundary_elements::{Panel, Precision};
use crate::{Error, Vec3};

/// A triangle that a contact may load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchableTriangle {
    /// Its number in the mesh.
    pub triangle: TriangleId,
    /// Its centroid [m].
    pub centroid: Vec3,
    /// Outward unit normal [-].
    pub normal: Vec3,
    /// Area [m²].
    pub area: f64,
}

impl TouchableTriangle {
    /// A triangle of `surface`; none where there is no such triangle or it spans no area.
    pub fn of(surface: &Surface, triangle: TriangleId) -> Option<Self> {
        if triangle.index() >= surface.mesh().triangles().len() {
            return None;
        }
        let panel = Panel::new(surface.mesh().positions(triangle))?;
        Some(Self {
            triangle,
            centroid: panel.centroid,
            normal: panel.normal,
            area: panel.area,
        })
    }
}

/// The quantity that the displacements of a response sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// The centroids of the triangles, as boundary elements collocate.
    Centroids,
    /// The triangles' means, as forces that are spread over them do work.
    Means,
}

/// The data of a response, for writing and reading it.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseParts<T> {
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// The triangles that can be loaded, ascending in their numbers.
    pub touchable: Vec<TouchableTriangle>,
    /// The triangles that cannot move, ascending; none of them touchable.
    pub fixed: Vec<TriangleId>,
    /// Number of triangles of the mesh.
    pub triangles: usize,
    /// The quantity that the displacements sample.
    pub sampling: Sampling,
    /// Displacements of the triangles from unit forces on the touchable triangles, times E [1/m]: number
    /// 3 n (3 j + b) + 3 i + a is component a of triangle i from the component b on the j-th touchable one.
    pub displacements: Vec<T>,
}

/// `count` zeros of a large matrix.
///
/// # Errors
/// When there is no memory.
pub(crate) fn zeros<T: Precision>(count: usize) -> Result<Vec<T>, Error> {
    let mut numbers = Vec::new();
    let bytes = count.saturating_mul(size_of::<T>());
    numbers
        .try_reserve_exact(count)
        .map_err(|_| Error::NoMemory { bytes })?;
    numbers.resize(count, T::of(0.0));
    Ok(numbers)
}

impl<T: Precision> ResponseParts<T> {
    /// Of the right lengths, without a displacement.
    ///
    /// # Errors
    /// When there is no memory.
    pub(crate) fn zeros(
        poissons_ratio: f64,
        touchable: Vec<TouchableTriangle>,
        triangles: usize,
        fixed: &[TriangleId],
        sampling: Sampling,
    ) -> Result<Self, Error> {
        let columns = 3 * touchable.len();
        let mut fixed = fixed.to_vec();
        fixed.sort();
        Ok(Self {
            poissons_ratio,
            fixed,
            triangles,
            sampling,
            displacements: zeros(columns * 3 * triangles)?,
            touchable,
        })
    }

    /// The first fault in them, if any.
    pub(super) fn fault(&self) -> Option<&'static str> {
        let columns = 3 * self.touchable.len();
        let known = |t: &TouchableTriangle| t.triangle.index() < self.triangles;
        // Numbers of a file may be too large for their product.
        let rows = self.triangles.saturating_mul(3);
        let ascends = |pair: &[TouchableTriangle]| pair[0].triangle < pair[1].triangle;
        let sound = |t: &TouchableTriangle| {
            t.area > 0.0
                && t.area.is_finite()
                && (t.normal.norm() - 1.0).abs() < 1e-6
                && t.centroid.iter().all(|c| c.is_finite())
        };
        let yields = |k: usize| {
            let row = 3 * self.touchable[k / 3].triangle.index() + k % 3;
            self.displacements[k * rows + row] > T::of(0.0)
        };
        if columns == 0 {
            Some("no triangle can be touched")
        } else if !self.touchable.windows(2).all(ascends) {
            Some("its triangles do not ascend")
        } else if !self.fixed.is_sorted() {
            Some("its fixed triangles do not ascend")
        } else if !self.touchable.iter().all(sound) {
            Some("a triangle has no area, normal or place")
        } else if !self.touchable.iter().all(known) {
            Some("it has fewer triangles than its numbers say")
        } else if Some(self.displacements.len()) != columns.checked_mul(rows) {
            Some("numbers are missing or too many")
        } else if !self
            .displacements
            .iter()
            .all(|&value| value.into().is_finite())
        {
            Some("it holds values that are no numbers")
        } else if !(0..columns).all(yields) {
            Some("a triangle moves against its force")
        } else {
            None
        }
    }
}
