//! What every cut mesh must be, from its numbers alone.

use palpate_geometry::{Adjacency, CutSurface, NodeId, Surface, TriangleMesh, Vec3};

/// The tables of the cut are those of its mesh made afresh; every edge has one triangle or two of
/// opposite sense; every vertex has one fan; no triangle is a sliver that was none before; every place
/// is finite.
pub(super) fn sound(surface: &Surface, cut: &CutSurface) {
    let mesh = cut.mesh();
    let fresh = Adjacency::new(mesh);
    for triangle in mesh.triangle_ids() {
        assert_eq!(fresh.across(triangle), cut.across(triangle), "{triangle:?}");
    }
    let mut directed: Vec<[NodeId; 2]> = edges(mesh).collect();
    directed.sort_unstable();
    assert!(directed.windows(2).all(|pair| pair[0] != pair[1]));
    for number in 0..mesh.vertices().len() {
        let node = NodeId(number as u32);
        assert_eq!(fans(mesh, &fresh, node), 1, "{node:?}");
        assert!(mesh.vertices()[number].iter().all(|c| c.is_finite()));
        assert!((0.0..1.0 + 1e-12).contains(&cut.opening(node).norm()));
    }
    let least = |mesh: &TriangleMesh| {
        let shapes = mesh.triangle_ids().map(|t| shape(&mesh.positions(t)));
        shapes.fold(f64::INFINITY, f64::min)
    };
    // 0.05 is what the cut promises; rounding of a split at exactly that.
    assert!(least(mesh) >= least(surface.mesh()).min(0.05) - 1e-9);
}

fn shape([a, b, c]: &[Vec3; 3]) -> f64 {
    let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
    (b - a).cross(&(c - a)).norm() / (longest * longest)
}

fn edges(mesh: &TriangleMesh) -> impl Iterator<Item = [NodeId; 2]> {
    let around = |&[a, b, c]: &[NodeId; 3]| [[a, b], [b, c], [c, a]];
    mesh.triangles().iter().flat_map(around)
}

/// Triangles around a vertex that hang together over edges, counted by their beginnings.
fn fans(mesh: &TriangleMesh, adjacency: &Adjacency, node: NodeId) -> usize {
    let around = adjacency.around(node);
    let begins = |&&triangle: &&_| {
        let corners = mesh.corners(triangle);
        let place = corners.iter().position(|&c| c == node).unwrap();
        adjacency.across(triangle)[place].is_none()
    };
    let open = around.iter().filter(begins).count();
    if open > 0 {
        return open;
    }
    // A closed fan: walk it once.
    let (mut triangle, mut walked) = (around[0], 0);
    loop {
        let corners = mesh.corners(triangle);
        let place = corners.iter().position(|&c| c == node).unwrap();
        triangle = adjacency.across(triangle)[place].unwrap();
        walked += 1;
        if triangle == around[0] {
            return if walked == around.len() { 1 } else { 2 };
        }
    }
}

/// Edges with one triangle, in order of their starts.
fn borders(cut: &CutSurface) -> Vec<[NodeId; 2]> {
    let mesh = cut.mesh();
    let mut found = Vec::new();
    for triangle in mesh.triangle_ids() {
        let corners = mesh.corners(triangle);
        for (edge, other) in cut.across(triangle).into_iter().enumerate() {
            if other.is_none() {
                found.push([corners[edge], corners[(edge + 1) % 3]]);
            }
        }
    }
    found.sort_unstable();
    found
}

pub(super) fn border_edges(cut: &CutSurface) -> usize {
    borders(cut).len()
}

/// Closed chains of border edges.
pub(super) fn border_loops(cut: &CutSurface) -> usize {
    let borders = borders(cut);
    let mut seen = vec![false; borders.len()];
    let mut loops = 0;
    for start in 0..borders.len() {
        let mut at = start;
        loops += usize::from(!seen[start]);
        while !seen[at] {
            seen[at] = true;
            let end = borders[at][1];
            at = borders.partition_point(|edge| edge[0] < end);
            assert_eq!(borders[at][0], end, "a border ends");
        }
    }
    loops
}

/// Vertices − edges + triangles.
pub(super) fn euler(cut: &CutSurface) -> i64 {
    let mesh = cut.mesh();
    let mut undirected: Vec<[NodeId; 2]> = edges(mesh).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    undirected.sort_unstable();
    undirected.dedup();
    mesh.vertices().len() as i64 - undirected.len() as i64 + mesh.triangles().len() as i64
}

/// Pieces that hang together over edges.
pub(super) fn pieces(cut: &CutSurface) -> usize {
    let mesh = cut.mesh();
    let mut seen = vec![false; mesh.triangles().len()];
    let mut count = 0;
    for start in mesh.triangle_ids() {
        let mut waiting = vec![start];
        count += usize::from(!seen[start.index()]);
        while let Some(triangle) = waiting.pop() {
            if !std::mem::replace(&mut seen[triangle.index()], true) {
                waiting.extend(cut.across(triangle).into_iter().flatten());
            }
        }
    }
    count
}
