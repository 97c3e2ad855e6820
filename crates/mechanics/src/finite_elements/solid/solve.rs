//! Equilibrium of a supported solid: one linear solution, or as many steps as it takes.
//!
//! A linear system whose matrix carries the small pressure block of `assembly` is solved with one
//! factor: the true residual goes through it again until it is gone.

use super::super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::super::newton::{self, Failure, equilibrate};
use super::super::supports::Supports;
use super::frame::Conditions;
use crate::{Error, Strain};

/// Free residual over that of the reactions [-].
const TOLERANCE: f64 = 1e-9;
const MOST_SOLUTIONS: usize = 4;

/// The first step, and the shortest before giving up [parts of the way].
const FIRST: f64 = 0.25;
const SHORTEST: f64 = 1e-3;

/// Brings a body at rest to where the patch has gone all of its way and all loads act; `at_part` hears how far it is.
pub(super) fn equilibrium(
    model: &FiniteElementModel,
    conditions: &Conditions<'_>,
    workspace: &mut FiniteElementWorkspace,
    at_part: &mut dyn FnMut(f64),
) -> Result<FiniteElementState, Error> {
    let mut state = FiniteElementState::at_rest(model);
    if model.law.volume().strain == Strain::Small {
        let supports = conditions.supports(model, 1.0);
        linear(model, &supports, &mut state, workspace)
            .map_err(|failure| Error::NoSolid { part: 0.0, failure })?;
        at_part(1.0);
        return Ok(state);
    }
    let (mut part, mut step) = (0.0_f64, FIRST);
    let mut before: Option<(f64, Vec<f64>)> = None;
    while part < 1.0 {
        let goal = if part + 1.01 * step >= 1.0 {
            1.0
        } else {
            part + step
        };
        let mut trial = state.clone();
        if let Some((then, old)) = &before {
            let ahead = (goal - part) / (part - then);
            for (x, old) in trial.unknowns.iter_mut().zip(old) {
                *x += ahead * (*x - old);
            }
        }
        let supports = conditions.supports(model, goal);
        match equilibrate(model, &supports, &mut trial, workspace) {
            Ok(done) => {
                let old = std::mem::replace(&mut state, trial);
                before = Some((part, old.unknowns));
                part = goal;
                at_part(part);
                if done.iterations <= 5 {
                    step *= 1.5;
                }
            }
            Err(_) if step > SHORTEST => {
                step = 0.5 * (goal - part);
                if before.is_some() {
                    // A step that was predicted badly is tried again from where the body stands.
                    before = None;
                }
            }
            Err(failure) => return Err(Error::NoSolid { part, failure }),
        }
    }
    Ok(state)
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
    for (step, held) in workspace.step.iter_mut().zip(&supports.held) {
        *step = held.unwrap_or(0.0);
    }
    let is_held = newton::held_rows(model, supports);
    let mut right = vec![0.0; model.size()];
    newton::eliminate(model, &is_held, workspace, &mut right);
    newton::factor(model, workspace)?;
    for solution in 0..MOST_SOLUTIONS {
        workspace.factors.solve(&mut right);
        for (x, dx) in state.unknowns.iter_mut().zip(&right) {
            *x += dx;
        }
        newton::assemble(model, supports, &state.unknowns, workspace)?;
        let (mut free, mut reactions): (f64, f64) = (0.0, 0.0);
        for (row, right) in right.iter_mut().enumerate() {
            let residual = workspace.residual[row];
            *right = if is_held[row] { 0.0 } else { -residual };
            if row < model.displacements() {
                let size = if is_held[row] {
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
