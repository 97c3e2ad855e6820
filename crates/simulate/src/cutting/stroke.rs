use palpate_files::session::Event;
use palpate_geometry::{Footing, Vec3};

use super::CuttingModel;
use super::cuts::{CutSegment, Cuts, Stroke};
use crate::Contact;
use crate::simulation::Simulation;
use crate::state::SimulationState;

/// A blade that is farther from its goal than this many of the surface's typical edges has left it [-].
const LEFT: f64 = 3.0;

/// A blade that is farther from where it was a step before [m] was lifted in between: no hand is that fast.
const LEAP: f64 = 5e-3;

/// What the force of a tool opens, and what its blade does. Called when the forces are known.
pub(crate) fn advance(
    simulation: &Simulation,
    model: &CuttingModel,
    number: usize,
    state: &mut SimulationState,
) {
    let Some(cuts) = &mut state.cuts else {
        return;
    };
    let (tool, own) = (&simulation.tools[number], &mut state.tools[number]);
    own.cut_lag = 0;
    let Some(contact) = own.contact else {
        own.breaks_through = false;
        own.perforates = false;
        cuts.lift(simulation, number);
        return;
    };
    let pressed = own.force.dot(&contact.normal());
    let reach = 0.5 * model.width + tool.typical_radius;
    let is_bare = model.is_bare || cuts.expose(&contact.point(), reach);
    let passed = |limit: Option<f64>| limit.is_some_and(|limit| pressed > limit);
    if is_bare && passed(model.perforation) && !own.perforates {
        own.perforates = true;
        own.row.events.insert(Event::Perforation);
    }
    own.breaks_through |= !is_bare && passed(model.force_limit);
    let Some(blade) = own.blade else {
        cuts.lift(simulation, number);
        return;
    };
    let opened = cuts.go_on(simulation, number, &blade.footing, &contact);
    own.cut_lag = opened.lag;
    if opened.edges > 0 {
        own.row.events.insert(Event::Cut);
    }
}

/// What a step has opened.
#[derive(Debug, Clone, Copy, Default)]
struct Opened {
    edges: usize,
    lag: usize,
}

impl Cuts {
    /// Moves the blade of a tool to `footing`, or puts it down there.
    fn go_on(
        &mut self,
        simulation: &Simulation,
        tool: usize,
        footing: &Footing,
        contact: &Contact,
    ) -> Opened {
        let Some(stroke) = self.stroke else {
            self.put_down(simulation, tool, footing);
            return Opened::default();
        };
        if stroke.tool != tool {
            return Opened::default();
        }
        if (footing.point - stroke.blade).norm() > LEAP {
            self.lift(simulation, tool);
            self.put_down(simulation, tool, footing);
            return Opened::default();
        }
        let vertices = self.surface.mesh().vertices().len();
        let Ok(progress) = self.surface.advance(&simulation.surface, &footing.point) else {
            return Opened::default();
        };
        if let Some(stroke) = &mut self.stroke {
            stroke.blade = footing.point;
        }
        self.largest_lag = self.largest_lag.max(progress.lag);
        // A vertex may wait for its edge to be opened.
        if progress.opened > 0 || self.surface.mesh().vertices().len() != vertices {
            self.version += 1;
        }
        if progress.opened > 0 {
            self.go_to(&footing.point, &contact.normal());
        }
        if progress.away > LEFT * simulation.typical_edge {
            self.lift(simulation, tool);
        }
        Opened {
            edges: progress.opened,
            lag: progress.lag,
        }
    }

    fn put_down(&mut self, simulation: &Simulation, tool: usize, footing: &Footing) {
        let begun = self
            .surface
            .begin(&simulation.surface, footing.triangle, &footing.point);
        if begun.is_ok() {
            // A triangle may have been split.
            self.version += 1;
            self.stroke = Some(Stroke {
                tool,
                at: footing.point,
                blade: footing.point,
                before: self.way.len(),
            });
        }
    }

    fn go_to(&mut self, place: &Vec3, normal: &Vec3) {
        if let Some(stroke) = &mut self.stroke {
            self.way.push(CutSegment {
                ends: [stroke.at, *place],
                normal: *normal,
            });
            stroke.at = *place;
        }
    }

    /// Ends the cut of a tool, if it makes one.
    fn lift(&mut self, simulation: &Simulation, tool: usize) {
        let Some(stroke) = self.stroke.filter(|stroke| stroke.tool == tool) else {
            return;
        };
        self.stroke = None;
        self.version += 1;
        let opened = self.surface.end(&simulation.surface).unwrap_or(0);
        if opened == 0 {
            self.way.truncate(stroke.before);
        } else {
            self.before.push(stroke.before);
        }
    }
}
