use palpate_geometry::TriangleId;

use crate::Vec3;

/// Φ of (4.10): for each of some points, weights over the triangles of a coarse mesh; a sparse matrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Weights {
    /// The end of each row.
    ends: Vec<u32>,
    triangles: Vec<TriangleId>,
    values: Vec<f64>,
}

impl Weights {
    /// Empty, with room for so many rows of so many `weights` together.
    pub(super) fn with_capacity(rows: usize, weights: usize) -> Self {
        Self {
            ends: Vec::with_capacity(rows),
            triangles: Vec::with_capacity(weights),
            values: Vec::with_capacity(weights),
        }
    }

    /// Number of points.
    pub fn rows(&self) -> usize {
        self.ends.len()
    }

    /// The triangles and their weights [-] at point `row`.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (TriangleId, f64)> {
        let range = self.range(row);
        let values = self.values[range.clone()].iter();
        self.triangles[range].iter().copied().zip(values.copied())
    }

    /// Σ Φ_i v_i at point `row`, in the unit of `values`, which are those of all triangles.
    pub fn sum(&self, row: usize, values: &[Vec3]) -> Vec3 {
        let terms = self.row(row);
        terms
            .map(|(triangle, weight)| weight * values[triangle.index()])
            .sum()
    }

    pub(super) fn clear(&mut self) {
        self.ends.clear();
        self.triangles.clear();
        self.values.clear();
    }

    /// One more triangle in the row that is being written.
    pub(super) fn push(&mut self, triangle: TriangleId, weight: f64) {
        self.triangles.push(triangle);
        self.values.push(weight);
    }

    /// The row that is being written.
    pub(super) fn open_row(&mut self) -> (&[TriangleId], &mut [f64]) {
        let start = self.ends.last().map_or(0, |&end| end as usize);
        (&self.triangles[start..], &mut self.values[start..])
    }

    pub(super) fn end_row(&mut self) {
        self.ends.push(self.values.len() as u32);
    }

    fn range(&self, row: usize) -> std::ops::Range<usize> {
        let start = row.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[row] as usize
    }
}
