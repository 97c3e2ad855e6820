use std::cell::Cell;
use std::ops::ControlFlow;

use super::{Aabb, AabbTree, Below, STACK};
use crate::proximity::{PointOnTriangle, closest_on_triangle, segment_to_triangle};
use crate::{TriangleId, TriangleMesh, Vec3};

/// The nearest point of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The triangle it lies on; the lowest number when several are equally near.
    pub triangle: TriangleId,
    /// The point on the triangle.
    pub on: PointOnTriangle,
    /// Distance [m], not signed.
    pub distance: f64,
}

/// Intersection of a ray with a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The triangle that is met.
    pub triangle: TriangleId,
    /// Distance along the ray [m].
    pub distance: f64,
}

/// Farther out [m] squares of distances do not distinguish an organ's points, and the nearest one could be behind
/// it.
const FAR: f64 = 1e6;

/// Clamps points that lie farther out.
fn within_reach(point: &Vec3) -> Vec3 {
    point.map(|number| number.clamp(-FAR, FAR))
}

impl AabbTree {
    /// The point of `mesh` nearest to `point` [m], of which no coordinate counts for more than a thousand kilometres.
    pub fn nearest(&self, mesh: &TriangleMesh, point: &Vec3) -> Nearest {
        self.nearest_from(mesh, point, None)
    }

    /// As [`Self::nearest`], faster if `near` is a triangle close to the point, such as the nearest one of the step before.
    ///
    /// # Panics
    /// When that triangle is not of `mesh`.
    pub fn nearest_from(
        &self,
        mesh: &TriangleMesh,
        point: &Vec3,
        near: Option<TriangleId>,
    ) -> Nearest {
        let point = within_reach(point);
        self.search(
            near,
            |aabb| aabb.squared_distance(&point),
            |triangle| {
                let on = closest_on_triangle(&mesh.positions(triangle), &point);
                ((on.position - point).norm_squared(), on)
            },
        )
    }

