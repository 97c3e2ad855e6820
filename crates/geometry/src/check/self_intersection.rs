//! Whether a mesh passes through itself, decided by the signs of determinants that are exact
//! [Shewchuk 1997], so that neither a touch nor a crossing depends on rounding.

use super::contact::{Corners, same_sign, segment_meets_triangle};
use crate::{NodeId, TriangleId, TriangleMesh, Vec3};

/// Number of triangles that [cross](self_intersecting) another.
pub(crate) fn count_self_intersections(mesh: &TriangleMesh) -> usize {
    self_intersecting(mesh).len()
}

/// Triangles that meet another elsewhere than in a vertex or an edge that both have.
///
/// Vertices in the same place count as one, so that an open seam is no crossing. Triangles without
/// area are passed over.
pub(crate) fn self_intersecting(mesh: &TriangleMesh) -> Vec<TriangleId> {
    let (mesh, _) = crate::weld_exactly(mesh);
    let mut crossing = vec![false; mesh.triangles().len()];
    for_each_close_pair(&mesh, |one, other| {
        let known = crossing[one.index()] && crossing[other.index()];
        if !known && triangles_meet(&Placed::of(&mesh, one), &Placed::of(&mesh, other)) {
            crossing[one.index()] = true;
            crossing[other.index()] = true;
        }
    });
    let crossing = mesh.triangle_ids().zip(crossing);
    crossing
        .filter_map(|(triangle, crosses)| crosses.then_some(triangle))
        .collect()
}

struct Bounded {
    triangle: TriangleId,
    low: [f64; 3],
    high: [f64; 3],
}

/// Calls `visit` for all pairs whose boxes touch: a sweep along the longest axis of the mesh.
fn for_each_close_pair(mesh: &TriangleMesh, mut visit: impl FnMut(TriangleId, TriangleId)) {
    let (low, high) = mesh.bounds();
    let axis = (high - low).imax();
    let mut boxes: Vec<_> = mesh
        .triangle_ids()
        .filter(|&t| Corners(mesh.positions(t)).have_area())
        .map(|triangle| {
            let [a, b, c] = mesh.positions(triangle);
            Bounded {
                triangle,
                low: a.inf(&b).inf(&c).into(),
                high: a.sup(&b).sup(&c).into(),
            }
        })
        .collect();
    boxes.sort_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
    for (k, one) in boxes.iter().enumerate() {
        for other in &boxes[k + 1..] {
            if other.low[axis] > one.high[axis] {
                break;
            }
            if (0..3).all(|i| other.low[i] <= one.high[i] && one.low[i] <= other.high[i]) {
                visit(one.triangle, other.triangle);
            }
        }
    }
}

/// A triangle where it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) nodes: [NodeId; 3],
    pub(crate) corners: [Vec3; 3],
}

impl Placed {
    fn of(mesh: &TriangleMesh, triangle: TriangleId) -> Self {
        Self {
            nodes: mesh.corners(triangle),
            corners: mesh.positions(triangle),
        }
    }

    /// Number of the corner that the other triangle does not have, when it is one.
    fn tip(&self, other: &Self) -> Option<usize> {
        let own = |&k: &usize| !other.nodes.contains(&self.nodes[k]);
        (0..3).find(own)
    }
}

/// Whether two triangles meet elsewhere than in a vertex or an edge that both have.
pub(crate) fn triangles_meet(one: &Placed, other: &Placed) -> bool {
    let shared = |node: &&NodeId| other.nodes.contains(node);
    match one.nodes.iter().filter(shared).count() {
        0 => apart_triangles_meet(one, other),
        1 => {
            // What they have in common is convex and holds the shared vertex, so anything more
            // reaches the side opposite of it in one of them.
            opposite_side_meets(one, other) || opposite_side_meets(other, one)
        }
        2 => folded_together(one, other),
        _ => true,
    }
}

fn apart_triangles_meet(one: &Placed, other: &Placed) -> bool {
    let (ours, theirs) = (Corners(one.corners), Corners(other.corners));
    // Whether the plane of `a` has corners of `b` on both sides, or in it.
    let reaches = |a: &Corners, b: &Corners| {
        let heights = b.0.map(|p| a.side_of(&p));
        let apart = heights.iter().all(|&h| h > 0.0) || heights.iter().all(|&h| h < 0.0);
        !apart
    };
    let any_side_meets = |a: &Corners, b: &Corners| {
        (0..3).any(|k| segment_meets_triangle(&a.0[k], &a.0[(k + 1) % 3], b))
    };
    reaches(&ours, &theirs)
        && reaches(&theirs, &ours)
        && (any_side_meets(&ours, &theirs) || any_side_meets(&theirs, &ours))
}

/// For triangles with one vertex in common: whether the side of `one` opposite of it meets `other`.
fn opposite_side_meets(one: &Placed, other: &Placed) -> bool {
    let mut ends = (0..3)
        .filter(|&k| !other.nodes.contains(&one.nodes[k]))
        .map(|k| one.corners[k]);
    let (Some(from), Some(to)) = (ends.next(), ends.next()) else {
        return false;
    };
    segment_meets_triangle(&from, &to, &Corners(other.corners))
}

/// For triangles with an edge in common: whether one lies on the other.
fn folded_together(one: &Placed, other: &Placed) -> bool {
    let (Some(tip), Some(their_tip)) = (one.tip(other), other.tip(one)) else {
        return true;
    };
    let triangle = Corners(one.corners);
    let their_tip = other.corners[their_tip];
    if triangle.side_of(&their_tip) != 0.0 {
        return false;
    }
    let edge = one.corners.map(|p| triangle.flat(&p));
    let (from, to) = (edge[(tip + 1) % 3], edge[(tip + 2) % 3]);
    let turn = |p| robust::orient2d(from, to, p);
    // On the same side of the common edge, in one plane.
    same_sign(turn(edge[tip]), turn(triangle.flat(&their_tip)))
}
