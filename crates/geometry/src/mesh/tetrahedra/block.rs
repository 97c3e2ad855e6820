use super::{TetrahedronError, TetrahedronMesh};
use crate::{NodeId, Vec3};

/// The paths along the edges of a cell from its lowest to its highest corner, as axes in turn, each
/// with whether its tetrahedron is positive as it stands [Kuhn 1960].
const PATHS: [([usize; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
    ([1, 0, 2], false),
];

impl TetrahedronMesh {
    /// A block from `low` to `high` [m] of `cells` along x, y and z, each cut into six tetrahedra
    /// around its diagonal. Vertices count along x first.
    ///
    /// # Errors
    /// When there are no cells or too many, or the block has no volume.
    pub fn block(low: Vec3, high: Vec3, cells: [usize; 3]) -> Result<Self, TetrahedronError> {
        let size = high - low;
        if let Some(&found) = size.iter().find(|s| !s.is_finite() || **s <= 0.0) {
            let what = "an edge of the block";
            return Err(TetrahedronError::NotALength { what, found });
        }
        let expected = 6.0 * cells.iter().map(|&n| n as f64).product::<f64>();
        if expected > Self::MAX_TETRAHEDRA as f64 {
            return Err(TetrahedronError::TooMany {
                expected,
                edge_m: size.x / cells[0] as f64,
                most: Self::MAX_TETRAHEDRA,
            });
        }
        if expected == 0.0 {
            return Err(TetrahedronError::Empty);
        }
        let mut vertices = Vec::new();
        for_all(cells.map(|n| n + 1), |at| {
            let part = [0, 1, 2].map(|k| at[k] as f64 / cells[k] as f64);
            vertices.push(low + size.component_mul(&Vec3::from(part)));
        });
        let number = |at: [usize; 3]| {
            NodeId(((at[2] * (cells[1] + 1) + at[1]) * (cells[0] + 1) + at[0]) as u32)
        };
        let mut tetrahedra = Vec::new();
        for_all(cells, |cell| {
            for (axes, positive) in PATHS {
                let mut at = cell;
                let mut nodes = [number(at); 4];
                for (step, axis) in axes.into_iter().enumerate() {
                    at[axis] += 1;
                    nodes[step + 1] = number(at);
                }
                if !positive {
                    nodes.swap(1, 2);
                }
                tetrahedra.push(nodes);
            }
        });
        Self::new(vertices, tetrahedra)
    }
}

/// Calls `visit` for all triples below `counts`, the first running fastest.
fn for_all(counts: [usize; 3], mut visit: impl FnMut([usize; 3])) {
    for z in 0..counts[2] {
        for y in 0..counts[1] {
            for x in 0..counts[0] {
                visit([x, y, z]);
            }
        }
    }
}
