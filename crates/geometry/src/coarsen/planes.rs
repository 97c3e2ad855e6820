//! The planes that each vertex of a boundary stands for: those of the surface that was filled, since a filling cuts off its
//! sharp edges.

use crate::simplify::Quadric;
use crate::{AabbTree, TetrahedronMesh, TriangleMesh, Vec3};

/// Length of a part of the surface over the edges of the boundary, at most [-].
const PART: f64 = 0.4;

/// A triangle of the surface has no more than the square of so many parts [-].
const MOST_PARTS: f64 = 64.0;

/// The quadric of each vertex of a mesh, zero inside, and the area that it stands for [m²].
pub(super) fn of_surface(mesh: &TetrahedronMesh, surface: &TriangleMesh) -> Vec<(Quadric, f64)> {
    let mut all = vec![(Quadric::zero(), 0.0); mesh.vertices().len()];
    let faces = mesh.boundary();
    let boundary = mesh.boundary_mesh();
    let tree = AabbTree::new(&boundary);
    let edge = (2.0 * boundary.area() / faces.len() as f64).sqrt();
    for triangle in surface.triangle_ids() {
        let corners = surface.positions(triangle);
        let outward = surface.area_vector(triangle);
        let double = outward.norm();
        if double == 0.0 {
            continue;
        }
        let normal = outward / double;
        for_each_part(&corners, PART * edge, |place, part| {
            let nearest = tree.nearest(&boundary, place);
            // Across a thin wall.
            if boundary.area_vector(nearest.triangle).dot(&normal) <= 0.0 {
                return;
            }
            let plane = Quadric::of_plane(place, &normal, 1.0);
            let face = faces[nearest.triangle.index()].0;
            for (node, weight) in face.iter().zip(nearest.on.barycentric) {
                let area = 0.5 * double * part * weight;
                let (quadric, sum) = &mut all[node.index()];
                *quadric = quadric.plus(&plane.times(area));
                *sum += area;
            }
        });
    }
    all
}

/// Centroids of equal parts of a triangle, whose edges are no longer than `edge` [m], and the part of its area [-].
fn for_each_part(corners: &[Vec3; 3], edge: f64, mut see: impl FnMut(&Vec3, f64)) {
    let [a, b, c] = corners;
    let longest = [b - a, c - b, a - c].map(|side| side.norm());
    let longest = longest.into_iter().fold(0.0, f64::max);
    let count = (longest / edge).ceil().clamp(1.0, MOST_PARTS);
    let (rows, part) = (count as u32, (count * count).recip());
    let mut at = |i: f64, j: f64| see(&(a + ((b - a) * i + (c - a) * j) / count), part);
    for i in 0..rows {
        for j in 0..rows - i {
            let [x, y] = [i, j].map(f64::from);
            at(x + 1.0 / 3.0, y + 1.0 / 3.0);
            if i + j + 1 < rows {
                at(x + 2.0 / 3.0, y + 2.0 / 3.0);
            }
        }
    }
}
