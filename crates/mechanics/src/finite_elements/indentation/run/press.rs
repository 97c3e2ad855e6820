//! Pressing deeper, or lifting, in adaptive steps.

use std::ops::ControlFlow;

use super::super::super::continuation::{Increments, continue_to};
use super::{Failure, IndentationPoint, IndentationRun};
use crate::Error;

/// From this step down, an element that gives way is followed downhill [-].
const DOWNHILL_STEP: f64 = 0.1;

/// How an equilibrium is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SearchMethod {
    /// By Newton's method alone.
    Straight,
    /// Downhill in energy, where that fails.
    Downhill,
}

/// A run from one depth to another, in metres of travel.
struct Pressing<'r> {
    run: &'r mut IndentationRun,
    /// Times [s] and depths [m] of both ends.
    times: [f64; 2],
    depths: [f64; 2],
    travelled: f64,
}

impl IndentationRun {
    /// Continues to `depth` [m] at `time` [s], linearly and in adaptive steps; `at_step` receives each.
    ///
    /// # Errors
    /// When no equilibrium is found on the way, or tissue enters an indenter without a side.
    pub fn press(
        &mut self,
        time: f64,
        depth: f64,
        mut at_step: impl FnMut(&IndentationPoint),
    ) -> Result<IndentationPoint, Error> {
        let (from, mut steps) = (self.now.depth, self.steps);
        self.only_deeper &= depth >= from;
        // Under a growing load the face sticks and slips at the same places.
        if self.is_linear() && (self.only_deeper || !self.has_friction) {
            steps.next = f64::INFINITY;
        }
        let mut pressing = Pressing {
            times: [self.now.time, time],
            depths: [from, depth],
            travelled: 0.0,
            run: self,
        };
        let length = (depth - from).abs();
        let mut found = Ok(None);
        let mut report = |pressing: &mut Pressing<'_>| {
            found = pressing.run.check_domain().map(|()| {
                let point = pressing.run.point();
                at_step(&point);
                Some(point)
            });
            match found {
                Ok(_) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        };
        let went = if length > 0.0 {
            continue_to(&mut pressing, &mut steps, length, report)
        } else {
            // Time alone passes.
            pressing.advance(0.0).map(|_| {
                let _ = report(&mut pressing);
            })
        };
        steps.next = steps.next.min(steps.longest);
        self.steps = steps;
        went.map_err(|failure| Error::NoEquilibrium {
            depth: self.now.depth,
            failure,
        })?;
        Ok(found?.unwrap_or_else(|| self.point()))
    }
}

impl Increments for Pressing<'_> {
    fn reached(&self) -> f64 {
        self.travelled
    }

    fn advance(&mut self, goal: f64) -> Result<usize, Failure> {
        let length = (self.depths[1] - self.depths[0]).abs();
        let part = if length > 0.0 { goal / length } else { 1.0 };
        let at = |ends: [f64; 2]| match part == 1.0 {
            true => ends[1],
            false => ends[0] + part * (ends[1] - ends[0]),
        };
        let run = &mut *self.run;
        // Friction has no energy to follow downhill.
        let way = match goal - self.travelled > DOWNHILL_STEP * run.scale || run.has_friction {
            true => SearchMethod::Straight,
            false => SearchMethod::Downhill,
        };
        let (increment, solutions) = run.increment_at(at(self.times), at(self.depths), way)?;
        run.before = Some(std::mem::replace(&mut run.now, increment));
        self.travelled = goal;
        Ok(solutions)
    }
}
