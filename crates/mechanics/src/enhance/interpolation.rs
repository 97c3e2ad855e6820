use nalgebra::Vector2;
use palpate_files::scene::Smoothing;
use palpate_geometry::{AabbTree, NodeId, Surface, TriangleId, closest_on_triangle};

use super::functions::{moving_least_squares, shepard};
use super::weights::Weights;
use crate::Vec3;
use crate::finite_spheres::quartic;

/// Radius of influence in distances from a centroid to its farthest corner. At two, every point of a
/// triangle has the weight 5/16 or more of its own centroid, so that there are no holes [-].
const RADIUS: f64 = 2.0;

/// How values at the centroids of a coarse surface are spread over it.
#[derive(Debug, Clone)]
pub struct Interpolation {
    surface: Surface,
    smoothing: Smoothing,
    nodes: Vec<Node>,
    /// The nodes that reach into triangle t: `reaching[starts[t]..starts[t + 1]]`, in ascending order.
    starts: Vec<u32>,
    reaching: Vec<TriangleId>,
}

/// A point of the coarse surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The triangle it lies on.
    pub triangle: TriangleId,
    /// Weights of its corners [-].
    pub barycentric: [f64; 3],
}

/// A centroid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// [m]
    pub(super) place: Vec3,
    pub(super) normal: Vec3,
    /// Radius of influence [m].
    pub(super) radius: f64,
}

impl SurfacePoint {
    /// The middle of `triangle`.
    pub fn centroid(triangle: TriangleId) -> Self {
        Self {
            triangle,
            barycentric: [1.0 / 3.0; 3],
        }
    }

    /// A vertex of `surface`, always on the same triangle.
    pub fn vertex(surface: &Surface, node: NodeId) -> Self {
        let triangle = surface.adjacency().around(node)[0];
        let corners = surface.mesh().corners(triangle);
        Self {
            triangle,
            barycentric: corners.map(|corner| f64::from(u8::from(corner == node))),
        }
    }
}

impl Interpolation {
    /// Over the coarse `surface`.
    pub fn new(surface: Surface, smoothing: Smoothing) -> Self {
        let mut interpolation = Self {
            nodes: Vec::with_capacity(surface.mesh().triangles().len()),
            surface,
            smoothing,
            starts: Vec::new(),
            reaching: Vec::new(),
        };
        for triangle in interpolation.surface.mesh().triangle_ids() {
            let at = SurfacePoint::centroid(triangle);
            let place = interpolation.place(&at);
            let corners = interpolation.surface.mesh().positions(triangle);
            let farthest = corners.map(|corner| (corner - place).norm());
            interpolation.nodes.push(Node {
                place,
                normal: interpolation.normal(&at),
                radius: RADIUS * farthest.into_iter().fold(0.0, f64::max),
            });
        }
        interpolation.find_reach();
        interpolation
    }

    /// The same nodes with another way to spread.
    pub(super) fn with_smoothing(&self, smoothing: Smoothing) -> Self {
        Self {
            smoothing,
            ..self.clone()
        }
    }

    /// The coarse surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Position of a point at rest [m].
    pub fn place(&self, at: &SurfacePoint) -> Vec3 {
        blend(&self.surface.mesh().positions(at.triangle), &at.barycentric)
    }

    /// The averaged unit outward normal there [-], continuous over the surface.
    pub fn normal(&self, at: &SurfacePoint) -> Vec3 {
        let corners = self.surface.mesh().corners(at.triangle);
        let normals = corners.map(|node| self.surface.vertex_normals()[node.index()]);
        let facing = self.surface.mesh().area_vector(at.triangle);
        blend(&normals, &at.barycentric)
            .try_normalize(1e-12)
            .unwrap_or_else(|| facing.normalize())
    }

    /// The point nearest to `place` [m] on a triangle that does not face away from the unit `normal` [-];
    /// `tree` is around the coarse surface. Allocates nothing.
    pub fn nearest_facing(&self, tree: &AabbTree, place: &Vec3, normal: &Vec3) -> SurfacePoint {
        let mesh = self.surface.mesh();
        let faces_alike = |triangle: TriangleId| mesh.area_vector(triangle).dot(normal) > 0.0;
        let nearest = tree.nearest(mesh, place);
        let mut best = SurfacePoint {
            triangle: nearest.triangle,
            barycentric: nearest.on.barycentric,
        };
        if faces_alike(nearest.triangle) {
            return best;
        }
        // The other side of a thin wall, or of a sharp edge.
        let mut distance = nearest.distance + self.nodes[best.triangle.index()].radius;
        let reach = Vec3::repeat(distance);
        tree.visit_box(&(place - reach), &(place + reach), |triangle| {
            let on = closest_on_triangle(&mesh.positions(triangle), place);
            let away = (on.position - place).norm();
            if away < distance && faces_alike(triangle) {
                distance = away;
                best = SurfacePoint {
                    triangle,
                    barycentric: on.barycentric,
                };
            }
        });
        best
    }

