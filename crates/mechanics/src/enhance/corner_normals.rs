use palpate_geometry::{SHARP_EDGE, Surface, TriangleId};

use crate::Vec3;

/// Normals of a surface that may have sharp edges: smooth around each vertex up to the next edge.
#[derive(Debug, Clone)]
pub(super) struct CornerNormals {
    /// Per triangle and edge (from corner k to the next): whether it is sharp.
    sharp: Vec<[bool; 3]>,
    /// Per triangle and corner: unit outward normal [-].
    normals: Vec<[Vec3; 3]>,
}

impl CornerNormals {
    pub(super) fn new(surface: &Surface) -> Self {
        let mesh = surface.mesh();
        let facing = |triangle| mesh.area_vector(triangle).normalize();
        let sharp = mesh.triangle_ids().map(|triangle| {
            let across = surface.adjacency().across(triangle);
            across.map(|other| {
                other.is_none_or(|other| facing(triangle).dot(&facing(other)) < SHARP_EDGE)
            })
        });
        let mut found = Self {
            sharp: sharp.collect(),
            normals: Vec::with_capacity(mesh.triangles().len()),
        };
        for triangle in mesh.triangle_ids() {
            let normals = [0, 1, 2].map(|corner| found.around(surface, triangle, corner));
            found.normals.push(normals);
        }
        found
    }

    pub(super) fn of(&self, triangle: TriangleId) -> &[Vec3; 3] {
        &self.normals[triangle.index()]
    }

    pub(super) fn sharp(&self, triangle: TriangleId) -> [bool; 3] {
        self.sharp[triangle.index()]
    }

    /// Mean over the triangles around a corner, both ways up to a sharp edge, with the weights that are
    /// exact on a sphere [Max 1999].
    fn around(&self, surface: &Surface, start: TriangleId, corner: usize) -> Vec3 {
        let mesh = surface.mesh();
        let node = mesh.corners(start)[corner];
        let mut sum = weighted(surface, start, corner);
        for backward in [false, true] {
            let (mut triangle, mut here) = (start, corner);
            loop {
                let edge = if backward { (here + 2) % 3 } else { here };
                let across = surface.adjacency().across(triangle)[edge];
                let Some(next) = across.filter(|_| !self.sharp(triangle)[edge]) else {
                    break;
                };
                if next == start {
                    // All around.
                    return normal_or_face(surface, start, &sum);
                }
                triangle = next;
                here = mesh
                    .corners(next)
                    .iter()
                    .position(|&c| c == node)
                    .unwrap_or(0);
                sum += weighted(surface, triangle, here);
            }
        }
        normal_or_face(surface, start, &sum)
    }
}

fn weighted(surface: &Surface, triangle: TriangleId, corner: usize) -> Vec3 {
    let positions = surface.mesh().positions(triangle);
    let one = positions[(corner + 1) % 3] - positions[corner];
    let other = positions[(corner + 2) % 3] - positions[corner];
    one.cross(&other) / (one.norm_squared() * other.norm_squared())
}

fn normal_or_face(surface: &Surface, triangle: TriangleId, sum: &Vec3) -> Vec3 {
    let face = surface.mesh().area_vector(triangle);
    sum.try_normalize(0.0).unwrap_or_else(|| face.normalize())
}
