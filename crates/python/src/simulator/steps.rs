//! Steps of many states, shared out to threads.

use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::stepper::Stepper;
use super::{Model, poses};
use crate::failure::Failure;

/// The calling thread works for so long before it starts others, which takes about half of that for each.
const BEFORE_THREADS: Duration = Duration::from_micros(100);

/// Steps of all states, as rows of numbers that were checked.
pub(super) struct Steps<'p> {
    /// Step by step, state by state, tool by tool.
    pub(super) flat: &'p [f64],
    /// Numbers of a pose.
    pub(super) width: usize,
    pub(super) steps: usize,
    /// Of each tool of each state: whether its hand says at the last step: here.
    pub(super) marks: Vec<bool>,
    /// Of each state.
    pub(super) goes_on: Vec<bool>,
}

impl Steps<'_> {
    /// All of them; whoever is idle takes the next state. The forces [N] are written state by state.
    pub(super) fn run(
        &self,
        models: &[Arc<Model>],
        steppers: &mut [Stepper],
        threads: usize,
        forces: &mut [f64],
    ) -> Result<(), Failure> {
        let (count, tools) = (steppers.len(), models[0].prepared.tools().len());
        let each = (self.steps * 3 * tools).max(1);
        let states = steppers.iter_mut().zip(forces.chunks_mut(each));
        let queue = Mutex::new(states.enumerate());
        let failed = Mutex::new(None);
        let work = |until: Option<Instant>| {
            while until.is_none_or(|until| Instant::now() < until) {
                let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
                let Some((number, (stepper, forces))) = next else {
                    return;
                };
                if let Err(failure) = self.run_one(&models[number], number, count, stepper, forces)
                {
                    *failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(failure);
                }
            }
        };
        work(Some(Instant::now() + BEFORE_THREADS));
        let left = queue.lock().unwrap_or_else(PoisonError::into_inner).len();
        thread::scope(|scope| {
            for _ in 1..threads.min(left) {
                let work = || work(None);
                // With fewer threads it takes longer, and comes to the same.
                if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                    break;
                }
            }
            work(None);
        });
        let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
        failed.map_or(Ok(()), Err)
    }

    /// Those of the state of this number among so many.
    fn run_one(
        &self,
        model: &Model,
        number: usize,
        count: usize,
        stepper: &mut Stepper,
        forces: &mut [f64],
    ) -> Result<(), Failure> {
        let tools = stepper.poses.len();
        let row = tools * self.width;
        for (step, forces) in forces.chunks_exact_mut(3 * tools).enumerate() {
            if self.goes_on[number] {
                let at = (step * count + number) * row;
                let poses = &self.flat[at..at + row];
                poses::of_flat(poses, self.width, &mut stepper.poses, "tool")?;
                let marks = match step + 1 == self.steps {
                    true => &self.marks[number * tools..(number + 1) * tools],
                    false => &[],
                };
                stepper.step(model, None, marks);
            }
            stepper.write_forces(forces);
        }
        Ok(())
    }
}
