//! Equilibrium beyond a limit point, where the way there leads downhill in energy and no small step of
//! the supports helps.
//!
//! Newton's method with artificial damping (pseudo-transient continuation): each iteration solves
//! (K + c D) Δu = −r, an implicit step in time of D u̇ = −r, with D the diagonal of K. The damping c
//! follows the residual (switched evolution relaxation [Kelley and Keyes 1998]): it goes to zero where
//! the residual falls, which leaves Newton's method. So a single element that snaps through at the edge
//! of the contact does not end a run.
//!
//! *How we know*: `indentation::goes_on_to_eight_radii`, `indentation::a_sliding_side_goes_on_to_seven_radii`.
//!
//! *Limits*: arrives at an equilibrium, not necessarily at the nearest: beyond six radii under a sliding
//! side forces on the coarsest mesh differ by 3 % with the depths stopped at, and eight radii are not always
//! reached.

use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Effort, Equilibrium, Failure};
use super::supports::Supports;

/// Damping in parts of the stiffness's diagonal [-]: the first, that at which to stop, and that below
/// which there is none.
const FIRST: f64 = 1e-3;
const STRONGEST: f64 = 10.0;
const WEAKEST: f64 = 1e-9;
/// By how much the damping may change in an iteration [-].
const CHANGES: [f64; 2] = [0.1, 3.0];
/// Damping after an iteration in vain [-], in parts of that before.
const AFTER_FAILURE: f64 = 10.0;
/// How much the residual may grow in an iteration [-]; on the way over a limit point it does.
const GROWTH: f64 = 10.0;
/// Parts of an iteration's step that are tried [-].
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
const MOST_ITERATIONS: usize = 200;

/// Brings `state` into equilibrium with `supports` as [`newton::equilibrate`] does, also where that
/// fails.
///
/// # Errors
/// As [`newton::equilibrate`].
pub(super) fn equilibrate_downhill(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<Equilibrium, Failure> {
    newton::assemble(model, supports, &state.unknowns, workspace)?;
    let places: Vec<usize> = (0..model.displacements())
        .map(|i| model.pattern.range(i).start)
        .collect();
    let stiffness: Vec<f64> = places.iter().map(|&i| workspace.tangent[i].abs()).collect();
    let mut damping = FIRST;
    for iterations in 0..MOST_ITERATIONS {
        let gap = newton::prescribe(model, supports, &state.unknowns, workspace);
        let before = newton::size_of_residual(model, supports, workspace);
        if gap == 0.0 && iterations > 0 && before.is_small(Effort::FULL.tolerance) {
            return Ok(Equilibrium { iterations });
        }
        if damping > WEAKEST {
            for (&place, stiffness) in places.iter().zip(&stiffness) {
                workspace.tangent[place] += damping * stiffness;
            }
        }
        newton::solve(model, supports, workspace)?;
        let most = if gap == 0.0 {
            GROWTH * GROWTH * before.free
        } else {
            f64::INFINITY
        };
        match follow(model, supports, state, workspace, most) {
            Some(after) if gap == 0.0 => {
                damping *= (after / before.free).sqrt().clamp(CHANGES[0], CHANGES[1]);
            }
            Some(_) => {}
            None => {
                damping = AFTER_FAILURE * damping.max(WEAKEST);
                if damping > STRONGEST {
                    break;
                }
                newton::assemble(model, supports, &state.unknowns, workspace)?;
            }
        }
    }
    Err(Failure::NotConverged)
}

/// Goes along the step as far as no element turns inside out and the residual's size stays below `most`
/// [J]; answers that size, or nothing where no part of the step is possible.
fn follow(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
    most: f64,
) -> Option<f64> {
    for part in PARTS {
        let steps = state.unknowns.iter().zip(&workspace.step);
        let trial: Vec<f64> = steps.map(|(x, dx)| x + part * dx).collect();
        if newton::assemble(model, supports, &trial, workspace).is_err() {
            continue;
        }
        workspace.trial.copy_from_slice(&trial);
        let after = newton::size_of_residual(model, supports, workspace).free;
        if after <= most {
            state.unknowns = trial;
            return Some(after);
        }
    }
    None
}
