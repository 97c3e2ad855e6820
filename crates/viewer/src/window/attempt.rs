//! An attempt at a task: from the instructions to the score.

use std::path::{Path, PathBuf};

use palpate_files::scene::{Goal, Task};
use palpate_files::session::{Event, SessionRow};
use palpate_files::{Claim, Overwrite};
use palpate_geometry::Vec3;
use palpate_simulate::performance::{
    Comparison, Deviation, Errors, Outcome, Performance, Score, Standard, Status, compare,
};
use palpate_simulate::{Demonstration, Ghost, SessionFolder, ShownTool, Tutor, read_experts};

use super::play::{ModelRequest, Play};
use super::texts::text;
use super::training::PastResult;

/// An attempt at a task.
pub(super) struct Attempt {
    pub(super) task: Task,
    pub(super) phase: Phase,
    performance: Performance,
    /// Whether the first row of the attempt has come.
    has_begun: bool,
    standards: Vec<Standard>,
    tutor: Option<Tutor>,
    pub(super) ghosts: Vec<Option<Ghost>>,
    /// The script that does it, while it is shown.
    demonstration: Option<Demonstration>,
    /// Whether this variant was shown: its answer is then known.
    pub(super) was_shown: bool,
    /// Times [s] and forces [N], the largest of all tools.
    pub(super) forces: Vec<[f64; 2]>,
    /// Where a place was marked [m].
    pub(super) marked: Option<Vec3>,
    /// The diameter that is to be stated [mm], as it is set so far.
    pub(super) diameter: Option<u32>,
    /// An error outside the touch.
    pub(super) error: Option<String>,
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
    pub(super) error: Option<String>,
}

impl Unsaved {
    /// Of a session that was to be in `folder`; the same name where the program was started is suggested.
    fn new(folder: Option<PathBuf>, cause: String) -> Self {
        let name = folder.as_deref().and_then(Path::file_name);
        let here = std::env::current_dir().unwrap_or_default();
        Self {
            cause,
            elsewhere: here.join(name.unwrap_or_default()).display().to_string(),
            error: None,
        }
    }
}

/// Phase of an attempt.
pub(super) enum Phase {
    /// The trainee reads.
    Briefing,
    /// It goes on, and is recorded in a folder, if anywhere.
    Running(Option<PathBuf>),
    /// It is over.
    Ended(Box<Done>),
}

/// Result of an attempt.
pub(super) struct Done {
    pub(super) score: Score,
    pub(super) compared: Vec<Comparison>,
    /// Because its time was over.
    pub(super) late: bool,
    /// Where it was recorded.
    pub(super) folder: Option<PathBuf>,
    /// The trainee's attempts at the task before.
    pub(super) earlier: Vec<PastResult>,
}

/// The least and the largest diameter that can be stated [mm].
pub(super) const DIAMETERS: [u32; 2] = [4, 40];

/// Shortest interval between the forces of a plot [s].
const PLOTTED: f64 = 0.02;

impl Attempt {
    /// Of a scene's task. An expert's sessions that cannot be read give a warning and are left out.
    pub(super) fn new(play: &Play) -> Self {
        let task = play.scene.task.clone();
        let names = names(play);
        let mut no_expert = None;
        let experts = match task.expert.as_deref().map(read_experts) {
            Some(Ok(experts)) => experts,
            Some(Err(error)) => {
                no_expert = Some(text!("attempt-no-expert", error = error.to_string()));
                Vec::new()
            }
            None => Vec::new(),
        };
        let scores: Vec<Score> = experts.iter().map(|expert| expert.score(&task)).collect();
        Self {
            performance: Performance::new(&task, &names),
            standards: Standard::of(&scores),
            // Where another variant was cut or pulled there is nothing to do here.
            tutor: experts
                .first()
                .filter(|expert| {
                    let own = play.simulation.session_header().scene_digest;
                    expert.session.header.scene_digest == own
                })
                .and_then(|expert| Tutor::new(&expert.session, &names)),
            ghosts: Vec::new(),
            demonstration: None,
            was_shown: false,
            forces: Vec::new(),
            marked: None,
            diameter: None,
            phase: Phase::Briefing,
            has_begun: false,
            task,
            error: no_expert,
            unsaved: None,
        }
    }

