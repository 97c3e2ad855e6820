//! The nodes with prescribed displacements: fixed and moved ones.

use std::collections::BTreeSet;

use palpate_geometry::TetrahedronMesh;

use super::mesh::Face;
use super::patch::{area_of, faces_within};
use super::problem::SolidProblem;
use crate::{Error, Vec3};

/// Nodes with prescribed displacements, ascending.
#[derive(Debug)]
pub(super) struct PrescribedNodes {
    /// Fixed nodes.
    pub(super) anchored: Vec<usize>,
    /// Nodes of the patch.
    pub(super) moved: Vec<usize>,
    /// Area of the patch [m²].
    pub(super) area: f64,
}

impl PrescribedNodes {
    pub(super) fn new(
        problem: &SolidProblem,
        mesh: &TetrahedronMesh,
        faces: &[Face],
        center: Option<&Vec3>,
    ) -> Result<Self, Error> {
        let anchored: Vec<&Face> = faces
            .iter()
            .filter(|face| problem.anchor.contains(face.centroid(mesh).into()))
            .collect();
        if anchored.is_empty() {
            return Err(Error::NothingFixed);
        }
        check_every_piece_is_fixed(mesh, &anchored)?;
        let patch = match (&problem.patch, center) {
            (Some(patch), Some(center)) => faces_within(patch.radius, center, mesh, faces),
            _ => Vec::new(),
        };
        let nodes = |faces: &[&Face]| -> Vec<usize> {
            let nodes: BTreeSet<_> = faces.iter().flat_map(|face| face.nodes).collect();
            nodes.into_iter().collect()
        };
        let (anchored, moved) = (nodes(&anchored), nodes(&patch));
        if let (true, Some(patch)) = (moved.is_empty(), &problem.patch) {
            let radius = patch.radius;
            return Err(Error::EmptyPatch { radius });
        }
        let both = moved.iter().filter(|n| anchored.binary_search(n).is_ok());
        let both = both.count();
        if both > 0 {
            let part = both as f64 / moved.len() as f64;
            return Err(Error::PatchIsFixed { part });
        }
        Ok(Self {
            anchored,
            moved,
            area: area_of(&patch, mesh),
        })
    }
}

fn check_every_piece_is_fixed(mesh: &TetrahedronMesh, anchored: &[&Face]) -> Result<(), Error> {
    let pieces = mesh.pieces();
    let count = pieces.iter().max().map_or(0, |&last| last + 1);
    let mut is_fixed = vec![false; count];
    for face in anchored {
        is_fixed[pieces[face.tetrahedron]] = true;
    }
    let Some(loose) = is_fixed.iter().position(|fixed| !fixed) else {
        return Ok(());
    };
    let place = pieces.iter().position(|&piece| piece == loose);
    let [x, y, z] = place.map_or([0.0; 3], |t| mesh.positions(t)[0].into());
    Err(Error::UnfixedPiece {
        place: [x, y, z],
        pieces: count,
    })
}
