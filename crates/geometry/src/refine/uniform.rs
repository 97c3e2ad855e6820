use super::shell::{Shell, move_if_sound};
use crate::{NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Angles below this are not made by moving a vertex [rad].
const FLOOR: f64 = 0.17;

/// Cuts every tetrahedron into eight: four at its corners, and four around the shortest diagonal of
/// what is left [Bey 1995]. The vertices of `mesh` keep their numbers, and the eight follow each
/// other. Vertices of the boundary move onto `surface`, if it is given.
///
/// # Errors
/// When there come more than [`TetrahedronMesh::MOST_TETRAHEDRA`].
pub fn refine_uniformly(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
) -> Result<TetrahedronMesh, TetrahedronError> {
    let count = 8 * mesh.tetrahedra().len();
    if count > TetrahedronMesh::MOST_TETRAHEDRA {
        return Err(TetrahedronError::TooMany {
            expected: count as f64,
            edge_m: 0.5 * mesh.quality().longest_edge,
            most: TetrahedronMesh::MOST_TETRAHEDRA,
        });
    }
    let edges = mesh.edges();
    let old = mesh.vertices().len();
    let mut vertices = mesh.vertices().to_vec();
    vertices.extend(edges.iter().map(|edge| {
        let [from, to] = edge.map(|node| mesh.vertices()[node.index()]);
        0.5 * (from + to)
    }));
    let middle = |a: NodeId, b: NodeId| {
        let found = edges.binary_search(&[a.min(b), a.max(b)]);
        NodeId((old + found.expect("all edges are listed")) as u32)
    };
    let mut tetrahedra = Vec::with_capacity(count);
    for &corners in mesh.tetrahedra() {
        tetrahedra.extend(eight(corners, middle, &vertices));
    }
    if let Some(surface) = surface {
        let shell = Shell::new(surface);
        let mut on_boundary: Vec<NodeId> = mesh
            .boundary()
            .iter()
            .flat_map(|&([a, b, c], _)| [a, b, c, middle(a, b), middle(b, c), middle(c, a)])
            .collect();
        on_boundary.sort_unstable();
        on_boundary.dedup();
        let around = around(vertices.len(), &tetrahedra);
        for node in on_boundary {
            let target = shell.nearest(&vertices[node.index()]);
            let star = around[node.index()]
                .iter()
                .map(|&t| tetrahedra[t as usize].map(|n| n.0));
            // All the way, or else half of it; old vertices that could not move try again.
            let halfway = 0.5 * (vertices[node.index()] + target);
            let _ = move_if_sound(&mut vertices, star.clone(), node.0, target, FLOOR)
                || move_if_sound(&mut vertices, star, node.0, halfway, FLOOR);
        }
    }
    TetrahedronMesh::new(vertices, tetrahedra)
}

/// The tetrahedra around each vertex, in ascending order.
pub(super) fn around(vertices: usize, tetrahedra: &[[NodeId; 4]]) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); vertices];
    for (number, corners) in tetrahedra.iter().enumerate() {
        for node in corners {
            around[node.index()].push(number as u32);
        }
    }
    around
}

fn eight(
    [a, b, c, d]: [NodeId; 4],
    middle: impl Fn(NodeId, NodeId) -> NodeId,
    vertices: &[Vec3],
) -> [[NodeId; 4]; 8] {
    let (ab, ac, ad) = (middle(a, b), middle(a, c), middle(a, d));
    let (bc, bd, cd) = (middle(b, c), middle(b, d), middle(c, d));
    let length = |from: NodeId, to: NodeId| (vertices[to.index()] - vertices[from.index()]).norm();
    // Each diagonal with the ring around it, which turns so that the four are positive.
    let diagonals = [
        (ab, cd, [ac, ad, bd, bc]),
        (ac, bd, [ad, ab, bc, cd]),
        (ad, bc, [ab, ac, cd, bd]),
    ];
    let mut shortest = diagonals[0];
    for diagonal in diagonals {
        if length(diagonal.0, diagonal.1) < (1.0 - 1e-9) * length(shortest.0, shortest.1) {
            shortest = diagonal;
        }
    }
    let (from, to, ring) = shortest;
    let inner = |k: usize| [from, to, ring[k], ring[(k + 1) % 4]];
    [
        [a, ab, ac, ad],
        [ab, b, bc, bd],
        [ac, bc, c, cd],
        [ad, bd, cd, d],
        inner(0),
        inner(1),
        inner(2),
        inner(3),
    ]
}
