//! A state on its way: with its workspace, its clock, and the score of its task.
//!
//! The clock is that of `palpate_simulate::play`: the n-th step is at n times the step's length, so that the same
//! poses are the same bytes as in a session.

use palpate_files::scene::Task;
use palpate_files::{Event, Pose, Scene};
use palpate_simulate::performance::Performance;
use palpate_simulate::{SimulationState, SimulationWorkspace, step};

use super::Model;
use crate::failure::Failure;
use crate::scene;

/// All that changes while one organ is touched.
pub(super) struct Stepper {
    pub(super) course: SavedState,
    workspace: SimulationWorkspace,
    /// Where the tools go next.
    pub(super) poses: Vec<Option<Pose>>,
}

/// What has to be kept to go on.
#[derive(Clone)]
pub(super) struct SavedState {
    pub(super) state: SimulationState,
    pub(super) clock: Clock,
    /// None where there is no task.
    pub(super) judge: Option<Judge>,
}

/// What there is to do, and how it goes.
#[derive(Clone)]
pub(super) struct Judge {
    pub(super) task: Task,
    pub(super) performance: Performance,
}

/// When a step is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Clock {
    /// Of the last step [s].
    pub(super) time: f64,
    /// When steps of the usual length began [s], and how many there were since.
    begin: f64,
    number: u64,
    has_begun: bool,
}

impl Clock {
    /// Goes on by `elapsed`, or by a `step` [s]: how long that is [s]. The first step is at zero.
    fn go_on(&mut self, step: f64, elapsed: Option<f64>) -> f64 {
        let before = self.time;
        match (elapsed, self.has_begun) {
            (Some(elapsed), _) => {
                self.time = before + elapsed;
                self.begin = self.time;
                self.number = 0;
            }
            (None, false) => {}
            (None, true) => {
                self.number += 1;
                self.time = self.begin + self.number as f64 * step;
            }
        }
        self.has_begun = true;
        self.time - before
    }
}

impl Judge {
    fn new(scene: &Scene) -> Option<Self> {
        let names: Vec<String> = scene.tools.iter().map(|tool| tool.name.clone()).collect();
        scene::Scene::judged(scene).map(|task| Self {
            task: task.clone(),
            performance: Performance::new(task, &names),
        })
    }
}

impl Stepper {
    pub(super) fn new(model: &Model) -> Self {
        Self {
            course: SavedState {
                state: SimulationState::new(&model.prepared),
                clock: Clock::default(),
                judge: Judge::new(&model.scene),
            },
            workspace: SimulationWorkspace::new(&model.prepared),
            poses: vec![None; model.prepared.tools().len()],
        }
    }

    /// The surface follows no more often than every `period` [s].
    pub(super) fn show_every(&mut self, period: f64) {
        self.course.state.set_show_every(period);
    }

    /// Everything as in the beginning; with the estimated inclusions and the task of `scene`, if one is given.
    pub(super) fn reset(
        &mut self,
        model: &Model,
        scene: Option<&Scene>,
        period: f64,
    ) -> Result<(), Failure> {
        let scene = scene.unwrap_or(&model.scene);
        let SavedState {
            state,
            clock,
            judge,
        } = &mut self.course;
        state.set_estimated_inclusions(&model.prepared, &scene.organ.estimated_inclusions)?;
        state.reset(&model.prepared);
        state.set_show_every(period);
        *clock = Clock::default();
        *judge = Judge::new(scene);
        Ok(())
    }

    /// As it was.
    pub(super) fn restore(&mut self, model: &Model, course: SavedState) {
        self.course = course;
        // Scratch follows cuts by their number, which begins anew with a state that was kept.
        if self.course.state.cuts.is_some() {
            self.workspace = SimulationWorkspace::new(&model.prepared);
        }
    }

    /// One step to [`Self::poses`]. The tools that `marks` names say: here.
    pub(super) fn step(&mut self, model: &Model, elapsed: Option<f64>, marks: &[bool]) {
        let SavedState {
            state,
            clock,
            judge,
        } = &mut self.course;
        let elapsed = clock.go_on(model.prepared.step(), elapsed);
        step(
            &model.prepared,
            clock.time,
            elapsed,
            &self.poses,
            state,
            &mut self.workspace,
        );
        for (tool, _) in state.tools.iter_mut().zip(marks).filter(|(_, mark)| **mark) {
            tool.row.events.insert(Event::Mark);
        }
        if let Some(judge) = judge {
            for tool in state.tools.iter().filter(|tool| tool.pose.is_some()) {
                judge.performance.add(&tool.row);
            }
        }
    }

    /// The forces on the tools [N], into three numbers each.
    pub(super) fn write_forces(&self, forces: &mut [f64]) {
        for (own, tool) in forces.chunks_exact_mut(3).zip(&self.course.state.tools) {
            own.copy_from_slice(tool.force.as_slice());
        }
    }
}
