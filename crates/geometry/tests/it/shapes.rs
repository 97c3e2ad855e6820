//! Meshes, random numbers and the outside judge, for the tests of contact.

use std::f64::consts::TAU;

use nalgebra::Rotation3;
use palpate_geometry::{AabbTree, NodeId, Organ, Surface, TriangleMesh, Vec3, weld_exactly};
use parry3d_f64::shape::{TriMesh, TriMeshFlags};

/// `full` tries when `PALPATE_FULL=1`, else a tenth.
pub(crate) fn tries(full: usize) -> usize {
    if crate::wants_full() {
        full
    } else {
        full.div_ceil(10)
    }
}

pub(crate) fn organ(organ: Organ, triangles: usize) -> (Surface, AabbTree) {
    let surface = Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap();
    let tree = AabbTree::new(surface.mesh());
    (surface, tree)
}

/// A ball about the origin [m], of 8,192 triangles; its volume is 0.1 % below that of the sphere through its vertices.
pub(crate) fn ball(radius: f64) -> TriangleMesh {
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for octant in 0..8 {
        let [x, y, z] = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 });
        let [a, b, c] = [Vec3::x() * x, Vec3::y() * y, Vec3::z() * z];
        triangles.push(if x * y * z > 0.0 {
            [a, b, c]
        } else {
            [a, c, b]
        });
    }
    for _ in 0..5 {
        let quarters = |[a, b, c]: [Vec3; 3]| {
            let [d, e, f] = [
                (a + b).normalize(),
                (b + c).normalize(),
                (c + a).normalize(),
            ];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        };
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    let vertices = triangles
        .iter()
        .flatten()
        .map(|vertex| radius * vertex)
        .collect();
    let numbers = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2].map(NodeId));
    weld_exactly(&TriangleMesh::new(vertices, numbers.collect()).unwrap()).0
}

/// A closed tube of `radius` and `length` [m] along z with `around` equal triangles to a turn.
pub(crate) fn cylinder(radius: f64, length: f64, around: usize) -> Surface {
    let rise = TAU * radius / around as f64 * 0.75f64.sqrt();
    let rows = (length / rise).round() as usize;
    let mut vertices = Vec::new();
    for row in 0..=rows {
        for k in 0..around {
            let turn = TAU * (k as f64 + 0.5 * (row % 2) as f64) / around as f64;
            let z = length * (row as f64 / rows as f64 - 0.5);
            vertices.push(Vec3::new(radius * turn.cos(), radius * turn.sin(), z));
        }
    }
    let node = |row: usize, k: usize| NodeId((row * around + k % around) as u32);
    let mut triangles = Vec::new();
    for row in 0..rows {
        for k in 0..around {
            let (this, next) = (node(row, k), node(row, k + 1));
            if row % 2 == 0 {
                triangles.push([this, next, node(row + 1, k)]);
                triangles.push([next, node(row + 1, k + 1), node(row + 1, k)]);
            } else {
                triangles.push([this, next, node(row + 1, k + 1)]);
                triangles.push([this, node(row + 1, k + 1), node(row + 1, k)]);
            }
        }
    }
    for (row, low) in [(0, true), (rows, false)] {
        let center = NodeId(vertices.len() as u32);
        vertices.push(Vec3::z() * (if low { -0.5 } else { 0.5 } * length));
        for k in 0..around {
            let (this, next) = (node(row, k), node(row, k + 1));
            triangles.push(if low {
                [next, this, center]
            } else {
                [this, next, center]
            });
        }
    }
    Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// A seeded generator of random numbers [Knuth's MMIX constants].
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Even in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        let z = 2.0 * self.unit() - 1.0;
        let (sine, cosine) = (TAU * self.unit()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vec3::new(across * cosine, across * sine, z)
    }

    /// Even in the box of `mesh`, made larger by half on every side.
    pub(crate) fn around(&mut self, mesh: &TriangleMesh) -> Vec3 {
        let (low, high) = mesh.bounds();
        let along = Vec3::from_fn(|_, _| 2.0 * self.unit() - 0.5);
        low + (high - low).component_mul(&along)
    }

    pub(crate) fn rotation(&mut self) -> Rotation3<f64> {
        Rotation3::new(self.direction() * (3.0 * self.unit()))
    }
}

/// Diagonal of the bounding box [m].
pub(crate) fn size(mesh: &TriangleMesh) -> f64 {
    let (low, high) = mesh.bounds();
    (high - low).norm()
}

pub(crate) fn parry_vector(v: &Vec3) -> parry3d_f64::math::Vector {
    parry3d_f64::math::Vector::new(v.x, v.y, v.z)
}

pub(crate) fn from_parry(v: parry3d_f64::math::Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

/// The same mesh in the outside code, with its signs of distance.
pub(crate) fn parry_mesh(mesh: &TriangleMesh) -> TriMesh {
    let vertices = mesh.vertices().iter().map(parry_vector).collect();
    let triangles = mesh.triangles().iter().map(|t| t.map(|n| n.0)).collect();
    TriMesh::with_flags(vertices, triangles, TriMeshFlags::ORIENTED).unwrap()
}
