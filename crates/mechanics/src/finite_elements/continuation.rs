//! Continuation: a sequence of equilibria along a path, with steps that grow while they converge easily.

use std::ops::ControlFlow;

use super::newton::Failure;

/// A body that follows a path of supports and loads.
pub(super) trait Increments {
    /// The place reached, in any unit.
    fn reached(&self) -> f64;

    /// Finds the equilibrium at `goal` and moves there; on failure it stays. Returns the number of solutions of the
    /// linear system.
    fn advance(&mut self, goal: f64) -> Result<usize, Failure>;
}

/// Lengths of steps, in the unit of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps {
    /// The next one.
    pub(super) next: f64,
    pub(super) longest: f64,
    /// A shorter one is not tried.
    pub(super) shortest: f64,
    /// Steps grow after so many solutions or fewer.
    pub(super) easy: usize,
    /// They shrink after more than these.
    pub(super) hard: usize,
}

impl Steps {
    /// The next step when `left` are left; two equal steps rather than a long and a tiny one.
    pub(super) fn step(&self, left: f64) -> f64 {
        match left <= self.next {
            true => left,
            false => self.next.min(0.5 * left),
        }
    }

    /// After a `step` that took this number of solutions.
    pub(super) fn succeeded(&mut self, step: f64, solutions: usize) {
        if solutions <= self.easy {
            self.next = (1.5 * step).max(self.next).min(self.longest);
        } else if solutions > self.hard {
            self.next = 0.7 * step;
        }
    }

    /// After a `step` that failed; whether a shorter one is worth it.
    pub(super) fn failed(&mut self, step: f64) -> bool {
        let again = step > self.shortest;
        if again {
            self.next = 0.5 * step;
        }
        again
    }
}

/// Continues to `end`; `at_step` receives each equilibrium on the path, and may end it there.
pub(super) fn continue_to<R: Increments>(
    run: &mut R,
    steps: &mut Steps,
    end: f64,
    mut at_step: impl FnMut(&mut R) -> ControlFlow<()>,
) -> Result<(), Failure> {
    while run.reached() < end {
        let from = run.reached();
        let step = steps.step(end - from);
        let goal = if step == end - from { end } else { from + step };
        match run.advance(goal) {
            Ok(solutions) => {
                steps.succeeded(step, solutions);
                if at_step(run).is_break() {
                    return Ok(());
                }
            }
            Err(failure) => {
                if !steps.failed(step) {
                    return Err(failure);
                }
            }
        }
    }
    Ok(())
}

/// The unknowns of a body at a place of its path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached<'a> {
    /// In the unit of the path.
    pub(super) place: f64,
    pub(super) unknowns: &'a [f64],
}

/// The unknowns at `goal`, extrapolated linearly from `before` and `now`.
pub(super) fn extrapolated(now: Reached<'_>, before: Option<Reached<'_>>, goal: f64) -> Vec<f64> {
    let mut ahead = now.unknowns.to_vec();
    if let Some(before) = before {
        let part = (goal - now.place) / (now.place - before.place);
        for (x, old) in ahead.iter_mut().zip(before.unknowns) {
            *x += part * (*x - old);
        }
    }
    ahead
}
