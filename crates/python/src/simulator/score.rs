//! How well a task was done, as `palpate score` tells it.

use palpate_files::scene::Task;
use palpate_simulate::performance::{Outcome, Score, Status};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::stepper::Judge;

/// The measures by their keys, in SI, with what became of the task.
pub(crate) fn dict<'py>(
    py: Python<'py>,
    score: &Score,
    task: &Task,
) -> PyResult<Bound<'py, PyDict>> {
    let measures = PyDict::new(py);
    for measure in score.measures() {
        measures.set_item(measure.key, measure.value)?;
    }
    let dict = PyDict::new(py);
    dict.set_item("kind", task.goal.word())?;
    dict.set_item("title", &task.title)?;
    dict.set_item("passed", score.outcome.passed())?;
    dict.set_item(
        "part",
        match score.outcome {
            Outcome::Cut { part, .. } => Some(part),
            _ => None,
        },
    )?;
    dict.set_item("measures", measures)?;
    Ok(dict)
}

/// How far a task is: the part that is done [-] or NaN, whether it is over, and whether its time is.
pub(super) fn status(judge: Option<&Judge>) -> (f64, bool, bool) {
    match judge.map(|judge| judge.performance.status()) {
        None => (f64::NAN, false, false),
        Some(Status::InProgress { part, .. }) => (part.unwrap_or(f64::NAN), false, false),
        Some(Status::Ended { late }) => {
            let part = if late { f64::NAN } else { 1.0 };
            (part, true, late)
        }
    }
}
