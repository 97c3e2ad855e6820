//! Tetrahedra with nodes in the middles of their edges, and those on the boundary.

use std::collections::HashSet;

use palpate_geometry::{NodeId, TetrahedronMesh};

use super::super::element::ElementKind;
use super::super::mesh::ElementMesh;
use crate::Vec3;

/// Corners at the two ends of each middle node of a tetrahedron.
pub(super) const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

impl ElementMesh {
    /// Quadratic tetrahedra with straight edges: the vertices keep their numbers, and the middles
    /// follow in the order of [`TetrahedronMesh::edges`].
    pub fn from_tetrahedra(mesh: &TetrahedronMesh) -> Self {
        let edges = mesh.edges();
        let mut nodes = mesh.vertices().to_vec();
        nodes.extend(edges.iter().map(|edge| {
            let [from, to] = edge.map(|node| mesh.vertices()[node.index()]);
            0.5 * (from + to)
        }));
        let mut elements = Vec::with_capacity(10 * mesh.tetrahedra().len());
        for corners in mesh.tetrahedra() {
            elements.extend(corners.map(|node| node.0));
            elements.extend(EDGES.map(|[a, b]| middle(mesh, &edges, [corners[a], corners[b]])));
        }
        Self {
            kind: ElementKind::Tet10,
            nodes,
            elements,
        }
    }
}

/// Number of the node in the middle of an edge.
fn middle(mesh: &TetrahedronMesh, edges: &[[NodeId; 2]], [a, b]: [NodeId; 2]) -> u32 {
    let found = edges.binary_search(&[a.min(b), a.max(b)]);
    (mesh.vertices().len() + found.expect("all edges are listed")) as u32
}

/// A triangle of the boundary.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Face {
    /// Its corners, counter-clockwise seen from outside.
    pub(crate) corners: [NodeId; 3],
    /// Its six nodes: corners, then middles.
    pub(crate) nodes: [usize; 6],
    /// The tetrahedron that it belongs to.
    pub(crate) tetrahedron: usize,
}

/// The boundary of `mesh`, with the node numbers of [`ElementMesh::from_tetrahedra`].
pub(crate) fn faces(mesh: &TetrahedronMesh) -> Vec<Face> {
    let edges = mesh.edges();
    let faces = mesh.boundary().into_iter();
    faces
        .map(|(corners, tetrahedron)| {
            let [a, b, c] = corners;
            let middles = [[a, b], [b, c], [c, a]].map(|edge| middle(mesh, &edges, edge) as usize);
            let [a, b, c] = corners.map(NodeId::index);
            let [d, e, f] = middles;
            Face {
                corners,
                nodes: [a, b, c, d, e, f],
                tetrahedron,
            }
        })
        .collect()
}

/// Takes the faces of each of the `walls` out of those of a boundary.
pub(crate) fn take_walls(boundary: &mut Vec<Face>, walls: &[Vec<[NodeId; 3]>]) -> Vec<Vec<Face>> {
    let sorted = |mut corners: [NodeId; 3]| {
        corners.sort_unstable();
        corners
    };
    let each = walls.iter().map(|wall| {
        let around: HashSet<_> = wall.iter().copied().map(sorted).collect();
        let is_wall = |face: &mut Face| around.contains(&sorted(face.corners));
        boundary.extract_if(.., is_wall).collect()
    });
    each.collect()
}

impl Face {
    /// Its nodes, counter-clockwise seen from inside.
    pub(crate) fn seen_from_inside(&self) -> [u32; 6] {
        turned_over(self.nodes.map(|node| node as u32))
    }

    pub(super) fn positions(&self, mesh: &TetrahedronMesh) -> [Vec3; 3] {
        self.corners.map(|node| mesh.vertices()[node.index()])
    }

    /// Its area at rest [m²].
    pub(super) fn area(&self, mesh: &TetrahedronMesh) -> f64 {
        let [a, b, c] = self.positions(mesh);
        0.5 * (b - a).cross(&(c - a)).norm()
    }

    pub(super) fn centroid(&self, mesh: &TetrahedronMesh) -> Vec3 {
        self.positions(mesh).iter().sum::<Vec3>() / 3.0
    }
}

/// What the six nodes of a face have, in the order in which they are seen from the other side.
pub(super) fn turned_over<T>([a, b, c, ab, bc, ca]: [T; 6]) -> [T; 6] {
    [a, c, b, ca, bc, ab]
}
