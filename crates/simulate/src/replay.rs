//! A session played again: the same hands on the same organ give the same forces, to the last bit.
//!
//! A row has where its tool was; that it was gone (`lifted`), that a cut was taken back (`undo_cut`) and that all
//! began anew (`reset`) are events. Rows of one time are one step, as long as the time between them.
//!
//! *How we know*: `replay::what_was_felt_is_felt_again`, `replay::going_back_is_exact`,
//! `replay::states_from_ahead_are_those_of_the_session`.
//!
//! *Limits*: without an orientation of its own a free tool's shaft was not known; played again with another model than the
//! nonlinear one it is, and may be told to touch where it did not before. Rows that were lost stay lost.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use palpate_files::{Event, Pose, Session, SessionRow};

use crate::interactive::DISPLAY;
use crate::{Error, Simulation, SimulationState, SimulationWorkspace, step};

/// Time between two states that are kept to go to [s], where a session is short.
const APART: f64 = 1.0;

/// States that are kept of a long one: some megabytes each.
const KEPT: f64 = 128.0;

/// A session that is played again, step by step, forth and back.
pub struct Replay {
    course: Course,
    state: SimulationState,
    workspace: SimulationWorkspace,
    /// How many steps were played.
    played: usize,
    /// States by the number of steps before them.
    kept: BTreeMap<usize, SimulationState>,
    /// Further ones, from a thread that plays ahead.
    ahead: Option<Receiver<(usize, SimulationState)>>,
    poses: Vec<Option<Pose>>,
}

/// What happened, and on what.
#[derive(Clone)]
struct Course {
    simulation: Arc<Simulation>,
    rows: Arc<[SessionRow]>,
    /// The pose of each.
    poses: Arc<[Pose]>,
    /// The rows of each step.
    steps: Arc<[Range<usize>]>,
}

impl Replay {
    /// Nothing is played yet.
    ///
    /// # Errors
    /// When the session is of another scene, model or step, or there is nothing in it.
    pub fn new(simulation: Arc<Simulation>, session: &Session) -> Result<Self, Error> {
        let (was, is) = (&session.header, simulation.session_header());
        let other = |what, was: &dyn ToString, is: &dyn ToString| Error::OtherSession {
            what,
            was: was.to_string(),
            is: is.to_string(),
        };
        if was.model != is.model {
            return Err(other("model", &was.model, &is.model));
        }
        if was.step_s != is.step_s {
            return Err(other("step [s]", &was.step_s, &is.step_s));
        }
        if !simulation.scene_digest.is(&was.scene_digest) {
            return Err(other("scene", &was.scene_digest, &is.scene_digest));
        }
        let number = |name: &String| {
            let known = simulation
                .tools()
                .iter()
                .position(|tool| tool.name == *name);
            known.ok_or_else(|| other("tool", name, &"none of that name"))
        };
        let tools: Vec<_> = session.tools.iter().map(number).collect::<Result<_, _>>()?;
        let in_scene = |row: &SessionRow| SessionRow {
            tool: tools[row.tool],
            ..*row
        };
        let steps = steps(&session.rows);
        if steps.is_empty() {
            return Err(Error::EmptySession);
        }
        Ok(Self::of(Course {
            simulation,
            rows: session.rows.iter().map(in_scene).collect(),
            poses: session.poses().collect(),
            steps: steps.into(),
        }))
    }

    fn of(course: Course) -> Self {
        let simulation = &course.simulation;
        Self {
            state: course.start(),
            workspace: SimulationWorkspace::new(simulation),
            poses: vec![None; simulation.tools().len()],
            played: 0,
            kept: BTreeMap::new(),
            ahead: None,
            course,
        }
    }

    /// Plays the session on a thread of its own as well, once, so that [`Self::go_to`] and [`Self::jump`] soon find a
    /// state near every step. Where there is no thread to be had, they know what was played.
    pub fn look_ahead(&mut self) {
        let (sender, receiver) = sync_channel(4);
        let course = self.course.clone();
        let ahead = std::thread::Builder::new().name("palpate-replay".to_owned());
        let ahead = ahead.spawn(move || {
            let mut replay = Self::of(course);
            while replay.advance() {
                // Nobody listens any more once the session is closed.
                if let Some(kept) = replay.kept.pop_first()
                    && sender.send(kept).is_err()
                {
                    break;
                }
            }
        });
        self.ahead = ahead.is_ok().then_some(receiver);
    }

