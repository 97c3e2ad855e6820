//! The change of an equilibrium with the law's parameters.

use std::sync::Arc;

use super::assembly;
use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Failure};
use super::supports::Supports;
use crate::material::law::Law;

/// ∂r/∂q: change of the residual [N per unit; m³ per unit] with a parameter of `law` at fixed unknowns, where the body is of
/// that law.
pub(super) fn residual_sensitivity(
    model: &FiniteElementModel,
    state: &FiniteElementState,
    law: &Arc<dyn Law>,
    parameter: usize,
) -> Vec<f64> {
    let mut residual = vec![0.0; model.size()];
    assembly::add_sensitivity(model, &state.unknowns, law, parameter, &mut residual);
    residual
}

/// Solves K s = −`force` for the free rows of `slope`; its prescribed rows are given, and a sliding node
/// moves along its surface alone. The tangent is that of the last assembly, at `state`, and is factored
/// anew.
pub(super) fn solve(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &FiniteElementState,
    force: &[f64],
    slope: &mut [f64],
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    workspace.supported.copy_from_slice(&workspace.tangent);
    workspace.trial.copy_from_slice(&state.unknowns);
    workspace.step.fill(0.0);
    for ((step, prescribed), slope) in workspace
        .step
        .iter_mut()
        .zip(&supports.prescribed)
        .zip(&*slope)
    {
        if prescribed.is_some() {
            *step = *slope;
        }
    }
    let mut right: Vec<f64> = force.iter().map(|f| -f).collect();
    newton::turn(model, supports, workspace, &mut right);
    newton::eliminate(
        model,
        &newton::prescribed_rows(model, supports),
        workspace,
        &mut right,
    );
    newton::factor(model, workspace)?;
    workspace.factors.solve(&mut right);
    newton::turn_back(model, supports, workspace, &mut right);
    slope.copy_from_slice(&right);
    Ok(())
}
