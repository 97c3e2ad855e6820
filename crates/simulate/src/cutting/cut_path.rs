use palpate_files::session::{Event, Events};
use palpate_geometry::{ContactPoint, Vec3};

use super::CuttingModel;
use super::cuts::{CutPath, Cuts, Deepened, Mark};
use super::model::cuts;
use super::parts::{CutPart, opening_at};
use crate::Contact;
use crate::simulation::Simulation;
use crate::state::SimulationState;

/// A blade that is farther from its goal than this many typical edges of the surface has left it [-].
const LEFT: f64 = 3.0;

/// A blade that is farther from its position a step before [m] was lifted in between: no hand is that fast.
const LEAP: f64 = 5e-3;

/// A blade that opens the surface continues in an earlier opening once it is this close to its middle, and one that
/// moves within an opening begins another one once it is this far from its middle, in widths of an opening [-]: between
/// the two it does not change, so that a path along the edge is not a row of punctures.
const ENTERS: f64 = 0.5;
pub(super) const LEAVES: f64 = 1.5;

/// Opens tissue by the force of a tool, and moves its blade. Called after the forces are known.
pub(crate) fn advance(
    simulation: &Simulation,
    model: &CuttingModel,
    number: usize,
    state: &mut SimulationState,
) {
    let Some(all) = &mut state.cuts else {
        return;
    };
    let (tool, own) = (&simulation.tools[number], &mut state.tools[number]);
    own.cut_lag = 0;
    let Some(contact) = own.contact else {
        own.broken_layers = 0;
        own.perforates = false;
        all.lift(simulation, number);
        return;
    };
    let reach = 0.5 * model.width + tool.typical_radius;
    let under = all.part_near(&contact.point(), reach);
    let bare = under.map_or(0, |part| all.parts[part].layers);
    let pressed = own.force_of_organ().dot(&contact.normal());
    let limit = model.layers.get(bare).and_then(|layer| layer.limit);
    let gives_way = limit.is_some_and(|limit| pressed > limit);
    if gives_way {
        own.broken_layers = own.broken_layers.max(bare + 1);
    }
    let Some(blade) = own.blade else {
        all.lift(simulation, number);
        return;
    };
    let by_hand = cuts(tool.kind) && own.pose.is_some_and(|pose| pose.cut);
    let reached = if by_hand {
        model.reached(contact.depth)
    } else {
        0
    };
    let edge = Edge {
        tool: number,
        contact_point: blade.contact_point,
        contact,
        layers: reached.max(own.broken_layers),
    };
    let mut opened = all.go_on(simulation, model, &edge);
    // Under pressure the tissue gives way under the whole tip, a cut only in its opening.
    let under = under.filter(|_| gives_way);
    let below = opening_at(&all.parts, &blade.contact_point.point, LEAVES * model.width);
    for part in [under, below].into_iter().flatten() {
        opened.events = opened.events | all.deepen(model, part, edge.layers);
    }
    own.cut_lag = opened.lag;
    if opened.events.contains(Event::Perforation) && own.perforates {
        opened.events.remove(Event::Perforation);
    }
    own.perforates |= opened.events.contains(Event::Perforation);
    own.row.events = own.row.events | opened.events;
}

/// The edge of a cutting tool.
struct Edge {
    tool: usize,
    /// Its point on the resting surface.
    contact_point: ContactPoint,
    contact: Contact,
    /// Number of layers that it opens there.
    layers: usize,
}

/// The openings of a step.
#[derive(Debug, Clone, Copy, Default)]
struct Opened {
    events: Events,
    lag: usize,
}

/// The events for opening the layers from `open` up to `layers`.
fn events(model: &CuttingModel, open: usize, layers: usize) -> Events {
    if !model.is_layered {
        return Event::Cut.into();
    }
    let opened = Event::OPENS_LAYER.into_iter().take(layers).skip(open);
    let mut events: Events = opened.chain([Event::Cut]).collect();
    if layers == model.layers.len() && open < layers {
        events.insert(Event::Perforation);
    }
    events
}

impl Cuts {
    /// Moves the blade of a tool to its `edge`, or puts it down there.
    fn go_on(&mut self, simulation: &Simulation, model: &CuttingModel, edge: &Edge) -> Opened {
        if edge.layers == 0 {
            // The blade scratches.
            self.lift(simulation, edge.tool);
            return Opened::default();
        }
        let at = edge.contact_point.point;
        let leaps = |cut_path: CutPath| (at - cut_path.blade).norm() > LEAP;
        if self
            .cut_path
            .is_some_and(|cut_path| cut_path.tool == edge.tool && leaps(cut_path))
        {
            self.lift(simulation, edge.tool);
        }
        let Some(cut_path) = self.cut_path else {
            return self.put_down(simulation, model, edge);
        };
        if cut_path.tool != edge.tool {
            return Opened::default();
        }
        if !cut_path.opens {
            return self.leave_opening(simulation, model, edge);
        }
        let earlier = &self.parts[..cut_path.before.parts];
        if model.is_layered && opening_at(earlier, &at, ENTERS * model.width).is_some() {
            self.enter_opening(simulation, at);
            return Opened::default();
        }
        let vertices = self.surface.mesh().vertices().len();
        let Ok(progress) = self.surface.advance(&simulation.surface, &at) else {
            return Opened::default();
        };
        self.set_blade(at);
        self.largest_lag = self.largest_lag.max(progress.lag);
        // A vertex may have to wait until its edge is open.
        if progress.opened > 0 || self.surface.mesh().vertices().len() != vertices {
            self.version += 1;
        }
        let mut opened = Opened {
            events: Events::NONE,
            lag: progress.lag,
        };
        if progress.opened > 0 {
            self.extend(cut_path, edge);
            opened.events = events(model, 0, edge.layers);
        }
        if progress.away > LEFT * simulation.typical_edge {
            self.lift(simulation, edge.tool);
        }
        opened
    }

