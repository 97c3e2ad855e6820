//! What a window needs to know of a training, and where it gives the results.

use std::path::PathBuf;

use palpate_files::Scene;
use palpate_files::scene::Task;
use palpate_simulate::performance::Score;

/// What a window needs to train somebody.
pub struct Training {
    /// The tasks to choose from: scenes with a title.
    pub tasks: Vec<Scene>,
    /// What is touched without a task.
    pub free: Scene,
    /// The folder in which sessions are kept.
    pub sessions: PathBuf,
    /// Who trains.
    pub trainee: String,
    /// Where results are kept.
    pub record: Box<dyn TrainingRecord>,
}

/// Where results are kept.
pub trait TrainingRecord {
    /// The folder for a new session of a task, which is not there yet.
    fn new_session(&self, task: &Task) -> PathBuf;

    /// Keeps a result; what went wrong, in a sentence.
    ///
    /// # Errors
    /// When it cannot be kept.
    fn keep(&mut self, result: &TrainingResult<'_>) -> Result<(), String>;

    /// The results of a trainee, the last one last.
    ///
    /// # Errors
    /// When they cannot be read; in a sentence.
    fn results(&self, trainee: &str) -> Result<Vec<PastResult>, String>;
}

/// How somebody has just done a task.
pub struct TrainingResult<'a> {
    /// Who.
    pub trainee: &'a str,
    /// The scene of the task.
    pub scene: &'a Scene,
    /// The folder of the session.
    pub session: &'a std::path::Path,
    /// How it was done.
    pub score: &'a Score,
}

/// How somebody once did a task.
#[derive(Debug, Clone, PartialEq)]
pub struct PastResult {
    /// The title of the task.
    pub task: String,
    /// When, for people.
    pub date: String,
    /// Whether it was done as it should be; none where nothing had to be.
    pub passed: Option<bool>,
    /// How long it took [s].
    pub time: f64,
    /// Errors in all.
    pub errors: u64,
    /// The folder of the session, to look at it again.
    pub session: PathBuf,
}
