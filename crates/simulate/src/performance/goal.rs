//! How far a task is, and what became of it.

use palpate_files::scene::{Goal, SoughtSize};
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use super::Errors;
use super::cut::{CutWay, aside};
use super::touch::TouchWatch;

/// A pull below this part of the wanted force is not one yet [-].
const BEGINS: f64 = 0.2;

/// Watches for the goal.
#[derive(Debug, Clone)]
pub(super) struct GoalWatch {
    goal: Goal,
    tool: Option<usize>,
    done: bool,
    /// How far beside the target was marked [m].
    beside: Option<f64>,
    /// The diameter that was stated [m].
    stated: Option<f64>,
    /// Time [s] and force [N] of each tool before.
    last: Vec<Option<(f64, Vec3)>>,
    /// The last pull of the tool that pulls.
    pull: Option<Advice>,
    /// The force at which the tissue tore [N].
    torn: Option<f64>,
    within: f64,
    /// Time of the pull [s], and ∫ (F − wanted)² dt [N² s].
    pulled: (f64, f64),
    /// Of a place that is to be touched.
    touch: Option<TouchWatch>,
}

/// A force beside the one that is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advice {
    /// Its size [N].
    pub force: f64,
    /// How it should be changed.
    pub cue: Cue,
}

/// The one thing that should be changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cue {
    /// Nothing: hold it.
    Hold,
    /// Pull or press harder.
    More,
    /// Pull or press less.
    Less,
    /// Pull in the other direction.
    Turn,
    /// Take hold of the organ: the force is that of the tool that shall.
    Grasp,
    /// Lift the organ out of the way of the tool that shall touch: the force is that of the tool that lifts.
    Lift,
    /// Touch the place that is meant: the force is that of the tool that lifts, if one has to.
    Reach,
}

/// How far a task is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Status {
    /// It goes on; the part that is done [-], if that can be told.
    GoesOn {
        /// From 0 to 1 [-].
        part: Option<f64>,
        /// What to change, where a force is wanted.
        advice: Option<Advice>,
    },
    /// It is over.
    Over {
        /// Because its time is.
        late: bool,
    },
}

/// What was stated of the size of what was to be found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeOutcome {
    /// The diameter that was stated [m]; none if none was.
    pub stated: Option<f64>,
    /// The size that it has.
    pub truth: SoughtSize,
}

impl SizeOutcome {
    /// Whether the stated diameter is near enough.
    pub fn is_right(&self) -> bool {
        self.stated.is_some_and(|stated| self.truth.accepts(stated))
    }
}

/// What became of a task.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// There was nothing that had to be done.
    Free,
    /// A place was to be found.
    Find {
        /// How far beside it was marked [m]; none if nothing was.
        beside: Option<f64>,
        /// Whether that is near enough.
        found: bool,
        /// Its size, where that was asked for.
        size: Option<SizeOutcome>,
    },
    /// A force was to be held.
    Traction {
        /// How long it was held within its tolerance [s].
        within: f64,
        /// How far it was from the wanted one, root of the mean square since the pull began [N].
        error: Option<f64>,
        /// Whether it was held for long enough.
        held: bool,
        /// The pull at which the tissue tore [N]; none where it did not.
        torn: Option<f64>,
    },
    /// A place was to be touched.
    Touch {
        /// How long it was touched as it should be [s].
        within: f64,
        /// The least distance from it at which the tool was, with the organ out of its way [m]; none if it never was.
        beside: Option<f64>,
        /// Whether it was touched for long enough.
        reached: bool,
        /// The force that injured it [N]; none where none did.
        injured: Option<f64>,
        /// The pull at which the held tissue tore [N]; none where it did not.
        torn: Option<f64>,
    },
    /// A line was to be cut.
    Cut {
        /// The part of the line that was cut [-].
        part: f64,
        /// Whether it was cut whole, within its tolerance and without a perforation.
        clean: bool,
    },
}

