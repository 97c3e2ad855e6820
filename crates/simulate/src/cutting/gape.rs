use std::collections::{BTreeMap, VecDeque};

use palpate_geometry::{CutSurface, NodeId, TriangleId, TriangleMesh, Vec3};

/// Passes by which an opening is spread over the triangles beside it.
const PASSES: usize = 100;

/// How far each vertex of `cut` is moved when it gapes up to `width` [m] for the eye: a slit is widest in its
/// middle, as an ellipse is. What is beside it moves along, less and less up to the width of the slit away: each
/// vertex as the mean of its neighbours, so that no triangle folds over.
pub fn gape(cut: &CutSurface, width: f64) -> Vec<Vec3> {
    ways(cut, &rims(cut), width)
}

/// The ends of the open edges of `cut`.
fn rims(cut: &CutSurface) -> Vec<[NodeId; 2]> {
    let of_triangle = |triangle: TriangleId| {
        let corners = cut.mesh().corners(triangle);
        let sides = cut.sides(triangle).into_iter().enumerate();
        sides
            .filter(|(_, side)| side.is_some())
            .map(move |(edge, _)| [corners[edge], corners[(edge + 1) % 3]])
    };
    cut.mesh().triangle_ids().flat_map(of_triangle).collect()
}

/// How far each vertex is moved [m].
fn ways(cut: &CutSurface, rims: &[[NodeId; 2]], width: f64) -> Vec<Vec3> {
    let vertices = cut.mesh().vertices();
    let mut ways = vec![Vec3::zeros(); vertices.len()];
    let along = from_ends(cut, rims);
    let half = along.values().copied().fold(0.0, f64::max).max(1e-12);
    for (node, from_end) in &along {
        let part = 1.0 - from_end / half;
        let open = (1.0 - part * part).max(0.0).sqrt();
        ways[node.index()] = 0.5 * width * open * cut.opening(*node);
    }
    let free = free_near(cut, &along, 1.5 * width);
    let neighbours = neighbours(cut.mesh(), &free);
    for _ in 0..PASSES {
        for (node, around) in free.iter().zip(&neighbours) {
            let sum: Vec3 = around.iter().map(|other| ways[other.index()]).sum();
            ways[node.index()] = sum / around.len() as f64;
        }
    }
    ways
}

/// Way along the rim to the nearest end of a slit [m], for each vertex of a rim.
fn from_ends(cut: &CutSurface, rims: &[[NodeId; 2]]) -> BTreeMap<NodeId, f64> {
    let vertices = cut.mesh().vertices();
    let is_end = |node: NodeId| cut.opening(node) == Vec3::zeros();
    let mut found: BTreeMap<NodeId, f64> = BTreeMap::new();
    for node in rims.iter().flatten() {
        let way = if is_end(*node) { 0.0 } else { f64::INFINITY };
        found.insert(*node, way);
    }
    // As often as a rim is long, at most; rims are short.
    for _ in 0..found.len() {
        let mut changed = false;
        for [a, b] in rims {
            let length = (vertices[a.index()] - vertices[b.index()]).norm();
            for (from, to) in [(a, b), (b, a)] {
                let way = found[from] + length;
                if way < found[to] {
                    found.insert(*to, way);
                    changed = true;
                }
            }
        }
        if !changed {
            break;
        }
    }
    // A loop without an end is as open as any.
    let known = found.values().copied().filter(|way| way.is_finite());
    let longest = known.fold(0.0, f64::max).max(1e-9);
    for way in found.values_mut().filter(|way| way.is_infinite()) {
        *way = longest;
    }
    found
}

/// The vertices that are on no rim, within `reach` [m] of one.
fn free_near(cut: &CutSurface, rims: &BTreeMap<NodeId, f64>, reach: f64) -> Vec<NodeId> {
    let mesh = cut.mesh();
    let vertices = mesh.vertices();
    let mut around: Vec<Vec<NodeId>> = vec![Vec::new(); vertices.len()];
    for corners in mesh.triangles() {
        for k in 0..3 {
            around[corners[k].index()].push(corners[(k + 1) % 3]);
            around[corners[k].index()].push(corners[(k + 2) % 3]);
        }
    }
    let mut source: Vec<Option<NodeId>> = vec![None; vertices.len()];
    let mut waiting = VecDeque::new();
    for node in rims.keys() {
        source[node.index()] = Some(*node);
        waiting.push_back(*node);
    }
    let mut found = Vec::new();
    while let Some(node) = waiting.pop_front() {
        let Some(from) = source[node.index()] else {
            continue;
        };
        for next in &around[node.index()] {
            let near = (vertices[next.index()] - vertices[from.index()]).norm() < reach;
            if near && source[next.index()].is_none() {
                source[next.index()] = Some(from);
                found.push(*next);
                waiting.push_back(*next);
            }
        }
    }
    found
}

/// The neighbours of each of `nodes`.
fn neighbours(mesh: &TriangleMesh, nodes: &[NodeId]) -> Vec<Vec<NodeId>> {
    let mut number: Vec<Option<usize>> = vec![None; mesh.vertices().len()];
    for (k, node) in nodes.iter().enumerate() {
        number[node.index()] = Some(k);
    }
    let mut found = vec![Vec::new(); nodes.len()];
    for corners in mesh.triangles() {
        for k in 0..3 {
            if let Some(own) = number[corners[k].index()] {
                found[own].push(corners[(k + 1) % 3]);
                found[own].push(corners[(k + 2) % 3]);
            }
        }
    }
    found
}
