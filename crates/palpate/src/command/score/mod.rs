//! `palpate score`: the measures of a session, compared with an expert's.

mod answer;
mod table;

use std::path::{Path, PathBuf};

use clap::Args;
use palpate_files::Scene;
use palpate_files::scene::Task;
use palpate_record::Record;
use palpate_simulate::performance::{Standard, compare};
use palpate_simulate::{SessionFolder, read_experts};

use crate::failure::Failure;
use crate::output;
use crate::training::{self, Author};
use answer::Answer;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate score session
      time, path length, rotation, economy of motion, smoothness, forces, errors, and the task's result
  palpate score session --expert expert --json
      the same, compared with an expert's session, or with mean and standard deviation of a folder
      of sessions
  palpate score session --trainee Anna
      also saves the score; `palpate progress` shows Anna's progress

The folder contains session.csv, and scene.toml if there was a task. Each measure is defined, with its formula \
and its reference, in docs/theory/performance.md.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The session's folder, or its file.
    #[arg(value_name = "SESSION_DIR")]
    session: PathBuf,
    /// An expert's session, or a folder of several; default: the task's.
    #[arg(long, value_name = "DIR")]
    expert: Option<PathBuf>,
    /// The scene with the task, if it is not in the session's folder.
    #[arg(long, value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Save the score in the training record, for this trainee.
    #[arg(long, value_name = "NAME")]
    trainee: Option<String>,
    /// With --trainee: mark this session, which must be passed, as an expert's; a teacher's option.
    #[arg(long, requires = "trainee")]
    as_expert: bool,
    /// With --as-expert: the teacher's PIN, if the record has one.
    #[arg(long, requires = "as_expert")]
    pin: Option<String>,
    /// With --trainee: also save an incomplete session.
    #[arg(long, requires = "trainee")]
    incomplete: bool,
    /// With --trainee: the training record; default: the one in your data folder.
    #[arg(long, value_name = "FILE.sqlite", requires = "trainee")]
    record: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Measures a session.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = SessionFolder::read(&arguments.session)?;
    let task = match &arguments.scene {
        Some(path) => Scene::read(path)?.task,
        None => folder.task(),
    };
    let score = folder.score(&task);
    let mut warnings = warnings(&folder);
    let standards = match arguments.expert.as_deref().or(task.expert.as_deref()) {
        Some(path) => {
            let experts = experts(path, &folder, arguments.expert.is_some(), &mut warnings)?;
            standards(&experts, &task, &folder, &mut warnings)
        }
        None => Vec::new(),
    };
    let compared = compare(&score, &standards);
    let is_refused = folder.session.incomplete.is_some() && !arguments.incomplete;
    if let Some(trainee) = arguments.trainee.as_ref().filter(|_| !is_refused) {
        let file = training::record_file(arguments.record.as_deref())?;
        if arguments.as_expert {
            if score.outcome.passed() == Some(false) {
                return Err(Failure::input(format!(
                    "{}: the task was not passed, so it is no standard; leave --as-expert out",
                    arguments.session.display()
                )));
            }
            if file.exists() {
                Record::read(&file)?.check_pin(arguments.pin.as_deref())?;
            }
        }
        let author = Author {
            trainee,
            is_expert: arguments.as_expert,
        };
        warnings.extend(training::save_score(&file, author, &folder, &task, &score)?);
    }
    let answer = Answer::new(&arguments.session, &task, &score, &compared, warnings);
    if arguments.json {
        output::json(&answer)?;
    } else {
        output::text(table::text(&task, &score, &compared))?;
        output::warnings(&answer.warnings);
    }
    match arguments.trainee.is_some() && is_refused {
        true => Err(Failure::input(format!(
            "{}: the session is incomplete, so its score is not added to the record; --incomplete adds it",
            arguments.session.display()
        ))),
        false => Ok(()),
    }
}

/// The experts' sessions without the judged one: its presence is an error where `--expert` names them, and a warning
/// where the task does.
fn experts(
    path: &Path,
    own: &SessionFolder,
    is_named: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<SessionFolder>, Failure> {
    let mut experts = read_experts(path)?;
    let count = experts.len();
    experts.retain(|expert| !expert.is_same(own));
    let path = path.display();
    let judged = own.path.display();
    if experts.len() < count && is_named {
        return Err(Failure::input(format!(
            "{judged} is among the experts of {path} and would be judged against itself; name other sessions with \
             --expert"
        )));
    }
    if experts.len() < count {
        warnings.push(format!(
            "{judged} is among the experts of {path}, and is not judged against itself"
        ));
    }
    let incomplete = experts.iter().flat_map(SessionFolder::warnings);
    warnings.extend(incomplete.map(|warning| format!("an expert's session, {warning}")));
    Ok(experts)
}

/// The values of the experts in this task.
fn standards(
    experts: &[SessionFolder],
    task: &Task,
    own: &SessionFolder,
    warnings: &mut Vec<String>,
) -> Vec<Standard> {
    let other = |expert: &&SessionFolder| expert.is_of_other_scene(own) == Some(true);
    if let Some(expert) = experts.iter().find(other) {
        warnings.push(format!(
            "{} is a session of another scene; its measures are of another task",
            expert.path.display()
        ));
    }
    let scores: Vec<_> = experts.iter().map(|expert| expert.score(task)).collect();
    if let [_] = scores.as_slice() {
        warnings.push(
            "a single expert session has no standard deviation; proficiency needs two or more"
                .to_owned(),
        );
    }
    Standard::of(&scores)
}

fn warnings(folder: &SessionFolder) -> Vec<String> {
    let mut warnings = folder.warnings();
    if folder.session.rows.is_empty() {
        warnings.push("the session has no row: nothing was done".to_owned());
    }
    if folder.scene.is_none() {
        warnings.push(
            "there is no scene.toml beside the session: its task and its force limit are not known; \
             name them with --scene"
                .to_owned(),
        );
    }
    warnings
}
