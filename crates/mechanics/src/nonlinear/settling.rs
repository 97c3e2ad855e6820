//! A body at rest under its own weight and the pressures in its cavities.

use super::cavities::{Wall, WallLoad};
use super::constraints::Conditions;
use super::model::NonlinearModel;
use super::state::{CavityHistory, NonlinearState};
use super::step::{StepSettings, Workspace, advance};
use crate::Error;
use palpate_files::scene::CavityContent;

/// Loads come in so many parts, each in so many steps; then so many steps more at most, until a step moves no node by
/// more than a part of the body's size [-].
const PARTS: usize = 20;
const STEPS: usize = 2;
const MAX_STEPS: usize = 200;
const SETTLED: f64 = 1e-7;

/// Long enough for every tissue to have relaxed [s].
const LONG: f64 = 1e12;

impl NonlinearModel {
    /// The same body under the pressures in its cavities: its equilibrium after they have acted for long, with its tissues relaxed.
    /// A fluid has the volume at which it has its pressure while nothing else loads the body.
    ///
    /// # Errors
    /// When the body does not come to rest.
    pub fn under_pressure(self) -> Result<Self, Error> {
        let is_loaded = |wall: &Wall| {
            wall.content.own_pressure() != 0.0 || wall.filling.is_some_and(|filling| filling != 1.0)
        };
        match self.walls.iter().any(is_loaded) {
            true => self.settle(Vec::new()),
            false => Ok(self),
        }
    }

    /// The same at rest under the pressures and a `weight` on each node [N], if it has any.
    pub(super) fn settle(mut self, weight: Vec<f32>) -> Result<Self, Error> {
        let mut state = NonlinearState::at_rest(&self, 0);
        state.cavities.fill(CavityHistory::default());
        let mut workspace = self.workspace(0);
        let fills = |wall: &Wall| match (wall.content, wall.filling) {
            (CavityContent::Fluid(pressure), None) => Some(pressure).filter(|own| *own != 0.0),
            _ => None,
        };
        if self.walls.iter().any(|wall| fills(wall).is_some()) {
            // Nothing but the fluids loads the body.
            self.load(&mut state, &mut workspace, |model, part| {
                for wall in &mut model.walls {
                    wall.load = WallLoad::Pressure(part * fills(wall).unwrap_or(0.0));
                }
            })?;
            for number in 0..self.walls.len() {
                let volume = self.walls[number].volume(self.nodes(), &state.displacements);
                let wall = &mut self.walls[number];
                wall.filling = match wall.content {
                    CavityContent::Fluid(_) => Some(wall.filling.unwrap_or(volume / wall.at_rest)),
                    CavityContent::Pressure(_) => None,
                };
                state.cavities[number].set_pressure(fills(wall).unwrap_or(0.0));
            }
        }
        let volumes: Vec<f64> = self
            .walls
            .iter()
            .map(|wall| wall.volume(self.nodes(), &state.displacements))
            .collect();
        self.load(&mut state, &mut workspace, |model, part| {
            let of_weight = weight.iter().map(|force| part as f32 * force);
            model.weight = of_weight.collect();
            for (wall, from) in model.walls.iter_mut().zip(&volumes) {
                wall.load = match wall.content {
                    CavityContent::Pressure(pressure) => WallLoad::Pressure(part * pressure),
                    CavityContent::Fluid(_) => {
                        let target = wall.filling.unwrap_or(1.0) * wall.at_rest;
                        WallLoad::Volume(from + part * (target - from))
                    }
                };
            }
        })?;
        for (own, wall) in state.cavities.iter_mut().zip(&self.walls) {
            if let WallLoad::Pressure(pressure) = wall.load {
                own.set_pressure(pressure);
            }
        }
        state.stop();
        self.settled = Some(Box::new(state));
        Ok(self)
    }

    /// Loads it part by part, and steps until it is at rest.
    fn load(
        &mut self,
        state: &mut NonlinearState,
        workspace: &mut Workspace,
        at_part: impl Fn(&mut Self, f64),
    ) -> Result<(), Error> {
        let pace = StepSettings {
            iterations: 40,
            elapsed: LONG,
        };
        let first = self.nodes()[0];
        let size = self.nodes().iter().map(|node| (node - first).norm());
        let farthest = SETTLED * size.fold(0.0, f64::max);
        for step in 1..=PARTS * STEPS + MAX_STEPS {
            at_part(self, (step.div_ceil(STEPS) as f64 / PARTS as f64).min(1.0));
            let ended = advance(self, Conditions::of_tools(&[]), pace, state, workspace);
            if ended.was_reset {
                break;
            }
            if step > PARTS * STEPS && state.last_motion() < farthest {
                return Ok(());
            }
        }
        Err(Error::InvalidResponse {
            fault: "it does not come to rest under its own weight and the pressures in it",
        })
    }
}
