//! Every measure of every attempt in a row of its own.

use palpate_files::text_cell;

use super::learning_curves::{JudgedAttempt, LearningCurve};
use crate::date;
use crate::failure::Failure;

const COLUMNS: [&str; 13] = [
    "task",
    "trainee",
    "expert",
    "attempt",
    "when_unix_s",
    "date_utc",
    "session",
    "scene_digest",
    "passed",
    "measure",
    "value",
    "better",
    "proficient",
];

/// The table, in which no text is a formula; experts are not counted and not judged.
pub(super) fn csv(courses: &[LearningCurve<'_>]) -> Result<String, Failure> {
    let cannot = |error: csv::Error| {
        Failure::failed(format!(
            "the table cannot be written: {error}; please report this"
        ))
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS).map_err(cannot)?;
    for course in courses {
        let made = course
            .trainees
            .iter()
            .flat_map(|own| (1..).zip(&own.attempts));
        let made = made.map(|(number, own)| rows(course, number, own));
        let experts = course.experts.iter().map(|attempt| {
            let own = JudgedAttempt {
                attempt,
                judgement: course.standards.judge(attempt),
            };
            rows(course, 0, &own)
        });
        for row in made.chain(experts).flatten() {
            let cells = row.iter().map(|cell| text_cell(cell).into_owned());
            writer.write_record(cells).map_err(cannot)?;
        }
    }
    let bytes = writer.into_inner();
    let bytes = bytes.map_err(|error| cannot(error.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Of one attempt; `number` zero is that of an expert.
fn rows(
    course: &LearningCurve<'_>,
    number: usize,
    made: &JudgedAttempt<'_>,
) -> Vec<[String; COLUMNS.len()]> {
    let attempt = made.attempt;
    let truth = |is: Option<bool>| is.map_or_else(String::new, |is| is.to_string());
    let counted = |text: String| match attempt.is_expert {
        true => String::new(),
        false => text,
    };
    let row = |measure: &palpate_record::Measure| {
        let judged = made.judged(course, &measure.key);
        [
            attempt.task.clone(),
            attempt.trainee.clone(),
            attempt.is_expert.to_string(),
            counted(number.to_string()),
            attempt.when.to_string(),
            date::exact(attempt.when),
            attempt.session.display().to_string(),
            attempt.scene_digest.clone(),
            truth(attempt.passed),
            measure.key.clone(),
            measure.value.to_string(),
            measure.better.word().to_owned(),
            counted(truth(judged)),
        ]
    };
    attempt.measures.iter().map(row).collect()
}