impl GoalWatch {
    pub(super) fn new(goal: &Goal, tools: &[String]) -> Self {
        let tool = match goal {
            Goal::Traction {
                tool: Some(name), ..
            } => tools.iter().position(|tool| tool == name),
            _ => None,
        };
        Self {
            goal: goal.clone(),
            tool,
            done: false,
            beside: None,
            stated: None,
            last: vec![None; tools.len()],
            pull: None,
            torn: None,
            within: 0.0,
            pulled: (0.0, 0.0),
            touch: match goal {
                Goal::Touch(touch) => Some(TouchWatch::new(touch, tools)),
                _ => None,
            },
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        if row.events.contains(Event::Mark) {
            match self.goal {
                // The first mark counts; where a size is asked for, that is still to be stated.
                Goal::Find { target_m, size, .. } if row.contact && self.beside.is_none() => {
                    let way = Vec3::from(row.position_m) - Vec3::from(target_m);
                    self.beside = Some(aside(&way, row.depth_m));
                    self.done = size.is_none();
                }
                // In the air nothing is meant.
                Goal::Find { .. } => {}
                _ => self.done = true,
            }
        }
        if self.awaits_diameter() && row.stated_diameter_m.is_some() {
            self.stated = row.stated_diameter_m;
            self.done = true;
        }
        if let Some(touch) = &mut self.touch {
            touch.add(row);
            self.done |= touch.is_done();
        }
        let &Goal::Traction {
            force_n,
            hold_s,
            tear_force_n,
            ..
        } = &self.goal
        else {
            return;
        };
        let force = Vec3::from(row.force_n);
        let Some(last) = self.last.get_mut(row.tool) else {
            return;
        };
        let before = last.replace((row.time_s, force));
        // Without a name it is the tool that pulls first.
        if self.tool.is_none() && force.norm() > BEGINS * force_n {
            self.tool = Some(row.tool);
        }
        if self.tool != Some(row.tool) {
            return;
        }
        if let Some((time, before)) = before {
            let elapsed = row.time_s - time;
            let pull = advice(&self.goal, &(0.5 * (before + force)));
            if pull.is_some_and(|pull| pull.cue == Cue::Hold) {
                self.within += elapsed;
            }
            let middle = 0.5 * (before.norm() + force.norm());
            if middle > BEGINS * force_n || self.pulled.0 > 0.0 {
                self.pulled.0 += elapsed;
                self.pulled.1 += elapsed * (middle - force_n).powi(2);
            }
        }
        self.pull = advice(&self.goal, &force);
        if tear_force_n.is_some_and(|tear| force.norm() > tear) {
            self.torn = Some(force.norm());
        }
        self.done |= self.within >= hold_s || self.torn.is_some();
    }

    /// Whether a place is marked and its size is still to be stated.
    pub(super) fn awaits_diameter(&self) -> bool {
        let is_asked = matches!(self.goal, Goal::Find { size: Some(_), .. });
        is_asked && self.beside.is_some() && self.stated.is_none()
    }

    pub(super) fn status(&self, cut: &CutWay, late: bool) -> Status {
        let part = match &self.goal {
            Goal::Free | Goal::Find { .. } => None,
            Goal::Traction { hold_s, .. } => Some((self.within / hold_s).min(1.0)),
            Goal::Cut { .. } => cut.part(),
            Goal::Touch(_) => self.touch.as_ref().map(TouchWatch::part),
        };
        let is_cut = cut.is_whole();
        match self.done || is_cut || late {
            true => Status::Over {
                late: late && !self.done && !is_cut,
            },
            false => Status::GoesOn {
                part,
                advice: match &self.touch {
                    Some(touch) => Some(touch.advice()),
                    None => self.pull,
                },
            },
        }
    }

    pub(super) fn outcome(&self, cut: &CutWay, errors: &Errors) -> Outcome {
        match &self.goal {
            Goal::Free => Outcome::Free,
            Goal::Find {
                tolerance_m, size, ..
            } => Outcome::Find {
                beside: self.beside,
                found: self.beside.is_some_and(|beside| beside <= *tolerance_m),
                size: size.map(|truth| SizeOutcome {
                    stated: self.stated,
                    truth,
                }),
            },
            Goal::Traction { hold_s, .. } => Outcome::Traction {
                within: self.within,
                error: (self.pulled.0 > 0.0).then(|| (self.pulled.1 / self.pulled.0).sqrt()),
                held: self.within >= *hold_s && self.torn.is_none(),
                torn: self.torn,
            },
            Goal::Touch(_) => self
                .touch
                .as_ref()
                .map_or(Outcome::Free, TouchWatch::outcome),
            Goal::Cut { tolerance_m, .. } => {
                let line = cut.score().and_then(|score| score.along_line);
                let on_line = line.is_some_and(|line| line.largest_deviation <= *tolerance_m);
                Outcome::Cut {
                    part: cut.part().unwrap_or(0.0),
                    clean: cut.is_whole() && on_line && errors.perforations == 0,
                }
            }
        }
    }
}

/// A force on the tool [N] compared with the pull of a traction; none for other goals.
fn advice(goal: &Goal, force: &Vec3) -> Option<Advice> {
    let Goal::Traction {
        force_n,
        tolerance_n,
        direction,
        ..
    } = goal
    else {
        return None;
    };
    let size = force.norm();
    // A tool pulls against the force on it. Before there is one, it has no direction either.
    let turned = direction.is_some_and(|(direction, tolerance)| {
        size > BEGINS * force_n && (-force).angle(&Vec3::from(direction)) > tolerance
    });
    let cue = match size {
        _ if turned => Cue::Turn,
        size if size < force_n - tolerance_n => Cue::More,
        size if size > force_n + tolerance_n => Cue::Less,
        _ => Cue::Hold,
    };
    Some(Advice { force: size, cue })
}

impl Outcome {
    /// Whether the task was done as it should be; none where nothing had to be.
    pub fn passed(&self) -> Option<bool> {
        match *self {
            Self::Free => None,
            Self::Find { found, size, .. } => Some(found && size.is_none_or(|own| own.is_right())),
            Self::Traction { held, .. } => Some(held),
            Self::Cut { clean, .. } => Some(clean),
            Self::Touch { reached, .. } => Some(reached),
        }
    }
}
