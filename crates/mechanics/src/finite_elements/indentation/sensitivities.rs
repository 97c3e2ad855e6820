//! Derivatives of the answer with respect to the parameters of the law, without a second run.
//!
//! At an equilibrium r(u, q) = 0, so K ∂u/∂q = −∂r/∂q: one more solution with the factors that Newton's
//! method has made. Prescribed displacements do not depend on q, except where a node sticks: it keeps
//! the derivative of the place at which it was activated.
//!
//! *How we know*: `sensitivities::…` against runs with moved parameters.
//!
//! *Limits*: elastic tissue; the moment at which a sliding node is activated does not change with q.

use std::sync::Arc;

use super::super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::super::newton::Failure;
use super::super::sensitivity;
use super::super::supports::Supports;
use crate::material::law::Law;

/// How a node came into the indenter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) node: usize,
    /// How deep it was inside before (negative) and after [m].
    pub(super) ways: [f64; 2],
    /// The part of the way at which it came in [-].
    pub(super) part: f64,
    /// How far it rose on the way [m].
    pub(super) rise: f64,
}

/// A parameter of the sensitivities.
#[derive(Debug, Clone)]
pub(super) struct SensitivityParameter {
    /// The law that it is of.
    pub(super) law: Arc<dyn Law>,
    /// Its place among the law's parameters.
    pub(super) parameter: usize,
    /// The change of it that answers are for.
    pub(super) unit: f64,
}

/// ∂u/∂q of all unknowns, one column for each parameter.
#[derive(Debug, Clone)]
pub(super) struct Sensitivities {
    sought: Vec<SensitivityParameter>,
    columns: Vec<Vec<f64>>,
}

impl Sensitivities {
    pub(super) fn at_rest(model: &FiniteElementModel, sought: Vec<SensitivityParameter>) -> Self {
        Self {
            columns: vec![vec![0.0; model.size()]; sought.len()],
            sought,
        }
    }

    /// At the equilibrium `state`; prescribed unknowns keep their slopes.
    pub(super) fn solve(
        &mut self,
        model: &FiniteElementModel,
        supports: &Supports<'_>,
        state: &FiniteElementState,
        workspace: &mut FiniteElementWorkspace,
    ) -> Result<(), Failure> {
        for (sought, column) in self.sought.iter().zip(&mut self.columns) {
            let (law, parameter) = (&sought.law, sought.parameter);
            let force = sensitivity::residual_sensitivity(model, state, law, parameter);
            sensitivity::solve(model, supports, state, &force, column, workspace)?;
        }
        Ok(())
    }

    /// The node `entry.node` is activated: its prescribed place moves with the parameters as the point where it
    /// came in does.
    pub(super) fn activate(&mut self, entry: &Entry, old: &Self) {
        let Entry {
            node,
            ways,
            part,
            rise,
        } = *entry;
        let length = ways[1] - ways[0];
        for (column, old) in self.columns.iter_mut().zip(&old.columns) {
            let radius = [old[2 * node], column[2 * node]];
            let height = [old[2 * node + 1], column[2 * node + 1]];
            // part = o/(o + i) with ∂o = ∂r before and ∂i = −∂r after.
            let part_slope = ((1.0 - part) * radius[0] + part * radius[1]) / length;
            column[2 * node] = 0.0;
            column[2 * node + 1] = height[0] + part * (height[1] - height[0]) + part_slope * rise;
        }
    }

    /// ∂F/∂q of the force on the tissue [N per unit], from the tangent of the last assembly; `rows` are
    /// the prescribed rows whose reactions sum to the force.
    pub(super) fn force<I: Iterator<Item = usize>>(
        &self,
        model: &FiniteElementModel,
        state: &FiniteElementState,
        workspace: &FiniteElementWorkspace,
        rows: impl Fn() -> I,
    ) -> Vec<f64> {
        let mut product = vec![0.0; model.size()];
        let each = |(sought, column): (&SensitivityParameter, &Vec<f64>)| {
            let (law, parameter) = (&sought.law, sought.parameter);
            let direct = sensitivity::residual_sensitivity(model, state, law, parameter);
            model
                .pattern
                .multiply(&workspace.tangent, column, &mut product);
            -sought.unit * rows().map(|row| direct[row] + product[row]).sum::<f64>()
        };
        self.sought.iter().zip(&self.columns).map(each).collect()
    }
}
