//! What comes of a problem, one file per kind: the figures of the JSON object, a table for people, a
//! plot, and the deformed body.

mod doubts;
mod field;
mod figures;
mod hemisphere;
mod indentation;
mod plots;
mod solid;
mod tube;
mod uniaxial;

pub(super) use figures::Figures;

use palpate_files::Recording;

use super::problem::{Case, Problem};
use super::table::Table;
use super::waiting::Waiting;
use crate::failure::Failure;
use crate::plot::Plot;

/// An answer in all its forms.
#[derive(Debug)]
pub(super) struct Solution {
    pub(super) figures: Figures,
    pub(super) unknowns: usize,
    /// Relative, the largest over the points [-].
    pub(super) estimated_error: f64,
    pub(super) warnings: Vec<String>,
    pub(super) heading: String,
    pub(super) tables: Vec<Table>,
    pub(super) plot: Plot,
    /// The bytes of a `.vtu` file.
    pub(super) vtu: Option<Vec<u8>>,
    /// What the same indenter would record on such a tissue.
    pub(super) recording: Option<Recording>,
}

/// What is wanted beside the figures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    /// A plot that deserves work of its own.
    pub(super) plot: bool,
    /// The deformed body.
    pub(super) vtu: bool,
}

/// Solves `problem`.
pub(super) fn of(
    problem: &Problem,
    wanted: Wanted,
    waiting: &Waiting,
) -> Result<Solution, Failure> {
    let mut solution = match &problem.case {
        Case::Indentation(case) => indentation::solution(problem, case, wanted, waiting),
        Case::Hemisphere(case) => hemisphere::solution(problem, case, waiting),
        Case::Tube(case) => tube::solution(problem, case, wanted, waiting),
        Case::Uniaxial(case) => uniaxial::solution(problem, case),
        Case::Solid(case) => solid::solution(problem, case, wanted, waiting),
    }?;
    if !solution.figures.are_numbers() {
        return Err(Failure::failed(
            "the answer is no number, which should not happen; please report the problem",
        ));
    }
    let mut warnings = doubts::shared(problem, solution.estimated_error);
    warnings.append(&mut solution.warnings);
    solution.warnings = warnings;
    Ok(solution)
}

/// Millimetres, of lengths [m].
fn millimetres(lengths: &[f64]) -> impl Iterator<Item = f64> {
    lengths.iter().map(|length| 1e3 * length)
}

/// Millinewtons, of forces [N].
fn millinewtons(forces: &[f64]) -> impl Iterator<Item = f64> {
    forces.iter().map(|force| 1e3 * force)
}
