//! The planes that each vertex of a boundary represents: those of the filled surface, since a filling cuts off its sharp
//! edges.

use crate::deviation::for_each_middle;
use crate::simplify::Quadric;
use crate::{AabbTree, TetrahedronMesh, TriangleMesh};

/// Length of a part of the surface over the edges of the boundary, at most [-].
const PART: f64 = 0.4;

/// Rows of parts of a triangle of the surface at most [-].
const MAX_ROWS: f64 = 64.0;

/// The quadric of each vertex of a mesh, zero inside, and the area that it represents [m²].
pub(super) fn of_surface(mesh: &TetrahedronMesh, surface: &TriangleMesh) -> Vec<(Quadric, f64)> {
    let mut all = vec![(Quadric::zero(), 0.0); mesh.vertices().len()];
    let faces = mesh.boundary();
    // The same faces in the same order.
    let boundary = mesh.boundary_mesh();
    let tree = AabbTree::new(&boundary);
    let edge = (2.0 * boundary.area() / faces.len() as f64).sqrt();
    for triangle in surface.triangle_ids() {
        let [a, b, c] = surface.positions(triangle);
        let outward = surface.area_vector(triangle);
        let double = outward.norm();
        if double == 0.0 {
            continue;
        }
        let normal = outward / double;
        let longest = [b - a, c - b, a - c].map(|side| side.norm());
        let longest = longest.into_iter().fold(0.0, f64::max);
        let rows = (longest / (PART * edge)).ceil().clamp(1.0, MAX_ROWS);
        let area = 0.5 * double * (rows * rows).recip();
        for_each_middle(surface, triangle, rows as usize, |place| {
            let nearest = tree.nearest(&boundary, &place);
            // Across a thin wall.
            if boundary.area_vector(nearest.triangle).dot(&normal) <= 0.0 {
                return;
            }
            let plane = Quadric::of_plane(&place, &normal, 1.0);
            let face = faces[nearest.triangle.index()].0;
            for (node, weight) in face.iter().zip(nearest.on.barycentric) {
                let (quadric, sum) = &mut all[node.index()];
                *quadric = quadric.plus(&plane.times(area * weight));
                *sum += area * weight;
            }
        });
    }
    all
}
