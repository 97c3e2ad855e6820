use std::collections::HashMap;

use super::{AnchorPlane, OrganDescription};
use crate::{MeshError, NodeId, TriangleMesh, Vec3};

const EDGE: f64 = 0.1;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "A cube, for comparison with closed forms.",
        axes: "x, y and z along the edges, z up",
        origin: "the centre",
        lengths: "edge 100 mm: [-0.05, 0.05] m along each axis",
        held: "the bottom face, z = -0.05 m",
        extent: Vec3::repeat(EDGE),
        volume: EDGE.powi(3),
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        // Just above the face: below the centroid of any triangle of the sides.
        point: Vec3::new(0.0, 0.0, -0.5 * EDGE + 1e-6),
        normal: Vec3::z(),
    }]
}

/// A grid of squares on each face, with alternating diagonals: 12 n² triangles.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    let cells = nearest_square(triangles, 12, 1);
    let mut corners = Corners::new(cells);
    let mut faces = Vec::with_capacity(12 * cells * cells);
    for axis in 0..3 {
        for side in [0, cells] {
            for (i, j) in (0..cells * cells).map(|c| (c % cells, c / cells)) {
                let mut square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(u, v)| {
                    let mut lattice = [side; 3];
                    lattice[(axis + 1) % 3] = u;
                    lattice[(axis + 2) % 3] = v;
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

/// The whole number n, `least` or more, for which `factor` n² is nearest to `wanted`.
pub(super) fn nearest_square(wanted: usize, factor: usize, least: usize) -> usize {
    let root = (wanted as f64 / factor as f64).sqrt();
    let (below, above) = (root.floor() as usize, root.ceil() as usize);
    let nearest =
        if wanted.abs_diff(factor * below * below) <= wanted.abs_diff(factor * above * above) {
            below
        } else {
            above
        };
    nearest.max(least)
}

/// Lattice points on the surface, numbered as they are first met.
struct Corners {
    cells: usize,
    numbers: HashMap<[usize; 3], NodeId>,
    positions: Vec<Vec3>,
}

impl Corners {
    fn new(cells: usize) -> Self {
        Self {
            cells,
            numbers: HashMap::new(),
            positions: Vec::new(),
        }
    }

    fn node(&mut self, lattice: [usize; 3]) -> NodeId {
        *self.numbers.entry(lattice).or_insert_with(|| {
            let scaled = lattice.map(|l| EDGE * (l as f64 / self.cells as f64 - 0.5));
            self.positions.push(Vec3::from(scaled));
            NodeId(self.positions.len() as u32 - 1)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volume_and_bounds_are_exact() {
        let mesh = surface_mesh(300).unwrap();
        assert_eq!(mesh.triangles().len(), 300);
        assert!((mesh.volume() - 1e-3).abs() < 1e-15);
        assert_eq!(mesh.bounds(), (Vec3::repeat(-0.05), Vec3::repeat(0.05)));
    }

    #[test]
    fn only_the_bottom_is_held() {
        let mesh = surface_mesh(10_000).unwrap();
        let plane = anchor()[0];
        let held: f64 = mesh
            .triangle_ids()
            .filter(|&t| plane.holds(&(mesh.positions(t).iter().sum::<Vec3>() / 3.0)))
            .map(|t| mesh.area_vector(t).norm())
            .sum();
        assert!((held - 0.01).abs() < 1e-12);
    }

    #[test]
    fn the_nearest_square_is_chosen() {
        assert_eq!(nearest_square(12, 12, 1), 1);
        assert_eq!(nearest_square(100, 12, 1), 3);
        assert_eq!(nearest_square(5, 12, 1), 1);
    }
}
