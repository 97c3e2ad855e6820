//! The change of an equilibrium with the law's parameters.

use super::assembly;
use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Failure};

/// ∂r/∂q: change of the residual [N per unit; m³ per unit] with a parameter at fixed unknowns.
pub(super) fn residual_by_parameter(
    model: &FiniteElementModel,
    state: &FiniteElementState,
    parameter: usize,
) -> Vec<f64> {
    let mut residual = vec![0.0; model.size()];
    assembly::add_by_parameter(model, &state.unknowns, parameter, &mut residual);
    residual
}

/// Solves K s = −`force` for the free rows of `slope`; its held rows are given. The tangent is that of
/// the last assembly, and is factored anew.
pub(super) fn solve(
    model: &FiniteElementModel,
    is_held: &[bool],
    force: &[f64],
    slope: &mut [f64],
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Failure> {
    workspace.supported.copy_from_slice(&workspace.tangent);
    for ((step, held), slope) in workspace.step.iter_mut().zip(is_held).zip(slope.iter()) {
        *step = if *held { *slope } else { 0.0 };
    }
    let mut right: Vec<f64> = force.iter().map(|f| -f).collect();
    newton::eliminate(model, is_held, workspace, &mut right);
    newton::factor(model, workspace)?;
    workspace.factors.solve(&mut right);
    slope.copy_from_slice(&right);
    Ok(())
}
