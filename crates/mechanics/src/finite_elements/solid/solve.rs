//! Equilibrium of a supported solid: one linear solution, or as many steps as it takes.
//!
//! A linear system whose matrix carries the small pressure block of `assembly` is solved with one
//! factor: the true residual goes through it again until it is gone.

use std::ops::ControlFlow;

use super::super::continuation::{Increments, Reached, Steps, continue_to, extrapolated};
use super::super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::super::newton::{self, Failure, SolverControls, correct};
use super::super::rigid_tool::{Contacts, ToolLoad};
use super::super::supports::Supports;
use super::frame::Conditions;
use crate::{Error, Strain};

/// Free residual over that of the reactions [-].
const TOLERANCE: f64 = 1e-9;
const MAX_SOLUTIONS: usize = 4;

/// Steps of the loads and of each part of the tools' paths [-].
const STEPS: Steps = Steps {
    next: 0.25,
    longest: 1.0,
    shortest: 1e-3,
    easy: 5,
    hard: usize::MAX,
};

/// The same while tools move. Slip depends on the path, and backward differences of it have an error of the first power of the
/// step.
const TOOL_STEPS: Steps = Steps {
    next: 0.5,
    longest: 1.0,
    shortest: 1e-3,
    easy: 20,
    hard: 60,
};

/// Contact is found when a further augmentation would change its forces by this part of them [-].
const CONTACT_TOLERANCE: f64 = 1e-5;
const MAX_AUGMENTATIONS: usize = 40;

/// Tolerance of an equilibrium that a further augmentation changes, in the last change of the forces in contact [-].
const TOLERANCE_IN_CHANGE: f64 = 1e-3;

/// After so many of them what faces a tool stays the same.
const FACED: usize = 1;

/// A solid in equilibrium.
pub(super) struct Solved<'a> {
    pub(super) state: FiniteElementState,
    /// Contacts at the end of the tools' paths.
    pub(super) contacts: Option<Contacts<'a>>,
    /// Force on each tool at each step.
    pub(super) increments: Vec<ToolIncrement>,
}

/// Forces on the tools at a place of their paths.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolIncrement {
    /// Parts of their paths done [-].
    pub along: f64,
    /// Of each tool.
    pub loads: Vec<ToolLoad>,
}

/// Brings a body from rest to the full displacement of the patch and the full loads, and then along the paths of tools;
/// `at_part` receives the part done [-].
pub(super) fn equilibrium<'a>(
    model: &FiniteElementModel,
    conditions: &Conditions<'_>,
    contacts: Option<Contacts<'a>>,
    workspace: &mut FiniteElementWorkspace,
    at_part: &mut dyn FnMut(f64),
) -> Result<Solved<'a>, Error> {
    let mut state = FiniteElementState::at_rest(model);
    if model.law.volume().strain == Strain::Small && contacts.is_none() {
        let supports = conditions.supports(model, 1.0);
        linear(model, &supports, &mut state, workspace)
            .map_err(|failure| Error::NoSolid { part: 0.0, failure })?;
        at_part(1.0);
        return Ok(Solved {
            state,
            contacts: None,
            increments: Vec::new(),
        });
    }
    let parts = contacts.as_ref().map_or(0, Contacts::parts);
    let whole = 1.0 + parts as f64;
    let mut run = SolidRun {
        model,
        conditions,
        workspace,
        reached: 0.0,
        state,
        contacts,
        before: None,
    };
    if let Some(contacts) = &mut run.contacts {
        contacts.close_increment(model, &run.state.unknowns);
    }
    let mut increments = Vec::new();
    let mut steps = STEPS;
    let first = usize::from(!conditions.move_or_load());
    run.reached = first as f64;
    for part in first..=parts {
        if part > 0 {
            steps = TOOL_STEPS;
            // The path turns.
            run.before = None;
        }
        let mut at_step = |run: &mut SolidRun<'_, 'a>| {
            if let Some(contacts) = &run.contacts {
                increments.push(ToolIncrement {
                    along: (run.reached - 1.0).max(0.0),
                    loads: contacts.loads(model, &run.state.unknowns),
                });
            }
            at_part(run.reached / whole);
            ControlFlow::Continue(())
        };
        continue_to(&mut run, &mut steps, 1.0 + part as f64, &mut at_step).map_err(|failure| {
            Error::NoSolid {
                part: run.reached / whole,
                failure,
            }
        })?;
    }
    Ok(Solved {
        state: run.state,
        contacts: run.contacts,
        increments,
    })
}

