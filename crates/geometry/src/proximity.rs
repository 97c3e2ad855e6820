//! Nearest points between points, segments and triangles, and the signed distance to a surface.
//!
//! Point to triangle by Voronoi regions [Ericson 2004, 5.1.5]; the sign by the normal of the nearest
//! feature, which is exact for closed meshes [Baerentzen and Aanaes 2005].
//!
//! *How we know*: `agreement::closest_point_is_that_of_parry`, `analytic::signed_distance_of_sphere`.

use crate::{AabbTree, Nearest, Surface, TriangleId, Vec3};

/// A point on a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointOnTriangle {
    /// Weights of the three corners [-]; they sum to one, and those of the corners that do not take
    /// part are exactly zero.
    pub barycentric: [f64; 3],
    /// The point [m].
    pub position: Vec3,
}

impl PointOnTriangle {
    /// The start value of a search.
    pub(crate) const NOWHERE: Self = Self {
        barycentric: [1.0, 0.0, 0.0],
        position: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
    };

    fn at(corners: &[Vec3; 3], barycentric: [f64; 3]) -> Self {
        let [u, v, w] = barycentric;
        Self {
            barycentric,
            position: corners[0] * u + corners[1] * v + corners[2] * w,
        }
    }
}

/// The point of the triangle `corners` [m] nearest to `point` [m].
pub fn closest_on_triangle(corners: &[Vec3; 3], point: &Vec3) -> PointOnTriangle {
    let [a, b, c] = corners;
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return PointOnTriangle::at(corners, [1.0, 0.0, 0.0]);
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return PointOnTriangle::at(corners, [0.0, 1.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return PointOnTriangle::at(corners, [1.0 - v, v, 0.0]);
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return PointOnTriangle::at(corners, [0.0, 0.0, 1.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return PointOnTriangle::at(corners, [1.0 - w, 0.0, w]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return PointOnTriangle::at(corners, [0.0, 1.0 - w, w]);
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    PointOnTriangle::at(corners, [1.0 - v - w, v, w])
}

/// Squared distance [m²] between a segment and a triangle.
pub(crate) fn segment_to_triangle(start: &Vec3, end: &Vec3, corners: &[Vec3; 3]) -> f64 {
    if is_crossed(start, end, corners) {
        return 0.0;
    }
    let [a, b, c] = corners;
    let tip = |tip: &Vec3| (closest_on_triangle(corners, tip).position - tip).norm_squared();
    let edge = |from: &Vec3, to: &Vec3| between_segments(start, end, from, to);
    tip(start)
        .min(tip(end))
        .min(edge(a, b))
        .min(edge(b, c))
        .min(edge(c, a))
}

/// Whether a segment passes through the inside of a triangle.
fn is_crossed(start: &Vec3, end: &Vec3, corners: &[Vec3; 3]) -> bool {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let (above, below) = ((start - a).dot(&normal), (end - a).dot(&normal));
    if above * below >= 0.0 {
        return false;
    }
    let point = start + (end - start) * (above / (above - below));
    let on = closest_on_triangle(corners, &point);
    on.barycentric.iter().all(|&weight| weight > 0.0)
}

/// Squared distance [m²] between two segments [Ericson 2004, 5.1.9].
fn between_segments(p1: &Vec3, q1: &Vec3, p2: &Vec3, q2: &Vec3) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let (b, c) = (d1.dot(&d2), d1.dot(&r));
    let fraction = |top: f64, bottom: f64| {
        if bottom > 0.0 {
            (top / bottom).clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    let mut s = fraction(b * f - c * e, a * e - b * b);
    let mut t = fraction(b * s + f, e);
    s = fraction(b * t - c, a);
    t = fraction(b * s + f, e);
    (r + d1 * s - d2 * t).norm_squared()
}

impl Surface {
    /// The nearest point of the surface and the signed distance of `point` to it [m], negative
    /// inside. `tree` is the tree of this surface's mesh.
    pub fn signed_distance(&self, tree: &AabbTree, point: &Vec3) -> (Nearest, f64) {
        self.signed_distance_from(tree, point, None)
    }

    /// As [`Self::signed_distance`], faster if `near` is a triangle close to the point.
    pub fn signed_distance_from(
        &self,
        tree: &AabbTree,
        point: &Vec3,
        near: Option<TriangleId>,
    ) -> (Nearest, f64) {
        let nearest = tree.nearest_from(self.mesh(), point, near);
        let outward = self.pseudo_normal(&nearest);
        let sign = if outward.dot(&(point - nearest.on.position)) < 0.0 {
            -1.0
        } else {
            1.0
        };
        (nearest, sign * nearest.distance)
    }

    /// Normal of the feature (face, edge or vertex) that a nearest point lies on.
    fn pseudo_normal(&self, nearest: &Nearest) -> Vec3 {
        let mesh = self.mesh();
        let face = |t| mesh.area_vector(t).normalize();
        let corners = mesh.corners(nearest.triangle);
        let taking_part = [0, 1, 2].map(|k| nearest.on.barycentric[k] > 0.0);
        match taking_part {
            [true, false, false] => self.vertex_normals()[corners[0].index()],
            [false, true, false] => self.vertex_normals()[corners[1].index()],
            [false, false, true] => self.vertex_normals()[corners[2].index()],
            [true, true, false] => face(nearest.triangle) + self.normal_across(nearest, 0),
            [false, true, true] => face(nearest.triangle) + self.normal_across(nearest, 1),
            [true, false, true] => face(nearest.triangle) + self.normal_across(nearest, 2),
            _ => face(nearest.triangle),
        }
    }

    fn normal_across(&self, nearest: &Nearest, edge: usize) -> Vec3 {
        self.adjacency().across(nearest.triangle)[edge]
            .map_or_else(Vec3::zeros, |t| self.mesh().area_vector(t).normalize())
    }
}
