//! `palpate progress`: trainees' progress, from the training record.

mod anonymous;
mod answer;
mod class;
mod curves;
mod export;
mod learning_curves;
mod report;
mod table;
mod xapi;

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use palpate_files::write_atomically;
use palpate_record::{Filter, IN_A_ROW, Record};

use self::answer::Answer;
pub(crate) use self::class::class;
use self::learning_curves::LearningCurve;
pub(crate) use self::learning_curves::{ERRORS, TIME};
use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use palpate_jobs::nearest;

use crate::{output, training};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate progress
      attempts of all trainees at all tasks, and who is proficient
  palpate progress --trainee Anna --task 'Find the stiff spot'
      one trainee at one task
  palpate progress --report progress.html
      the same as an HTML report with learning curves
  palpate progress --cohort spring --anonymous --xapi statements.json
      a cohort without names, as statements for a learning record store
  palpate progress --csv attempts.csv
      one row per measure and attempt, for statistics software

A measure is proficient if it is at most one standard deviation worse than the experts' mean. A trainee is proficient \
after two consecutive attempts without failure that are proficient in as many measures as the experts themselves on \
average. Dates are in UTC.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Only this trainee.
    #[arg(long, value_name = "NAME")]
    trainee: Option<String>,
    /// Only this task.
    #[arg(long, value_name = "TITLE")]
    task: Option<String>,
    /// The training record; default: the one in your data folder.
    #[arg(long, value_name = "FILE.sqlite")]
    record: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Write a CSV table with one row per measure and attempt.
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Write statements of the Experience API (xAPI), for a learning record store.
    #[arg(long, value_name = "FILE.json")]
    xapi: Option<PathBuf>,
    /// Only the trainees of this cohort (`palpate teacher cohort`).
    #[arg(long, value_name = "NAME")]
    cohort: Option<String>,
    /// Replace names by numbers and dates by times since each trainee's first attempt; leave out sessions.
    #[arg(long, conflicts_with = "trainee")]
    anonymous: bool,
    /// Write an HTML report with learning curves.
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Reads the record and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = training::record_file(arguments.record.as_deref())?;
    let files = || {
        let tables = arguments.csv.iter().chain(&arguments.report);
        tables.chain(&arguments.xapi)
    };
    for written in files() {
        if is_same(written, &file) {
            let file = written.display();
            return Err(Failure::input(format!(
                "{file} is the training record itself; write to another file"
            )));
        }
    }
    let _claims = arguments.overwrite.claim(files())?;
    let record = Record::read(&file)?;
    let trainee = known("trainee", &arguments.trainee, &record.trainees()?)?;
    let task = known("task", &arguments.task, &record.tasks()?)?;
    // Of all trainees, because experts are among them.
    let mut attempts = record.attempts(&Filter {
        trainee: None,
        task,
    })?;
    let cohorts = record.cohorts()?;
    let names: Vec<String> = cohorts.iter().map(|own| own.name.clone()).collect();
    if let Some(name) = known("cohort", &arguments.cohort, &names)? {
        let cohort = cohorts.into_iter().find(|own| own.name == name);
        let trainees = cohort.map_or(Vec::new(), |own| own.trainees);
        attempts.retain(|own| own.is_expert || trainees.contains(&own.trainee));
    }
    if arguments.anonymous {
        anonymous::anonymous(&mut attempts);
    }
    let courses = LearningCurve::all(&attempts, trainee.as_deref());
    let answer = Answer::new(record.path(), &courses);
    if let Some(table) = &arguments.csv {
        write_atomically(table, export::csv(&courses)?.as_bytes())?;
    }
    if let Some(statements) = &arguments.xapi {
        let text = output::json_text(&xapi::statements(&courses))?;
        write_atomically(statements, text.as_bytes())?;
    }
    if let Some(page) = &arguments.report {
        let html = report::html(
            &courses,
            &answer.warnings,
            &settings(arguments, record.path()),
        );
        write_atomically(page, html.as_bytes())?;
    }
    if arguments.json {
        return output::json(&answer);
    }
    let asked = arguments.trainee.is_some() || arguments.task.is_some();
    output::text(table::of(&courses, record.path(), asked))?;
    for written in files() {
        output::line(format!("written: {}", written.display()))?;
    }
    output::warnings(&answer.warnings);
    Ok(())
}

/// The criterion for proficiency, in words.
fn rule() -> String {
    format!(
        "A measure is proficient when it is not worse than the mean of the experts' sessions by more than one \
         standard deviation. A trainee is proficient after {IN_A_ROW} attempts in a row that did not fail and are \
         proficient in as many measures as the experts themselves on average."
    )
}

/// The requested name, if the record has it.
fn known(what: &str, asked: &Option<String>, names: &[String]) -> Result<Option<String>, Failure> {
    let Some(asked) = asked else {
        return Ok(None);
    };
    if names.contains(asked) {
        return Ok(Some(asked.clone()));
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Err(Failure::input(match names.is_empty() {
        true => {
            format!("the record has no {what} `{asked}`, for it is empty; leave `--{what}` out")
        }
        false => format!(
            "the record has no {what} `{asked}`; the nearest is `{}`",
            nearest(asked, &names)
        ),
    }))
}

/// Whether two paths lead to the same file.
fn is_same(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(fs::canonicalize);
    one.is_ok_and(|one| other.is_ok_and(|other| one == other))
}

/// The options of the command, for a page.
fn settings(arguments: &Arguments, record: &Path) -> Vec<(String, String)> {
    let asked = [
        ("--record", Some(record.display().to_string())),
        ("--trainee", arguments.trainee.clone()),
        ("--task", arguments.task.clone()),
    ];
    let asked = asked.into_iter();
    asked
        .filter_map(|(name, value)| Some((name.to_owned(), value?)))
        .collect()
}
