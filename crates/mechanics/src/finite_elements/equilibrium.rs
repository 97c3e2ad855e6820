use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{self, Equilibrium};
use super::supports::Supports;
use crate::Error;

/// Brings `state` into equilibrium with `supports`. Where no equilibrium is found `state` is the last iterate.
///
/// # Errors
/// Before any work: when supports, state or workspace are not those of `model`. Later: when there is no equilibrium to
/// be found, and a smaller change of the supports may succeed.
pub fn equilibrate(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    state: &mut FiniteElementState,
    workspace: &mut FiniteElementWorkspace,
) -> Result<Equilibrium, Error> {
    supports.check(model)?;
    model.check_length("the state", state.unknowns.len())?;
    workspace.check(model)?;
    newton::equilibrate(model, supports, state, workspace)
        .map_err(|failure| Error::NotInEquilibrium { failure })
}