    /// How many steps there are.
    pub fn steps(&self) -> usize {
        self.course.steps.len()
    }

    /// How many were played.
    pub fn played(&self) -> usize {
        self.played
    }

    /// The time of a step [s].
    pub fn time(&self, step: usize) -> f64 {
        self.course.time(step)
    }

    /// The state after the steps that were played.
    pub fn state(&self) -> &SimulationState {
        &self.state
    }

    /// What was recorded of the last step that was played, with the scene's numbers of its tools; nothing
    /// before the first.
    pub fn recorded(&self) -> &[SessionRow] {
        self.recorded_in(self.played.saturating_sub(1)..self.played)
    }

    /// What was recorded of these steps, with the scene's numbers of its tools.
    ///
    /// # Panics
    /// When there are no such steps.
    pub fn recorded_in(&self, steps: Range<usize>) -> &[SessionRow] {
        match &self.course.steps[steps] {
            [] => &[],
            [first, .., last] => &self.course.rows[first.start..last.end],
            [only] => &self.course.rows[only.clone()],
        }
    }

    /// Plays the next step. Whether there was one.
    pub fn advance(&mut self) -> bool {
        let course = &self.course;
        let Some(step_rows) = course.steps.get(self.played).cloned() else {
            return false;
        };
        let (rows, poses) = (&course.rows[step_rows.clone()], &course.poses[step_rows]);
        let time = rows[0].time_s;
        let mut before = self.played.checked_sub(1).map(|last| course.time(last));
        let happened = |event| rows.iter().any(|row| row.events.contains(event));
        if happened(Event::BeginAnew) {
            self.state.reset(&course.simulation);
            before = None;
        }
        if happened(Event::UndoCut) {
            self.state.undo_cut();
        }
        self.poses.fill(None);
        for (row, pose) in rows.iter().zip(poses) {
            if !row.events.contains(Event::Lifted) {
                self.poses[row.tool] = Some(*pose);
            }
        }
        step(
            &course.simulation,
            time,
            before.map_or(0.0, |before| time - before),
            &self.poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.played += 1;
        self.keep();
        true
    }

    /// Plays until so many steps were played, forth, or back and forth from the nearest state that was kept.
    pub fn go_to(&mut self, played: usize) {
        self.jump(played);
        while self.played < played && self.advance() {}
    }

    /// Takes the last state that was kept before so many steps were played, where it is nearer than the present one.
    /// It computes nothing.
    pub fn jump(&mut self, played: usize) {
        if let Some(ahead) = &self.ahead {
            self.kept.extend(ahead.try_iter());
        }
        let goes_back = played < self.played;
        match self.kept.range(..=played).next_back() {
            Some((at, state)) if goes_back || *at > self.played => {
                (self.played, self.state) = (*at, state.clone());
            }
            None if goes_back => (self.played, self.state) = (0, self.course.start()),
            _ => {}
        }
    }

    fn keep(&mut self) {
        let since = |step| self.course.time(step) - self.course.time(0);
        let apart = APART.max(since(usize::MAX) / KEPT);
        let [last, this] = [self.played - 1, self.played].map(since);
        if (last / apart).floor() < (this / apart).floor() && !self.kept.contains_key(&self.played)
        {
            self.kept.insert(self.played, self.state.clone());
        }
    }
}

impl Course {
    /// The time of a step, or of the last one [s].
    fn time(&self, step: usize) -> f64 {
        let step = step.min(self.steps.len() - 1);
        self.rows[self.steps[step].start].time_s
    }

    fn start(&self) -> SimulationState {
        SimulationState::new(&self.simulation).show_every(DISPLAY)
    }
}

/// The rows of each time.
fn steps(rows: &[SessionRow]) -> Vec<Range<usize>> {
    let mut steps: Vec<Range<usize>> = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        match steps.last_mut() {
            Some(step) if rows[step.start].time_s == row.time_s => step.end = number + 1,
            _ => steps.push(number..number + 1),
        }
    }
    steps
}
