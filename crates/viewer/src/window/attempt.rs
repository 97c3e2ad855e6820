//! A task that is attempted: from reading what there is to do to how it was done.

use std::path::{Path, PathBuf};

use palpate_files::scene::{Goal, Task};
use palpate_files::session::{Event, SessionRow};
use palpate_files::{Claim, Overwrite};
use palpate_simulate::performance::{
    Comparison, Errors, Performance, Score, Standard, Status, compare,
};
use palpate_simulate::{Guidance, SessionFolder, Tutor, read_experts};

use super::play::Play;

/// A task that is attempted.
pub(super) struct Attempt {
    pub(super) task: Task,
    pub(super) phase: Phase,
    performance: Performance,
    /// Whether the first row of the attempt has come.
    has_begun: bool,
    standards: Vec<Standard>,
    tutor: Option<Tutor>,
    pub(super) guidance: Option<Guidance>,
    /// What went wrong beside the touch.
    pub(super) trouble: Option<String>,
    /// The recording, where it cannot be written.
    pub(super) unsaved: Option<Unsaved>,
}

/// A recording that cannot be written where it was to be; its rows are in memory.
pub(super) struct Unsaved {
    /// Why, in a sentence.
    pub(super) cause: String,
    /// The folder where it shall be written instead, as it is typed.
    pub(super) elsewhere: String,
    /// Why it cannot be written there either.
    pub(super) trouble: Option<String>,
}

impl Unsaved {
    /// Of a session that was to be in `folder`; the same name where the program was started is suggested.
    fn new(folder: Option<PathBuf>, cause: String) -> Self {
        let name = folder.as_deref().and_then(Path::file_name);
        let here = std::env::current_dir().unwrap_or_default();
        Self {
            cause,
            elsewhere: here.join(name.unwrap_or_default()).display().to_string(),
            trouble: None,
        }
    }
}

/// How far an attempt is.
pub(super) enum Phase {
    /// The trainee reads.
    Reads,
    /// It goes on, and is recorded in a folder, if anywhere.
    GoesOn(Option<PathBuf>),
    /// It is over.
    Over(Box<Done>),
}

/// How it was done.
pub(super) struct Done {
    pub(super) score: Score,
    pub(super) compared: Vec<Comparison>,
    /// Because its time was over.
    pub(super) late: bool,
    /// Where it was recorded.
    pub(super) folder: Option<PathBuf>,
}

impl Attempt {
    /// Of a scene's task. An expert's sessions that cannot be read are told and left out.
    pub(super) fn new(play: &Play) -> Self {
        let task = play.scene.task.clone();
        let names = names(play);
        let mut trouble = None;
        let experts = match task.expert.as_deref().map(read_experts) {
            Some(Ok(experts)) => experts,
            Some(Err(error)) => {
                trouble = Some(format!("without an expert: {error}"));
                Vec::new()
            }
            None => Vec::new(),
        };
        let scores: Vec<Score> = experts.iter().map(|expert| expert.score(&task)).collect();
        Self {
            performance: Performance::new(&task, &names),
            standards: Standard::of(&scores),
            tutor: experts
                .first()
                .and_then(|expert| Tutor::new(&expert.session, &names)),
            guidance: None,
            phase: Phase::Reads,
            has_begun: false,
            task,
            trouble,
            unsaved: None,
        }
    }

    /// Whether a scene has something to do, or says what can be done.
    pub(super) fn is_wanted(task: &Task) -> bool {
        task.goal != Goal::Free || task.title.is_some()
    }

    /// Begins with the organ as it was at the start; recorded in the folder `session`, where that is given.
    pub(super) fn begin(&mut self, play: &mut Play, session: Option<PathBuf>) {
        self.performance = Performance::new(&self.task, &names(play));
        self.has_begun = false;
        self.guidance = None;
        self.unsaved = None;
        if let Some(tutor) = &mut self.tutor {
            tutor.begin_anew();
        }
        let mut folder = session;
        if play.scene.written.is_none() && folder.take().is_some() {
            self.trouble = Some(
                "not recorded: the scene was changed beside its file, so that it could not be played again"
                    .to_owned(),
            );
        }
        self.phase = Phase::GoesOn(match folder {
            None => {
                play.begin_anew();
                None
            }
            Some(folder) => match Claim::of_folder(&folder, Overwrite::Refused)
                .map_err(palpate_simulate::Error::from)
                .and_then(|claim| SessionFolder::create(claim, (&play.scene, &play.simulation)))
            {
                Ok(writer) => {
                    play.go_on();
                    play.source.record(writer);
                    Some(folder)
                }
                Err(error) => {
                    self.trouble = Some(format!("not recorded: {error}"));
                    play.begin_anew();
                    None
                }
            },
        });
    }

