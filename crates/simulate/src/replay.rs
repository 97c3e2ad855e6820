//! Replay of a session: the same motions on the same organ give the same forces, to the last bit.
//!
//! A row has the pose of its tool; events mark that the tool left (`lifted`), that a cut was undone (`undo_cut`) and
//! that all restarted (`reset`). Rows of one time are one step, as long as the time between them.
//!
//! *How we know*: `replay::what_was_felt_is_felt_again`, `replay::going_back_is_exact`,
//! `replay::states_from_ahead_are_those_of_the_session`.
//!
//! *Limits*: the shaft of a free tool without an orientation of its own is unknown; replayed with another model than
//! the nonlinear one it is known, and may cause contact events that the session does not have. Lost rows stay lost.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use palpate_files::{Event, Pose, Session, SessionRow};

use crate::interactive::DISPLAY;
use crate::{Error, Simulation, SimulationState, SimulationWorkspace, step};

/// Interval of the stored states for seeking [s], in a short session.
const APART: f64 = 1.0;

/// Number of stored states of a long session: some megabytes each.
const STORED_STATES: f64 = 128.0;

/// A session that is replayed step by step, forwards and backwards.
pub struct Replay {
    recorded: RecordedSession,
    state: SimulationState,
    workspace: SimulationWorkspace,
    /// Number of replayed steps.
    played: usize,
    /// Stored states by the number of steps before them.
    stored: BTreeMap<usize, SimulationState>,
    /// Further stored states, from a thread that plays ahead.
    ahead: Option<Receiver<(usize, SimulationState)>>,
    poses: Vec<Option<Pose>>,
}

/// The recorded session, and its simulation.
#[derive(Clone)]
struct RecordedSession {
    simulation: Arc<Simulation>,
    rows: Arc<[SessionRow]>,
    /// The pose of each.
    poses: Arc<[Pose]>,
    /// The rows of each step.
    steps: Arc<[Range<usize>]>,
}

impl Replay {
    /// A replay before its first step.
    ///
    /// # Errors
    /// When the session is of another scene, model or step, or is empty.
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
        if !simulation.scene_digest.matches(&was.scene_digest) {
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
        Ok(Self::of(RecordedSession {
            simulation,
            rows: session.rows.iter().map(in_scene).collect(),
            poses: session.poses().collect(),
            steps: steps.into(),
        }))
    }

    fn of(recorded: RecordedSession) -> Self {
        let simulation = &recorded.simulation;
        Self {
            state: recorded.start(),
            workspace: SimulationWorkspace::new(simulation),
            poses: vec![None; simulation.tools().len()],
            played: 0,
            stored: BTreeMap::new(),
            ahead: None,
            recorded,
        }
    }

    /// Also replays the session once on a background thread, so that [`Self::go_to`] and [`Self::jump`] soon find a
    /// state near every step. If the system provides no thread, only states of replayed steps are available.
    pub fn look_ahead(&mut self) {
        let (sender, receiver) = sync_channel(4);
        let recorded = self.recorded.clone();
        let ahead = std::thread::Builder::new().name("palpate-replay".to_owned());
        let ahead = ahead.spawn(move || {
            let mut replay = Self::of(recorded);
            while replay.advance() {
                // The receiver is gone once the session is closed.
                if let Some(stored) = replay.stored.pop_first()
                    && sender.send(stored).is_err()
                {
                    break;
                }
            }
        });
        self.ahead = ahead.is_ok().then_some(receiver);
    }

    /// Number of all steps.
    pub fn steps(&self) -> usize {
        self.recorded.steps.len()
    }

    /// Number of replayed steps.
    pub fn played(&self) -> usize {
        self.played
    }

    /// The time of a step [s].
    pub fn time(&self, step: usize) -> f64 {
        self.recorded.time(step)
    }

    /// The state after the replayed steps.
    pub fn state(&self) -> &SimulationState {
        &self.state
    }

    /// The recorded rows of the last replayed step, with the scene's numbers of its tools; empty before the first.
    pub fn recorded(&self) -> &[SessionRow] {
        self.recorded_in(self.played.saturating_sub(1)..self.played)
    }

    /// The recorded rows of these steps, with the scene's numbers of their tools.
    ///
    /// # Panics
    /// When there are no such steps.
    pub fn recorded_in(&self, steps: Range<usize>) -> &[SessionRow] {
        match &self.recorded.steps[steps] {
            [] => &[],
            [first, .., last] => &self.recorded.rows[first.start..last.end],
            [only] => &self.recorded.rows[only.clone()],
        }
    }

    /// Replays the next step. Returns whether there was one.
    pub fn advance(&mut self) -> bool {
        let recorded = &self.recorded;
        let Some(step_rows) = recorded.steps.get(self.played).cloned() else {
            return false;
        };
        let (rows, poses) = (
            &recorded.rows[step_rows.clone()],
            &recorded.poses[step_rows],
        );
        let time = rows[0].time_s;
        let mut before = self.played.checked_sub(1).map(|last| recorded.time(last));
        let happened = |event| rows.iter().any(|row| row.events.contains(event));
        if happened(Event::Restart) {
            self.state.reset(&recorded.simulation);
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
            &recorded.simulation,
            time,
            before.map_or(0.0, |before| time - before),
            &self.poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.played += 1;
        self.store();
        true
    }

    /// Goes to the state after this number of steps, forwards, or backwards from the nearest stored state.
    pub fn go_to(&mut self, played: usize) {
        self.jump(played);
        while self.played < played && self.advance() {}
    }

    /// Takes the last stored state before this number of steps, if it is nearer than the present one. It computes
    /// nothing.
    pub fn jump(&mut self, played: usize) {
        if let Some(ahead) = &self.ahead {
            self.stored.extend(ahead.try_iter());
        }
        let goes_back = played < self.played;
        match self.stored.range(..=played).next_back() {
            Some((at, state)) if goes_back || *at > self.played => {
                (self.played, self.state) = (*at, state.clone());
            }
            None if goes_back => (self.played, self.state) = (0, self.recorded.start()),
            _ => {}
        }
    }

    fn store(&mut self) {
        let since = |step| self.recorded.time(step) - self.recorded.time(0);
        let apart = APART.max(since(usize::MAX) / STORED_STATES);
        let [last, this] = [self.played - 1, self.played].map(since);
        if (last / apart).floor() < (this / apart).floor()
            && !self.stored.contains_key(&self.played)
        {
            self.stored.insert(self.played, self.state.clone());
        }
    }
}

impl RecordedSession {
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
