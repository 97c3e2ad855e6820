use std::time::Duration;

use serde::Serialize;

use super::problem::Problem;
use super::solution::{Figures, Solution};
use crate::VERSION;

/// What `solve --json` prints.
#[derive(Debug, Serialize)]
pub struct Answer {
    palpate: &'static str,
    kind: &'static str,
    /// What deserves doubt.
    pub warnings: Vec<String>,
    #[serde(flatten)]
    figures: Figures,
    /// Of the finest mesh.
    pub unknowns: usize,
    /// Relative, the largest over the points [-].
    pub estimated_error: f64,
    /// Order of convergence of the value with that error, where three meshes show it [-].
    pub observed_order: Option<f64>,
    /// That the solution took [s].
    pub seconds: f64,
}

impl Answer {
    /// The answer of `solution`, which took `took`.
    pub fn new(problem: &Problem, solution: &Solution, took: Duration) -> Self {
        Self {
            palpate: VERSION,
            kind: problem.case.word(),
            warnings: solution.warnings.clone(),
            figures: solution.figures.clone(),
            unknowns: solution.unknowns,
            estimated_error: solution.estimated_error,
            observed_order: solution.observed_order,
            seconds: took.as_secs_f64(),
        }
    }
}
