use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::Vec3;

/// The corners of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corners(pub(super) [Vec3; 3]);

impl Corners {
    /// Whether the corners are not all on one line; exact.
    pub(super) fn have_area(&self) -> bool {
        (0..3).any(|axis| {
            let [a, b, c] = self.0.map(|p| without_axis(&p, axis));
            orient2d(a, b, c) != 0.0
        })
    }

    /// Positive on one side of the plane, negative on the other, zero in it; the sign is exact.
    pub(super) fn side_of(&self, p: &Vec3) -> f64 {
        let [a, b, c] = &self.0;
        side(a, b, c, p)
    }

    /// The point seen along the axis that the triangle faces most.
    pub(super) fn flat(&self, p: &Vec3) -> Coord<f64> {
        let [a, b, c] = &self.0;
        let facing = (b - a).cross(&(c - a)).iamax();
        without_axis(p, facing)
    }
}

/// Whether the segment and the triangle have a point in common, ends and border included.
pub(super) fn segment_meets_triangle(from: &Vec3, to: &Vec3, triangle: &Corners) -> bool {
    let (start, end) = (triangle.side_of(from), triangle.side_of(to));
    if same_sign(start, end) {
        return false;
    }
    if start == 0.0 && end == 0.0 {
        return meet_in_plane(from, to, triangle);
    }
    // The line crosses the plane in one point, which is inside when all sides turn the same way.
    let turns = [0, 1, 2].map(|k| side(from, to, &triangle.0[k], &triangle.0[(k + 1) % 3]));
    turns.iter().all(|&t| t >= 0.0) || turns.iter().all(|&t| t <= 0.0)
}

fn meet_in_plane(from: &Vec3, to: &Vec3, triangle: &Corners) -> bool {
    let (from, to) = (triangle.flat(from), triangle.flat(to));
    let corners = triangle.0.map(|p| triangle.flat(&p));
    is_inside(from, corners)
        || is_inside(to, corners)
        || (0..3).any(|k| segments_meet([from, to], [corners[k], corners[(k + 1) % 3]]))
}

fn is_inside(p: Coord<f64>, corners: [Coord<f64>; 3]) -> bool {
    let turns = [0, 1, 2].map(|k| orient2d(corners[k], corners[(k + 1) % 3], p));
    turns.iter().all(|&t| t >= 0.0) || turns.iter().all(|&t| t <= 0.0)
}

fn segments_meet(one: [Coord<f64>; 2], other: [Coord<f64>; 2]) -> bool {
    let [a, b] = one.map(|p| orient2d(other[0], other[1], p));
    let [c, d] = other.map(|p| orient2d(one[0], one[1], p));
    if a == 0.0 && b == 0.0 && c == 0.0 && d == 0.0 {
        // All on one line.
        let overlap = |of: fn(Coord<f64>) -> f64| {
            let ([p, q], [r, s]) = (one.map(of), other.map(of));
            p.max(q) >= r.min(s) && r.max(s) >= p.min(q)
        };
        return overlap(|p| p.x) && overlap(|p| p.y);
    }
    !same_sign(a, b) && !same_sign(c, d)
}

/// Compared rather than multiplied: a product of tiny determinants may vanish.
pub(super) fn same_sign(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

fn side(a: &Vec3, b: &Vec3, c: &Vec3, p: &Vec3) -> f64 {
    let [a, b, c, p] = [a, b, c, p].map(|v| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    });
    orient3d(a, b, c, p)
}

fn without_axis(p: &Vec3, axis: usize) -> Coord<f64> {
    Coord {
        x: p[(axis + 1) % 3],
        y: p[(axis + 2) % 3],
    }
}
