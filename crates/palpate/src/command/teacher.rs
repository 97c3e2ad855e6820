//! `palpate teacher`: cohorts, assignments, and experts' sessions.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use palpate_files::printable;
use palpate_record::{Assignment, Cohort, Filter, Record};
use palpate_simulate::SessionFolder;
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{self, VERSION};
use crate::{date, training};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate teacher cohort spring --add Anna --add Carla
      Anna and Carla belong to the cohort spring
  palpate teacher assign spring Palpation --due 2026-12-24 --passes 2
      both must pass the task twice by the end of that day (UTC)
  palpate teacher show
      shows everybody's standing
  palpate teacher expert sessions/2026-11-25-myotomy --trainee Carla
      compares others with this passed attempt, which stays Carla's
  palpate teacher pin 4711
      these commands then require --pin 4711

The PIN prevents mistakes only. It does not protect the data: anyone who can write the record's file can change it.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: What,
    /// The training record; default: the one in your data folder.
    #[arg(long, value_name = "FILE.sqlite", global = true)]
    record: Option<PathBuf>,
    /// The teacher's PIN, if the record has one.
    #[arg(long, global = true)]
    pin: Option<String>,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Show assignments and each trainee's standing.
    Show {
        /// Print one JSON object.
        #[arg(long)]
        json: bool,
    },
    #[command(flatten)]
    Change(Change),
}

/// What changes the record.
#[derive(Debug, Subcommand)]
enum Change {
    /// Add trainees to a cohort, or remove them.
    Cohort {
        /// The cohort.
        name: String,
        /// A trainee to add.
        #[arg(long, value_name = "TRAINEE")]
        add: Vec<String>,
        /// A trainee to remove; their attempts stay.
        #[arg(long, value_name = "TRAINEE")]
        remove: Vec<String>,
    },
    /// Assign a task to a cohort, with a due date.
    Assign {
        /// The cohort.
        cohort: String,
        /// The title of the task.
        task: String,
        /// The due date, such as 2026-12-24.
        #[arg(long, value_name = "DATE")]
        due: String,
        /// Number of passed attempts required.
        #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
        passes: u32,
    },
    /// Mark a passed attempt as an expert's, for comparison.
    Expert {
        /// The session's folder.
        session: PathBuf,
        /// Whose attempt it is.
        #[arg(long, value_name = "NAME")]
        trainee: String,
    },
    /// Set or change the teacher's PIN.
    Pin {
        /// The new PIN.
        new: String,
    },
}

/// The answer that `show --json` prints.
#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    record: PathBuf,
    cohorts: Vec<Cohort>,
    assignments: Vec<AssignmentAnswer>,
}

#[derive(Debug, Serialize)]
pub(super) struct AssignmentAnswer {
    pub(super) cohort: String,
    pub(super) task: String,
    pub(super) due_unix_s: i64,
    due_utc: String,
    pub(super) passes: u32,
    pub(super) trainees: Vec<StandingAnswer>,
}

#[derive(Debug, Serialize)]
pub(super) struct StandingAnswer {
    pub(super) trainee: String,
    pub(super) attempts: usize,
    pub(super) passed: usize,
    /// `done`, `open` or `late`.
    pub(super) standing: &'static str,
}

/// Runs the subcommand.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = training::record_file(arguments.record.as_deref())?;
    match &arguments.what {
        What::Show { json } => {
            let answer = answer(&Record::read(&file)?)?;
            match json {
                true => output::json(&answer),
                false => output::text(text(&answer)),
            }
        }
        What::Change(wanted) => {
            let done = change(wanted, &file, arguments.pin.as_deref())?;
            output::line(done)
        }
    }
}

fn change(wanted: &Change, file: &Path, pin: Option<&str>) -> Result<String, Failure> {
    let mut record = Record::open(file)?;
    record.check_pin(pin)?;
    output::warnings(record.warnings());
    Ok(match wanted {
        Change::Cohort { name, add, remove } => {
            record.join(name, add)?;
            record.leave(name, remove)?;
            let cohorts = record.cohorts()?;
            let own = cohorts.iter().find(|own| own.name == name.trim());
            let trainees = own.map_or(String::new(), |own| own.trainees.join(", "));
            format!("{}: {}", printable(name), printable(&trainees))
        }
        Change::Assign {
            cohort,
            task,
            due,
            passes,
        } => {
            let end = date::end_of_day(due).ok_or_else(|| {
                Failure::input(format!("`{due}` is no day; give one, such as 2026-12-24"))
            })?;
            record.assign(&Assignment {
                cohort: cohort.clone(),
                task: task.clone(),
                due: end,
                passes: *passes,
            })?;
            format!(
                "{}: {} is due by {}",
                printable(cohort),
                printable(task),
                date::short(end)
            )
        }
        Change::Expert { session, trainee } => {
            let folder = SessionFolder::read(session)?;
            record.make_expert(trainee, &folder.session.digest())?;
            format!(
                "others are judged by this attempt of {}, too",
                printable(trainee)
            )
        }
        Change::Pin { new } => {
            record.set_pin(new)?;
            "the PIN is set; it guards against mistakes, not against people who may write the file"
                .to_owned()
        }
    })
}

fn answer(record: &Record) -> Result<Answer, Failure> {
    Ok(Answer {
        palpate: VERSION,
        record: record.path().to_owned(),
        cohorts: record.cohorts()?,
        assignments: standings(record)?,
    })
}

/// Each assignment, and the progress of each trainee of its cohort.
pub(super) fn standings(record: &Record) -> Result<Vec<AssignmentAnswer>, Failure> {
    let (cohorts, attempts) = (record.cohorts()?, record.attempts(&Filter::default())?);
    let now = training::now();
    let standing = |given: &Assignment, trainee: &String| {
        let own = attempts.iter().filter(|own| own.trainee == *trainee);
        let found = given.standing(own);
        StandingAnswer {
            trainee: trainee.clone(),
            attempts: found.attempts,
            passed: found.passed,
            standing: match found.is_done {
                true => "done",
                false if now <= given.due => "open",
                false => "late",
            },
        }
    };
    let assignments = record.assignments()?.into_iter().map(|given| {
        let cohort = cohorts.iter().find(|own| own.name == given.cohort);
        let trainees = cohort.iter().flat_map(|own| &own.trainees);
        AssignmentAnswer {
            trainees: trainees.map(|own| standing(&given, own)).collect(),
            due_unix_s: given.due,
            due_utc: date::exact(given.due),
            passes: given.passes,
            cohort: given.cohort,
            task: given.task,
        }
    });
    Ok(assignments.collect())
}

fn text(answer: &Answer) -> String {
    let mut lines = Vec::new();
    for cohort in &answer.cohorts {
        let names: Vec<_> = cohort.trainees.iter().map(|own| printable(own)).collect();
        lines.push(format!("{}: {}", printable(&cohort.name), names.join(", ")));
    }
    if answer.cohorts.is_empty() {
        lines.push(
            "no cohort yet; `palpate teacher cohort NAME --add TRAINEE` begins one".to_owned(),
        );
    }
    for given in &answer.assignments {
        lines.push(format!(
            "\n{}, {}: pass {} times by {}",
            printable(&given.task),
            printable(&given.cohort),
            given.passes,
            date::short(given.due_unix_s)
        ));
        for own in &given.trainees {
            lines.push(format!(
                "  {:24} {:5} passed {} of {} attempts",
                printable(&own.trainee),
                own.standing,
                own.passed,
                own.attempts
            ));
        }
    }
    lines.join("\n")
}
