//! Progress and outcome of a task.

use palpate_files::scene::{Goal, SizeGoal};
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use super::Errors;
use super::cut::{CutTracker, surface_part};
use super::touch::TouchTracker;

/// A pull below this part of the required force does not count yet [-].
const BEGINS: f64 = 0.2;

/// Evaluates the goal, row by row.
#[derive(Debug, Clone)]
pub(super) struct GoalTracker {
    goal: Goal,
    tool: Option<usize>,
    done: bool,
    /// Distance of the mark from the target [m].
    target_distance: Option<f64>,
    /// The stated diameter [m].
    stated: Option<f64>,
    /// Previous time [s] and force [N] of each tool.
    last: Vec<Option<(f64, Vec3)>>,
    /// The last pull of the tool that pulls.
    pull: Option<Advice>,
    /// The force at which the tissue tore [N].
    torn: Option<f64>,
    within: f64,
    /// Duration of the pull [s], and ∫ (F − wanted)² dt [N² s].
    pulled: (f64, f64),
    /// For a target that is to be touched.
    touch: Option<TouchTracker>,
}

/// A force compared with the required one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advice {
    /// Its size [N].
    pub force: f64,
    /// Its required change.
    pub cue: Cue,
}

/// The one thing to change.
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
    /// Grasp the organ: the force is that of the grasping tool.
    Grasp,
    /// Lift the organ out of the way of the touching tool: the force is that of the lifting tool.
    Lift,
    /// Touch the target: the force is that of the lifting tool, if one has to lift.
    Reach,
}

/// The progress of a task.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Status {
    /// It continues; the completed part [-], if defined.
    InProgress {
        /// From 0 to 1 [-].
        part: Option<f64>,
        /// What to change, if a force is required.
        advice: Option<Advice>,
    },
    /// It is over.
    Ended {
        /// Because its time limit was reached.
        late: bool,
    },
}

/// The stated size of the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeOutcome {
    /// The stated diameter [m]; none if none was stated.
    pub stated: Option<f64>,
    /// The true diameter.
    pub truth: SizeGoal,
}

impl SizeOutcome {
    /// Whether the stated diameter is accurate enough.
    pub fn is_right(&self) -> bool {
        self.stated.is_some_and(|stated| self.truth.accepts(stated))
    }
}

/// The outcome of a task.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// The task had no goal.
    Free,
    /// Finding a target.
    Find {
        /// Distance of the mark from it [m]; none without a mark.
        target_distance: Option<f64>,
        /// Whether that is close enough.
        found: bool,
        /// Its size, if the task asked for it.
        size: Option<SizeOutcome>,
    },
    /// Holding a force.
    Traction {
        /// Time within its tolerance [s].
        within: f64,
        /// Deviation from the required force, root mean square since the pull began [N].
        error: Option<f64>,
        /// Whether it was held long enough.
        held: bool,
        /// The pull at which the tissue tore [N]; none if it did not.
        torn: Option<f64>,
    },
    /// Touching a target.
    Touch {
        /// Time of correct touch [s].
        within: f64,
        /// The least distance of the tool from it, with the organ out of its way [m]; none if it never was.
        target_distance: Option<f64>,
        /// Whether it was touched long enough.
        reached: bool,
        /// The force that injured it [N]; none if none did.
        injured: Option<f64>,
        /// The pull at which the held tissue tore [N]; none if it did not.
        torn: Option<f64>,
    },
    /// Cutting a line.
    Cut {
        /// The cut part of the line [-].
        part: f64,
        /// Whether the whole line was cut, within its tolerance and without a perforation.
        clean: bool,
    },
}

impl GoalTracker {
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
            target_distance: None,
            stated: None,
            last: vec![None; tools.len()],
            pull: None,
            torn: None,
            within: 0.0,
            pulled: (0.0, 0.0),
            touch: match goal {
                Goal::Touch(touch) => Some(TouchTracker::new(touch, tools)),
                _ => None,
            },
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        if row.events.contains(Event::Mark) {
            match self.goal {
                // The first mark counts; if a size is required, it is still missing.
                Goal::Find { target_m, size, .. }
                    if row.contact && self.target_distance.is_none() =>
                {
                    let offset = Vec3::from(row.position_m) - Vec3::from(target_m);
                    self.target_distance = Some(surface_part(&offset, row.depth_m));
                    self.done = size.is_none();
                }
                // A mark in the air does not count.
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

    /// Whether a place is marked and its size is still missing.
    pub(super) fn awaits_diameter(&self) -> bool {
        let is_asked = matches!(self.goal, Goal::Find { size: Some(_), .. });
        is_asked && self.target_distance.is_some() && self.stated.is_none()
    }

    pub(super) fn status(&self, cut: &CutTracker, late: bool) -> Status {
        let part = match &self.goal {
            Goal::Free | Goal::Find { .. } => None,
            Goal::Traction { hold_s, .. } => Some((self.within / hold_s).min(1.0)),
            Goal::Cut { .. } => cut.part(),
            Goal::Touch(_) => self.touch.as_ref().map(TouchTracker::part),
        };
        let is_cut = cut.is_complete();
        match self.done || is_cut || late {
            true => Status::Ended {
                late: late && !self.done && !is_cut,
            },
            false => Status::InProgress {
                part,
                advice: match &self.touch {
                    Some(touch) => Some(touch.advice()),
                    None => self.pull,
                },
            },
        }
    }

    pub(super) fn outcome(&self, cut: &CutTracker, errors: &Errors) -> Outcome {
        match &self.goal {
            Goal::Free => Outcome::Free,
            Goal::Find {
                tolerance_m, size, ..
            } => Outcome::Find {
                target_distance: self.target_distance,
                found: self
                    .target_distance
                    .is_some_and(|distance| distance <= *tolerance_m),
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
                .map_or(Outcome::Free, TouchTracker::outcome),
            Goal::Cut { tolerance_m, .. } => {
                let line = cut.score().and_then(|score| score.along_line);
                let on_line = line.is_some_and(|line| line.largest_deviation <= *tolerance_m);
                Outcome::Cut {
                    part: cut.part().unwrap_or(0.0),
                    clean: cut.is_complete() && on_line && errors.perforations == 0,
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
    // A tool pulls against the force on it. Before there is a force, it has no direction either.
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
    /// Whether the task was passed; none for a task without a goal.
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
