//! The answer for a person.

use std::path::Path;

use palpate_files::printable;
use palpate_files::quantity::number;

use super::learning_curves::{CurveQuantity, JudgedAttempt, LearningCurve, Trainee};
use crate::date;
use crate::report::{count, quantity, unit};

/// An empty value.
pub(super) const NONE: &str = "–";

/// All tasks of a record, or a selection if `filtered`.
pub(super) fn of(courses: &[LearningCurve<'_>], record: &Path, filtered: bool) -> String {
    if courses.is_empty() {
        let such = if filtered { "such " } else { "" };
        return format!(
            "{} holds no {such}attempt of a trainee yet",
            record.display()
        );
    }
    let mut text = String::new();
    for course in courses {
        text += &heading(course);
        for trainee in &course.trainees {
            text += &format!("\n  {}: {}\n", printable(trainee.name), standing(trainee));
            text += &columns(&attempts(trainee));
        }
        if course.trainees.len() > 1 {
            text += "\n  mean and standard deviation over trainees\n";
            text += &columns(&means(course));
        }
        if let [only] = course.trainees.as_slice() {
            text += &comparison(course, only);
        }
        text += "\n";
    }
    let several = courses.iter().any(|course| course.trainees.len() > 1);
    let more = match several {
        true => "\n`--trainee NAME` shows every measure of one of them.",
        false => "",
    };
    text + &super::rule().replace(". ", ".\n") + more + "\n"
}

fn heading(course: &LearningCurve<'_>) -> String {
    format!(
        "{}: {} of {}, {}\n",
        printable(course.task),
        count(course.attempts(), "attempt"),
        count(course.trainees.len(), "trainee"),
        count(course.experts.len(), "session") + " of experts"
    )
}

/// The progress of a trainee.
pub(super) fn standing(trainee: &Trainee<'_>) -> String {
    match trainee.proficient_since {
        Some(number) => format!("proficient since attempt {number}"),
        None => "not proficient yet".to_owned(),
    }
}

fn attempts(trainee: &Trainee<'_>) -> Vec<Vec<String>> {
    let head = [
        "attempt",
        "date (UTC)",
        "time [s]",
        "errors",
        "passed",
        "proficient",
        "measures",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (number, own) in (1..).zip(&trainee.attempts) {
        rows.push(vec![
            format!("{number}"),
            date::short(own.attempt.when),
            shown(own.time()),
            shown(own.errors()),
            truth(own.attempt.passed),
            truth(own.judgement.proficient),
            proficient(own),
        ]);
    }
    rows
}

/// How many measures are proficient, of how many.
pub(super) fn proficient(made: &JudgedAttempt<'_>) -> String {
    match made.proficient() {
        (_, 0) => NONE.to_owned(),
        (proficient, judged) => format!("{proficient} of {judged}"),
    }
}

fn means(course: &LearningCurve<'_>) -> Vec<Vec<String>> {
    let head = ["attempt", "trainees", "time [s]", "±", "errors", "±"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let errors = course.curve(CurveQuantity::Errors);
    for point in course.curve(CurveQuantity::Time) {
        let errors = errors.iter().find(|own| own.attempt == point.attempt);
        let errors = errors.map(|own| own.spread);
        rows.push(vec![
            point.attempt.to_string(),
            point.spread.count.to_string(),
            shown(Some(point.spread.mean)),
            shown(point.spread.standard_deviation),
            shown(errors.map(|own| own.mean)),
            shown(errors.and_then(|own| own.standard_deviation)),
        ]);
    }
    rows
}

/// The latest attempt compared with the experts, measure by measure.
fn comparison(course: &LearningCurve<'_>, trainee: &Trainee<'_>) -> String {
    let Some(last) = trainee.attempts.last() else {
        return String::new();
    };
    if course.standards.each.is_empty() {
        return String::new();
    }
    let head = ["measure", "value", "experts", "proficient"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (standard, judged) in course.standards.each.iter().zip(&last.judgement.measures) {
        let (key, spread) = (&standard.key, standard.spread);
        rows.push(vec![
            printable(key).into_owned(),
            valued(key, judged.value),
            quantity(key, spread.mean, spread.standard_deviation),
            truth(judged.proficient),
        ]);
    }
    let (name, number) = (printable(trainee.name), trainee.attempts.len());
    format!("\n  {name}, attempt {number} compared with the experts\n") + &columns(&rows)
}

/// A number without its unit.
pub(super) fn shown(value: Option<f64>) -> String {
    value.map_or(NONE.to_owned(), number)
}

/// The value of a measure, with its unit; counts are whole.
pub(super) fn valued(key: &str, value: Option<f64>) -> String {
    match value {
        Some(value) if unit(key, value).unit.is_empty() => shown(Some(value)),
        Some(value) => quantity(key, value, None),
        None => NONE.to_owned(),
    }
}

pub(super) fn truth(is: Option<bool>) -> String {
    let word = match is {
        Some(true) => "yes",
        Some(false) => "no",
        None => NONE,
    };
    word.to_owned()
}

/// Rows under one another, every column as wide as its widest text.
fn columns(rows: &[Vec<String>]) -> String {
    let width = |place: usize| {
        let cells = rows.iter().filter_map(|row| row.get(place));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..rows.first().map_or(0, Vec::len)).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths);
        let cells = cells.map(|(cell, width)| format!("  {cell:>width$}"));
        format!("  {}\n", cells.collect::<String>())
    };
    rows.iter().map(line).collect()
}
