use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Failure};
use super::supports::Supports;
use crate::Error;

/// The linear system of one step of Newton's method, to time its parts or to export it to another code.
/// [`super::equilibrate`] does the same by itself.
///
/// Prescribed unknowns stay in it, each alone in its row. Sliding nodes are not turned.
#[derive(Debug)]
pub struct LinearSystem<'a> {
    model: &'a FiniteElementModel,
    workspace: &'a mut FiniteElementWorkspace,
}

impl<'a> LinearSystem<'a> {
    /// The system at `state`; no support moves.
    ///
    /// # Errors
    /// When supports, state or workspace are not those of `model`, or an element is turned inside out.
    pub fn assemble(
        model: &'a FiniteElementModel,
        supports: &Supports<'_>,
        state: &FiniteElementState,
        workspace: &'a mut FiniteElementWorkspace,
    ) -> Result<Self, Error> {
        supports.check(model)?;
        model.check_length("the state", state.unknowns.len())?;
        workspace.check(model)?;
        newton::assemble(model, supports, &state.unknowns, workspace)
            .map_err(|failure| Error::NotInEquilibrium { failure })?;
        workspace.supported.copy_from_slice(&workspace.tangent);
        workspace.step.fill(0.0);
        let is_prescribed = newton::prescribed_rows(model, supports);
        let mut right = vec![0.0; model.size()];
        newton::eliminate(model, &is_prescribed, workspace, &mut right);
        Ok(Self { model, workspace })
    }

    /// Row, column and value of each entry on and below the diagonal, column by column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let pattern = &self.model.pattern;
        (0..pattern.size()).flat_map(move |column| {
            let places = pattern.range(column);
            let rows = pattern.rows(column).iter();
            rows.zip(places)
                .map(move |(&row, place)| (row, column, self.workspace.supported[place]))
        })
    }

    /// Makes the factors.
    ///
    /// # Errors
    /// When the matrix is singular.
    pub fn factor(&mut self) -> Result<(), Failure> {
        newton::factor(self.model, self.workspace)
    }

    /// Replaces `right` by the solution, with the factors of the last [`Self::factor`].
    ///
    /// # Errors
    /// When `right` has not one number for each unknown.
    pub fn solve(&mut self, right: &mut [f64]) -> Result<(), Error> {
        self.model.check_length("the right side", right.len())?;
        self.workspace.factors.solve(right);
        Ok(())
    }
}
