//! The mechanics of the cuts: the way of the blades over the shown surface as facets of a slit in the mechanical
//! one, whose faces bear no traction.
//!
//! A facet takes the parts of the way that make up its length; what is left of a cut that has ended becomes a
//! shorter one. The slit is what it is by its facets alone, so that an undone cut leaves nothing.
//!
//! *How we know*: `slit::…` of `mechanics`; `cut_mechanics::…`.
//!
//! *Limits*: the contact tells its side of a slit by its place at rest; a cut beyond [`MOST`] facets is seen and
//! no longer felt, with a warning.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::surface_response::slit::{
    CutBody, Slit, SlitFacet, SlitJumps, SlitLoad, Spot,
};
use palpate_mechanics::surface_response::{Share, SurfaceResponse};

use super::{GlobalModel, GlobalWorkspace};
use crate::cutting::{CutPart, Cuts, CuttingModel};
use crate::grip::{HeldTriangle, MOST_PARTS};
use crate::simulation::Simulation;
use crate::state::ToolState;

/// Facets of all cuts.
const MOST: usize = 96;

/// Length of a facet over the depth of the cut [-], and at least [m]: what a tip beside it feels is summed over
/// facets.
const OF_THE_DEPTH: f64 = 0.5;
const SHORTEST: f64 = 1.2e-3;

/// What is left of a cut has to be this part of a facet's length [-] to be one.
const A_REST: f64 = 0.3;

/// The parts of a cut that a facet is of, from the first up to the one before `end`, and the layers that were open
/// in all of them.
#[derive(Debug, Clone, Copy)]
struct Source {
    first: usize,
    end: usize,
    layers: usize,
}

impl Source {
    /// Whether the parts still are what they were.
    fn is_in(&self, parts: &[CutPart]) -> bool {
        let own = parts.get(self.first..self.end);
        own.is_some_and(|own| own.iter().all(|part| part.felt == self.layers))
    }
}

/// The slit with what forces do to it. It is made again of the cuts where it is lost.
#[derive(Debug)]
pub(crate) struct OrganSlit {
    slit: Slit,
    /// Of which parts each facet is.
    sources: Vec<Source>,
    /// Parts of the way that were taken, whether they became a facet or not.
    taken: usize,
    /// Length of the facets that could not be [m].
    unfelt: f64,
    /// Another number whenever the facets are others.
    pub(super) version: u64,
    /// Of the force of each tool's tip.
    tips: Vec<SlitLoad>,
    /// Of the force on each part of what jaws hold.
    parts: Vec<SlitLoad>,
    scratch: SlitLoad,
    jumps: SlitJumps,
}

impl OrganSlit {
    /// None yet, in an organ that so many tools touch.
    pub(super) fn new(response: &SurfaceResponse, tools: usize) -> Self {
        let slit = Slit::new(response, MOST);
        let loads = |count: usize| (0..count).map(|_| slit.load()).collect();
        Self {
            tips: loads(tools),
            parts: loads(tools * MOST_PARTS),
            scratch: slit.load(),
            jumps: slit.jumps(),
            slit,
            sources: Vec::with_capacity(MOST),
            taken: 0,
            unfelt: 0.0,
            version: 0,
        }
    }

    /// Follows the cuts as they are now.
    fn follow(&mut self, global: &GlobalModel, model: &CuttingModel, cuts: &Cuts) {
        let way = cuts.parts();
        let kept = self.sources.iter().take_while(|source| source.is_in(way));
        let kept = kept.count();
        if kept < self.sources.len() {
            self.sources.truncate(kept);
            self.slit.truncate(kept);
            self.taken = self.sources.last().map_or(0, |source| source.end);
            self.unfelt = 0.0;
            self.version += 1;
        }
        if way.len() < self.taken {
            self.taken = way.len();
            self.unfelt = 0.0;
        }
        while let Some(part) = way.get(self.taken) {
            let wanted = (OF_THE_DEPTH * model.depth_of(part.felt)).max(SHORTEST);
            let Some(next) = next(way, self.taken, cuts.goes_on(), wanted) else {
                break;
            };
            let first = std::mem::replace(&mut self.taken, next.end);
            if next.is_facet {
                self.open(global, model, &way[first..next.end], wanted);
            }
        }
    }

