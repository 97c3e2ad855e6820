//! Tetrahedra with operations to split edges, move vertices and separate faces.

use std::collections::{HashMap, HashSet};

use super::SlitPoint;
use crate::mesh::tetrahedra::{Face, faces, find, longest_edge, matched};
use crate::refine::{SplitNet, move_if_valid};
use crate::{AabbTree, NodeId, TetrahedronMesh, TriangleMesh, Vec3};

pub(super) type Edge = [u32; 2];

/// Angles below this are not made by moving a vertex [rad].
const MOVED_FLOOR: f64 = 0.17;

/// A vertex of the boundary moves no farther out of a face there than this part of its way [-].
const OFF_BOUNDARY: f64 = 0.2;

#[derive(Clone)]
pub(super) struct Net {
    pub(super) split: SplitNet,
    /// Of which tetrahedron of the body each is a part.
    pub(super) parents: Vec<u32>,
    /// Vertices on the sides of a slit, which stay.
    is_locked: Vec<bool>,
}

impl Net {
    pub(super) fn new(mesh: &TetrahedronMesh) -> Self {
        let tetrahedra = mesh.tetrahedra().iter();
        let tetrahedra: Vec<_> = tetrahedra.map(|nodes| nodes.map(|node| node.0)).collect();
        Self {
            parents: (0..tetrahedra.len() as u32).collect(),
            split: SplitNet::new(mesh.vertices().to_vec(), tetrahedra),
            is_locked: vec![false; mesh.vertices().len()],
        }
    }

    pub(super) fn positions(&self, tetrahedron: u32) -> [Vec3; 4] {
        self.split.tetrahedra[tetrahedron as usize].map(|node| self.split.vertices[node as usize])
    }

