//! The mechanics of the cuts: the path of the blades over the displayed surface as facets of a slit in the mechanical
//! one, whose faces are free of traction.
//!
//! A facet covers the parts of the path that make up its length; the rest of a completed cut becomes a shorter one. The
//! facets alone define the slit, so that an undone cut leaves no trace.
//!
//! *How we know*: `slit::…` of `mechanics`; `cut_mechanics::…`.
//!
//! *Limits*: the contact determines its side of a slit from its position at rest; cuts beyond [`MOST`] facets are
//! displayed but do not change the forces, with a warning.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::surface_response::slit::{
    CutBody, DiscForce, Slit, SlitFacet, SlitJumps, SlitLoad,
};
use palpate_mechanics::surface_response::{Share, SurfaceResponse};

use super::{GlobalModel, GlobalWorkspace};
use crate::cutting::{CutPart, Cuts, CuttingModel};
use crate::grip::{GraspedTriangle, MAX_PARTS};
use crate::simulation::Simulation;
use crate::state::ToolState;

/// Facets of all cuts.
const MOST: usize = 96;

/// Length of a facet over the depth of the cut [-], and at least [m]: its effect on a tip next to it is a sum over
/// facets.
const OF_THE_DEPTH: f64 = 0.5;
const SHORTEST: f64 = 1.2e-3;

/// Least length of the rest of a cut, in parts of a facet's length [-].
const A_REST: f64 = 0.3;

/// The parts of a cut that a facet covers, from the first up to the one before `end`, and the number of open layers in
/// all of them.
#[derive(Debug, Clone, Copy)]
struct Source {
    first: usize,
    end: usize,
    layers: usize,
}

impl Source {
    /// Whether the parts are unchanged.
    fn is_in(&self, parts: &[CutPart]) -> bool {
        let own = parts.get(self.first..self.end);
        own.is_some_and(|own| own.iter().all(|part| part.in_mechanics == self.layers))
    }
}

/// The slit with its response to forces. It is rebuilt from the cuts if it is lost.
#[derive(Debug)]
pub(crate) struct OrganSlit {
    slit: Slit,
    /// The parts of each facet.
    sources: Vec<Source>,
    /// Number of processed parts of the path, whether they became a facet or not.
    taken: usize,
    /// Total length of the facets that could not be made [m].
    unfelt: f64,
    /// Changes whenever the facets change.
    pub(super) version: u64,
    /// Response to the force of each tool's tip.
    tips: Vec<SlitLoad>,
    /// Response to the force on each held part.
    parts: Vec<SlitLoad>,
    scratch: SlitLoad,
    jumps: SlitJumps,
}

impl OrganSlit {
    /// An empty slit, in an organ that this number of tools may touch.
    pub(super) fn new(response: &SurfaceResponse, tools: usize) -> Self {
        let slit = Slit::new(response, MOST);
        let loads = |count: usize| (0..count).map(|_| slit.load()).collect();
        Self {
            tips: loads(tools),
            parts: loads(tools * MAX_PARTS),
            scratch: slit.load(),
            jumps: slit.jumps(),
            slit,
            sources: Vec::with_capacity(MOST),
            taken: 0,
            unfelt: 0.0,
            version: 0,
        }
    }

    /// Updates to the current cuts.
    fn follow(&mut self, global: &GlobalModel, model: &CuttingModel, cuts: &Cuts) {
        let path = cuts.parts();
        let kept = self.sources.iter().take_while(|source| source.is_in(path));
        let kept = kept.count();
        if kept < self.sources.len() {
            self.sources.truncate(kept);
            self.slit.truncate(kept);
            self.taken = self.sources.last().map_or(0, |source| source.end);
            self.unfelt = 0.0;
            self.version += 1;
        }
        if path.len() < self.taken {
            self.taken = path.len();
            self.unfelt = 0.0;
        }
        while let Some(part) = path.get(self.taken) {
            let wanted = (OF_THE_DEPTH * model.depth_of(part.in_mechanics)).max(SHORTEST);
            let Some(next) = next(path, self.taken, cuts.is_in_progress(), wanted) else {
                break;
            };
            let first = std::mem::replace(&mut self.taken, next.end);
            if next.is_facet {
                self.open(global, model, &path[first..next.end], wanted);
            }
        }
    }

    /// Makes facets of about the `wanted` length [m] from a straight part of the path.
    fn open(&mut self, global: &GlobalModel, model: &CuttingModel, parts: &[CutPart], wanted: f64) {
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else {
            return;
        };
        let start = first.ends[0];
        let whole = last.ends[1] - start;
        let count = (whole.norm() / wanted).round().max(1.0);
        let body = CutBody {
            surface: global.enhancement.interpolation().surface(),
            tree: &global.tree,
            response: &global.response,
        };
        for number in 0..count as u32 {
            let facet = SlitFacet {
                middle: start + whole * ((f64::from(number) + 0.5) / count),
                along: whole,
                normal: parts.iter().map(|part| part.normal).sum(),
                length: whole.norm() / count,
                depth: model.depth_of(first.in_mechanics),
            };
            // An impossible facet (no capacity, on an edge of the organ) leaves the stiffness unchanged.
            if self.slit.open(&body, &facet).is_ok() {
                self.sources.push(Source {
                    first: self.taken - parts.len(),
                    end: self.taken,
                    layers: first.in_mechanics,
                });
                self.version += 1;
            } else {
                self.unfelt += facet.length;
            }
        }
    }

