use std::path::{Path, PathBuf};

use palpate_record::{CurvePoint, Measure, Spread, Standard};
use serde::Serialize;

use super::learning_curves::{CurveQuantity, JudgedAttempt, LearningCurve, Trainee};
use crate::date;
use crate::output::VERSION;

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    record: PathBuf,
    rule: String,
    tasks: Vec<TaskAnswer>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct TaskAnswer {
    task: String,
    /// How many different scenes there are.
    scenes: usize,
    /// How many sessions of experts.
    experts: usize,
    standards: Vec<Standard>,
    trainees: Vec<TraineeAnswer>,
    learning_curve: CurvesAnswer,
}

#[derive(Debug, Serialize)]
struct TraineeAnswer {
    trainee: String,
    /// Counted from one.
    proficient_since_attempt: Option<usize>,
    attempts: Vec<AttemptAnswer>,
}

#[derive(Debug, Serialize)]
struct AttemptAnswer {
    attempt: usize,
    when_unix_s: i64,
    date_utc: String,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    session: PathBuf,
    scene_digest: String,
    time_s: Option<f64>,
    errors: Option<f64>,
    passed: Option<bool>,
    proficient: Option<bool>,
    measures: Vec<MeasureAnswer>,
}

#[derive(Debug, Serialize)]
struct MeasureAnswer {
    #[serde(flatten)]
    measure: Measure,
    proficient: Option<bool>,
}

#[derive(Debug, Serialize)]
struct CurvesAnswer {
    time_s: CurveAnswer,
    errors: CurveAnswer,
    proficient_percent: CurveAnswer,
}

#[derive(Debug, Serialize)]
struct CurveAnswer {
    experts: Option<Spread>,
    trainees: Vec<CurvePoint>,
}

impl Answer {
    pub(super) fn new(record: &Path, courses: &[LearningCurve<'_>]) -> Self {
        Self {
            palpate: VERSION,
            record: record.to_owned(),
            rule: super::rule(),
            tasks: courses.iter().map(TaskAnswer::new).collect(),
            warnings: courses.iter().flat_map(LearningCurve::warnings).collect(),
        }
    }
}

impl TaskAnswer {
    fn new(course: &LearningCurve<'_>) -> Self {
        let trainees = course.trainees.iter();
        let curve = |of: CurveQuantity| CurveAnswer {
            experts: course.of_experts(of),
            trainees: course.curve(of),
        };
        Self {
            task: course.task.to_owned(),
            scenes: course.scenes,
            experts: course.experts.len(),
            standards: course.standards.each.clone(),
            trainees: trainees.map(|own| trainee(course, own)).collect(),
            learning_curve: CurvesAnswer {
                time_s: curve(CurveQuantity::Time),
                errors: curve(CurveQuantity::Errors),
                proficient_percent: curve(CurveQuantity::ProficientPart),
            },
        }
    }
}

fn trainee(course: &LearningCurve<'_>, trainee: &Trainee<'_>) -> TraineeAnswer {
    let attempts = (1..).zip(&trainee.attempts);
    TraineeAnswer {
        trainee: trainee.name.to_owned(),
        proficient_since_attempt: trainee.proficient_since,
        attempts: attempts
            .map(|(number, own)| attempt(course, number, own))
            .collect(),
    }
}

fn attempt(course: &LearningCurve<'_>, number: usize, made: &JudgedAttempt<'_>) -> AttemptAnswer {
    let own = made.attempt;
    let measures = own.measures.iter().map(|measure| MeasureAnswer {
        measure: measure.clone(),
        proficient: made.judged(course, &measure.key),
    });
    AttemptAnswer {
        attempt: number,
        when_unix_s: own.when,
        date_utc: date::exact(own.when),
        session: own.session.clone(),
        scene_digest: own.scene_digest.clone(),
        time_s: made.time(),
        errors: made.errors(),
        passed: own.passed,
        proficient: made.judgement.proficient,
        measures: measures.collect(),
    }
}
