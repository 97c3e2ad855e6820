//! Normals and curvatures of a surface averaged over patches of the size of a tool.
//!
//! A mesh has neither: its normal jumps at every edge and its curvature sits in the edges. The normal at a
//! vertex v is the mean over the connected surface within a radius, with the weight (1 − (r/radius)²)² times the
//! cosine to the normal at v. For the curvature a paraboloid z = z₀ + a·x − ½ x·K·x is fitted by least squares to the
//! connected vertices, with the same weights. Between vertices normal and K are interpolated linearly, so both are
//! continuous over the whole surface.
//!
//! *How we know*: `analytic::curvature_of_sphere_and_cylinder`, `analytic::normals_are_those_of_the_surface_and_not_of_its_mesh`,
//! `invariants::patch_field_turns_along`.
//!
//! *Limits*: where the mesh is coarser than the radius, the radius grows to the longest edge at the vertex, for the curvature
//! to one and a half times that; a feature smaller than the patch is smoothed.

use nalgebra::{Matrix3, Matrix6, Vector6};

use crate::deviation::for_each_middle;
use crate::{NodeId, Surface, TriangleId, Vec3};

/// Averaged outward normals and curvature tensors of a [`Surface`], vertex by vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchField {
    radius: f64,
    normals: Vec<Vec3>,
    curvatures: Vec<Matrix3<f64>>,
}

/// Normal and curvature at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Unit outward normal [-].
    pub normal: Vec3,
    /// Curvature tensor [1/m]: t·K·t is the normal curvature along the unit tangent t, positive where
    /// the organ bulges out; the normal is in its null space.
    pub curvature: Matrix3<f64>,
}

impl Patch {
    /// The principal curvatures [1/m], the larger one first.
    pub fn principal_curvatures(&self) -> [f64; 2] {
        principal(&self.curvature)
    }
}

/// The eigenvalues of a curvature tensor but for that of the normal, which is zero.
fn principal(curvature: &Matrix3<f64>) -> [f64; 2] {
    let mean = 0.5 * curvature.trace();
    let half = (0.5 * curvature.norm_squared() - mean * mean)
        .max(0.0)
        .sqrt();
    [mean + half, mean - half]
}

/// Weight of the curvature against the data: a hundredth of a vertex determines a patch with too few
/// vertices, and is far too little to flatten a real one.
const RIDGE: f64 = 1e-2;

impl PatchField {
    /// The field of `surface` over patches of `radius` [m].
    pub fn new(surface: &Surface, radius: f64) -> Self {
        let mut walk = Walk::new(surface);
        let count = surface.mesh().vertices().len();
        let mut normals = Vec::with_capacity(count);
        for v in 0..count {
            let node = NodeId(v as u32);
            walk.around(surface, node, radius.max(longest_edge(surface, node)));
            normals.push(walk.mean_normal(surface));
        }
        let mut curvatures = Vec::with_capacity(count);
        for (v, normal) in normals.iter().enumerate() {
            let node = NodeId(v as u32);
            walk.around(surface, node, radius.max(1.5 * longest_edge(surface, node)));
            curvatures.push(walk.fit(surface, normal));
        }
        Self {
            radius,
            normals,
            curvatures,
        }
    }

    /// Radius of the patches [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Averaged unit normals at the vertices [-].
    pub fn vertex_normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Principal curvatures at a vertex [1/m], the larger one first.
    pub fn principal_curvatures(&self, node: NodeId) -> [f64; 2] {
        principal(&self.curvatures[node.index()])
    }

    /// The patch at the point of `triangle` with the weights `barycentric` [-].
    pub fn at(&self, surface: &Surface, triangle: TriangleId, barycentric: &[f64; 3]) -> Patch {
        let mut normal = Vec3::zeros();
        let mut curvature = Matrix3::zeros();
        for (node, &weight) in surface.mesh().corners(triangle).iter().zip(barycentric) {
            normal += weight * self.normals[node.index()];
            curvature += weight * self.curvatures[node.index()];
        }
        let normal = normal.normalize();
        let flat = Matrix3::identity() - normal * normal.transpose();
        Patch {
            normal,
            curvature: flat * curvature * flat,
        }
    }
}

/// A triangle of a mean has this many rows of parts per radius, and no more than [`MAX_ROWS`] in all.
const ROWS_PER_RADIUS: f64 = 6.0;
const MAX_ROWS: f64 = 6.0;

/// Collects the vertices of a patch, edge by edge, with their weights.
struct Walk {
    seen: Vec<u32>,
    seen_triangles: Vec<u32>,
    turn: u32,
    found: Vec<(NodeId, f64)>,
    radius: f64,
    center: NodeId,
}

impl Walk {
    fn new(surface: &Surface) -> Self {
        Self {
            seen: vec![0; surface.mesh().vertices().len()],
            seen_triangles: vec![0; surface.mesh().triangles().len()],
            turn: 0,
            found: Vec::new(),
            radius: 0.0,
            center: NodeId(0),
        }
    }

