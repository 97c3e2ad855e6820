use serde::Serialize;

use super::solution::Solution;

/// The answer that `solve --json` prints.
#[derive(Debug, Serialize)]
pub struct Answer {
    pub(super) palpate: &'static str,
    pub(super) kind: &'static str,
    /// The solution.
    #[serde(flatten)]
    pub solution: Solution,
    /// Duration of the solution [s].
    pub seconds: f64,
}