    /// Whether a scene has something to do, or says what can be done.
    pub(super) fn has_goal(task: &Task) -> bool {
        task.goal != Goal::Free || task.title.is_some()
    }

    /// Begins with the organ as it was at the start; recorded in the folder `session`, where that is given.
    pub(super) fn begin(&mut self, play: &mut Play, session: Option<PathBuf>) {
        self.performance = Performance::new(&self.task, &names(play));
        self.has_begun = false;
        self.ghosts.clear();
        self.demonstration = None;
        self.forces.clear();
        self.marked = None;
        self.diameter = None;
        self.unsaved = None;
        if let Some(tutor) = &mut self.tutor {
            tutor.reset();
        }
        let mut folder = session;
        if play.scene.written.is_none() && folder.take().is_some() {
            self.error = Some(text!("attempt-scene-changed"));
        }
        self.phase = Phase::Running(match folder {
            None => {
                play.reset();
                None
            }
            Some(folder) => match Claim::of_folder(&folder, Overwrite::Refused)
                .map_err(palpate_simulate::Error::from)
                .and_then(|claim| SessionFolder::create(claim, &play.scene, &play.simulation))
            {
                Ok(writer) => {
                    play.go_on();
                    play.source.record(writer);
                    Some(folder)
                }
                Err(error) => {
                    let error = error.to_string();
                    self.error = Some(text!("attempt-unrecorded", error = error));
                    play.reset();
                    None
                }
            },
        });
    }

    /// Takes over what a tool did; the attempt begins with the new beginning that it asked for.
    pub(super) fn add(&mut self, row: &SessionRow) {
        if !matches!(self.phase, Phase::Running(_)) {
            return;
        }
        self.has_begun |= row.events.contains(Event::Restart);
        if !self.has_begun {
            return;
        }
        self.performance.add(row);
        let (time, force) = (self.performance.elapsed(), Vec3::from(row.force_n).norm());
        match self.forces.last_mut() {
            Some(last) if time - last[0] < PLOTTED => last[1] = last[1].max(force),
            _ => self.forces.push([time, force]),
        }
        if row.events.contains(Event::Mark) && row.contact && self.marked.is_none() {
            self.marked = Some(Vec3::from(row.position_m));
        }
    }

    /// Shows how it may be done, on the organ as it was at the start.
    pub(super) fn show(&mut self, play: &mut Play) {
        self.begin(play, None);
        self.demonstration = Demonstration::new(&play.scene, &play.simulation);
        self.was_shown = true;
    }

    /// Whether a script does it now.
    pub(super) fn is_shown(&self) -> bool {
        self.demonstration.is_some()
    }

    /// Where the script has the tools after another `elapsed` [s]; none where a trainee has them.
    pub(super) fn shown(
        &mut self,
        play: &mut Play,
        elapsed: f64,
    ) -> Option<Vec<Option<ShownTool>>> {
        let demonstration = self.demonstration.as_mut()?;
        let tools = play.source.snapshot().tools.iter();
        let forces: Vec<Vec3> = tools.map(|tool| tool.force).collect();
        let elapsed = if self.has_begun { elapsed } else { 0.0 };
        let shown = demonstration.follow(elapsed, &forces).to_vec();
        if demonstration.marks() {
            play.send(ModelRequest::Mark);
        }
        if let Some(diameter) = demonstration.states() {
            self.diameter = Some((1e3 * diameter).round() as u32);
            play.send(ModelRequest::StateDiameter(diameter));
        }
        Some(shown)
    }

    /// Whether the place is marked and the diameter is still to be stated.
    pub(super) fn awaits_diameter(&self) -> bool {
        matches!(self.phase, Phase::Running(_)) && self.performance.awaits_diameter()
    }

    /// Sets the diameter by so many millimetres more or less.
    pub(super) fn change_diameter(&mut self, by: i32) {
        let [least, most] = DIAMETERS;
        let now = self.diameter.unwrap_or(least);
        self.diameter = Some(now.saturating_add_signed(by).clamp(least, most));
    }

    /// The stated diameter, once the attempt is over [m].
    pub(super) fn stated_diameter(&self) -> Option<f64> {
        match &self.phase {
            Phase::Ended(done) => match done.score.outcome {
                Outcome::Find { size, .. } => size?.stated,
                _ => None,
            },
            Phase::Briefing | Phase::Running(_) => None,
        }
    }

