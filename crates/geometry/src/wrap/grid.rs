use crate::{TriangleMesh, Vec3};

/// Voxels between the triangles and the border of a grid, in addition to the closing's radius.
const MARGIN: f64 = 3.0;

/// A block of voxels around a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    pub(super) size: [usize; 3],
    /// Middle of the first voxel [m].
    pub(super) origin: Vec3,
    /// Edge of a voxel [m].
    pub(super) spacing: f64,
}

impl Grid {
    /// The grid around `mesh` with a margin for balls of `radius` [m].
    pub(super) fn around(mesh: &TriangleMesh, spacing: f64, radius: f64) -> Self {
        let (low, high) = mesh.bounds();
        let margin = radius + MARGIN * spacing;
        let size =
            (high - low).map(|extent| ((extent + 2.0 * margin) / spacing).ceil() as usize + 1);
        Self {
            size: size.into(),
            origin: low - Vec3::repeat(margin),
            spacing,
        }
    }

    /// How many voxels there are.
    pub(super) fn voxels(&self) -> f64 {
        self.size.iter().map(|&count| count as f64).product()
    }

    /// The number of a voxel; the first index runs fastest.
    pub(super) fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.size[0] * (j + self.size[1] * k)
    }

    /// The indices of a voxel.
    pub(super) fn indices(&self, number: usize) -> [usize; 3] {
        let row = number / self.size[0];
        [
            number % self.size[0],
            row % self.size[1],
            row / self.size[1],
        ]
    }

    /// Whether a voxel is one of the outermost.
    pub(super) fn is_border(&self, number: usize) -> bool {
        let indices = self.indices(number).into_iter().zip(self.size);
        indices
            .into_iter()
            .any(|(index, count)| index == 0 || index + 1 == count)
    }

    /// The middle of a voxel [m].
    pub(super) fn middle(&self, indices: [usize; 3]) -> Vec3 {
        self.origin + self.spacing * Vec3::from(indices.map(|index| index as f64))
    }

    /// The voxels that share a side with this one, within the block.
    pub(super) fn neighbours(&self, indices: [usize; 3]) -> impl Iterator<Item = usize> {
        let grid = *self;
        (0..6).filter_map(move |side| {
            let mut next = indices;
            let axis = side / 2;
            next[axis] = match side % 2 {
                0 => next[axis].checked_sub(1)?,
                _ => Some(next[axis] + 1).filter(|&index| index < grid.size[axis])?,
            };
            Some(grid.number(next))
        })
    }

    /// The indices within `reach` [m] of a box.
    pub(super) fn range(&self, low: &Vec3, high: &Vec3, reach: f64) -> [std::ops::Range<usize>; 3] {
        [0, 1, 2].map(|axis| {
            let index = |place: f64| (place - self.origin[axis]) / self.spacing;
            let first = index(low[axis] - reach).ceil().max(0.0) as usize;
            let last = index(high[axis] + reach).floor().max(0.0) as usize;
            first..(last + 1).min(self.size[axis])
        })
    }
}
