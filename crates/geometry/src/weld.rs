use std::collections::HashMap;

use crate::mesh::edges::{by_edge, sides};
use crate::orient::orient_outward;
use crate::{MeshError, NodeId, TriangleMesh, Vec3};

/// Border vertices nearer than this part of the diagonal are one.
const TOLERANCE: f64 = 1e-6;

/// The changes of a mesh by [`repair`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Repairs {
    /// Vertices that were joined to another in the same place.
    pub welded_vertices: usize,
    /// Triangles that were dropped because two of their corners are one.
    pub degenerate_triangles: usize,
    /// Vertices that were dropped because no triangle uses them.
    pub unused_vertices: usize,
    /// Triangles that were turned over.
    pub flipped_triangles: usize,
}

/// The mesh with coincident vertices joined, collapsed triangles and unused vertices dropped, and
/// all triangles turned consistently and outward.
///
/// Vertices in exactly the same place are joined everywhere; those within a millionth of the
/// diagonal only at borders, so that a closed mesh keeps its finest triangles.
///
/// # Errors
/// When no triangle is left.
pub fn repair(mesh: &TriangleMesh) -> Result<(TriangleMesh, Repairs), MeshError> {
    let mut repairs = Repairs::default();
    let mut triangles = mesh.triangles().to_vec();
    join(&mut triangles, &same_place(mesh.vertices()), &mut repairs);
    let near = near_at_borders(mesh, &triangles);
    join(&mut triangles, &near, &mut repairs);
    let (used, vertices) = numbers_of_used(mesh, &triangles);
    let gone = mesh.vertices().len() - vertices.len();
    repairs.unused_vertices = gone - repairs.welded_vertices;
    for node in triangles.iter_mut().flatten() {
        *node = used[node.index()];
    }
    repairs.flipped_triangles = orient_outward(&vertices, &mut triangles);
    Ok((TriangleMesh::new(vertices, triangles)?, repairs))
}

/// The mesh with vertices in exactly the same place joined, and how many were; every triangle stays,
/// even one that collapsed.
pub fn weld_exactly(mesh: &TriangleMesh) -> (TriangleMesh, usize) {
    let leaders = same_place(mesh.vertices());
    let mut numbers = Vec::with_capacity(leaders.len());
    let mut vertices = Vec::new();
    for (vertex, &leader) in leaders.iter().enumerate() {
        if leader.index() == vertex {
            numbers.push(NodeId(vertices.len() as u32));
            vertices.push(mesh.vertices()[vertex]);
        } else {
            // A leader comes before its followers.
            numbers.push(numbers[leader.index()]);
        }
    }
    let joined = leaders.len() - vertices.len();
    let renumber = |corners: &[NodeId; 3]| corners.map(|node| numbers[node.index()]);
    let triangles = mesh.triangles().iter().map(renumber).collect();
    let welded = TriangleMesh::new(vertices, triangles);
    (
        welded.expect("the vertices were finite and are still there"),
        joined,
    )
}

/// Per vertex the first one in exactly the same place.
fn same_place(vertices: &[Vec3]) -> Vec<NodeId> {
    let mut first = HashMap::with_capacity(vertices.len());
    vertices
        .iter()
        .enumerate()
        .map(|(vertex, position)| {
            // Adding zero makes -0 and 0 the same place.
            let place = [position.x, position.y, position.z].map(|c| (c + 0.0).to_bits());
            *first.entry(place).or_insert(NodeId(vertex as u32))
        })
        .collect()
}

/// Per vertex itself, or for one on a border the first near it that is on a border too.
fn near_at_borders(mesh: &TriangleMesh, triangles: &[[NodeId; 3]]) -> Vec<NodeId> {
    let vertices = mesh.vertices();
    let mut leaders: Vec<_> = (0..vertices.len() as u32).map(NodeId).collect();
    let mut on_border = vec![false; vertices.len()];
    for edge in by_edge(&sides(triangles)).filter(|edge| edge.len() == 1) {
        on_border[edge[0].low.index()] = true;
        on_border[edge[0].high.index()] = true;
    }
    let (low, high) = mesh.bounds();
    let tolerance = TOLERANCE * (high - low).norm();
    if tolerance <= 0.0 {
        return leaders;
    }
    // Cells as large as the tolerance: what is near lies in the same cell or one of its neighbours.
    let mut cells: HashMap<[i64; 3], Vec<NodeId>> = HashMap::new();
    for vertex in (0..vertices.len()).filter(|&v| on_border[v]) {
        let place = (vertices[vertex] - low) / tolerance;
        let cell = [place.x, place.y, place.z].map(|c| c.floor() as i64);
        let near = neighbors(cell)
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .filter(|leader| (vertices[leader.index()] - vertices[vertex]).norm() <= tolerance)
            .min();
        match near {
            Some(&leader) => leaders[vertex] = leader,
            None => cells.entry(cell).or_default().push(NodeId(vertex as u32)),
        }
    }
    leaders
}

