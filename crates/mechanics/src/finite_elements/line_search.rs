//! The length of a step of Newton's method.

use super::model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace};
use super::newton::{Failure, SolverControls, assemble, size_of_residual};
use super::rigid_tool::Contacts;
use super::supports::Supports;

/// Shortest part of a step that is tried when an element turns inside out on its way [-].
const SHORTEST_BEFORE_INVERSION: f64 = 1.0 / 16.0;
/// Bisections of a step on which tissue meets and leaves tools.
const BISECTIONS: usize = 20;
/// Shortest part of such a step that is taken [-].
const SHORTEST_AT_TOOLS: f64 = 0.02;

/// The whole step is taken if the residual falls. If it does not and there are tools, the step is taken as far as the energy
/// falls; otherwise it is halved until the residual falls.
///
/// The residual jumps where tissue meets or leaves a tool, so that its size is no measure of a step. The energy of tissue and
/// tools, at constant multipliers, is convex where that of the tissue is.
pub(super) struct LineSearch<'a> {
    pub(super) model: &'a FiniteElementModel,
    pub(super) supports: &'a Supports<'a>,
    pub(super) controls: SolverControls,
    /// Size of the residual [J] when no support moves.
    pub(super) before: Option<f64>,
}

impl LineSearch<'_> {
    /// Moves `state` along the workspace's step.
    ///
    /// # Errors
    /// When no part of the step that is tried serves.
    pub(super) fn advance(
        &self,
        state: &mut FiniteElementState,
        workspace: &mut FiniteElementWorkspace,
    ) -> Result<(), Failure> {
        let energy = self.supports.contacts.map(|contacts| StepEnergy {
            search: self,
            contacts,
            tissue: self.tissue_slope(contacts, &state.unknowns, workspace),
        });
        let mut length = 1.0;
        // Whether the energy is lowest at this length.
        let mut is_lowest = false;
        loop {
            let trial = moved(&state.unknowns, &workspace.step, length);
            let step = std::mem::take(&mut workspace.step);
            let assembled = assemble(self.model, self.supports, &trial, workspace);
            workspace.step = step;
            workspace.trial.copy_from_slice(&trial);
            let size = match assembled {
                Ok(()) => Some(size_of_residual(self.model, self.supports, workspace)),
                Err(_) => None,
            };
            let size = size.filter(|size| size.free.is_finite());
            let mut good = size.as_ref().is_some_and(|size| {
                // A body that already rests has a residual of rounding, which no step makes smaller.
                let falls = self.before.is_none_or(|before| size.free <= before);
                falls || is_lowest || size.is_small(self.controls.tolerance)
            });
            if let (Some(_), false, Some(energy)) = (size, good, &energy) {
                match energy.lowest(length, &state.unknowns, &trial, workspace) {
                    Some(lowest) if lowest < length => {
                        (length, is_lowest) = (lowest, true);
                        continue;
                    }
                    Some(_) => good = true,
                    None => {}
                }
            }
            // A step that turns an element inside out is too long, which does not make it a bad one.
            let shortest = if assembled.is_ok() {
                self.controls.shortest
            } else {
                self.controls.shortest.min(SHORTEST_BEFORE_INVERSION)
            };
            let last = length <= shortest;
            if good || (last && self.controls.accept_larger_residual && assembled.is_ok()) {
                state.unknowns = trial;
                return Ok(());
            }
            if last {
                assembled?;
                return Err(Failure::NotConverged);
            }
            length *= 0.5;
        }
    }

    /// Slope of the tissue's energy along the step at `unknowns`, where the residual is assembled [J].
    fn tissue_slope(
        &self,
        contacts: &Contacts<'_>,
        unknowns: &[f64],
        workspace: &FiniteElementWorkspace,
    ) -> f64 {
        let count = self.model.displacements();
        let whole = dot(&workspace.residual[..count], &workspace.step[..count]);
        whole - self.tool_slope(contacts, unknowns, &workspace.step)
    }

    /// The same of the tools.
    fn tool_slope(&self, contacts: &Contacts<'_>, unknowns: &[f64], step: &[f64]) -> f64 {
        let mut forces = vec![0.0; unknowns.len()];
        contacts.add_forces(self.model, unknowns, -1.0, &mut forces);
        dot(&forces, step)
    }
}

/// Energy of tissue and tools along a step.
struct StepEnergy<'a> {
    search: &'a LineSearch<'a>,
    contacts: &'a Contacts<'a>,
    /// Slope of the tissue's at the beginning [J].
    tissue: f64,
}

impl StepEnergy<'_> {
    /// The part of the step up to `length` at which the energy is lowest, from the residual assembled there, at `trial`; none
    /// where it rises from the beginning. The energy of the tissue is taken for a parabola.
    fn lowest(
        &self,
        length: f64,
        unknowns: &[f64],
        trial: &[f64],
        workspace: &FiniteElementWorkspace,
    ) -> Option<f64> {
        let (search, step) = (self.search, &workspace.step);
        let end = search.tissue_slope(self.contacts, trial, workspace);
        let slope = |part: f64| {
            let tissue = self.tissue + part / length * (end - self.tissue);
            let there = moved(unknowns, step, part);
            tissue + search.tool_slope(self.contacts, &there, step)
        };
        if slope(0.0) >= 0.0 {
            return None;
        }
        if slope(length) <= 0.0 {
            return Some(length);
        }
        let (mut low, mut high) = (0.0, length);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high.max(SHORTEST_AT_TOOLS.min(length)))
    }
}

fn moved(unknowns: &[f64], step: &[f64], length: f64) -> Vec<f64> {
    let each = unknowns.iter().zip(step);
    each.map(|(x, dx)| x + length * dx).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
