//! Equilibrium beyond a limit point, where the way there leads downhill in energy and no small step of
//! the supports helps.
//!
//! Each iteration solves (K + c D) Δu + Bᵀ(p + Δp) = −f, B Δu = −g, with D the diagonal of K at the start, g
//! what is missing from the pressures' equations, and c the smallest of a ladder with which the matrix has as many negative
//! eigenvalues as there are pressures: then Δu leads downhill on the surface where volume is as it must be
//! [Nocedal and Wright 2006, chapter 18]. It is gone along as far as
//!   Π(u, p + Δp) + (w/2) Σ g² μ/M
//! falls, with Π as in [`super::assembly`]. A whole step weakens c, and c = 0 is Newton's method. So the end is a
//! minimum of energy, below the start.
//!
//! *How we know*: `punch_edge::…`, `indentation::goes_on_to_eight_radii`,
//! `indentation::a_sliding_side_goes_on_to_seven_radii`.
//!
//! *Limits*: a minimum, not necessarily the least. The energy of a body that relaxes is not known: there the
//! residual must not grow more than [`GROWTH`] times in an iteration.

use super::assembly::PRESSURE_REGULARIZATION;
use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Equilibrium, Failure, SolverControls};
use super::supports::Supports;

/// c [-]: the first, that at which to stop, and that below which there is none.
const FIRST: f64 = 1e-5;
const STRONGEST: f64 = 1e3;
const WEAKEST: f64 = 1e-6;
/// By how much c changes after a whole step [-], and where it is too small.
const WEAKER: f64 = 0.25;
const STRONGER: f64 = 5.0;
/// How much the residual of a body that relaxes may grow in an iteration [-].
const GROWTH: f64 = 10.0;
/// Parts of an iteration's step that are tried [-].
const PARTS: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];
/// Solutions of the linear system.
const MAX_ITERATIONS: usize = 400;
/// Weight w of the error of volume relative to energy [-].
const VOLUME: f64 = 10.0;

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
    let mut damping = 0.0;
    let mut iterations = 0;
    loop {
        let gap = newton::prescribe(model, supports, &state.unknowns, workspace);
        let before = newton::size_of_residual(model, supports, workspace);
        if gap == 0.0 && iterations > 0 && before.is_small(SolverControls::FULL.tolerance) {
            return Ok(Equilibrium { iterations });
        }
        // The damping in the tangent.
        let mut there = 0.0;
        let prescribed = workspace.step.clone();
        let moved = loop {
            for (&place, stiffness) in places.iter().zip(&stiffness) {
                workspace.tangent[place] += (damping - there) * stiffness;
            }
            there = damping;
            if iterations == MAX_ITERATIONS {
                return Err(Failure::NotConverged);
            }
            iterations += 1;
            newton::solve(model, supports, workspace)?;
            let unstable = workspace.factors.negative_eigenvalues() > model.pressures();
            if !unstable {
                if let Some(part) = follow(model, supports, state, workspace, gap, before.free) {
                    break part;
                }
                newton::assemble(model, supports, &state.unknowns, workspace)?;
                there = 0.0;
            }
            damping = if damping > 0.0 {
                STRONGER * damping
            } else {
                FIRST
            };
            if damping > STRONGEST {
                return Err(Failure::NotConverged);
            }
            workspace.trial.copy_from_slice(&state.unknowns);
            workspace.step.copy_from_slice(&prescribed);
        };
        if moved == 1.0 {
            damping *= WEAKER;
            if damping < WEAKEST {
                damping = 0.0;
            }
        }
    }
}

/// Goes along the step as far as no element turns inside out and energy falls; answers which part of it that is, or
/// nothing where no part of the step is possible.
fn follow(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
    gap: f64,
    before: f64,
) -> Option<f64> {
    let displacements = model.displacements();
    let moved = |part: f64, step: &[f64], from: &[f64]| -> Vec<f64> {
        let parts = from.iter().zip(step).enumerate();
        parts
            .map(|(i, (x, dx))| x + if i < displacements { part * dx } else { *dx })
            .collect()
    };
    let step = workspace.step.clone();
    let energy = |workspace: &FiniteElementWorkspace, pressures: &[f64]| {
        let soft =
            1.0 / model.law.volume().bulk_modulus + PRESSURE_REGULARIZATION / model.shear_modulus;
        let mut sum = workspace.energy;
        for (i, pressure) in (displacements..).zip(pressures) {
            let residual = workspace.residual[i];
            let mass = workspace.tangent[model.pattern.range(i).start].abs() / soft;
            sum +=
                pressure * residual + 0.5 * VOLUME * residual.powi(2) * model.shear_modulus / mass;
        }
        sum
    };
    let known = gap == 0.0 && supports.relaxing.is_none();
    let most = if known {
        let trial = moved(0.0, &step, &state.unknowns);
        newton::assemble(model, supports, &trial, workspace).ok()?;
        energy(workspace, &trial[displacements..])
    } else {
        f64::INFINITY
    };
    for part in PARTS {
        let trial = moved(part, &step, &state.unknowns);
        if newton::assemble(model, supports, &trial, workspace).is_err() {
            continue;
        }
        workspace.trial.copy_from_slice(&trial);
        let size = newton::size_of_residual(model, supports, workspace);
        let after = size.free;
        let good = if size.is_small(SolverControls::FULL.tolerance) {
            true
        } else if known {
            energy(workspace, &trial[displacements..]) < most || after <= 0.25 * before
        } else {
            gap > 0.0 || after <= GROWTH * GROWTH * before
        };
        if good {
            state.unknowns = trial;
            return Some(part);
        }
    }
    None
}
