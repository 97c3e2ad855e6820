use std::collections::HashMap;

use crate::{MeshError, NodeId, TriangleMesh, Vec3};

/// The surface of a block as a grid of rectangles, so many along x, y and z, with alternating diagonals. `place` maps
/// the unit cube to the block [m].
pub(super) fn surface_mesh(
    cells: [usize; 3],
    place: impl Fn(Vec3) -> Vec3,
) -> Result<TriangleMesh, MeshError> {
    let mut corners = Corners {
        cells,
        place,
        numbers: HashMap::new(),
        positions: Vec::new(),
    };
    let mut faces = Vec::with_capacity(triangles(cells));
    for axis in 0..3 {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [0, cells[axis]] {
            for c in 0..cells[first] * cells[second] {
                let (i, j) = (c % cells[first], c / cells[first]);
                let mut square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(u, v)| {
                    let mut lattice = [side; 3];
                    lattice[first] = u;
                    lattice[second] = v;
                    corners.node(lattice)
                });
                if side == 0 {
                    square.reverse();
                }
                // Starting one corner further turns the diagonal.
                let [a, b, c, d] = if (i + j) % 2 == 0 {
                    square
                } else {
                    [square[1], square[2], square[3], square[0]]
                };
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    TriangleMesh::new(corners.positions, faces)
}

/// How many triangles so many rectangles along x, y and z make.
pub(super) fn triangles([x, y, z]: [usize; 3]) -> usize {
    4 * (x * y + y * z + z * x)
}

/// Lattice points on the surface, numbered as they are first met.
struct Corners<P> {
    cells: [usize; 3],
    place: P,
    numbers: HashMap<[usize; 3], NodeId>,
    positions: Vec<Vec3>,
}

impl<P: Fn(Vec3) -> Vec3> Corners<P> {
    fn node(&mut self, lattice: [usize; 3]) -> NodeId {
        *self.numbers.entry(lattice).or_insert_with(|| {
            let part = |axis, _| lattice[axis] as f64 / self.cells[axis] as f64;
            self.positions.push((self.place)(Vec3::from_fn(part)));
            NodeId(self.positions.len() as u32 - 1)
        })
    }
}