    /// Stops opening the surface where an earlier cut has opened it.
    fn enter_opening(&mut self, simulation: &Simulation, at: Vec3) {
        self.surface.end(&simulation.surface).ok();
        self.version += 1;
        if let Some(cut_path) = &mut self.cut_path {
            cut_path.opens = false;
            cut_path.blade = at;
        }
    }

    fn set_blade(&mut self, at: Vec3) {
        if let Some(cut_path) = &mut self.cut_path {
            cut_path.blade = at;
        }
    }

    fn put_down(&mut self, simulation: &Simulation, model: &CuttingModel, edge: &Edge) -> Opened {
        let at = edge.contact_point.point;
        self.cut_path = Some(CutPath {
            tool: edge.tool,
            at,
            blade: at,
            opens: false,
            before: Mark {
                parts: self.parts.len(),
                deepened: self.deepened.len(),
                surface: self.surface.cuts(),
            },
        });
        self.leave_opening(simulation, model, edge)
    }

    /// Moves within an opening, and begins to open the surface where that ends.
    fn leave_opening(
        &mut self,
        simulation: &Simulation,
        model: &CuttingModel,
        edge: &Edge,
    ) -> Opened {
        let at = edge.contact_point.point;
        self.set_blade(at);
        if model.is_layered && opening_at(&self.parts, &at, LEAVES * model.width).is_some() {
            return Opened::default();
        }
        let begun = self
            .surface
            .begin(&simulation.surface, edge.contact_point.triangle, &at);
        let Some(cut_path) = self.cut_path.as_mut().filter(|_| begun.is_ok()) else {
            self.lift(simulation, edge.tool);
            return Opened::default();
        };
        cut_path.opens = true;
        cut_path.at = at;
        // A triangle may have been split.
        self.version += 1;
        let mut opened = Opened::default();
        if model.is_layered {
            // It enters the tissue before it moves along.
            let cut_path = *cut_path;
            self.extend(cut_path, edge);
            opened.events = events(model, 0, edge.layers);
        }
        opened
    }

    /// Adds a part from the last point of `stroke`.
    fn extend(&mut self, cut_path: CutPath, edge: &Edge) {
        let at = edge.contact_point.point;
        let before = self.parts[cut_path.before.parts.min(self.parts.len())..].last();
        let begins = before.is_none_or(|part| part.ends[1] != cut_path.at);
        self.parts.push(CutPart {
            ends: [cut_path.at, at],
            normal: edge.contact.rest_normal(),
            begins,
            layers: edge.layers,
            in_mechanics: edge.layers,
        });
        // Each part can be deepened once per closed layer.
        let room = Event::OPENS_LAYER.len() * self.parts.len();
        self.deepened
            .reserve(room.saturating_sub(self.deepened.len()));
        if let Some(cut_path) = &mut self.cut_path {
            cut_path.at = at;
        }
    }

    /// Opens a part of a cut down to `layers`, as part of the cut in progress.
    fn deepen(&mut self, model: &CuttingModel, part: usize, layers: usize) -> Events {
        let before = self.parts[part].layers;
        if !model.is_layered || self.cut_path.is_none() || before >= layers {
            return Events::NONE;
        }
        self.parts[part].layers = layers;
        self.deepened.push(Deepened { part, before });
        events(model, before, layers)
    }

    /// Ends the cut of a tool, if it makes one.
    fn lift(&mut self, simulation: &Simulation, tool: usize) {
        let Some(cut_path) = self.cut_path.filter(|cut_path| cut_path.tool == tool) else {
            return;
        };
        self.cut_path = None;
        let before = cut_path.before;
        let is_deeper = self.deepened.len() > before.deepened;
        self.version += u64::from(cut_path.opens || is_deeper);
        if cut_path.opens {
            // A blade that has opened nothing leaves the surface unchanged, and a puncture of its layers.
            self.surface.end(&simulation.surface).ok();
        }
        for part in &mut self.parts {
            part.in_mechanics = part.layers;
        }
        let has_opened =
            self.parts.len() > before.parts || is_deeper || self.surface.cuts() > before.surface;
        if has_opened {
            self.before.push(before);
        }
    }
}