    fn around(&mut self, surface: &Surface, center: NodeId, radius: f64) {
        let mesh = surface.mesh();
        let positions = mesh.vertices();
        let origin = positions[center.index()];
        self.turn += 1;
        self.center = center;
        self.radius = radius;
        self.found.clear();
        self.found.push((center, 1.0));
        self.seen[center.index()] = self.turn;
        let facing = surface.vertex_normals()[center.index()];
        let mut next = 0;
        while next < self.found.len() {
            let (node, _) = self.found[next];
            next += 1;
            for &triangle in surface.adjacency().around(node) {
                for other in mesh.corners(triangle) {
                    if self.seen[other.index()] == self.turn {
                        continue;
                    }
                    self.seen[other.index()] = self.turn;
                    let ratio = (positions[other.index()] - origin).norm() / self.radius;
                    let cosine = surface.vertex_normals()[other.index()].dot(&facing);
                    if ratio < 1.0 && cosine > 0.0 {
                        let weight = (1.0 - ratio * ratio).powi(2) * cosine;
                        self.found.push((other, weight));
                    }
                }
            }
        }
    }

    /// Over the triangles at the collected vertices.
    fn mean_normal(&mut self, surface: &Surface) -> Vec3 {
        let mesh = surface.mesh();
        let origin = mesh.vertices()[self.center.index()];
        let facing = surface.vertex_normals()[self.center.index()];
        let mut sum = Vec3::zeros();
        for &(node, _) in &self.found {
            for &triangle in surface.adjacency().around(node) {
                if std::mem::replace(&mut self.seen_triangles[triangle.index()], self.turn)
                    == self.turn
                {
                    continue;
                }
                let area = mesh.area_vector(triangle);
                let cosine = area.dot(&facing) / area.norm().max(f64::MIN_POSITIVE);
                if cosine > 0.0 {
                    sum += cosine * self.mean_weight(surface, triangle, &origin) * area;
                }
            }
        }
        sum.try_normalize(0.0).unwrap_or(facing)
    }

    /// The mean of (1 − (r/radius)²)² over a triangle, r from `origin`.
    fn mean_weight(&self, surface: &Surface, triangle: TriangleId, origin: &Vec3) -> f64 {
        let mesh = surface.mesh();
        let [a, b, c] = mesh.positions(triangle);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let rows = (ROWS_PER_RADIUS * longest / self.radius).ceil();
        let rows = rows.clamp(1.0, MAX_ROWS) as usize;
        let mut sum = 0.0;
        for_each_middle(mesh, triangle, rows, |place| {
            let ratio = (place - origin).norm() / self.radius;
            sum += (1.0 - ratio * ratio).max(0.0).powi(2);
        });
        sum / (rows * rows) as f64
    }

    fn fit(&self, surface: &Surface, normal: &Vec3) -> Matrix3<f64> {
        let (first, second) = tangents(normal);
        let origin = surface.mesh().vertices()[self.center.index()];
        let mut matrix = Matrix6::zeros();
        let mut right = Vector6::zeros();
        for &(node, weight) in &self.found {
            let offset = (surface.mesh().vertices()[node.index()] - origin) / self.radius;
            let (x, y, z) = (offset.dot(&first), offset.dot(&second), offset.dot(normal));
            let row = Vector6::new(1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y);
            matrix += weight * row * row.transpose();
            right += weight * z * row;
        }
        // On xx² + 2 xy² + yy², which does not depend on the tangents.
        for (k, times) in [(3, 1.0), (4, 2.0), (5, 1.0)] {
            // Scaled by what a vertex halfway out adds to the diagonal.
            matrix[(k, k)] += times * RIDGE * 0.5f64.powi(6);
        }
        for k in 0..3 {
            matrix[(k, k)] += 1e-9;
        }
        let solution = matrix
            .cholesky()
            .map_or_else(Vector6::zeros, |factor| factor.solve(&right));
        let (xx, xy, yy) = (solution[3], solution[4], solution[5]);
        let mixed = first * second.transpose() + second * first.transpose();
        -(xx * first * first.transpose() + yy * second * second.transpose() + xy * mixed)
            / self.radius
    }
}

fn longest_edge(surface: &Surface, node: NodeId) -> f64 {
    let positions = surface.mesh().vertices();
    let origin = positions[node.index()];
    let around = surface.adjacency().around(node).iter();
    around
        .flat_map(|&triangle| surface.mesh().corners(triangle))
        .map(|other| (positions[other.index()] - origin).norm())
        .fold(0.0, f64::max)
}

/// Any two unit tangents that make a right-handed frame with `normal`.
fn tangents(normal: &Vec3) -> (Vec3, Vec3) {
    let mut axis = Vec3::zeros();
    axis[normal.iamin()] = 1.0;
    let first = axis.cross(normal).normalize();
    (first, normal.cross(&first))
}
