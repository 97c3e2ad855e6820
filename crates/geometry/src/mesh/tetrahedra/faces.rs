use super::{TetrahedronError, TetrahedronMesh};
use crate::{MeshError, NodeId, Surface, TriangleMesh};

/// Corners of the face that leaves out corner `k`, counter-clockwise seen from outside.
pub(crate) const OPPOSITE: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// One face of one tetrahedron, with its corners in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Face {
    pub(crate) corners: [NodeId; 3],
    pub(crate) tetrahedron: u32,
    /// The corner of the tetrahedron that it leaves out, from 0 to 3.
    pub(crate) opposite: u8,
}

/// All faces of all tetrahedra, sorted so that those of equal corners lie together.
pub(crate) fn faces(tetrahedra: &[[NodeId; 4]]) -> Vec<Face> {
    let mut faces = Vec::with_capacity(4 * tetrahedra.len());
    for (number, nodes) in tetrahedra.iter().enumerate() {
        for (opposite, corners) in OPPOSITE.iter().enumerate() {
            let mut corners = corners.map(|k| nodes[k]);
            corners.sort_unstable();
            faces.push(Face {
                corners,
                tetrahedron: number as u32,
                opposite: opposite as u8,
            });
        }
    }
    faces.sort_unstable();
    faces
}

/// The faces of equal corners at a time: two inside, one on the boundary.
pub(crate) fn matched(faces: &[Face]) -> impl Iterator<Item = &[Face]> {
    faces.chunk_by(|a, b| a.corners == b.corners)
}

/// Tetrahedra from which whole regions were taken out.
#[derive(Debug, Clone)]
pub struct HollowMesh {
    /// The remaining tetrahedra.
    pub mesh: TetrahedronMesh,
    /// For each region that was taken out the triangles of the boundary around it, oriented like those of
    /// [`TetrahedronMesh::boundary`].
    pub walls: Vec<Vec<[NodeId; 3]>>,
}

impl TetrahedronMesh {
    /// The mesh without the tetrahedra of these `regions`, each of which the others enclose.
    ///
    /// # Errors
    /// When a region reaches the boundary or another of `regions`, or nothing is left.
    pub fn without(&self, regions: &[u32]) -> Result<HollowMesh, TetrahedronError> {
        let place = |tetrahedron: u32| {
            let region = self.region(tetrahedron as usize);
            regions.iter().position(|taken| *taken == region)
        };
        let mut walls = vec![Vec::new(); regions.len()];
        for alike in matched(&faces(&self.tetrahedra)) {
            let taken = alike.iter().find_map(|face| place(face.tetrahedron));
            let left = alike.iter().find(|face| place(face.tetrahedron).is_none());
            match (taken, left) {
                (Some(at), Some(face)) => {
                    let nodes = self.tetrahedra[face.tetrahedron as usize];
                    walls[at].push(OPPOSITE[face.opposite as usize].map(|k| nodes[k]));
                }
                (Some(at), None)
                    if alike.iter().any(|face| place(face.tetrahedron) != Some(at))
                        || alike.len() == 1 =>
                {
                    return Err(TetrahedronError::NotEnclosed {
                        region: regions[at],
                    });
                }
                _ => {}
            }
        }
        let numbers = 0..self.tetrahedra.len();
        let left: Vec<_> = numbers.filter(|t| place(*t as u32).is_none()).collect();
        let tetrahedra: Vec<_> = left.iter().map(|t| self.tetrahedra[*t]).collect();
        // Vertices that are left keep their order.
        let mut number = vec![0; self.vertices.len()];
        for node in tetrahedra.iter().flatten() {
            number[node.index()] = 1;
        }
        let mut next = 0;
        for number in &mut number {
            next += std::mem::replace(number, next);
        }
        for node in walls.iter_mut().flatten().flatten() {
            *node = NodeId(number[node.index()]);
        }
        let regions = left.iter().map(|t| self.region(*t)).collect();
        let mesh = Self::new(self.vertices.clone(), tetrahedra)?.with_regions(regions)?;
        Ok(HollowMesh { mesh, walls })
    }

    /// The triangles of the boundary, oriented outward, with the vertex numbers of this mesh, each
    /// with the number of its tetrahedron; in the order of the tetrahedra.
    pub fn boundary(&self) -> Vec<([NodeId; 3], usize)> {
        let faces = faces(&self.tetrahedra);
        let mut alone: Vec<_> = matched(&faces)
            .filter(|alike| alike.len() == 1)
            .map(|alike| (alike[0].tetrahedron, alike[0].opposite))
            .collect();
        alone.sort_unstable();
        alone
            .into_iter()
            .map(|(tetrahedron, opposite)| {
                let nodes = self.tetrahedra[tetrahedron as usize];
                let corners = OPPOSITE[opposite as usize].map(|k| nodes[k]);
                (corners, tetrahedron as usize)
            })
            .collect()
    }

    /// The boundary with vertices of its own.
    ///
    /// # Errors
    /// When it touches itself in an edge or a vertex.
    pub fn boundary_surface(&self) -> Result<Surface, MeshError> {
        Surface::new(self.boundary_mesh())
    }

    /// The triangles of the boundary with vertices of their own, which may touch in an edge or a vertex.
    pub(crate) fn boundary_mesh(&self) -> TriangleMesh {
        let mut number = vec![None; self.vertices.len()];
        let mut vertices = Vec::new();
        let mut own = |node: NodeId| {
            *number[node.index()].get_or_insert_with(|| {
                vertices.push(self.vertices[node.index()]);
                NodeId(vertices.len() as u32 - 1)
            })
        };
        let triangles = self.boundary().into_iter();
        let triangles = triangles
            .map(|(corners, _)| corners.map(&mut own))
            .collect();
        TriangleMesh::new(vertices, triangles).expect("tetrahedra have a boundary")
    }

    /// For each tetrahedron the number of its piece. Pieces hang together over faces and are
    /// numbered from zero by their first tetrahedron.
    pub fn pieces(&self) -> Vec<usize> {
        pieces(&self.tetrahedra)
    }
}

/// See [`TetrahedronMesh::pieces`].
pub(crate) fn pieces(tetrahedra: &[[NodeId; 4]]) -> Vec<usize> {
    let faces = faces(tetrahedra);
    let mut root: Vec<u32> = (0..tetrahedra.len() as u32).collect();
    for alike in matched(&faces) {
        for pair in alike.windows(2) {
            let one = find(&mut root, pair[0].tetrahedron);
            let other = find(&mut root, pair[1].tetrahedron);
            // The lower number leads, so that a root is the first of its piece.
            root[one.max(other) as usize] = one.min(other);
        }
    }
    let mut number = vec![usize::MAX; tetrahedra.len()];
    let mut count = 0;
    (0..tetrahedra.len())
        .map(|t| {
            let leader = find(&mut root, t as u32) as usize;
            if number[leader] == usize::MAX {
                number[leader] = count;
                count += 1;
            }
            number[leader]
        })
        .collect()
}

/// The leader of a set, with the path to it halved.
pub(crate) fn find(root: &mut [u32], mut at: u32) -> u32 {
    while root[at as usize] != at {
        root[at as usize] = root[root[at as usize] as usize];
        at = root[at as usize];
    }
    at
}
