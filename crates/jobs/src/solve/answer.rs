use serde::Serialize;

use super::solution::Solution;

/// What `solve --json` prints.
#[derive(Debug, Serialize)]
pub struct Answer {
    pub(super) palpate: &'static str,
    pub(super) kind: &'static str,
    /// What was found.
    #[serde(flatten)]
    pub solution: Solution,
    /// That the solution took [s].
    pub seconds: f64,
}
