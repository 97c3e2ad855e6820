//! The connected part of the boundary within a radius of a point: of tetrahedra, and of the surface that they
//! fill.

use std::collections::BTreeSet;

use palpate_geometry::{Surface, TetrahedronMesh, TriangleId, closest_on_triangle};

use super::mesh::Face;
use super::problem::MovedPatch;
use crate::Vec3;
use crate::contact::Friction;

/// A vertex within this part of the radius outside of the sphere is on it [-].
const ON: f64 = 1e-8;

/// The faces within `radius` [m] of `center` that hang together with the nearest of them.
pub(super) fn faces_within<'a>(
    radius: f64,
    center: &Vec3,
    mesh: &TetrahedronMesh,
    faces: &'a [Face],
) -> Vec<&'a Face> {
    let reach = radius * (1.0 + ON);
    let within = |face: &&Face| {
        let corners = face.positions(mesh);
        corners.iter().all(|p| (p - center).norm() <= reach)
    };
    let mut inside: Vec<&Face> = faces.iter().filter(within).collect();
    let distance =
        |face: &Face| (closest_on_triangle(&face.positions(mesh), center).position - center).norm();
    inside.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    // Middles of edges are shared by neighbours only.
    let mut reached: BTreeSet<usize> = inside
        .first()
        .into_iter()
        .flat_map(|face| face.nodes[3..].iter().copied())
        .collect();
    let mut patch = Vec::new();
    loop {
        let (new, rest): (Vec<&Face>, Vec<&Face>) = inside
            .into_iter()
            .partition(|face| face.nodes[3..].iter().any(|n| reached.contains(n)));
        if new.is_empty() {
            return patch;
        }
        reached.extend(new.iter().flat_map(|face| face.nodes[3..].iter().copied()));
        patch.extend(new);
        inside = rest;
    }
}

impl MovedPatch {
    /// A warning where the patch resists turning more than a face that is only pressed can: where the `moment` about its centre
    /// [N m] puts its `force` [N] outside of it.
    pub(super) fn pulls(&self, force: &Vec3, moment: &Vec3) -> Option<String> {
        let lever = moment.norm() / (force.norm() * self.radius);
        (self.friction == Friction::Frictionless && lever > 1.0).then(|| {
            format!(
                "the patch pulls on one side: it cannot turn, and its force acts {lever:.1} radii from its centre; a rigid tool in \
                 contact lets go there, and its force is smaller"
            )
        })
    }
}

/// Of faces [m²].
pub(super) fn area_of(faces: &[&Face], mesh: &TetrahedronMesh) -> f64 {
    let areas = faces.iter().map(|face| {
        let [a, b, c] = face.positions(mesh);
        0.5 * (b - a).cross(&(c - a)).norm()
    });
    areas.sum()
}

/// Area of the part of `surface` within `radius` [m] of `center` that hangs together with the triangle nearest to
/// it [m²].
pub(super) fn area_within(radius: f64, center: &Vec3, surface: &Surface) -> f64 {
    let mesh = surface.mesh();
    let from = |triangle: &TriangleId| {
        let nearest = closest_on_triangle(&mesh.positions(*triangle), center).position;
        (nearest - center).norm()
    };
    let nearest = mesh
        .triangle_ids()
        .min_by(|a, b| from(a).total_cmp(&from(b)));
    let mut found: Vec<TriangleId> = nearest.into_iter().collect();
    let mut seen: BTreeSet<TriangleId> = found.iter().copied().collect();
    let mut area = 0.0;
    while let Some(triangle) = found.pop() {
        let corners = mesh.positions(triangle);
        area += area_in_sphere(&corners, center, radius);
        for (k, other) in surface.adjacency().across(triangle).into_iter().enumerate() {
            let [from, to] = [corners[k], corners[(k + 1) % 3]];
            let reached = distance_to_edge(&from, &to, center) < radius;
            found.extend(other.filter(|&other| reached && seen.insert(other)));
        }
    }
    area
}

fn distance_to_edge(from: &Vec3, to: &Vec3, point: &Vec3) -> f64 {
    let way = to - from;
    let part = way.dot(&(point - from)) / way.norm_squared();
    (from + way * part.clamp(0.0, 1.0) - point).norm()
}

/// Of the part of a triangle within a sphere [m²]: the triangle and a disc in its plane, edge by edge as seen from
/// the disc's middle, where the edge is within the disc a triangle and elsewhere a sector.
fn area_in_sphere([a, b, c]: &[Vec3; 3], center: &Vec3, radius: f64) -> f64 {
    let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else {
        return 0.0;
    };
    let height = (center - a).dot(&normal);
    let squared = radius * radius - height * height;
    if squared <= 0.0 {
        return 0.0;
    }
    let foot = center - normal * height;
    let edges = [(a, b), (b, c), (c, a)];
    let parts = edges.map(|(from, to)| {
        let (from, way) = (from - foot, to - from);
        // Where the line enters the disc and leaves it.
        let middle = -from.dot(&way) / way.norm_squared();
        let half = (squared - (from + way * middle).norm_squared())
            .max(0.0)
            .sqrt()
            / way.norm();
        let [enters, leaves] = [middle - half, middle + half].map(|part| part.clamp(0.0, 1.0));
        let at = |part: f64| from + way * part;
        let turned = |one: Vec3, other: Vec3| {
            normal.dot(&one.cross(&other)).atan2(one.dot(&other)) * 0.5 * squared
        };
        let inside = 0.5 * normal.dot(&at(enters).cross(&at(leaves)));
        turned(at(0.0), at(enters)) + inside + turned(at(leaves), at(1.0))
    });
    parts.iter().sum()
}