    /// The most weights that a row may have.
    pub(super) fn longest_row(&self) -> usize {
        let mesh = self.surface.mesh();
        let around = |node: NodeId| self.surface.adjacency().around(node).len();
        let of_means = |triangle| mesh.corners(triangle).map(around).iter().sum();
        let row = |triangle| match self.smoothing {
            Smoothing::None => of_means(triangle),
            Smoothing::Shepard | Smoothing::MovingLeastSquares => self.reaching(triangle).len(),
        };
        mesh.triangle_ids().map(row).max().unwrap_or(0)
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Adds the row of a point.
    pub(super) fn write_row(&self, at: &SurfacePoint, weights: &mut Weights) {
        match self.smoothing {
            Smoothing::None => self.write_means(at, weights),
            Smoothing::Shepard | Smoothing::MovingLeastSquares => self.write_smooth(at, weights),
        }
        weights.end_row();
    }

    /// Linear between the corners, each with the mean over its triangles by area.
    fn write_means(&self, at: &SurfacePoint, weights: &mut Weights) {
        let mesh = self.surface.mesh();
        for (node, share) in mesh.corners(at.triangle).into_iter().zip(at.barycentric) {
            if share == 0.0 {
                continue;
            }
            let around = self.surface.adjacency().around(node);
            let area = |&triangle: &TriangleId| mesh.area_vector(triangle).norm();
            let whole: f64 = around.iter().map(area).sum();
            for triangle in around {
                weights.push(*triangle, share * area(triangle) / whole);
            }
        }
    }

    fn write_smooth(&self, at: &SurfacePoint, weights: &mut Weights) {
        let (place, normal) = (self.place(at), self.normal(at));
        for &triangle in self.reaching(at.triangle) {
            let node = &self.nodes[triangle.index()];
            let ratio = (node.place - place).norm() / node.radius;
            // (4.13); the other side of a thin wall has no part.
            let weight = quartic(ratio) * alike(&node.normal, &normal);
            if weight > 0.0 {
                weights.push(triangle, weight);
            }
        }
        if weights.open_row().0.is_empty() {
            // A spike, whose mean normal is that of none of its triangles.
            weights.push(at.triangle, 1.0);
        }
        let (triangles, values) = weights.open_row();
        if self.smoothing == Smoothing::Shepard {
            return shepard(values);
        }
        let (s, t) = tangents(&normal);
        moving_least_squares(values, |i| {
            let away = self.nodes[triangles[i].index()].place - place;
            Vector2::new(away.dot(&s), away.dot(&t))
        });
    }

    fn reaching(&self, triangle: TriangleId) -> &[TriangleId] {
        let [start, end] = [0, 1].map(|k| self.starts[triangle.index() + k] as usize);
        &self.reaching[start..end]
    }

    /// Goes from each node over the triangles within its radius: what is near through air is not reached.
    fn find_reach(&mut self) {
        let mesh = self.surface.mesh();
        let count = mesh.triangles().len();
        let mut pairs: Vec<(TriangleId, TriangleId)> = Vec::with_capacity(24 * count);
        let mut seen = vec![u32::MAX; count];
        let mut reached = Vec::new();
        for node in mesh.triangle_ids() {
            let Node { place, radius, .. } = self.nodes[node.index()];
            reached.clear();
            reached.push(node);
            seen[node.index()] = node.0;
            let mut next = 0;
            while let Some(&triangle) = reached.get(next) {
                next += 1;
                pairs.push((triangle, node));
                for corner in mesh.corners(triangle) {
                    for &other in self.surface.adjacency().around(corner) {
                        if seen[other.index()] == node.0 {
                            continue;
                        }
                        seen[other.index()] = node.0;
                        let nearest = closest_on_triangle(&mesh.positions(other), &place);
                        if (nearest.position - place).norm() < radius {
                            reached.push(other);
                        }
                    }
                }
            }
        }
        pairs.sort_unstable();
        self.starts = vec![0; count + 1];
        for (triangle, _) in &pairs {
            self.starts[triangle.index() + 1] += 1;
        }
        for triangle in 0..count {
            self.starts[triangle + 1] += self.starts[triangle];
        }
        self.reaching = pairs.into_iter().map(|(_, node)| node).collect();
    }
}

/// Whether two normals belong to the same side: one up to 60° between them, zero from a right angle on [-].
pub(super) fn alike(one: &Vec3, other: &Vec3) -> f64 {
    smooth_step(2.0 * one.dot(other))
}

/// From zero to one, flat at both ends [-].
pub(super) fn smooth_step(part: f64) -> f64 {
    let part = part.clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}

fn blend(corners: &[Vec3; 3], [u, v, w]: &[f64; 3]) -> Vec3 {
    corners[0] * *u + corners[1] * *v + corners[2] * *w
}

fn tangents(normal: &Vec3) -> (Vec3, Vec3) {
    let across = Vec3::ith(normal.iamin(), 1.0);
    let first = normal.cross(&across).normalize();
    (first, normal.cross(&first))
}