fn neighbors([i, j, k]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(move |n| [i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1])
}

/// Makes every corner its leader and drops the triangles that collapse.
fn join(triangles: &mut Vec<[NodeId; 3]>, leaders: &[NodeId], repairs: &mut Repairs) {
    let followers = leaders.iter().enumerate();
    repairs.welded_vertices += followers.filter(|(v, leader)| leader.index() != *v).count();
    for node in triangles.iter_mut().flatten() {
        *node = leaders[node.index()];
    }
    let before = triangles.len();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    repairs.degenerate_triangles += before - triangles.len();
}

/// New numbers of the vertices that `triangles` use, in the old order, and their positions.
fn numbers_of_used(mesh: &TriangleMesh, triangles: &[[NodeId; 3]]) -> (Vec<NodeId>, Vec<Vec3>) {
    let mut used = vec![false; mesh.vertices().len()];
    for node in triangles.iter().flatten() {
        used[node.index()] = true;
    }
    let mut vertices = Vec::new();
    let numbers = mesh
        .vertices()
        .iter()
        .zip(used)
        .map(|(&position, used)| {
            let number = NodeId(vertices.len() as u32);
            if used {
                vertices.push(position);
            }
            number
        })
        .collect();
    (numbers, vertices)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Surface;

    /// A tetrahedron whose corners are written out per triangle, the second triangle inside out,
    /// the corners off by `error` [m].
    fn soup(error: f64) -> TriangleMesh {
        let corners = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
        let triangles = [[0, 2, 1], [0, 3, 1], [0, 3, 2], [1, 2, 3]];
        let vertices = (triangles.iter().flatten().enumerate())
            .map(|(k, &corner)| corners[corner] + Vec3::repeat(error * k as f64))
            .collect();
        let numbers = (0..4u32).map(|t| [0, 1, 2].map(|k| NodeId(3 * t + k)));
        TriangleMesh::new(vertices, numbers.collect()).unwrap()
    }

    #[test]
    fn soup_becomes_a_surface() {
        for error in [0.0, 1e-9] {
            let (mesh, repairs) = repair(&soup(error)).unwrap();
            assert_eq!(repairs.welded_vertices, 8);
            assert_eq!(repairs.flipped_triangles, 1);
            Surface::new(mesh).unwrap();
        }
    }

    #[test]
    fn vertices_further_apart_than_the_tolerance_stay() {
        let (mesh, repairs) = repair(&soup(1e-4)).unwrap();
        assert_eq!(repairs.welded_vertices, 0);
        assert_eq!(mesh.vertices().len(), 12);
    }

    #[test]
    fn collapsed_triangles_and_unused_vertices_go() {
        let (surface, _) = repair(&soup(0.0)).unwrap();
        let mut vertices = surface.vertices().to_vec();
        let mut triangles = surface.triangles().to_vec();
        vertices.insert(0, Vec3::repeat(9.0));
        triangles.iter_mut().flatten().for_each(|n| n.0 += 1);
        triangles.push([NodeId(1), NodeId(1), NodeId(2)]);
        let dirty = TriangleMesh::new(vertices, triangles).unwrap();
        let (mesh, repairs) = repair(&dirty).unwrap();
        assert_eq!(mesh, surface);
        assert_eq!(
            (repairs.unused_vertices, repairs.degenerate_triangles),
            (1, 1)
        );
    }

    #[test]
    fn a_surface_is_left_as_it_is() {
        let (surface, _) = repair(&soup(0.0)).unwrap();
        assert_eq!(repair(&surface).unwrap(), (surface, Repairs::default()));
    }

    #[test]
    fn an_exact_weld_keeps_every_triangle() {
        let (mesh, joined) = weld_exactly(&soup(0.0));
        assert_eq!(
            (mesh.vertices().len(), mesh.triangles().len(), joined),
            (4, 4, 8)
        );
    }
}
