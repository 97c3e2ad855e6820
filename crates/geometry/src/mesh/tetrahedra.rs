//! Tetrahedra over shared vertices, for finite element solvers.
//!
//! A tetrahedron a, b, c, d is positive when (b − a) · (c − a) × (d − a) > 0: seen from d, its first
//! three corners run counter-clockwise. Faces are numbered by the corner that they leave out.
//!
//! *How we know*: `tetrahedra::a_block_has_its_volume_and_its_faces`, and the tests of filling and
//! refinement, which look at every face of every mesh that they make.
//!
//! *Limits*: that a vertex lies in the middle of a neighbour's edge is not noticed.

mod block;
mod error;
mod faces;
mod quality;

pub use error::TetrahedronError;
pub use faces::HollowMesh;
pub(crate) use faces::{Face, faces, find, matched, pieces};
pub use quality::TetrahedronQuality;
pub(crate) use quality::{dihedral_angles, longest_edge, six_fold_volume};

use crate::{NodeId, Vec3};

/// A tetrahedron whose height is below this part of its longest edge, cubed, is flat: its volume is
/// lost in rounding [-].
const FLAT: f64 = 1e-12;

/// Tetrahedra over shared vertices. Coordinates are finite, indices in range, every vertex is used,
/// every tetrahedron is positive, and no face belongs to more than two of them.
#[derive(Debug, Clone, PartialEq)]
pub struct TetrahedronMesh {
    vertices: Vec<Vec3>,
    tetrahedra: Vec<[NodeId; 4]>,
    /// The region of each; empty where all are of region 0.
    regions: Vec<u32>,
}

impl TetrahedronMesh {
    /// More are never made: a solver on one computer could not use them.
    pub const MAX_TETRAHEDRA: usize = 4_000_000;

    /// A mesh of `vertices` [m] and positive `tetrahedra` (vertex numbers). Vertices that none uses
    /// are dropped; the others keep their order. All tetrahedra are of region 0.
    ///
    /// # Errors
    /// When there is no tetrahedron, a coordinate is not finite, an index is out of range, a
    /// tetrahedron is inverted or flat, or a face belongs to three.
    pub fn new(
        vertices: Vec<Vec3>,
        tetrahedra: Vec<[NodeId; 4]>,
    ) -> Result<Self, TetrahedronError> {
        if tetrahedra.is_empty() {
            return Err(TetrahedronError::Empty);
        }
        for (tetrahedron, corners) in tetrahedra.iter().enumerate() {
            if let Some(node) = corners.iter().find(|n| n.index() >= vertices.len()) {
                return Err(TetrahedronError::IndexOutOfRange {
                    tetrahedron,
                    vertex: node.index(),
                    vertices: vertices.len(),
                });
            }
        }
        let (vertices, tetrahedra) = without_unused(vertices, tetrahedra);
        if let Some(vertex) = vertices
            .iter()
            .position(|v| !v.iter().all(|c| c.is_finite()))
        {
            return Err(TetrahedronError::NotFinite { vertex });
        }
        let mesh = Self {
            vertices,
            tetrahedra,
            regions: Vec::new(),
        };
        mesh.check_shapes()?;
        mesh.check_faces()?;
        Ok(mesh)
    }

    /// The same with a region for each tetrahedron.
    ///
    /// # Errors
    /// When there is not one for each.
    pub fn with_regions(self, regions: Vec<u32>) -> Result<Self, TetrahedronError> {
        if regions.len() != self.tetrahedra.len() {
            return Err(TetrahedronError::WrongRegions {
                found: regions.len(),
                tetrahedra: self.tetrahedra.len(),
            });
        }
        let regions = match regions.iter().all(|region| *region == 0) {
            true => Vec::new(),
            false => regions,
        };
        Ok(Self { regions, ..self })
    }

    /// The region that a tetrahedron belongs to.
    pub fn region(&self, tetrahedron: usize) -> u32 {
        self.regions.get(tetrahedron).copied().unwrap_or(0)
    }