    /// Makes facets of about the `wanted` length [m] of a straight part of the way.
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
                depth: model.depth_of(first.felt),
            };
            // One that cannot be (no room, on an edge of the organ) leaves the organ as stiff as it was.
            if self.slit.open(&body, &facet).is_ok() {
                self.sources.push(Source {
                    first: self.taken - parts.len(),
                    end: self.taken,
                    layers: first.felt,
                });
                self.version += 1;
            } else {
                self.unfelt += facet.length;
            }
        }
    }

    /// Puts the forces of the tips on the slit.
    pub(super) fn put_tips(
        &mut self,
        global: &GlobalModel,
        simulation: &Simulation,
        tools: &[ToolState],
    ) {
        let each = simulation.tools.iter().zip(tools).zip(&mut self.tips);
        for ((tool, state), load) in each {
            let on = global.load(tool, state);
            let spot = state.contact.map(|contact| Spot {
                place: contact.point(),
                normal: contact.rest_normal(),
                radius: tool.typical_radius,
            });
            let shares = on.iter().flat_map(|on| on.shares());
            self.slit.put(&global.response, shares, spot.as_ref(), load);
        }
    }

    /// Puts a force on part `number` of what jaws hold.
    pub(super) fn put_part(
        &mut self,
        response: &SurfaceResponse,
        number: usize,
        part: &[HeldTriangle],
    ) {
        let load = &mut self.parts[number];
        self.slit.put(response, shares(part), None, load);
    }

    /// What it adds to how a tip yields to itself, times E [1/m].
    pub(super) fn further(&self, tip: usize) -> Matrix3<f64> {
        self.slit.further(&self.tips[tip])
    }

    /// What it adds to how a tip yields to another, times E [1/m].
    pub(super) fn between_tips(&self, moved: usize, loaded: usize) -> Matrix3<f64> {
        self.slit.between(&self.tips[moved], &self.tips[loaded])
    }

    /// What it adds to how a held part yields to another, or to itself, times E [1/m].
    pub(super) fn between_parts(&self, moved: usize, loaded: usize) -> Matrix3<f64> {
        self.slit.between(&self.parts[moved], &self.parts[loaded])
    }

    /// What it adds to how a held part yields to a tip, times E [1/m].
    pub(super) fn part_by_tip(&self, part: usize, tip: usize) -> Matrix3<f64> {
        self.slit.between(&self.parts[part], &self.tips[tip])
    }

    /// What it adds to the displacement, times E [N/m], of a part under forces [N] on tips.
    pub(super) fn carry(
        &mut self,
        response: &SurfaceResponse,
        part: &[HeldTriangle],
        forces: impl Iterator<Item = (usize, Vec3)>,
    ) -> Vec3 {
        self.slit
            .put(response, shares(part), None, &mut self.scratch);
        let on = &self.scratch;
        let by = forces.map(|(tip, force)| self.slit.between(on, &self.tips[tip]) * force);
        by.sum()
    }

    /// Adds to `field` what it does under forces over E [m²] on tips and on held parts.
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
    /// Follows the cuts of an organ.
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
    /// What to be careful about in the forces of cuts, as sentences.
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

fn shares(part: &[HeldTriangle]) -> impl Iterator<Item = Share> {
    part.iter().map(|one| Share {
        triangle: one.touch,
        weight: one.weight,
    })
}

/// What the way becomes next.
struct Next {
    end: usize,
    is_facet: bool,
}

/// The parts of `way` after `taken` that are the next facet, if they are enough or their cut has ended or becomes
/// deeper or less deep.
fn next(way: &[CutPart], taken: usize, goes_on: bool, wanted: f64) -> Option<Next> {
    let first = way.get(taken)?;
    let differs = |part: &CutPart| part.begins || part.felt != first.felt;
    let later = way[taken + 1..].iter().position(differs);
    let last = later.map_or(way.len(), |later| taken + 1 + later);
    for end in taken + 1..=last {
        if (way[end - 1].ends[1] - first.ends[0]).norm() >= wanted {
            return Some(Next {
                end,
                is_facet: true,
            });
        }
    }
    let rest = (way[last - 1].ends[1] - first.ends[0]).norm();
    let ended = later.is_some() || !goes_on;
    ended.then_some(Next {
        end: last,
        is_facet: rest >= A_REST * wanted,
    })
}