/// A solid on its way: in the first unit of length all loads grow, in those that follow tools move.
struct SolidRun<'a, 'c> {
    model: &'a FiniteElementModel,
    conditions: &'a Conditions<'a>,
    workspace: &'a mut FiniteElementWorkspace,
    reached: f64,
    state: FiniteElementState,
    contacts: Option<Contacts<'c>>,
    before: Option<(f64, Vec<f64>)>,
}

impl Increments for SolidRun<'_, '_> {
    fn reached(&self) -> f64 {
        self.reached
    }

    fn advance(&mut self, goal: f64) -> Result<usize, Failure> {
        // A step that was predicted badly is tried again from where the body stands.
        let before = self.before.take();
        let now = Reached {
            place: self.reached,
            unknowns: &self.state.unknowns,
        };
        let before = before.as_ref().map(|(place, unknowns)| Reached {
            place: *place,
            unknowns,
        });
        let mut trial = FiniteElementState {
            unknowns: extrapolated(now, before, goal),
        };
        let mut contacts = self
            .contacts
            .as_ref()
            .map(|contacts| contacts.moved(goal - 1.0));
        if let Some(contacts) = &mut contacts {
            contacts.update_facing(self.model, &trial.unknowns);
        }
        let mut solutions = 0;
        let mut last = f64::INFINITY;
        for augmentation in 0.. {
            let mut supports = self.conditions.supports(self.model, goal.min(1.0));
            supports.contacts = contacts.as_ref();
            let controls = SolverControls {
                tolerance: match contacts {
                    Some(_) => {
                        let tolerance = TOLERANCE_IN_CHANGE * f64::min(last, 1.0);
                        tolerance.max(SolverControls::FULL.tolerance)
                    }
                    None => SolverControls::FULL.tolerance,
                },
                ..SolverControls::FULL
            };
            newton::assemble(self.model, &supports, &trial.unknowns, self.workspace)?;
            let found = correct(controls, self.model, &supports, &mut trial, self.workspace)?;
            solutions += found.iterations;
            let Some(contacts) = &mut contacts else {
                break;
            };
            let change = contacts.augment(self.model, &trial.unknowns);
            // Changes fall by a constant factor: the next one is about this.
            let next = change * (change / last).min(1.0);
            last = change;
            if augmentation < FACED {
                contacts.update_facing(self.model, &trial.unknowns);
            }
            if augmentation > FACED && next <= CONTACT_TOLERANCE || change == 0.0 {
                contacts.close_increment(self.model, &trial.unknowns);
                break;
            }
            if augmentation == MAX_AUGMENTATIONS {
                return Err(Failure::NotConverged);
            }
        }
        let old = std::mem::replace(&mut self.state, trial);
        self.before = Some((self.reached, old.unknowns));
        self.contacts = contacts;
        self.reached = goal;
        Ok(solutions)
    }
}

fn linear(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    newton::assemble(model, supports, &state.unknowns, workspace)?;
    workspace.supported.copy_from_slice(&workspace.tangent);
    workspace.step.fill(0.0);
    for (step, prescribed) in workspace.step.iter_mut().zip(&supports.prescribed) {
        *step = prescribed.unwrap_or(0.0);
    }
    let is_prescribed = newton::prescribed_rows(model, supports);
    let mut right = vec![0.0; model.size()];
    newton::eliminate(model, &is_prescribed, workspace, &mut right);
    newton::factor(model, workspace)?;
    for solution in 0..MAX_SOLUTIONS {
        workspace.factors.solve(&mut right);
        for (x, dx) in state.unknowns.iter_mut().zip(&right) {
            *x += dx;
        }
        newton::assemble(model, supports, &state.unknowns, workspace)?;
        let (mut free, mut reactions): (f64, f64) = (0.0, 0.0);
        for (row, right) in right.iter_mut().enumerate() {
            let residual = workspace.residual[row];
            *right = if is_prescribed[row] { 0.0 } else { -residual };
            if row < model.displacements() {
                let size = if is_prescribed[row] {
                    &mut reactions
                } else {
                    &mut free
                };
                *size += residual * residual;
            }
        }
        if !free.is_finite() {
            return Err(Failure::Singular);
        }
        // The first has the small block in its pressures, where these forces do not show it.
        if solution > 0 && free <= TOLERANCE * TOLERANCE * reactions {
            return Ok(());
        }
    }
    Err(Failure::NotConverged)
}
