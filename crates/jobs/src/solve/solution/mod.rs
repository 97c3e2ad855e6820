//! The solution of a problem, one file per kind: the figures of the JSON object, a table for people, a plot, and the
//! deformed body.

mod field;
mod figures;
mod hemisphere;
mod indentation;
mod plots;
mod solid;
mod tube;
mod uniaxial;
mod warnings;

pub use figures::{
    Displacements, Figures, FrictionFigures, PatchFigures, PointFigures, Profile, SolidFigures,
    ToolFigures, TubeFigures,
};

use std::time::Instant;

use palpate_files::{Recording, Tissue};
use serde::Serialize;

use super::answer::Answer;
use super::problem::{Case, Problem};
use super::solver_progress::ProgressReporter;
use super::table::Table;
use crate::plot::Plot;
use crate::{Error, ProgressCallback, VERSION};

/// An answer in all its forms.
#[derive(Debug, Serialize)]
pub struct Solution {
    /// Warnings.
    pub warnings: Vec<String>,
    /// The figures of the JSON object.
    #[serde(flatten)]
    pub figures: Figures,
    /// Of the finest mesh.
    pub unknowns: usize,
    /// Relative, the largest over the points [-].
    pub estimated_error: f64,
    /// Order of convergence of the value with the largest error, where the meshes show it [-].
    pub observed_order: Option<f64>,
    /// Body and load on one line.
    #[serde(skip)]
    pub heading: String,
    #[serde(skip)]
    pub(crate) tables: Vec<Table>,
    /// Force against depth, or the problem's own result.
    #[serde(skip)]
    pub plot: Plot,
    /// The bytes of a `.vtu` file.
    #[serde(skip)]
    pub vtu: Option<Vec<u8>>,
    /// The simulated recording of the same indenter on such a tissue.
    #[serde(skip)]
    pub recording: Option<Recording>,
}

/// Requested outputs in addition to the figures.
#[derive(Debug, Clone, Copy, Default)]
pub struct RequestedOutputs {
    /// A plot that takes extra computation.
    pub plot: bool,
    /// The deformed body.
    pub vtu: bool,
}

/// Solves `problem`.
///
/// # Errors
/// When the solver rejects the problem, or finds no equilibrium.
pub fn solve(
    problem: &Problem,
    wanted: RequestedOutputs,
    watch: &dyn ProgressCallback,
) -> Result<Answer, Error> {
    let begun = Instant::now();
    let reporter = &ProgressReporter::new(watch);
    let mut solution = match &problem.case {
        Case::Indentation(case) => indentation::solution(problem, case, wanted, reporter),
        Case::Hemisphere(case) => hemisphere::solution(problem, case, reporter),
        Case::Tube(case) => tube::solution(problem, case, wanted, reporter),
        Case::Uniaxial(case) => uniaxial::solution(problem, case),
        Case::Solid(case) => solid::solution(problem, case, wanted, reporter),
    }?;
    if !solution.figures.are_numbers() {
        return Err(Error::failed(
            "the answer is no number, which should not happen; please report the problem",
        ));
    }
    let mut warnings = warnings::shared(problem, solution.estimated_error);
    warnings.append(&mut solution.warnings);
    solution.warnings = warnings;
    Ok(Answer {
        palpate: VERSION,
        kind: problem.kind(),
        solution,
        seconds: begun.elapsed().as_secs_f64(),
    })
}

impl Solution {
    /// The tissue, where its stiffness was fitted.
    pub fn fitted_tissue(&self) -> Option<&Tissue> {
        match &self.figures {
            Figures::Solid(solid) => solid.tissue.as_deref(),
            _ => None,
        }
    }
}

/// Millimetres, of lengths [m].
fn millimetres(lengths: &[f64]) -> impl Iterator<Item = f64> {
    lengths.iter().map(|length| 1e3 * length)
}

/// Millinewtons, of forces [N].
fn millinewtons(forces: &[f64]) -> impl Iterator<Item = f64> {
    forces.iter().map(|force| 1e3 * force)
}
