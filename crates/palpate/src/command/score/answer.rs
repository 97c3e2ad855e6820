use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use palpate_files::scene::Task;
use palpate_simulate::performance::{Comparison, Outcome, Score};
use serde::Serialize;

use crate::output::VERSION;

/// The answer that `--json` prints.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    session: PathBuf,
    task: TaskAnswer,
    /// By key, in SI.
    measures: BTreeMap<String, f64>,
    /// By key; empty without an expert.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    expert: BTreeMap<String, Comparison>,
    pub(super) warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct TaskAnswer {
    kind: &'static str,
    title: Option<String>,
    passed: Option<bool>,
    /// Of a cut line.
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<f64>,
}

impl Answer {
    pub(super) fn new(
        session: &Path,
        task: &Task,
        score: &Score,
        compared: &[Comparison],
        warnings: Vec<String>,
    ) -> Self {
        let measures = score.measures().into_iter();
        Self {
            palpate: VERSION,
            session: session.to_owned(),
            task: TaskAnswer {
                kind: task.goal.word(),
                title: task.title.clone(),
                passed: score.outcome.passed(),
                part: match score.outcome {
                    Outcome::Cut { part, .. } => Some(part),
                    _ => None,
                },
            },
            measures: measures
                .map(|measure| (measure.key, measure.value))
                .collect(),
            expert: compared
                .iter()
                .map(|compared| (compared.measure.key.clone(), compared.clone()))
                .collect(),
            warnings,
        }
    }
}
