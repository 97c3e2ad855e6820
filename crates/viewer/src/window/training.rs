//! Data of a training for the window, and the receiver of the results.

use std::io::Cursor;
use std::path::PathBuf;

use image::ImageFormat;
use palpate_files::Scene;
use palpate_files::scene::Task;
use palpate_simulate::performance::Score;

/// Data of a training.
pub struct Training {
    /// The tasks to choose from: scenes with a title.
    pub tasks: Vec<OfferedTask>,
    /// The scene without a task.
    pub free: Scene,
    /// The folder of sessions.
    pub sessions: PathBuf,
    /// The trainee.
    pub trainee: String,
    /// The store of results.
    pub record: Box<dyn TrainingRecord>,
}

/// A task of the start screen.
pub struct OfferedTask {
    /// Its scene.
    pub scene: Scene,
    /// A picture of it; none where there is none.
    pub picture: Option<TaskPicture>,
}

/// A picture of a task.
pub struct TaskPicture {
    /// Rows of pixels from the top, each red, green, blue and how opaque it is.
    pub(super) pixels: Vec<u8>,
    /// Across and down [pixels].
    pub(super) size: [u32; 2],
}

impl TaskPicture {
    /// No picture is larger, across or down [pixels].
    const LARGEST: u32 = 4096;

    /// From the bytes of a PNG file.
    ///
    /// # Errors
    /// When they are no picture, or too large a one; in a sentence without the name of the file.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = image::ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
        let mut limits = image::Limits::default();
        limits.max_image_width = Some(Self::LARGEST);
        limits.max_image_height = Some(Self::LARGEST);
        reader.limits(limits);
        let picture = reader.decode().map_err(|cause| {
            format!(
                "it is no PNG picture of at most {0} by {0} pixels ({cause}); save it as one",
                Self::LARGEST
            )
        })?;
        let picture = picture.into_rgba8();
        Ok(Self {
            size: [picture.width(), picture.height()],
            pixels: picture.into_raw(),
        })
    }
}

/// The store of results.
pub trait TrainingRecord {
    /// The folder for a new session of a task, which does not exist yet.
    fn new_session(&self, task: &Task) -> PathBuf;

    /// Stores a result.
    ///
    /// # Errors
    /// When it cannot be stored; in a sentence.
    fn keep(&mut self, result: &TrainingResult<'_>) -> Result<(), String>;

    /// Assignments of a trainee, the first due first.
    ///
    /// # Errors
    /// When it cannot be read; in a sentence.
    fn assigned(&self, trainee: &str) -> Result<Vec<Assigned>, String>;

    /// All trainees, for a teacher.
    ///
    /// # Errors
    /// When they cannot be read; in a sentence.
    fn class(&self) -> Result<Class, String>;

    /// Gives a cohort or a trainee something to do.
    ///
    /// # Errors
    /// When the PIN is wrong, the date is none, or it cannot be stored; in a sentence.
    fn assign(&mut self, given: &NewAssignment) -> Result<(), String>;

    /// The results of a trainee, the last one last.
    ///
    /// # Errors
    /// When they cannot be read; in a sentence.
    fn results(&self, trainee: &str) -> Result<Vec<PastResult>, String>;
}

/// An assignment by a teacher.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct NewAssignment {
    /// The cohort or trainee.
    pub to: String,
    /// The title of the task.
    pub task: String,
    /// The day until whose end it is to be done, such as 2026-12-24.
    pub due: String,
    /// Passed attempts that are needed.
    pub passes: u32,
    /// The teacher's PIN; empty without one.
    pub pin: String,
}

/// All trainees, for a teacher.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Class {
    /// Cohorts and trainees, to whom something can be given to do.
    pub assignees: Vec<String>,
    /// Assignments of cohorts, the first due first.
    pub assignments: Vec<AssignedTask>,
    /// Each task that was attempted.
    pub tasks: Vec<TaskProgress>,
}

/// An assignment of a cohort.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AssignedTask {
    /// The cohort.
    pub cohort: String,
    /// The title of the task.
    pub task: String,
    /// Until when, for people.
    pub due: String,
    /// Passed attempts that are needed.
    pub passes: u32,
    /// How far each trainee is.
    pub trainees: Vec<TraineeStanding>,
}

/// How far a trainee is with an assignment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TraineeStanding {
    /// Who.
    pub trainee: String,
    /// Attempts at the task.
    pub attempts: usize,
    /// Passed attempts until it was due.
    pub passed: usize,
    /// Whether that is enough.
    pub standing: StandingWord,
}

/// Whether somebody has done an assignment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StandingWord {
    /// Passed often enough, in time.
    Done,
    /// There is time.
    Open,
    /// There is no more time.
    Late,
}

/// Progress of all trainees in a task.
#[derive(Debug, Clone, PartialEq)]
pub struct TaskProgress {
    /// The title of the task.
    pub task: String,
    /// Each trainee.
    pub trainees: Vec<TraineeProgress>,
    /// Number of the attempt, counted from one, and the mean time of the trainees who made it [s].
    pub mean_times: Vec<[f64; 2]>,
    /// The mean time of the experts [s].
    pub expert_time: Option<f64>,
}

/// Progress of a trainee in a task.
#[derive(Debug, Clone, PartialEq)]
pub struct TraineeProgress {
    /// Who.
    pub trainee: String,
    /// Attempts.
    pub attempts: usize,
    /// Passed attempts.
    pub passed: usize,
    /// The attempt since which they are proficient, counted from one.
    pub proficient_since: Option<usize>,
    /// Number of the attempt, counted from one, and its time [s].
    pub times: Vec<[f64; 2]>,
}

/// An assignment of a trainee.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assigned {
    /// The title of the task.
    pub task: String,
    /// Until when, for people.
    pub due: String,
    /// Passed attempts until then.
    pub passed: usize,
    /// Passed attempts that are needed.
    pub passes: usize,
    /// Whether the time is over.
    pub is_over: bool,
}

/// A new result.
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

/// A stored result.
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
