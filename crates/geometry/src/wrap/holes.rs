use std::collections::BTreeMap;

use crate::mesh::edges::{by_edge, sides};
use crate::{MeshError, NodeId, TriangleMesh, Vec3};

/// A mesh whose holes are capped.
pub(super) struct Capped {
    pub(super) mesh: TriangleMesh,
    pub(super) holes: usize,
    /// Extent of the largest rim [m].
    pub(super) widest_rim: f64,
}

/// Caps every rim, a connected set of edges with one triangle, by a fan about its middle. Caps may cross anything: the
/// envelope does not mind.
pub(super) fn cap(mesh: &TriangleMesh) -> Result<Capped, MeshError> {
    let sides = sides(mesh.triangles());
    let rims: Vec<[NodeId; 2]> = by_edge(&sides)
        .filter(|edge| edge.len() == 1)
        .map(|edge| [edge[0].low, edge[0].high])
        .collect();
    let mut vertices = mesh.vertices().to_vec();
    let mut triangles = mesh.triangles().to_vec();
    let (mut holes, mut widest_rim) = (0, 0.0);
    for rim in connected(&rims) {
        let middle = middle(mesh, &rim);
        let nodes = rim
            .iter()
            .flatten()
            .map(|node| mesh.vertices()[node.index()]);
        let (low, high) = nodes.fold((middle, middle), |(low, high), place| {
            (low.inf(&place), high.sup(&place))
        });
        widest_rim = f64::max(widest_rim, (high - low).norm());
        holes += 1;
        let hub = NodeId(vertices.len() as u32);
        vertices.push(middle);
        triangles.extend(rim.iter().map(|&[a, b]| [a, b, hub]));
    }
    Ok(Capped {
        mesh: TriangleMesh::new(vertices, triangles)?,
        holes,
        widest_rim,
    })
}

/// The middle of a rim's edges, weighted by their lengths.
fn middle(mesh: &TriangleMesh, rim: &[[NodeId; 2]]) -> Vec3 {
    let (mut sum, mut length) = (Vec3::zeros(), 0.0);
    for edge in rim {
        let [a, b] = edge.map(|node| mesh.vertices()[node.index()]);
        let own = (b - a).norm().max(f64::MIN_POSITIVE);
        sum += 0.5 * own * (a + b);
        length += own;
    }
    sum / length
}

/// Edges that share nodes, together; in the order of their first edges.
fn connected(edges: &[[NodeId; 2]]) -> Vec<Vec<[NodeId; 2]>> {
    let mut of_node: BTreeMap<NodeId, Vec<usize>> = BTreeMap::new();
    for (number, edge) in edges.iter().enumerate() {
        for node in edge {
            of_node.entry(*node).or_default().push(number);
        }
    }
    let mut is_known = vec![false; edges.len()];
    let mut rims = Vec::new();
    for first in 0..edges.len() {
        if std::mem::replace(&mut is_known[first], true) {
            continue;
        }
        let (mut rim, mut open) = (Vec::new(), vec![first]);
        while let Some(number) = open.pop() {
            rim.push(edges[number]);
            for next in edges[number].iter().flat_map(|node| &of_node[node]) {
                if !std::mem::replace(&mut is_known[*next], true) {
                    open.push(*next);
                }
            }
        }
        rims.push(rim);
    }
    rims
}