    /// Whether the segment from `start` to `end` [m], as the shaft of a tool, comes nearer to `mesh` than `distance` [m].
    pub fn is_near_segment(
        &self,
        mesh: &TriangleMesh,
        [start, end]: [&Vec3; 2],
        distance: f64,
    ) -> bool {
        let (start, end) = (within_reach(start), within_reach(end));
        let (along, margin) = (end - start, Vec3::repeat(distance));
        let is_near = self.walk(
            |aabb| {
                let (low, high) = (aabb.low - margin, aabb.high + margin);
                Aabb { low, high }.is_crossed(&start, &along, 1.0)
            },
            |triangle| {
                let corners = mesh.positions(triangle);
                match segment_to_triangle(&start, &end, &corners).sqrt() < distance {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            },
        );
        is_near.is_break()
    }

    /// The first triangle that a ray from `origin` [m] along the unit vector `direction` meets
    /// within `reach` [m], from either side.
    pub fn cast(
        &self,
        mesh: &TriangleMesh,
        origin: &Vec3,
        direction: &Vec3,
        reach: f64,
    ) -> Option<Hit> {
        let best: Cell<Option<Hit>> = Cell::new(None);
        let limit = || best.get().map_or(reach, |hit| hit.distance);
        let _ = self.walk(
            |aabb| aabb.is_crossed(origin, direction, limit()),
            |triangle| {
                let corners = mesh.positions(triangle);
                if let Some(distance) = ray_meets_triangle(origin, direction, &corners)
                    && distance <= limit()
                {
                    best.set(Some(Hit { triangle, distance }));
                }
                ControlFlow::Continue(())
            },
        );
        best.get()
    }

    /// Calls `visit` for every triangle whose box meets the box `low` to `high` [m].
    pub fn visit_box(&self, low: &Vec3, high: &Vec3, mut visit: impl FnMut(TriangleId)) {
        let _ = self.walk(
            |aabb| !(0..3).any(|k| aabb.low[k] > high[k] || aabb.high[k] < low[k]),
            |triangle| {
                visit(triangle);
                ControlFlow::Continue(())
            },
        );
    }

    /// Takes every triangle below the boxes that are entered, until one ends it.
    #[inline]
    fn walk(
        &self,
        enters: impl Fn(&Aabb) -> bool,
        mut takes: impl FnMut(TriangleId) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut stack = [0u32; STACK];
        let mut filled = 1;
        while filled > 0 {
            filled -= 1;
            let node = &self.nodes[stack[filled] as usize];
            if !enters(&node.aabb) {
                continue;
            }
            match node.below {
                Below::Boxes(first) => {
                    stack[filled] = first;
                    stack[filled + 1] = first + 1;
                    filled += 2;
                }
                Below::Triangle(triangle) => takes(triangle)?,
            }
        }
        ControlFlow::Continue(())
    }

    /// Branch and bound, nearer box first, over squared distances, starting from the distance of the triangle `near`.
    fn search(
        &self,
        near: Option<TriangleId>,
        to_box: impl Fn(&Aabb) -> f64,
        to_triangle: impl Fn(TriangleId) -> (f64, PointOnTriangle),
    ) -> Nearest {
        let mut best = match near {
            Some(triangle) => {
                let (squared, on) = to_triangle(triangle);
                (squared, triangle, on)
            }
            None => (
                f64::INFINITY,
                TriangleId(u32::MAX),
                PointOnTriangle::NOWHERE,
            ),
        };
        let mut stack = [(0u32, 0.0); STACK];
        let mut filled = 1;
        while filled > 0 {
            filled -= 1;
            let (at, bound) = stack[filled];
            if bound > best.0 + self.tie {
                continue;
            }
            match self.nodes[at as usize].below {
                Below::Boxes(first) => {
                    let near = (first, to_box(&self.nodes[first as usize].aabb));
                    let far = (first + 1, to_box(&self.nodes[first as usize + 1].aabb));
                    let (near, far) = if near.1 <= far.1 {
                        (near, far)
                    } else {
                        (far, near)
                    };
                    stack[filled] = far;
                    stack[filled + 1] = near;
                    filled += 2;
                }
                Below::Triangle(triangle) => {
                    let (squared, on) = to_triangle(triangle);
                    let nearer = squared < best.0 - self.tie;
                    let tied = (squared - best.0).abs() <= self.tie && triangle < best.1;
                    if nearer || tied {
                        best = (squared, triangle, on);
                    }
                }
            }
        }
        Nearest {
            triangle: best.1,
            on: best.2,
            distance: best.0.sqrt(),
        }
    }
}

impl Aabb {
    /// Slab test. A zero component gives infinities, which compare as they should; a ray that runs
    /// in the plane of a face (0/0) counts as crossing.
    fn is_crossed(&self, origin: &Vec3, direction: &Vec3, reach: f64) -> bool {
        if self.low.x > self.high.x {
            return false;
        }
        let (mut enter, mut leave) = (0.0f64, reach);
        for k in 0..3 {
            let a = (self.low[k] - origin[k]) / direction[k];
            let b = (self.high[k] - origin[k]) / direction[k];
            if a.is_nan() || b.is_nan() {
                continue;
            }
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        // A flat box must not be missed for a rounding error.
        enter <= leave + 1e-12 * (1.0 + leave.abs())
    }
}

/// Distance along the ray from `origin` [m] in a unit `direction`, where it meets a triangle with these `corners` [m] from
/// either side; none where it does not [Möller and Trumbore 1997].
pub fn ray_meets_triangle(origin: &Vec3, direction: &Vec3, corners: &[Vec3; 3]) -> Option<f64> {
    let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
    let across = direction.cross(&ac);
    let determinant = ab.dot(&across);
    if determinant == 0.0 {
        return None;
    }
    let from = origin - corners[0];
    let u = from.dot(&across) / determinant;
    let turned = from.cross(&ab);
    let v = direction.dot(&turned) / determinant;
    // Rays through a shared edge must hit one of its two triangles.
    let slack = 1e-12;
    if u < -slack || v < -slack || u + v > 1.0 + 2.0 * slack {
        return None;
    }
    let distance = ac.dot(&turned) / determinant;
    (distance >= 0.0).then_some(distance)
}
