use crate::{NodeId, TriangleId, TriangleMesh};

/// The neighbour tables of a mesh: triangles that share an edge or a vertex (figure 4-4).
///
/// Edge `k` of a triangle runs from corner `k` to corner `(k + 1) % 3`.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjacency {
    /// Per triangle and edge: the triangle on the other side, or none at a border.
    across: Vec<[Option<TriangleId>; 3]>,
    /// Triangles around vertex `v`: `around[starts[v]..starts[v + 1]]`, in ascending order.
    starts: Vec<u32>,
    around: Vec<TriangleId>,
}

impl Adjacency {
    /// The tables of `mesh`. An edge with more than two triangles links none of them.
    pub fn new(mesh: &TriangleMesh) -> Self {
        let (starts, around) = triangles_around_vertices(mesh);
        let mut adjacency = Self {
            across: vec![[None; 3]; mesh.triangles().len()],
            starts,
            around,
        };
        for triangle in mesh.triangle_ids() {
            for edge in 0..3 {
                adjacency.across[triangle.index()][edge] =
                    adjacency.only_other_triangle(mesh, triangle, edge);
            }
        }
        adjacency
    }

    /// The triangle across each edge of `triangle`: its edge neighbourhood.
    pub fn across(&self, triangle: TriangleId) -> [Option<TriangleId>; 3] {
        self.across[triangle.index()]
    }

    /// The triangles that use `node`, in ascending order.
    pub fn around(&self, node: NodeId) -> &[TriangleId] {
        let start = self.starts[node.index()] as usize;
        let end = self.starts[node.index() + 1] as usize;
        &self.around[start..end]
    }

    /// The triangles that share an edge with `triangle`.
    pub fn edge_neighborhood(&self, triangle: TriangleId) -> impl Iterator<Item = TriangleId> {
        self.across(triangle).into_iter().flatten()
    }

    fn only_other_triangle(
        &self,
        mesh: &TriangleMesh,
        triangle: TriangleId,
        edge: usize,
    ) -> Option<TriangleId> {
        let corners = mesh.corners(triangle);
        let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
        let mut others = self
            .around(from)
            .iter()
            .copied()
            .filter(|&other| other != triangle && mesh.corners(other).contains(&to));
        let only = others.next()?;
        others.next().is_none().then_some(only)
    }
}

fn triangles_around_vertices(mesh: &TriangleMesh) -> (Vec<u32>, Vec<TriangleId>) {
    let mut starts = vec![0u32; mesh.vertices().len() + 1];
    for node in mesh.triangles().iter().flatten() {
        starts[node.index() + 1] += 1;
    }
    for v in 0..mesh.vertices().len() {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut around = vec![TriangleId(0); 3 * mesh.triangles().len()];
    for triangle in mesh.triangle_ids() {
        for node in mesh.corners(triangle) {
            around[next[node.index()] as usize] = triangle;
            next[node.index()] += 1;
        }
    }
    (starts, around)
}