    /// The edges of a tetrahedron, the lower vertex first.
    pub(super) fn edges(&self, tetrahedron: u32) -> [Edge; 6] {
        let [a, b, c, d] = self.split.tetrahedra[tetrahedron as usize];
        [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]].map(sorted)
    }

    /// The corners of the tetrahedra.
    pub(super) fn corners(&self) -> Vec<[NodeId; 4]> {
        let tetrahedra = self.split.tetrahedra.iter();
        tetrahedra.map(|nodes| nodes.map(NodeId)).collect()
    }

    /// The faces of the boundary.
    fn boundary_faces(&self) -> impl Iterator<Item = Face> {
        let faces = faces(&self.corners());
        let single = matched(&faces).filter(|alike| alike.len() == 1);
        let single: Vec<Face> = single.map(|alike| alike[0]).collect();
        single.into_iter()
    }

    /// Data of the boundary.
    pub(super) fn boundary(&self) -> Boundary {
        let mut boundary = Boundary {
            normals: vec![Vec::new(); self.split.vertices.len()],
            area: 0.0,
        };
        for face in self.boundary_faces() {
            let corners = face.corners.map(|node| node.0);
            let [a, b, c] = corners.map(|node| self.split.vertices[node as usize]);
            let inner = self.split.tetrahedra[face.tetrahedron as usize][face.opposite as usize];
            let double = (b - a).cross(&(c - a));
            boundary.area += 0.5 * double.norm();
            let normal = double.normalize();
            let outward = normal
                .dot(&(a - self.split.vertices[inner as usize]))
                .signum()
                * normal;
            for node in corners {
                boundary.normals[node as usize].push(outward);
            }
        }
        boundary
    }

    /// The longest edge of the tetrahedra that a slit below `path` may pass [m].
    pub(super) fn longest_edge_around(&self, path: &[SlitPoint]) -> f64 {
        let each = (0..self.split.tetrahedra.len() as u32).map(|number| self.positions(number));
        let near = each.filter_map(|positions| {
            let middle = positions.iter().sum::<Vec3>() / 4.0;
            let longest = longest_edge(&positions);
            let mut points = path.iter();
            points
                .any(|point| (point.place - middle).norm() < point.depth + longest)
                .then_some(longest)
        });
        near.fold(0.0, f64::max)
    }

    /// The points of a path, each at the nearest place of the boundary.
    pub(super) fn onto_boundary(&self, path: &[SlitPoint]) -> Vec<SlitPoint> {
        let corners = self.boundary_faces().map(|face| face.corners).collect();
        let Ok(mesh) = TriangleMesh::new(self.split.vertices.clone(), corners) else {
            return Vec::new();
        };
        let tree = AabbTree::new(&mesh);
        let each = path.iter().map(|point| SlitPoint {
            place: tree.nearest(&mesh, &point.place).on.position,
            ..*point
        });
        each.collect()
    }

    /// Moves a vertex by `way` [m] if the shapes around it allow for that, along the boundary if it is on it; whether it did.
    pub(super) fn shift(&mut self, vertex: u32, way: &Vec3, boundary: &Boundary) -> bool {
        let number = vertex as usize;
        let out = |normal: &Vec3| normal.dot(way).abs() > OFF_BOUNDARY * way.norm();
        if self.is_locked[number] || boundary.normals[number].iter().any(out) {
            return false;
        }
        let SplitNet {
            vertices,
            tetrahedra,
            around,
        } = &mut self.split;
        let star = around[number].iter();
        let star = star.map(|&t| tetrahedra[t as usize]);
        let target = vertices[number] + way;
        move_if_valid(vertices, star, vertex, target, MOVED_FLOOR)
    }

    /// Whether a vertex is on the side of a slit that is open already.
    pub(super) fn is_locked(&self, vertex: u32) -> bool {
        self.is_locked[vertex as usize]
    }

    /// Splits an edge at `place` [m] on it; the new vertex.
    pub(super) fn split(&mut self, edge: Edge, place: Vec3) -> u32 {
        let new = self.split.vertices.len() as u32;
        for parent in self.split.split(edge, place) {
            self.parents.push(self.parents[parent as usize]);
        }
        self.is_locked.push(false);
        new
    }

    /// Parts the tetrahedra on both sides of `faces`: a vertex around which they leave several pieces becomes one for each.
    pub(super) fn part(&mut self, faces: &HashSet<[u32; 3]>) {
        let on: HashSet<u32> = faces.iter().flatten().copied().collect();
        let mut on: Vec<u32> = on.into_iter().collect();
        on.sort_unstable();
        // All vertices are looked at before any becomes two.
        let pieces: Vec<_> = on
            .iter()
            .map(|&vertex| self.pieces_around(vertex, faces))
            .collect();
        for (&vertex, pieces) in on.iter().zip(pieces) {
            self.is_locked[vertex as usize] = true;
            for piece in pieces.into_iter().skip(1) {
                let copy = self.split.vertices.len() as u32;
                self.split
                    .vertices
                    .push(self.split.vertices[vertex as usize]);
                self.is_locked.push(true);
                self.split.around[vertex as usize].retain(|t| !piece.contains(t));
                for &tetrahedron in &piece {
                    for node in &mut self.split.tetrahedra[tetrahedron as usize] {
                        if *node == vertex {
                            *node = copy;
                        }
                    }
                }
                self.split.around.push(piece);
            }
        }
    }

    /// The tetrahedra around a vertex, in the pieces that `faces` leave of them.
    fn pieces_around(&self, vertex: u32, faces: &HashSet<[u32; 3]>) -> Vec<Vec<u32>> {
        let own = &self.split.around[vertex as usize];
        let mut root: Vec<u32> = (0..own.len() as u32).collect();
        let mut seen: HashMap<[u32; 3], u32> = HashMap::new();
        for (place, &tetrahedron) in own.iter().enumerate() {
            let nodes = self.split.tetrahedra[tetrahedron as usize];
            for left_out in nodes.into_iter().filter(|node| *node != vertex) {
                let face = face_without(nodes, left_out);
                if faces.contains(&face) {
                    continue;
                }
                if let Some(other) = seen.insert(face, place as u32) {
                    let [one, other] = [place as u32, other].map(|at| find(&mut root, at));
                    root[one.max(other) as usize] = one.min(other);
                }
            }
        }
        let mut pieces: Vec<(u32, Vec<u32>)> = Vec::new();
        for (place, &tetrahedron) in own.iter().enumerate() {
            let root = find(&mut root, place as u32);
            match pieces.iter_mut().find(|(known, _)| *known == root) {
                Some((_, piece)) => piece.push(tetrahedron),
                None => pieces.push((root, vec![tetrahedron])),
            }
        }
        pieces.into_iter().map(|(_, piece)| piece).collect()
    }
}

/// Of the boundary, as it is before anything is split.
pub(super) struct Boundary {
    /// Unit outward normals of the faces around each vertex; none inside.
    pub(super) normals: Vec<Vec<Vec3>>,
    /// Of all faces [m²].
    pub(super) area: f64,
}

pub(super) fn sorted([a, b]: Edge) -> Edge {
    [a.min(b), a.max(b)]
}

/// The corners of a face, ascending.
pub(super) fn face_without(nodes: [u32; 4], left_out: u32) -> [u32; 3] {
    let mut rest = nodes.into_iter().filter(|node| *node != left_out);
    let mut face = [0; 3].map(|_: u32| rest.next().unwrap_or_default());
    face.sort_unstable();
    face
}
