use super::net::{Corner, Facet, Net, Node, Origin};
use super::{MIN_SHAPE, NEAR};
use crate::proximity::closest_on_triangle;
use crate::{NodeId, Surface, TriangleId, Vec3};

/// How finely triangles may be split.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// No edge is split into parts shorter than this [m].
    pub(super) edge: f64,
    /// No more triangles are made than this.
    pub(super) triangles: usize,
}

/// The height of a triangle over its longest edge, in units of that [-]; 0.87 when all are equal.
pub(super) fn shape([a, b, c]: &[Vec3; 3]) -> f64 {
    let longest = (b - a)
        .norm_squared()
        .max((c - b).norm_squared())
        .max((a - c).norm_squared());
    (b - a).cross(&(c - a)).norm() / longest
}

/// Whether a point so far along an edge [-] is to be taken for one of its ends.
pub(super) fn is_near_end(
    net: &Net,
    triangle: TriangleId,
    edge: usize,
    part: f64,
    limits: &Limits,
) -> bool {
    let corners = net.mesh.positions(triangle);
    let length = (corners[(edge + 1) % 3] - corners[edge]).norm();
    part.min(1.0 - part) * length < limits.edge.max(NEAR * length)
}

/// Splits the triangles on both sides of an edge at a point so far along it [-], unless that makes
/// slivers. The new vertex; the first part of the edge stays with `triangle`.
pub(super) fn split_edge(
    net: &mut Net,
    surface: &Surface,
    triangle: TriangleId,
    edge: usize,
    part: f64,
    limits: &Limits,
) -> Option<Corner> {
    let mate = net.facet(triangle).across[edge];
    let back = net.edge_towards(mate, triangle);
    let ends = net.mesh.positions(triangle);
    let place = ends[edge] + part * (ends[(edge + 1) % 3] - ends[edge]);
    let children_are_sound = [(triangle, edge), (mate, back)].into_iter().all(|(id, k)| {
        let corners = net.mesh.positions(id);
        let (mut first, mut second) = (corners, corners);
        first[(k + 1) % 3] = place;
        second[k] = place;
        shape(&first).min(shape(&second)) >= MIN_SHAPE
    });
    if !children_are_sound || net.facets.len() + 2 > limits.triangles {
        return None;
    }
    let middle = push_node(net, surface, triangle, &place);
    let second = halve(net, triangle, edge, middle);
    let mate_second = halve(net, mate, back, middle);
    for (id, k, other) in [
        (triangle, edge, mate_second),
        (second, 0, mate),
        (mate, back, second),
        (mate_second, 0, triangle),
    ] {
        let mut facet = *net.facet(id);
        facet.across[k] = other;
        net.set_triangle(id, net.mesh.corners(id), facet);
    }
    let made = Corner {
        triangle,
        place: (edge + 1) % 3,
    };
    // On an earlier opening each side gets a vertex of its own.
    net.part(made);
    Some(made)
}

/// Cuts a triangle from the middle of its edge to the opposite corner. It keeps the first half; the
/// second, which is returned, begins with the middle.
fn halve(net: &mut Net, id: TriangleId, edge: usize, middle: NodeId) -> TriangleId {
    let (mut corners, mut facet) = (net.mesh.corners(id), *net.facet(id));
    let (b, c) = ((edge + 1) % 3, (edge + 2) % 3);
    let second = net.push_triangle(
        [middle, corners[b], corners[c]],
        Facet {
            across: [facet.across[edge], facet.across[b], id],
            open: [facet.open[edge], facet.open[b], None],
            parent: facet.parent,
        },
    );
    introduce(net, facet.across[b], id, second);
    corners[b] = middle;
    facet.across[b] = second;
    facet.open[b] = None;
    net.set_triangle(id, corners, facet);
    second
}

/// Updates a triangle when a neighbour changes its number.
fn introduce(net: &mut Net, triangle: TriangleId, old: TriangleId, new: TriangleId) {
    let mut facet = *net.facet(triangle);
    facet.across[net.edge_towards(triangle, old)] = new;
    net.set_triangle(triangle, net.mesh.corners(triangle), facet);
}

/// A vertex at a point of a triangle [m], or one near it: of the triangle, on an edge, or inside.
pub(super) fn insert(
    net: &mut Net,
    surface: &Surface,
    triangle: TriangleId,
    place: &Vec3,
    limits: &Limits,
) -> Option<Corner> {
    let corners = net.mesh.positions(triangle);
    let weights = closest_on_triangle(&corners, place).barycentric;
    let mut low = 0;
    for k in 1..3 {
        if weights[k] < weights[low] {
            low = k;
        }
    }
    let edge = (low + 1) % 3;
    let opposite = corners[(edge + 1) % 3] - corners[edge];
    let height = 2.0 * net.mesh.area_vector(triangle).norm() / opposite.norm();
    if weights[low] * height >= limits.edge.max(NEAR * height) {
        return split_inside(net, surface, triangle, place, limits);
    }
    let part = weights[(low + 2) % 3] / (1.0 - weights[low]);
    if is_near_end(net, triangle, edge, part, limits) {
        let place = if part < 0.5 { edge } else { (edge + 1) % 3 };
        return Some(Corner { triangle, place });
    }
    split_edge(net, surface, triangle, edge, part, limits)
}

/// Splits a triangle into three at `place` [m], unless that makes slivers.
fn split_inside(
    net: &mut Net,
    surface: &Surface,
    id: TriangleId,
    place: &Vec3,
    limits: &Limits,
) -> Option<Corner> {
    let positions = net.mesh.positions(id);
    let children_are_sound = (0..3).all(|k| {
        let mut child = positions;
        child[k] = *place;
        shape(&child) >= MIN_SHAPE
    });
    if !children_are_sound || net.facets.len() + 2 > limits.triangles {
        return None;
    }
    let middle = push_node(net, surface, id, place);
    let (corners, facet) = (net.mesh.corners(id), *net.facet(id));
    let first_number = net.facets.len() as u32;
    let (second, third) = (TriangleId(first_number), TriangleId(first_number + 1));
    for (k, [next, previous]) in [(1, [third, id]), (2, [id, second])] {
        let child = Facet {
            across: [facet.across[k], next, previous],
            open: [facet.open[k], None, None],
            parent: facet.parent,
        };
        let made = net.push_triangle([corners[k], corners[(k + 1) % 3], middle], child);
        introduce(net, facet.across[k], id, made);
    }
    let kept = Facet {
        across: [facet.across[0], second, third],
        open: [facet.open[0], None, None],
        ..facet
    };
    net.set_triangle(id, [corners[0], corners[1], middle], kept);
    Some(Corner {
        triangle: id,
        place: 2,
    })
}

/// A vertex at a point of a triangle [m], which is known by its place in the parent.
fn push_node(net: &mut Net, surface: &Surface, triangle: TriangleId, place: &Vec3) -> NodeId {
    let parent = net.facet(triangle).parent;
    let on = closest_on_triangle(&surface.mesh().positions(parent), place);
    let node = Node {
        origin: Origin {
            triangle: parent,
            barycentric: on.barycentric,
        },
        opening: Vec3::zeros(),
        side: None,
    };
    net.push_node(on.position, node)
}