    /// Takes over what a tool did; the attempt begins with the new beginning that it asked for.
    pub(super) fn add(&mut self, row: &SessionRow) {
        if !matches!(self.phase, Phase::GoesOn(_)) {
            return;
        }
        self.has_begun |= row.events.contains(Event::BeginAnew);
        if self.has_begun {
            self.performance.add(row);
        }
    }

    /// Looks whether it is over, and what the expert says. Whether it has just ended.
    pub(super) fn look(&mut self, play: &mut Play) -> bool {
        if !matches!(self.phase, Phase::GoesOn(_)) || !self.has_begun {
            return false;
        }
        self.check_recording(play);
        if let Some(tutor) = &mut self.tutor {
            self.guidance = Some(tutor.follow_snapshot(play.source.snapshot()));
        }
        match self.status() {
            Status::Over { late } => {
                self.end(play, late);
                true
            }
            Status::GoesOn { .. } => false,
        }
    }

    /// Takes over whether the recording can still be written.
    fn check_recording(&mut self, play: &Play) {
        if let (Phase::GoesOn(folder), None) = (&mut self.phase, &self.unsaved)
            && let Some(unwritten) = play.source.unwritten()
        {
            self.unsaved = Some(Unsaved::new(folder.take(), unwritten.cause));
        }
    }

    /// Records where somebody wants it instead, from the beginning on.
    pub(super) fn record_elsewhere(&mut self, play: &mut Play) {
        let Some(unsaved) = &mut self.unsaved else {
            return;
        };
        let folder = PathBuf::from(unsaved.elsewhere.trim());
        let written = Claim::of_folder(&folder, Overwrite::Refused)
            .map_err(palpate_simulate::Error::from)
            .and_then(|claim| SessionFolder::create(claim, (&play.scene, &play.simulation)))
            .and_then(|writer| play.source.record_elsewhere(writer));
        if let Err(error) = written {
            unsaved.trouble = Some(error.to_string());
            return;
        }
        self.unsaved = None;
        match &mut self.phase {
            Phase::GoesOn(own) => *own = Some(folder),
            Phase::Over(done) => done.folder = Some(folder),
            Phase::Reads => {}
        }
    }

    /// Whether it was done, one way or the other.
    pub(super) fn is_over(&self) -> bool {
        matches!(self.phase, Phase::Over(_))
    }

    /// How far it is.
    pub(super) fn status(&self) -> Status {
        self.performance.status()
    }

    /// How long it lasts [s].
    pub(super) fn elapsed(&self) -> f64 {
        self.performance.elapsed()
    }

    /// What should not have happened.
    pub(super) fn errors(&self) -> Errors {
        self.performance.errors()
    }

    /// Whether an expert is followed.
    pub(super) fn has_expert(&self) -> bool {
        self.tutor.is_some()
    }

    /// Ends it where it is.
    pub(super) fn end(&mut self, play: &mut Play, late: bool) {
        let score = self.performance.score();
        let mut folder = match &mut self.phase {
            Phase::GoesOn(folder) => folder.take(),
            Phase::Reads | Phase::Over(_) => None,
        };
        if let Err(error) = play.source.end_recording() {
            let lost = folder.take();
            let unsaved = || Unsaved::new(lost, error.to_string());
            self.unsaved.get_or_insert_with(unsaved);
        }
        self.guidance = None;
        self.phase = Phase::Over(Box::new(Done {
            compared: compare(&score, &self.standards),
            score,
            late,
            folder,
        }));
    }
}

fn names(play: &Play) -> Vec<String> {
    play.scene
        .tools
        .iter()
        .map(|tool| tool.name.clone())
        .collect()
}
