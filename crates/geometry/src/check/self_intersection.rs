//! Whether a mesh passes through itself, decided by the signs of determinants that are exact
//! [Shewchuk 1997], so that neither a touch nor a crossing depends on rounding.

use super::contact::{Corners, same_sign, segment_meets_triangle};
use crate::{NodeId, TriangleId, TriangleMesh};

/// Number of triangles that meet another elsewhere than in a vertex or an edge that both have.
///
/// Vertices in the same place count as one, so that an open seam is no crossing. Triangles without
/// area are passed over.
pub(crate) fn count_self_intersections(mesh: &TriangleMesh) -> usize {
    let (mesh, _) = crate::weld_exactly(mesh);
    let mut crossing = vec![false; mesh.triangles().len()];
    for_each_close_pair(&mesh, |one, other| {
        let known = crossing[one.index()] && crossing[other.index()];
        if !known && intersect(&mesh, one, other) {
            crossing[one.index()] = true;
            crossing[other.index()] = true;
        }
    });
    crossing.into_iter().filter(|&crosses| crosses).count()
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

fn intersect(mesh: &TriangleMesh, one: TriangleId, other: TriangleId) -> bool {
    let (ours, theirs) = (mesh.corners(one), mesh.corners(other));
    let shared = |node: &NodeId| theirs.contains(node);
    match ours.iter().filter(|&node| shared(node)).count() {
        0 => apart_triangles_meet(mesh, one, other),
        1 => {
            // What they have in common is convex and holds the shared vertex, so anything more
            // reaches the side opposite of it in one of them.
            opposite_side_meets(mesh, one, other) || opposite_side_meets(mesh, other, one)
        }
        2 => folded_together(mesh, one, other),
        _ => true,
    }
}

fn apart_triangles_meet(mesh: &TriangleMesh, one: TriangleId, other: TriangleId) -> bool {
    let (ours, theirs) = (Corners(mesh.positions(one)), Corners(mesh.positions(other)));
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
fn opposite_side_meets(mesh: &TriangleMesh, one: TriangleId, other: TriangleId) -> bool {
    let theirs = mesh.corners(other);
    let mut ends = mesh
        .corners(one)
        .into_iter()
        .filter(|node| !theirs.contains(node))
        .map(|node| mesh.vertices()[node.index()]);
    let (Some(from), Some(to)) = (ends.next(), ends.next()) else {
        return false;
    };
    segment_meets_triangle(&from, &to, &Corners(mesh.positions(other)))
}

/// For triangles with an edge in common: whether one lies on the other.
fn folded_together(mesh: &TriangleMesh, one: TriangleId, other: TriangleId) -> bool {
    let (ours, theirs) = (mesh.corners(one), mesh.corners(other));
    let position = |node: NodeId| mesh.vertices()[node.index()];
    let own = |ours: [NodeId; 3], theirs: [NodeId; 3]| {
        ours.into_iter().find(|node| !theirs.contains(node))
    };
    let (Some(our_tip), Some(their_tip)) = (own(ours, theirs), own(theirs, ours)) else {
        return true;
    };
    let triangle = Corners(mesh.positions(one));
    if triangle.side_of(&position(their_tip)) != 0.0 {
        return false;
    }
    let edge = ours.map(position).map(|p| triangle.flat(&p));
    let tip = ours.iter().position(|&node| node == our_tip).unwrap_or(0);
    let (from, to) = (edge[(tip + 1) % 3], edge[(tip + 2) % 3]);
    let turn = |p| robust::orient2d(from, to, p);
    // On the same side of the common edge, in one plane.
    same_sign(turn(edge[tip]), turn(triangle.flat(&position(their_tip))))
}
