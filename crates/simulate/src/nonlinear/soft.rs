//! Further organs and neighbours that bend: further pieces of the body, each with its own tissues and its own fixed
//! region.
//!
//! Pieces are in contact with one another, and an organ with `self_contact` with itself (`TouchingBoundary`); tools
//! touch all of them.
//!
//! *How we know*: `nonlinear_soft::…`.

use std::ops::Range;

use palpate_files::Scene;
use palpate_files::scene::{Location, Region, SoftNeighbour};
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::nonlinear::{NonlinearModel, TouchingBoundary};
use palpate_mechanics::{LinearElastic, TipLaw};

use super::merged::Merged;
use crate::Error;
use crate::organ::{back, fixed_region, read_neighbour, read_tissue};
use crate::regions::Regions;
use crate::tip_laws::stiffen;
use crate::tool::{Tool, typical_radius};
use crate::walls::typical_wall;

/// A neighbour that bends.
#[derive(Debug, Clone)]
pub(crate) struct SoftBody {
    pub(crate) surface: Surface,
    pub(crate) regions: Regions,
    /// Its fixed region; in its own frame if it has one.
    anchor: Region,
    location: Option<Location>,
    pub(super) nodes: usize,
    friction: f64,
    /// The force of its tissue on the tip of each tool.
    laws: Vec<TipLaw>,
}

impl SoftBody {
    /// The neighbours of `scene` that bend, and warnings.
    pub(crate) fn all(scene: &Scene) -> Result<(Vec<Self>, Vec<String>), Error> {
        let (mut all, mut warnings) = (Vec::new(), Vec::new());
        for (number, neighbour) in scene.neighbours.iter().enumerate() {
            let Some(SoftNeighbour {
                tissue,
                layers,
                inclusions,
                anchor,
                nodes,
            }) = &neighbour.soft
            else {
                continue;
            };
            let (surface, more) = read_neighbour(neighbour)?;
            warnings.extend(more);
            let tree = AabbTree::new(surface.mesh());
            let (tissue, material) = read_tissue(tissue)?;
            warnings.extend(material.warnings.iter().cloned());
            let regions = Regions::read(layers, inclusions, &surface, &tree, &tissue, &material)?;
            warnings.extend_from_slice(&regions.warnings);
            warnings.extend_from_slice(&regions.nonlinear_warnings);
            let body = Self {
                surface,
                regions,
                anchor: fixed_region(&neighbour.shape, anchor.as_ref()),
                location: anchor.is_none().then_some(neighbour.location),
                nodes: *nodes,
                friction: neighbour.friction,
                laws: Vec::new(),
            };
            let mut vertices = body.surface.mesh().vertices().iter();
            if !vertices.any(|vertex| body.is_fixed(vertex)) {
                return Err(Error::LooseNeighbour { number: number + 1 });
            }
            all.push(body);
        }
        Ok((all, warnings))
    }

    /// Prepares the force of its tissue on the tips of the `tools` of `scene`; returns warnings.
    pub(crate) fn prepare_tips(
        &mut self,
        scene: &Scene,
        tools: &[Tool],
        on_progress: &mut dyn FnMut(f64),
    ) -> Result<Vec<String>, Error> {
        let touched = scene.tools.iter();
        let touched = touched.map(|tool| self.regions.touched(typical_radius(&tool.tip)));
        let touched = touched.collect::<Result<Vec<_>, _>>()?;
        let mut own = tools.to_vec();
        for (tool, (_, material)) in own.iter_mut().zip(&touched) {
            tool.law = TipLaw::linear(tool.tip, tool.tip_friction, material.at_rest);
        }
        let warnings = stiffen(&mut own, &touched, on_progress)?;
        own.iter_mut()
            .for_each(|tool| self.regions.apply_to_tip(tool));
        self.laws = own.into_iter().map(|tool| tool.law).collect();
        Ok(warnings)
    }

    /// Whether a `place` of it [m] is fixed.
    pub(super) fn is_fixed(&self, place: &Vec3) -> bool {
        let place = match &self.location {
            Some(location) => back(location, place),
            None => *place,
        };
        self.anchor.contains(place.into())
    }
}

/// A piece of the body, for tools.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Its part of the displayed triangles.
    triangles: Range<u32>,
    /// Its tissues.
    pub(super) regions: Regions,
    /// Its typical thickness [m].
    pub(super) wall: f64,
    /// The force of its tissue on the tip of each tool; those of the tools themselves for the organ.
    laws: Vec<TipLaw>,
    /// For each tool, whether the piece bends around its tip instead of forming a dimple under it.
    pub(super) bends_around: Vec<bool>,
}

impl Piece {
    pub(super) fn all(
        surface: &Surface,
        regions: Regions,
        soft: &[SoftBody],
        tools: &[Tool],
    ) -> Vec<Self> {
        let mut first = 0;
        let mut piece = |surface: &Surface, regions: Regions, laws: &[TipLaw]| {
            let end = first + surface.mesh().triangles().len() as u32;
            let triangles = first..end;
            first = end;
            let wall = typical_wall(surface);
            Self {
                triangles,
                regions,
                laws: laws.to_vec(),
                bends_around: tools.iter().map(|tool| wraps(tool, wall)).collect(),
                wall,
            }
        };
        let mut all = vec![piece(surface, regions, &[])];
        all.extend(
            soft.iter()
                .map(|body| piece(&body.surface, body.regions.clone(), &body.laws)),
        );
        all
    }

    /// Its tissue at the surface, at rest.
    pub(super) fn law(&self) -> &LinearElastic {
        self.regions.at_rest()
    }

    /// The piece that has a displayed triangle.
    pub(super) fn with(pieces: &[Self], triangle: u32) -> usize {
        let found = pieces
            .iter()
            .position(|piece| piece.triangles.contains(&triangle));
        found.unwrap_or(0)
    }

    /// The force of its tissue on the tip of a tool.
    pub(super) fn tip_law<'a>(&'a self, number: usize, tool: &'a Tool) -> &'a TipLaw {
        self.laws.get(number).unwrap_or(&tool.law)
    }
}

/// Whether a `wall` of this thickness [m] bends around a tip: a ball that can slide and is wider than the wall. A tip
/// that always sticks counts as forming a dimple nevertheless.
fn wraps(tool: &Tool, wall: f64) -> bool {
    matches!(tool.tip, Tip::Sphere { radius } if tool.slides() && radius > wall)
}

/// The contact of the pieces with one another, of the sides of cuts with each other, and of the organ with itself with
/// this friction if it has any; none without any contact.
pub(super) fn touching(
    on_itself: Option<f64>,
    model: &NonlinearModel,
    merged: &Merged,
    soft: &[SoftBody],
) -> Result<Option<TouchingBoundary>, Error> {
    let own = |piece: usize| {
        piece
            .checked_sub(1)
            .map_or(0.0, |number| soft[number].friction)
    };
    let friction = |one: usize, other: usize| match one == other {
        true => on_itself.filter(|_| one == 0),
        false => Some(own(one).max(own(other))),
    };
    let in_slits = Some(on_itself.unwrap_or(0.0));
    Ok(TouchingBoundary::new(
        model,
        &merged.pieces,
        friction,
        in_slits,
    )?)
}
