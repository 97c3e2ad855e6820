use crate::mesh::edges::{Side, by_edge, sides};
use crate::{Adjacency, NodeId, TriangleMesh};

/// The connectivity of a mesh, whatever its coordinates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Topology {
    /// Edges with one triangle.
    pub(crate) boundary_edges: usize,
    /// Edges with more than two triangles.
    pub(crate) non_manifold_edges: usize,
    /// Edges whose two triangles run along them in the same direction.
    pub(crate) misoriented_edges: usize,
    /// Vertices where several fans of triangles touch.
    pub(crate) split_vertices: usize,
    /// Vertices of no triangle.
    pub(crate) unused_vertices: usize,
    /// Pieces that are connected over edges.
    pub(crate) components: usize,
    /// Vertices - edges + triangles, over the vertices that are used.
    euler: i64,
}

impl Topology {
    pub(crate) fn new(mesh: &TriangleMesh, adjacency: &Adjacency) -> Self {
        let sides = sides(mesh.triangles());
        let mut found = Self {
            boundary_edges: 0,
            non_manifold_edges: 0,
            misoriented_edges: 0,
            split_vertices: 0,
            unused_vertices: 0,
            components: pieces(mesh.triangles().len(), &sides).1,
            euler: mesh.triangles().len() as i64,
        };
        for edge in by_edge(&sides) {
            found.euler -= 1;
            match edge {
                [_] => found.boundary_edges += 1,
                [one, other] => {
                    found.misoriented_edges += usize::from(one.ascending == other.ascending);
                }
                _ => found.non_manifold_edges += 1,
            }
        }
        for vertex in 0..mesh.vertices().len() {
            match fans(mesh, adjacency, NodeId(vertex as u32)) {
                0 => found.unused_vertices += 1,
                1 => found.euler += 1,
                _ => {
                    found.euler += 1;
                    found.split_vertices += 1;
                }
            }
        }
        found
    }

    pub(crate) fn closed(&self) -> bool {
        self.boundary_edges == 0
    }

    pub(crate) fn manifold(&self) -> bool {
        self.non_manifold_edges == 0 && self.split_vertices == 0
    }

    /// Handles, summed over the pieces; only a closed manifold has them.
    pub(crate) fn genus(&self) -> Option<usize> {
        let twice = 2 * self.components as i64 - self.euler;
        (self.closed() && self.manifold() && twice >= 0 && twice % 2 == 0)
            .then_some(twice as usize / 2)
    }
}

/// Per triangle the number of its piece, and how many pieces there are. Pieces are numbered in the
/// order of their first triangles.
pub(crate) fn pieces(triangles: usize, sides: &[Side]) -> (Vec<usize>, usize) {
    let mut parents: Vec<usize> = (0..triangles).collect();
    for edge in by_edge(sides) {
        for pair in edge.windows(2) {
            let one = root(&mut parents, pair[0].triangle.index());
            let other = root(&mut parents, pair[1].triangle.index());
            // The lower number leads, so that a root is the first triangle of its piece.
            parents[one.max(other)] = one.min(other);
        }
    }
    let mut numbers = vec![0; triangles];
    let mut count = 0;
    for triangle in 0..triangles {
        let first = root(&mut parents, triangle);
        if first == triangle {
            numbers[triangle] = count;
            count += 1;
        } else {
            numbers[triangle] = numbers[first];
        }
    }
    (numbers, count)
}

fn root(parents: &mut [usize], mut node: usize) -> usize {
    while parents[node] != node {
        parents[node] = parents[parents[node]];
        node = parents[node];
    }
    node
}

/// How many fans of triangles meet in `node`: pieces of its ring of opposite edges.
pub(crate) fn fans(mesh: &TriangleMesh, adjacency: &Adjacency, node: NodeId) -> usize {
    let mut opposite: Vec<Vec<NodeId>> = Vec::new();
    for &triangle in adjacency.around(node) {
        let mut joined: Vec<NodeId> = mesh.corners(triangle).to_vec();
        joined.retain(|&corner| corner != node);
        // Fans that this triangle links become one.
        opposite.retain(|fan| {
            let linked = fan.iter().any(|corner| joined.contains(corner));
            if linked {
                joined.extend(fan);
            }
            !linked
        });
        opposite.push(joined);
    }
    opposite.len()
}
