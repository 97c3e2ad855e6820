use std::time::Instant;

use palpate_files::motion::{Cursor, ToolMotion};
use palpate_files::{Motion, SessionRow};

use crate::summary::{Summary, Tally};
use crate::{Error, Simulation, SimulationState, SimulationWorkspace, step};

/// A motion with more steps than this is probably a typing error: 55 hours at 200 Hz.
const MAX_STEPS: u64 = 40_000_000;

/// Whether to continue after a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Continue with the next step.
    Continue,
    /// End here; the steps so far count.
    Stop,
}

/// A completed step.
pub struct Frame<'a> {
    /// Number of the step, from zero.
    pub number: u64,
    /// Number of all steps.
    pub steps: u64,
    /// Its time [s].
    pub time: f64,
    /// The state after it.
    pub state: &'a SimulationState,
}

impl Frame<'_> {
    /// The rows of this step for the session: one for each tool that is present.
    pub fn rows(&self) -> impl Iterator<Item = &SessionRow> {
        let present = self.state.tools.iter().filter(|tool| tool.pose.is_some());
        present.map(|tool| &tool.row)
    }

    /// Whether this step is one of `wanted` frames, evenly from the first to the last, of which `done` were taken.
    pub fn is_due(&self, done: u64, wanted: u64) -> bool {
        let due = match wanted {
            0 => return false,
            1 => self.steps - 1,
            _ => done * (self.steps - 1) / (wanted - 1),
        };
        done < wanted && self.number >= due
    }
}

/// Rejects a motion that cannot be played, before a result is written anywhere.
///
/// # Errors
/// When the motion moves a tool that is not in the scene or takes too many steps.
pub fn check_motion(simulation: &Simulation, motion: &Motion) -> Result<(), Error> {
    match_tools(simulation, motion)?;
    whole_steps(simulation, motion.final_time_s() - motion.first_time_s())?;
    Ok(())
}

/// Plays a whole motion, from its first time to its last, as fast as possible; it calls `observe` after every step.
///
/// # Errors
/// When the motion moves a tool that is not in the scene or takes too many steps, and every error of `observe`.
pub fn play<E: From<Error>>(
    simulation: &Simulation,
    motion: &Motion,
    mut observe: impl FnMut(&Frame<'_>) -> Result<Flow, E>,
) -> Result<Summary, E> {
    let motions = match_tools(simulation, motion)?;
    let (first, last) = (motion.first_time_s(), motion.final_time_s());
    let whole = whole_steps(simulation, last - first)?;
    // The last time counts, also when it falls between two steps.
    let remainder = last - first - whole as f64 * simulation.step;
    let steps = whole + 1 + u64::from(remainder > 1e-6 * simulation.step);
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    let mut cursors = vec![Cursor::default(); motions.len()];
    let mut poses = vec![None; motions.len()];
    let mut tally = Tally::with_capacity(steps);
    let mut before = first;
    for number in 0..steps {
        let time = (first + number as f64 * simulation.step).min(last);
        for ((pose, tool), cursor) in poses.iter_mut().zip(&motions).zip(&mut cursors) {
            *pose = tool.and_then(|tool: &ToolMotion| tool.pose(time, cursor));
        }
        let start = Instant::now();
        step(
            simulation,
            time,
            time - before,
            &poses,
            &mut state,
            &mut workspace,
        );
        tally.add(start.elapsed(), &state);
        before = time;
        let frame = Frame {
            number,
            steps,
            time,
            state: &state,
        };
        if observe(&frame)? == Flow::Stop {
            let interrupted = number + 1 < steps;
            return Ok(tally.finish(simulation, &state, &workspace, interrupted));
        }
    }
    Ok(tally.finish(simulation, &state, &workspace, false))
}

fn match_tools<'m>(
    simulation: &Simulation,
    motion: &'m Motion,
) -> Result<Vec<Option<&'m ToolMotion>>, Error> {
    for moved in motion.tools() {
        if !simulation
            .tools
            .iter()
            .any(|tool| tool.name == moved.name())
        {
            let known: Vec<_> = simulation
                .tools
                .iter()
                .map(|tool| format!("{:?}", tool.name))
                .collect();
            return Err(Error::UnknownTool {
                found: moved.name().to_owned(),
                known: known.join(" and "),
            });
        }
    }
    let tools = simulation.tools.iter();
    Ok(tools.map(|tool| motion.tool(&tool.name)).collect())
}

fn whole_steps(simulation: &Simulation, duration: f64) -> Result<u64, Error> {
    let steps = (duration / simulation.step + 1e-6).floor();
    if steps < MAX_STEPS as f64 {
        return Ok(steps as u64);
    }
    Err(Error::TooLong {
        duration,
        step: simulation.step,
        steps: steps.min(u64::MAX as f64) as u64,
        most: MAX_STEPS,
    })
}
