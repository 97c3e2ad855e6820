//! The elements of all pieces as one body, without those in cavities.

use std::ops::Range;

use palpate_geometry::{NodeId, TetrahedronError, TetrahedronMesh};
use palpate_mechanics::nonlinear::BodyCavity;

use super::composition::Filled;
use super::regions::Elements;
use super::soft::Piece;
use crate::Error;

/// The organ's elements and those of the neighbours that bend.
pub(super) struct Merged {
    pub(super) mesh: TetrahedronMesh,
    pub(super) elements: Elements,
    /// Of each tetrahedron.
    pub(super) pieces: Vec<u32>,
    /// The tetrahedra of each piece.
    pub(super) ranges: Vec<Range<usize>>,
    pub(super) cavities: Vec<BodyCavity>,
}

impl Merged {
    pub(super) fn new(filled: &[Filled], pieces: &[Piece]) -> Result<Self, Error> {
        let (mut vertices, mut tetrahedra) = (Vec::new(), Vec::new());
        let (mut numbers, mut ranges) = (Vec::new(), Vec::new());
        let (mut elements, mut cavities) = (Elements::default(), Vec::new());
        for (number, (own, piece)) in filled.iter().zip(pieces).enumerate() {
            let regions = &piece.regions.cavities;
            let hollow = own.hollow(regions.len());
            let hollow = hollow.map_err(|error| match error {
                TetrahedronError::NotEnclosed { region } => Error::CavityNotEnclosed {
                    name: regions[region as usize - 1].name.clone(),
                },
                other => palpate_mechanics::Error::from(other).into(),
            })?;
            let (first, begin) = (vertices.len() as u32, tetrahedra.len());
            let moved = |node: NodeId| NodeId(node.0 + first);
            vertices.extend_from_slice(hollow.mesh.vertices());
            let corners = hollow.mesh.tetrahedra().iter();
            tetrahedra.extend(corners.map(|corners| corners.map(moved)));
            numbers.resize(tetrahedra.len(), number as u32);
            ranges.push(begin..tetrahedra.len());
            let is_tissue = |tetrahedron: &u32| own.mesh.region(*tetrahedron as usize) == 0;
            let left: Vec<u32> = (0..own.mesh.tetrahedra().len() as u32)
                .filter(is_tissue)
                .collect();
            elements.extend(own.elements.parts(&left));
            let walls = hollow.walls.into_iter().zip(regions);
            cavities.extend(walls.map(|(wall, region)| BodyCavity {
                wall: wall.into_iter().map(|face| face.map(moved)).collect(),
                content: region.content,
                filling: None,
            }));
        }
        let mesh = TetrahedronMesh::new(vertices, tetrahedra);
        Ok(Self {
            mesh: mesh.map_err(palpate_mechanics::Error::from)?,
            elements,
            pieces: numbers,
            ranges,
            cavities,
        })
    }
}
