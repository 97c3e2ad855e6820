//! Performance measures of a session: established measures of the field, and the outcome of the task.
//!
//! Rows are added one by one, in real time or when a session is read; [`Performance::score`] has the measures so far.
//! Definitions, formulas and references: `docs/theory/performance.md`.
//!
//! *How we know*: `performance::…`.
//!
//! *Limits*: a row has the tip, so that the motion of the hand within a trocar's friction is unknown; tremor faster
//! than half the model's rate does not appear.

mod comparison;
mod cut;
mod feedback;
mod force;
mod goal;
mod hand;
mod jerk;
mod measure;
mod touch;
mod words;

use palpate_files::scene::Task;
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

pub use comparison::{Comparison, Standard, compare};
pub use cut::{CutScore, Deviation};
pub use feedback::{Feedback, Phrase, PhraseValue, feedback};
pub use force::ForceScore;
pub use goal::{Advice, Cue, Outcome, SizeOutcome, Status};
pub use hand::HandScore;
pub use measure::{Better, Measure};
pub use words::outcome_words;

use cut::CutTracker;
use force::Forces;
use goal::GoalTracker;
use hand::HandTracker;

/// The performance in a task so far.
#[derive(Debug, Clone)]
pub struct Performance {
    task: Task,
    began: Option<f64>,
    now: f64,
    hands: Vec<HandTracker>,
    forces: Vec<Forces>,
    cut: CutTracker,
    goal: GoalTracker,
    errors: Errors,
    /// The task is over: later rows do not count.
    is_over: bool,
}

/// Counts of unwanted events.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Errors {
    /// How often the force rose above its limit.
    pub force_limit: u64,
    /// How often the innermost layer was opened.
    pub perforations: u64,
    /// How often held tissue was lost to a pull, with shut jaws.
    pub drops: u64,
    /// How often a shaft touched the organ.
    pub shaft_contacts: u64,
    /// Undone cuts.
    pub undone: u64,
}

/// The measures of a performance.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// From the first row to the last [s].
    pub duration: f64,
    /// Motion measures per tool.
    pub hands: Vec<HandScore>,
    /// Force measures per tool.
    pub forces: Vec<ForceScore>,
    /// Unwanted events.
    pub errors: Errors,
    /// Measures of the cuts, if there are any.
    pub cut: Option<CutScore>,
    /// The outcome of the task.
    pub outcome: Outcome,
}

impl Performance {
    /// A performance without rows, with tools of those names.
    pub fn new(task: &Task, tools: &[String]) -> Self {
        let limit = task.force_limit_n;
        Self {
            task: task.clone(),
            began: None,
            now: 0.0,
            hands: tools.iter().map(|name| HandTracker::new(name)).collect(),
            forces: tools.iter().map(|_| Forces::new(limit)).collect(),
            cut: CutTracker::new(&task.goal),
            goal: GoalTracker::new(&task.goal, tools),
            errors: Errors::default(),
            is_over: false,
        }
    }

    /// Adds a tool's row of a step, unless the task is over.
    pub fn add(&mut self, row: &SessionRow) {
        if self.is_over {
            return;
        }
        self.began.get_or_insert(row.time_s);
        self.now = row.time_s;
        let (Some(hand), Some(forces)) =
            (self.hands.get_mut(row.tool), self.forces.get_mut(row.tool))
        else {
            return;
        };
        let happened = |event| u64::from(row.events.contains(event));
        hand.add(row);
        self.errors.force_limit += u64::from(forces.add(row));
        self.errors.perforations += happened(Event::Perforation);
        self.errors.shaft_contacts += happened(Event::ShaftContact);
        self.errors.undone += happened(Event::UndoCut);
        // Jaws that are still shut lost the tissue.
        let lost = row.events.contains(Event::GripRelease) && row.grip > 0.5;
        let lifted = row.events.contains(Event::Lifted);
        self.errors.drops += u64::from(lost && !lifted);
        self.cut.add(row);
        self.goal.add(row);
        self.is_over = matches!(self.status(), Status::Ended { .. });
    }

    /// The progress of the task.
    pub fn status(&self) -> Status {
        let late = self
            .task
            .time_limit_s
            .is_some_and(|limit| self.elapsed() >= limit);
        self.goal.status(&self.cut, late)
    }

    /// Whether a place is marked and its diameter is still missing.
    pub fn awaits_diameter(&self) -> bool {
        self.goal.awaits_diameter()
    }

    /// Deviation of the present cut from its line.
    pub fn deviation(&self) -> Option<Deviation> {
        self.cut.deviation()
    }

    /// The stretches of the line that are not yet cut to the required depth: the ends of their straight pieces [m].
    pub fn uncut(&self) -> Vec<[Vec3; 2]> {
        self.cut.uncut()
    }

    /// The unwanted events.
    pub fn errors(&self) -> Errors {
        self.errors
    }

    /// Since the first row [s].
    pub fn elapsed(&self) -> f64 {
        self.began.map_or(0.0, |began| self.now - began)
    }

    /// The measures so far.
    pub fn score(&self) -> Score {
        Score {
            duration: self.elapsed(),
            hands: self.hands.iter().map(HandTracker::score).collect(),
            forces: self.forces.iter().map(Forces::score).collect(),
            errors: self.errors,
            cut: self.cut.score(),
            outcome: self.goal.outcome(&self.cut, &self.errors),
        }
    }
}

/// The score of a complete set of rows.
pub fn score<'r>(
    task: &Task,
    tools: &[String],
    rows: impl IntoIterator<Item = &'r SessionRow>,
) -> Score {
    let mut performance = Performance::new(task, tools);
    rows.into_iter().for_each(|row| performance.add(row));
    performance.score()
}
