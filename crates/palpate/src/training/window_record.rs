use std::path::{Path, PathBuf};

use palpate_files::scene::Task;
use palpate_record::{Added, Assignment, Attempt, Filter, Record};
use palpate_simulate::SessionFolder;
use palpate_simulate::performance::Score;
use palpate_viewer::training::{Assigned, Class, NewAssignment, PastResult, TrainingResult};

use super::TrainingRecord;
use super::record::{measures, record_file};
use crate::date;
use crate::failure::Failure;

/// The title of a task without one.
const UNTITLED: &str = "without a title";

/// The training record, as a window uses it. Each use opens it anew, because other programs may use it, too.
pub(super) struct WindowRecord {
    file: PathBuf,
    sessions: PathBuf,
}

/// The author of an attempt.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Author<'a> {
    pub(crate) trainee: &'a str,
    pub(crate) is_expert: bool,
}

/// Separates the digest of a scene from the seed of its variant.
pub(crate) const VARIANT: &str = ", variant ";

/// The scene's digest, with the seed where the task draws its numbers.
fn scene_digest(folder: &SessionFolder) -> String {
    let digest = &folder.session.header.scene_digest;
    match folder
        .scene
        .as_ref()
        .and_then(|scene| scene.variant.as_ref())
    {
        Some(variant) => format!("{digest}{VARIANT}{}", variant.seed),
        None => digest.clone(),
    }
}

/// Saves the score of a session in the record; returns warnings.
pub(crate) fn save_score(
    file: &Path,
    author: Author<'_>,
    folder: &SessionFolder,
    task: &Task,
    score: &Score,
) -> Result<Vec<String>, palpate_record::Error> {
    let mut record = Record::open(file)?;
    let session = &folder.path;
    let added = record.add(&Attempt {
        trainee: author.trainee.to_owned(),
        task: task.title.clone().unwrap_or_else(|| UNTITLED.to_owned()),
        scene_digest: scene_digest(folder),
        when: folder.when().unwrap_or_else(super::now),
        session: std::path::absolute(session).unwrap_or_else(|_| session.clone()),
        session_digest: folder.session.digest(),
        passed: score.outcome.passed(),
        is_expert: author.is_expert,
        measures: measures(score),
    })?;
    let mut warnings = record.warnings().to_vec();
    let session = session.display();
    match added {
        Added::New => {}
        Added::AlreadyThere => warnings.push(format!(
            "{session}: this attempt of {} is in the training record already; it counts once, and the record is as \
             it was",
            author.trainee
        )),
        Added::SameSession { trainee, when } => warnings.push(format!(
            "{session}: the same session, to the last bit, is in the training record as an attempt of {trainee} at \
             {}; both are kept",
            date::exact(when)
        )),
    }
    Ok(warnings)
}

impl WindowRecord {
    pub(super) fn new(folder: &Path) -> Result<Self, Failure> {
        Ok(Self {
            file: record_file(None)?,
            sessions: folder.join("sessions"),
        })
    }

    /// The trainee of the last attempt.
    pub(super) fn last_trainee(&self) -> Option<String> {
        let attempts = self.attempts(None).ok()?;
        attempts.last().map(|last| last.trainee.clone())
    }

    fn attempts(&self, trainee: Option<&str>) -> Result<Vec<Attempt>, palpate_record::Error> {
        if !self.file.exists() {
            return Ok(Vec::new());
        }
        Record::read(&self.file)?.attempts(&Filter {
            trainee: trainee.map(str::to_owned),
            task: None,
        })
    }
}

impl TrainingRecord for WindowRecord {
    fn new_session(&self, task: &Task) -> PathBuf {
        let plain = |letter: char| match letter.is_ascii_alphanumeric() {
            true => letter.to_ascii_lowercase(),
            false => '-',
        };
        let title: String = task
            .title
            .as_deref()
            .unwrap_or("session")
            .chars()
            .map(plain)
            .collect();
        let date = date::exact(super::now()).replace(':', "-");
        let name = format!("{date}-{title}");
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let mut names = std::iter::once(name.clone()).chain(numbered);
        let free = names.find(|name| !self.sessions.join(name).exists());
        self.sessions.join(free.unwrap_or(name))
    }

    fn keep(&mut self, result: &TrainingResult<'_>) -> Result<(), String> {
        let author = Author {
            trainee: result.trainee,
            is_expert: false,
        };
        let folder = SessionFolder::read(result.session).map_err(|error| error.to_string())?;
        let saved = save_score(
            &self.file,
            author,
            &folder,
            &result.scene.task,
            result.score,
        );
        match saved.map_err(|error| error.to_string())?.as_slice() {
            [] => Ok(()),
            warnings => Err(warnings.join(" ")),
        }
    }

    fn assigned(&self, trainee: &str) -> Result<Vec<Assigned>, String> {
        if !self.file.exists() {
            return Ok(Vec::new());
        }
        let read = || -> Result<Vec<Assigned>, palpate_record::Error> {
            let record = Record::read(&self.file)?;
            let cohorts = record.cohorts()?;
            let attempts = self.attempts(Some(trainee))?;
            let is_in = |cohort: &str| {
                let mut own = cohorts.iter().filter(|own| own.name == cohort);
                own.any(|own| own.trainees.iter().any(|name| name == trainee))
            };
            let given = record.assignments()?.into_iter();
            let given = given.filter(|given| is_in(&given.cohort));
            let assigned = given.map(|given| Assigned {
                due: date::short(given.due),
                passed: given.standing(attempts.iter()).passed,
                passes: given.passes as usize,
                is_over: super::now() > given.due,
                task: given.task,
            });
            Ok(assigned.collect())
        };
        read().map_err(|error| error.to_string())
    }

    fn class(&self) -> Result<Class, String> {
        if !self.file.exists() {
            return Ok(Class::default());
        }
        let record = Record::read(&self.file).map_err(|error| error.to_string())?;
        crate::command::progress::class(&record).map_err(|error| error.to_string())
    }

    fn assign(&mut self, given: &NewAssignment) -> Result<(), String> {
        let due = date::end_of_day(&given.due)
            .ok_or_else(|| format!("`{}` is no day; give one, such as 2026-12-24", given.due))?;
        let assign = || -> Result<(), palpate_record::Error> {
            let mut record = Record::open(&self.file)?;
            record.check_pin(Some(given.pin.as_str()))?;
            let cohorts = record.cohorts()?;
            // A trainee alone is a cohort of that name.
            if !cohorts.iter().any(|own| own.name == given.to) {
                record.join(&given.to, std::slice::from_ref(&given.to))?;
            }
            record.assign(&Assignment {
                cohort: given.to.clone(),
                task: given.task.clone(),
                due,
                passes: given.passes,
            })
        };
        assign().map_err(|error| error.to_string())
    }

    fn results(&self, trainee: &str) -> Result<Vec<PastResult>, String> {
        let attempts = self
            .attempts(Some(trainee))
            .map_err(|error| error.to_string())?;
        let errors = |attempt: &Attempt| {
            let counts = crate::command::progress::ERRORS.iter();
            counts.filter_map(|key| attempt.value(key)).sum::<f64>() as u64
        };
        let result = |attempt: &Attempt| PastResult {
            task: attempt.task.clone(),
            date: date::short(attempt.when),
            passed: attempt.passed,
            time: attempt.value(crate::command::progress::TIME).unwrap_or(0.0),
            errors: errors(attempt),
            session: attempt.session.clone(),
        };
        Ok(attempts.iter().map(result).collect())
    }
}