    /// Applies the forces of the tips to the slit.
    pub(super) fn put_tips(
        &mut self,
        global: &GlobalModel,
        simulation: &Simulation,
        tools: &[ToolState],
    ) {
        let each = simulation.tools.iter().zip(tools).zip(&mut self.tips);
        for ((tool, state), load) in each {
            let on = global.load(tool, state);
            let spot = state.contact.map(|contact| DiscForce {
                place: contact.point(),
                normal: contact.rest_normal(),
                radius: tool.typical_radius,
            });
            let shares = on.iter().flat_map(|on| on.shares());
            self.slit.put(&global.response, shares, spot.as_ref(), load);
        }
    }

    /// Applies a force on held part `number`.
    pub(super) fn put_part(
        &mut self,
        response: &SurfaceResponse,
        number: usize,
        part: &[GraspedTriangle],
    ) {
        let load = &mut self.parts[number];
        self.slit.put(response, shares(part), None, load);
    }

    /// Its addition to the self-compliance of a tip, times E [1/m].
    pub(super) fn further(&self, tip: usize) -> Matrix3<f64> {
        self.slit.added_compliance(&self.tips[tip])
    }

    /// Its addition to the compliance between two tips, times E [1/m].
    pub(super) fn between_tips(&self, moved: usize, loaded: usize) -> Matrix3<f64> {
        self.slit.between(&self.tips[moved], &self.tips[loaded])
    }

    /// Its addition to the compliance of a held part to another, or to itself, times E [1/m].
    pub(super) fn between_parts(&self, moved: usize, loaded: usize) -> Matrix3<f64> {
        self.slit.between(&self.parts[moved], &self.parts[loaded])
    }

    /// Its addition to the compliance between a held part and a tip, times E [1/m].
    pub(super) fn part_by_tip(&self, part: usize, tip: usize) -> Matrix3<f64> {
        self.slit.between(&self.parts[part], &self.tips[tip])
    }

    /// Its addition to the displacement, times E [N/m], of a part under forces [N] on tips.
    pub(super) fn carry(
        &mut self,
        response: &SurfaceResponse,
        part: &[GraspedTriangle],
        forces: impl Iterator<Item = (usize, Vec3)>,
    ) -> Vec3 {
        self.slit
            .put(response, shares(part), None, &mut self.scratch);
        let on = &self.scratch;
        let by = forces.map(|(tip, force)| self.slit.between(on, &self.tips[tip]) * force);
        by.sum()
    }

    /// Adds to `field` its displacement under forces over E [m²] on tips and on held parts.
    pub(super) fn add_field(
        &mut self,
        forces: (
            impl Iterator<Item = (usize, Vec3)>,
            impl Iterator<Item = (usize, Vec3)>,
        ),
        field: &mut [f32],
    ) {
        let (tips, parts) = (&self.tips, &self.parts);
        let on_tips = forces.0.map(|(tip, force)| (&tips[tip], force));
        let on_parts = forces.1.map(|(part, force)| (&parts[part], force));
        self.slit.jump(on_tips.chain(on_parts), &mut self.jumps);
        self.slit.add_field(&self.jumps, field);
    }
}

impl GlobalModel {
    /// Updates to the cuts of an organ.
    pub(crate) fn follow_cuts(
        &self,
        model: &CuttingModel,
        cuts: &Cuts,
        workspace: &mut GlobalWorkspace,
    ) {
        if let Some(slit) = &mut workspace.slit {
            slit.follow(self, model, cuts);
        }
    }
}

impl GlobalWorkspace {
    /// Warnings about the forces of cuts, as sentences.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let Some(own) = &self.slit else {
            return Vec::new();
        };
        let mut warnings = own.slit.warnings();
        if own.unfelt > 0.0 {
            warnings.push(format!(
                "{:.0} mm of the cuts are seen and do not change the force: the model has room for {MOST} pieces of {:.1} mm \
                 or half of the depth, and for none on an edge of the organ",
                1e3 * own.unfelt,
                1e3 * SHORTEST
            ));
        }
        warnings
    }
}

fn shares(part: &[GraspedTriangle]) -> impl Iterator<Item = Share> {
    part.iter().map(|one| Share {
        triangle: one.touch,
        weight: one.weight,
    })
}

/// The next section of the path.
struct Next {
    end: usize,
    is_facet: bool,
}

/// The parts of `path` after `taken` that form the next facet, if they are enough, or their cut has ended or changes its
/// depth.
fn next(path: &[CutPart], taken: usize, goes_on: bool, wanted: f64) -> Option<Next> {
    let first = path.get(taken)?;
    let differs = |part: &CutPart| part.begins || part.in_mechanics != first.in_mechanics;
    let later = path[taken + 1..].iter().position(differs);
    let last = later.map_or(path.len(), |later| taken + 1 + later);
    for end in taken + 1..=last {
        if (path[end - 1].ends[1] - first.ends[0]).norm() >= wanted {
            return Some(Next {
                end,
                is_facet: true,
            });
        }
    }
    let rest = (path[last - 1].ends[1] - first.ends[0]).norm();
    let ended = later.is_some() || !goes_on;
    ended.then_some(Next {
        end: last,
        is_facet: rest >= A_REST * wanted,
    })
}
