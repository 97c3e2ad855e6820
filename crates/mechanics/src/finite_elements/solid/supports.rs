//! Which nodes are held and which are moved.

use std::collections::BTreeSet;

use palpate_geometry::{TetrahedronMesh, closest_on_triangle};

use super::mesh::{Face, faces};
use super::problem::SolidProblem;
use crate::{Error, Vec3};

/// A vertex within this part of the radius outside of the sphere is on it [-].
const ON: f64 = 1e-8;

/// Nodes with a support, ascending.
#[derive(Debug)]
pub(super) struct Held {
    /// Those that do not move.
    pub(super) anchored: Vec<usize>,
    /// Those of the patch.
    pub(super) moved: Vec<usize>,
    /// Area of the patch [m²].
    pub(super) area: f64,
}

impl Held {
    pub(super) fn new(
        problem: &SolidProblem,
        mesh: &TetrahedronMesh,
        center: &Vec3,
    ) -> Result<Self, Error> {
        let faces = faces(mesh);
        let anchored: Vec<&Face> = faces
            .iter()
            .filter(|face| problem.anchor.holds(face.centroid(mesh).into()))
            .collect();
        if anchored.is_empty() {
            return Err(Error::NothingHeld);
        }
        every_piece_is_held(mesh, &anchored)?;
        let patch = patch(mesh, &faces, center, problem.patch.radius);
        let nodes = |faces: &[&Face]| -> Vec<usize> {
            let nodes: BTreeSet<_> = faces.iter().flat_map(|face| face.nodes).collect();
            nodes.into_iter().collect()
        };
        let (anchored, moved) = (nodes(&anchored), nodes(&patch));
        if moved.is_empty() {
            let radius = problem.patch.radius;
            return Err(Error::EmptyPatch { radius });
        }
        let both = moved.iter().filter(|n| anchored.binary_search(n).is_ok());
        let both = both.count();
        if both > 0 {
            let part = both as f64 / moved.len() as f64;
            return Err(Error::PatchIsHeld { part });
        }
        let area = patch.iter().map(|face| {
            let [a, b, c] = face.positions(mesh);
            0.5 * (b - a).cross(&(c - a)).norm()
        });
        let area = area.sum();
        Ok(Self {
            anchored,
            moved,
            area,
        })
    }
}

fn every_piece_is_held(mesh: &TetrahedronMesh, anchored: &[&Face]) -> Result<(), Error> {
    let pieces = mesh.pieces();
    let count = pieces.iter().max().map_or(0, |&last| last + 1);
    let mut is_held = vec![false; count];
    for face in anchored {
        is_held[pieces[face.tetrahedron]] = true;
    }
    let Some(loose) = is_held.iter().position(|held| !held) else {
        return Ok(());
    };
    let place = pieces.iter().position(|&piece| piece == loose);
    let [x, y, z] = place.map_or([0.0; 3], |t| mesh.positions(t)[0].into());
    Err(Error::LoosePiece {
        place: [x, y, z],
        pieces: count,
    })
}

/// The faces within `radius` of `center` that hang together with the nearest of them.
fn patch<'a>(
    mesh: &TetrahedronMesh,
    faces: &'a [Face],
    center: &Vec3,
    radius: f64,
) -> Vec<&'a Face> {
    let reach = radius * (1.0 + ON);
    let within = |face: &&Face| {
        let corners = face.positions(mesh);
        corners.iter().all(|p| (p - center).norm() <= reach)
    };
    let mut inside: Vec<&Face> = faces.iter().filter(within).collect();
    let distance =
        |face: &Face| (closest_on_triangle(&face.positions(mesh), center).position - center).norm();
    inside.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    // Middles of edges are shared by neighbours only.
    let mut reached: BTreeSet<usize> = inside
        .first()
        .into_iter()
        .flat_map(|face| face.nodes[3..].iter().copied())
        .collect();
    let mut patch = Vec::new();
    loop {
        let (new, rest): (Vec<&Face>, Vec<&Face>) = inside
            .into_iter()
            .partition(|face| face.nodes[3..].iter().any(|n| reached.contains(n)));
        if new.is_empty() {
            return patch;
        }
        reached.extend(new.iter().flat_map(|face| face.nodes[3..].iter().copied()));
        patch.extend(new);
        inside = rest;
    }
}
