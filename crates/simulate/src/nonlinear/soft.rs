//! Neighbours that bend: further pieces of the body, each of its own tissue and held where it stands.
//!
//! Pieces stay out of one another, and an organ with `self_contact` out of itself (`TouchingBoundary`); tools touch all of
//! them.
//!
//! *How we know*: `nonlinear_soft::…`.

use std::ops::Range;

use palpate_files::Scene;
use palpate_files::scene::{Location, Region, SoftNeighbour};
use palpate_geometry::{NodeId, Surface, TetrahedronMesh, Vec3};
use palpate_mechanics::contact::{Friction, Tip};
use palpate_mechanics::nonlinear::{Moduli, NonlinearModel, TouchingBoundary};
use palpate_mechanics::{LinearElastic, TipLaw};

use super::regions::{Elements, RegionTissue};
use crate::Error;
use crate::organ::{back, held_region, read_neighbour};
use crate::tip_laws::stiffen;
use crate::tool::Tool;
use crate::walls::typical_wall;

/// A neighbour that bends.
#[derive(Debug, Clone)]
pub(crate) struct SoftBody {
    pub(crate) surface: Surface,
    pub(crate) tissue: RegionTissue,
    /// Where it is held; in its own frame if it has one.
    anchor: Region,
    location: Option<Location>,
    pub(super) nodes: usize,
    friction: f64,
    /// The force of its tissue on the tip of each tool.
    laws: Vec<TipLaw>,
}

impl SoftBody {
    /// Those of `scene`, and warnings.
    pub(crate) fn all(scene: &Scene) -> Result<(Vec<Self>, Vec<String>), Error> {
        let (mut all, mut warnings) = (Vec::new(), Vec::new());
        for (number, neighbour) in scene.neighbours.iter().enumerate() {
            let Some(SoftNeighbour {
                tissue,
                anchor,
                nodes,
            }) = &neighbour.soft
            else {
                continue;
            };
            let (surface, more) = read_neighbour(neighbour)?;
            warnings.extend(more);
            let body = Self {
                surface,
                tissue: RegionTissue::read(tissue, &mut warnings)?,
                anchor: held_region(&neighbour.shape, anchor.as_ref()),
                location: anchor.is_none().then_some(neighbour.location),
                nodes: *nodes,
                friction: neighbour.friction,
                laws: Vec::new(),
            };
            let mut vertices = body.surface.mesh().vertices().iter();
            if !vertices.any(|vertex| body.holds(vertex)) {
                return Err(Error::LooseNeighbour { number: number + 1 });
            }
            all.push(body);
        }
        Ok((all, warnings))
    }

    /// Finds the force of its tissue on the tips of `tools`, and warnings.
    pub(crate) fn meet(
        &mut self,
        tools: &[Tool],
        watch: &mut dyn FnMut(f64),
    ) -> Result<Vec<String>, Error> {
        let RegionTissue {
            tissue, material, ..
        } = &self.tissue;
        let mut own = tools.to_vec();
        for tool in &mut own {
            tool.law = TipLaw::linear(tool.tip, tool.bond, material.at_rest);
        }
        let touched = vec![(tissue.clone(), material.clone()); tools.len()];
        let warnings = stiffen(&mut own, &touched, watch)?;
        self.laws = own.into_iter().map(|tool| tool.law).collect();
        Ok(warnings)
    }

    /// Whether a `place` of it [m] is held.
    pub(super) fn holds(&self, place: &Vec3) -> bool {
        let place = match &self.location {
            Some(location) => back(location, place),
            None => *place,
        };
        self.anchor.holds(place.into())
    }
}

/// A piece of the body, as tools meet it.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Its part of the shown triangles.
    triangles: Range<u32>,
    /// Its tissue at the surface at rest.
    pub(super) law: LinearElastic,
    /// The force of its tissue on the tip of each tool; those of the tools themselves for the organ.
    laws: Vec<TipLaw>,
    /// Of each tool, whether it bends around its tip, rather than that makes a dimple in it.
    pub(super) bends_around: Vec<bool>,
}

