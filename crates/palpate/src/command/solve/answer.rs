use std::time::Duration;

use serde::Serialize;

use super::problem::Problem;
use super::solution::{Figures, Solution};
use crate::output::VERSION;

/// What `solve --json` prints.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    kind: &'static str,
    pub(super) warnings: Vec<String>,
    #[serde(flatten)]
    figures: Figures,
    pub(super) unknowns: usize,
    /// Relative, the largest over the points [-].
    pub(super) estimated_error: f64,
    pub(super) seconds: f64,
}

impl Answer {
    pub(super) fn new(problem: &Problem, solution: &Solution, took: Duration) -> Self {
        Self {
            palpate: VERSION,
            kind: problem.case.word(),
            warnings: solution.warnings.clone(),
            figures: solution.figures.clone(),
            unknowns: solution.unknowns,
            estimated_error: solution.estimated_error,
            seconds: took.as_secs_f64(),
        }
    }
}
