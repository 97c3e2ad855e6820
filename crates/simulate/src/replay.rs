//! A session played again: the same hands on the same organ give the same forces, to the last bit.
//!
//! A row has where its tool was; that it was gone (`lifted`), that a cut was taken back (`undo_cut`) and that all
//! began anew (`begin_anew`) are events. Rows of one time are one step, as long as the time between them.
//!
//! *How we know*: `replay::what_was_felt_is_felt_again`, `replay::going_back_is_exact`.
//!
//! *Limits*: without an orientation of its own a free tool's shaft was not known; played again it is, and may
//! touch where it did not before. Rows that were lost stay lost.

use std::ops::Range;
use std::sync::Arc;

use palpate_files::{Event, Pose, Session, SessionRow};

use crate::interactive::DISPLAY;
use crate::{Error, Simulation, SimulationState, SimulationWorkspace, step};

/// States that are kept to go back to.
const KEPT: usize = 16;

/// A session that is played again, step by step, forth and back.
pub struct Replay {
    simulation: Arc<Simulation>,
    rows: Vec<SessionRow>,
    /// The rows of each step.
    steps: Vec<Range<usize>>,
    state: SimulationState,
    workspace: SimulationWorkspace,
    /// How many steps were played.
    played: usize,
    /// States after so many steps, in their order.
    kept: Vec<(usize, SimulationState)>,
    poses: Vec<Option<Pose>>,
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
        Ok(Self {
            state: SimulationState::new(&simulation).show_every(DISPLAY),
            workspace: SimulationWorkspace::new(&simulation),
            poses: vec![None; simulation.tools().len()],
            simulation,
            rows: session.rows.iter().map(in_scene).collect(),
            steps,
            played: 0,
            kept: Vec::new(),
        })
    }

    /// How many steps there are.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// How many were played.
    pub fn played(&self) -> usize {
        self.played
    }

    /// The time of a step [s].
    pub fn time(&self, step: usize) -> f64 {
        let step = step.min(self.steps.len() - 1);
        self.rows[self.steps[step].start].time_s
    }

    /// The state after the steps that were played.
    pub fn state(&self) -> &SimulationState {
        &self.state
    }

    /// What was recorded of the last step that was played, with the scene's numbers of its tools; nothing
    /// before the first.
    pub fn recorded(&self) -> &[SessionRow] {
        match self.played.checked_sub(1) {
            Some(last) => &self.rows[self.steps[last].clone()],
            None => &[],
        }
    }

    /// Plays the next step. Whether there was one.
    pub fn advance(&mut self) -> bool {
        let Some(rows) = self.steps.get(self.played).cloned() else {
            return false;
        };
        let rows = &self.rows[rows];
        let time = rows[0].time_s;
        let mut before = self.played.checked_sub(1).map(|last| self.time(last));
        let happened = |event| rows.iter().any(|row| row.events.contains(event));
        if happened(Event::BeginAnew) {
            self.state.begin_anew(&self.simulation);
            before = None;
        }
        if happened(Event::UndoCut) {
            self.state.undo_cut();
        }
        self.poses.fill(None);
        for row in rows
            .iter()
            .filter(|row| !row.events.contains(Event::Lifted))
        {
            self.poses[row.tool] = Some(Pose {
                position_m: row.position_m,
                orientation: Some(row.orientation),
                grip: row.grip,
                cut: row.cut,
            });
        }
        step(
            &self.simulation,
            (time, before.map_or(0.0, |before| time - before)),
            &self.poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.played += 1;
        self.keep();
        true
    }

    /// Plays until so many steps were played, forth, or back and forth from the last state that was kept.
    pub fn go_to(&mut self, played: usize) {
        self.go_back(played);
        while self.played < played && self.advance() {}
    }

    /// Back to the last state that was kept before so many steps were played; nothing where fewer were.
    pub fn go_back(&mut self, played: usize) {
        if played >= self.played {
            return;
        }
        let known = self.kept.iter().rposition(|(at, _)| *at <= played);
        (self.played, self.state) = match known {
            Some(known) => self.kept[known].clone(),
            None => (
                0,
                SimulationState::new(&self.simulation).show_every(DISPLAY),
            ),
        };
    }

    fn keep(&mut self) {
        let apart = (self.steps.len() / KEPT).max(1);
        let last = self.kept.last().map_or(0, |(at, _)| *at);
        if self.played >= last + apart {
            self.kept.push((self.played, self.state.clone()));
        }
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
