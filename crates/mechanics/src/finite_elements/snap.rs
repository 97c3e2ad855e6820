//! Equilibrium beyond a limit point, where the way there leads downhill in energy and no small step of
//! the supports helps.
//!
//! The body is put into a syrup: K is joined by a resistance c D against leaving the last place, D being
//! K's own diagonal. Each equilibrium in it is a step of D u̇ = −r in time; the syrup is thinned until
//! the body stands without it. So a single element that gives way in a corner does not end a run.
//!
//! *How we know*: `indentation::goes_on_to_eight_radii`.
//!
//! *Limits*: arrives at a stable state, not necessarily at the nearest.

use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Effort, Equilibrium, Failure, equilibrate, equilibrate_within};
use super::supports::Supports;

/// What resists a body that leaves a place.
#[derive(Debug, Clone)]
pub(super) struct Syrup {
    /// Resistance of each displacement [N/m].
    pub(super) resistance: Vec<f64>,
    /// The place [m].
    pub(super) place: Vec<f64>,
}

/// Resistances in parts of the stiffness's diagonal [-]: the first, and those at which to stop.
const FIRST: f64 = 1e-3;
const THICKEST: f64 = 10.0;
const THINNEST: f64 = 1e-6;
/// How the resistance changes after a step that was easy, good or bad [-].
const MUCH_THINNER: f64 = 0.3;
const THINNER: f64 = 0.7;
const THICKER: f64 = 3.0;
/// Solutions after which a step was easy.
const EASY: usize = 3;
/// What a step in the syrup is worth: it only shows the way.
const STEP: Effort = Effort {
    tolerance: 1e-5,
    ..Effort::TRY
};
const MOST_STEPS: usize = 150;

/// Brings `state` into equilibrium with `supports` as [`equilibrate`] does, also where that fails.
///
/// # Errors
/// As [`equilibrate`].
pub(super) fn equilibrate_downhill(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<Equilibrium, Failure> {
    newton::assemble(model, supports, &state.unknowns, workspace)?;
    let diagonal: Vec<f64> = (0..model.displacements())
        .map(|i| workspace.tangent[model.pattern.range(i).start].abs())
        .collect();
    let mut part = FIRST;
    let mut iterations = 0;
    let mut was_bad = false;
    for _ in 0..MOST_STEPS {
        let start = state.clone();
        let thick = Supports {
            syrup: Some(Syrup {
                resistance: diagonal.iter().map(|d| part * d).collect(),
                place: start.unknowns[..model.displacements()].to_vec(),
            }),
            ..supports.clone()
        };
        match equilibrate_within(STEP, model, &thick, (state, workspace)) {
            Ok(done) => {
                iterations += done.iterations;
                part *= match done.iterations {
                    _ if was_bad => 1.0,
                    ..=EASY => MUCH_THINNER,
                    _ => THINNER,
                };
                was_bad = false;
            }
            Err(_) => {
                *state = start;
                part *= THICKER;
                was_bad = true;
            }
        }
        if part < THINNEST {
            let done = equilibrate(model, supports, state, workspace)?;
            iterations += done.iterations;
            return Ok(Equilibrium { iterations });
        }
        if part > THICKEST {
            break;
        }
    }
    Err(Failure::NotConverged)
}