    /// Whether several regions meet in each vertex.
    pub(crate) fn between_regions(&self) -> Vec<bool> {
        let each = self.tetrahedra.iter().enumerate();
        let each = each.map(|(number, corners)| (corners.map(|node| node.0), self.region(number)));
        between_regions(self.vertices.len(), each)
    }

    fn check_shapes(&self) -> Result<(), TetrahedronError> {
        for tetrahedron in 0..self.tetrahedra.len() {
            let positions = self.positions(tetrahedron);
            let volume_m3 = six_fold_volume(&positions) / 6.0;
            if volume_m3.abs() <= FLAT * longest_edge(&positions).powi(3) {
                return Err(TetrahedronError::Flat { tetrahedron });
            }
            if volume_m3 < 0.0 {
                return Err(TetrahedronError::Inverted {
                    tetrahedron,
                    volume_m3,
                });
            }
        }
        Ok(())
    }

    fn check_faces(&self) -> Result<(), TetrahedronError> {
        let faces = faces(&self.tetrahedra);
        let crowded = matched(&faces).find(|alike| alike.len() > 2);
        crowded.map_or(Ok(()), |alike| {
            Err(TetrahedronError::NonManifoldFace {
                corners: alike[0].corners.map(NodeId::index),
                tetrahedra: alike.len(),
            })
        })
    }

    /// Positions of the vertices [m].
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// The tetrahedra as vertex numbers.
    pub fn tetrahedra(&self) -> &[[NodeId; 4]] {
        &self.tetrahedra
    }

    /// Vertices and tetrahedra, to be changed and checked again; the regions are left out.
    pub fn into_parts(self) -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
        (self.vertices, self.tetrahedra)
    }

    /// The four corners of a tetrahedron [m].
    pub fn positions(&self, tetrahedron: usize) -> [Vec3; 4] {
        self.tetrahedra[tetrahedron].map(|node| self.vertices[node.index()])
    }

    /// Total volume [m³].
    pub fn volume(&self) -> f64 {
        (0..self.tetrahedra.len()).map(|t| self.volume_of(t)).sum()
    }

    /// The volume of a tetrahedron [m³].
    pub fn volume_of(&self, tetrahedron: usize) -> f64 {
        six_fold_volume(&self.positions(tetrahedron)) / 6.0
    }

    /// All edges once, ends and list in ascending order.
    pub fn edges(&self) -> Vec<[NodeId; 2]> {
        let mut edges: Vec<_> = self
            .tetrahedra
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]])
            .map(|[from, to]| [from.min(to), from.max(to)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}

/// Whether several regions meet in each of so many vertices, from tetrahedra with their regions.
pub(crate) fn between_regions(
    vertices: usize,
    tetrahedra: impl Iterator<Item = ([u32; 4], u32)>,
) -> Vec<bool> {
    let mut first = vec![None; vertices];
    let mut between = vec![false; vertices];
    for (nodes, region) in tetrahedra {
        for node in nodes {
            let seen = *first[node as usize].get_or_insert(region);
            between[node as usize] |= seen != region;
        }
    }
    between
}

fn without_unused(
    vertices: Vec<Vec3>,
    mut tetrahedra: Vec<[NodeId; 4]>,
) -> (Vec<Vec3>, Vec<[NodeId; 4]>) {
    let mut used = vec![false; vertices.len()];
    for node in tetrahedra.iter().flatten() {
        used[node.index()] = true;
    }
    if used.iter().all(|&used| used) {
        return (vertices, tetrahedra);
    }
    let mut number = vec![NodeId(u32::MAX); vertices.len()];
    let mut kept = Vec::new();
    for (index, vertex) in vertices.into_iter().enumerate() {
        if used[index] {
            number[index] = NodeId(kept.len() as u32);
            kept.push(vertex);
        }
    }
    for node in tetrahedra.iter_mut().flatten() {
        *node = number[node.index()];
    }
    (kept, tetrahedra)
}