impl Piece {
    pub(super) fn all(
        organ: (&Surface, &LinearElastic),
        soft: &[SoftBody],
        tools: &[Tool],
    ) -> Vec<Self> {
        let mut first = 0;
        let mut piece = |surface: &Surface, law: &LinearElastic, laws: &[TipLaw]| {
            let end = first + surface.mesh().triangles().len() as u32;
            let triangles = first..end;
            first = end;
            Self {
                triangles,
                law: *law,
                laws: laws.to_vec(),
                bends_around: {
                    let wall = typical_wall(surface);
                    tools.iter().map(|tool| wraps(tool, wall)).collect()
                },
            }
        };
        let mut all = vec![piece(organ.0, organ.1, &[])];
        all.extend(
            soft.iter()
                .map(|body| piece(&body.surface, body.tissue.at_rest(), &body.laws)),
        );
        all
    }

    /// Which of the `pieces` has a shown triangle.
    pub(super) fn with(pieces: &[Self], triangle: u32) -> usize {
        let found = pieces
            .iter()
            .position(|piece| piece.triangles.contains(&triangle));
        found.unwrap_or(0)
    }

    /// The force of its tissue on the tip of a tool.
    pub(super) fn tip_law<'a>(&'a self, (number, tool): (usize, &'a Tool)) -> &'a TipLaw {
        self.laws.get(number).unwrap_or(&tool.law)
    }
}

/// Whether a `wall` so thick [m] bends around a tip: a ball that slips and is wider than the wall. One that sticks is taken as
/// a dimple all the same.
fn wraps(tool: &Tool, wall: f64) -> bool {
    let slips = tool.bond == Friction::Frictionless;
    matches!(tool.tip, Tip::Sphere { radius } if slips && radius > wall)
}

/// The organ's tetrahedra and those of the neighbours that bend.
pub(super) struct Merged {
    pub(super) mesh: TetrahedronMesh,
    /// Of each tetrahedron.
    pub(super) pieces: Vec<u32>,
    /// The tetrahedra of each piece.
    pub(super) ranges: Vec<Range<usize>>,
}

impl Merged {
    pub(super) fn new(organ: TetrahedronMesh, soft: Vec<TetrahedronMesh>) -> Result<Self, Error> {
        if soft.is_empty() {
            let count = organ.tetrahedra().len();
            return Ok(Self {
                mesh: organ,
                pieces: vec![0; count],
                ranges: std::iter::once(0..count).collect(),
            });
        }
        let (mut vertices, mut tetrahedra) = (Vec::new(), Vec::new());
        let (mut pieces, mut ranges) = (Vec::new(), Vec::new());
        for (number, piece) in std::iter::once(organ).chain(soft).enumerate() {
            let (first, begin) = (vertices.len() as u32, tetrahedra.len());
            vertices.extend_from_slice(piece.vertices());
            let own = piece.tetrahedra().iter();
            tetrahedra.extend(own.map(|corners| corners.map(|node| NodeId(node.0 + first))));
            pieces.resize(tetrahedra.len(), number as u32);
            ranges.push(begin..tetrahedra.len());
        }
        let mesh = TetrahedronMesh::new(vertices, tetrahedra);
        Ok(Self {
            mesh: mesh.map_err(palpate_mechanics::Error::from)?,
            pieces,
            ranges,
        })
    }

    /// The tissues of all of them: the organ's `elements`, and those of the neighbours, whose relaxation comes after so many
    /// of the organ.
    pub(super) fn elements(&self, organ: Elements, series: usize, soft: &[SoftBody]) -> Elements {
        let mut all = organ;
        for (number, (body, range)) in soft.iter().zip(&self.ranges[1..]).enumerate() {
            let moduli: Moduli<f64> = *body.tissue.moduli();
            let end = range.end;
            all.moduli.resize(end, moduli);
            all.numbers.resize(end, series + number);
            all.densities
                .resize(end, body.tissue.tissue.density_kg_m3.value);
        }
        all
    }
}

/// How the pieces touch one another, and the organ itself if the scene says so; none where nothing does.
pub(super) fn touching(
    scene: &Scene,
    model: &NonlinearModel,
    (merged, soft): (&Merged, &[SoftBody]),
) -> Result<Option<TouchingBoundary>, Error> {
    let organ = &scene.organ;
    if soft.is_empty() && !organ.self_contact {
        return Ok(None);
    }
    let own = |piece: usize| {
        piece
            .checked_sub(1)
            .map_or(0.0, |number| soft[number].friction)
    };
    let friction = |one: usize, other: usize| match one == other {
        true => (one == 0 && organ.self_contact).then_some(organ.self_friction),
        false => Some(own(one).max(own(other))),
    };
    Ok(Some(TouchingBoundary::new(
        model,
        &merged.pieces,
        friction,
    )?))
}