    /// Deviation of the current cut from its line, and the largest distance that counts [m].
    pub(super) fn deviation(&self) -> Option<(Deviation, f64)> {
        let Goal::Cut { tolerance_m, .. } = self.task.goal else {
            return None;
        };
        Some((self.performance.deviation()?, tolerance_m))
    }

    /// The stretches of a line that are not cut yet [m].
    pub(super) fn uncut(&self) -> Vec<[Vec3; 2]> {
        self.performance.uncut()
    }

    /// Looks whether it is over, and what the expert says. Whether it has just ended.
    pub(super) fn look(&mut self, play: &mut Play) -> bool {
        if !matches!(self.phase, Phase::Running(_)) || !self.has_begun {
            return false;
        }
        self.check_recording(play);
        if let Some(tutor) = &mut self.tutor {
            let tools = play.source.snapshot().tools.iter();
            let tips: Vec<_> = tools.map(|tool| Some(tool.pose?.position_m)).collect();
            self.ghosts = tutor.follow(&tips);
        }
        match self.status() {
            Status::Ended { late } => {
                self.end(play, late);
                true
            }
            Status::InProgress { .. } => false,
        }
    }

    /// Takes over whether the recording can still be written.
    fn check_recording(&mut self, play: &Play) {
        if let (Phase::Running(folder), None) = (&mut self.phase, &self.unsaved)
            && let Some(unwritten) = play.source.recording_failure()
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
            .and_then(|claim| SessionFolder::create(claim, &play.scene, &play.simulation))
            .and_then(|writer| play.source.record_elsewhere(writer));
        if let Err(error) = written {
            unsaved.error = Some(error.to_string());
            return;
        }
        self.unsaved = None;
        match &mut self.phase {
            Phase::Running(own) => *own = Some(folder),
            Phase::Ended(done) => done.folder = Some(folder),
            Phase::Briefing => {}
        }
    }

    /// Where it was recorded, once it is over.
    pub(super) fn folder(&self) -> Option<PathBuf> {
        match &self.phase {
            Phase::Ended(done) => done.folder.clone(),
            Phase::Briefing | Phase::Running(_) => None,
        }
    }

    /// Whether its card is read, before or after it, and no tool is moved for it.
    pub(super) fn is_card(&self) -> bool {
        matches!(self.phase, Phase::Briefing | Phase::Ended(_))
    }

    /// Whether it was done, one way or the other.
    pub(super) fn is_over(&self) -> bool {
        matches!(self.phase, Phase::Ended(_))
    }

    /// How far it is.
    pub(super) fn status(&self) -> Status {
        self.performance.status()
    }

    /// How long it lasts [s].
    pub(super) fn elapsed(&self) -> f64 {
        self.performance.elapsed()
    }

    /// Errors so far.
    pub(super) fn errors(&self) -> Errors {
        self.performance.errors()
    }

    /// Earlier attempts of the trainee, as far as known.
    pub(super) fn compare_with(&mut self, earlier: Vec<PastResult>) {
        if let Phase::Ended(done) = &mut self.phase {
            done.earlier = earlier;
        }
    }

    /// Whether an expert is followed.
    pub(super) fn has_expert(&self) -> bool {
        self.tutor.is_some()
    }

    /// Ends it where it is.
    pub(super) fn end(&mut self, play: &mut Play, late: bool) {
        if self.demonstration.take().is_some() {
            self.ghosts.clear();
            self.phase = Phase::Briefing;
            return;
        }
        let score = self.performance.score();
        let mut folder = match &mut self.phase {
            Phase::Running(folder) => folder.take(),
            Phase::Briefing | Phase::Ended(_) => None,
        };
        if let Err(error) = play.source.end_recording() {
            let lost = folder.take();
            let unsaved = || Unsaved::new(lost, error.to_string());
            self.unsaved.get_or_insert_with(unsaved);
        }
        self.ghosts.clear();
        self.phase = Phase::Ended(Box::new(Done {
            compared: compare(&score, &self.standards),
            score,
            late,
            folder,
            earlier: Vec::new(),
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
