use std::time::Instant;

use palpate_files::{Event, Events, Pose, SessionRow};
use palpate_servo::{AffineForce, Histogram, Priority, Sample, Stage, log};

use super::endpoints::ModelEndpoint;
use super::extrapolation_error::force_on_tool;
use super::hand_over::affine_force;
use super::model::{Model, ReplacementReceiver};
use super::quality::ExtrapolationError;
use super::snapshot::RenderedForce;
use super::{DevicePlacement, ModelCommand, ModelReport};
use crate::{shape, touch};

/// The period of a display [s], with some tolerance: a step that is a little early counts.
pub(crate) const DISPLAY: f64 = 0.9 / 60.0;

/// The button that cuts.
pub const CUTS: u32 = 1;

/// The model with its ends of all channels. A step allocates nothing and waits for no other thread.
pub(super) struct ModelLoop {
    model: Box<Model>,
    taking_over: ReplacementReceiver,
    endpoints: Vec<Option<ModelEndpoint>>,
    samples: Vec<Option<Sample>>,
    poses: Vec<Option<Pose>>,
    rendered: Vec<RenderedForce>,
    rows: log::Writer<SessionRow>,
    commands: log::Reader<ModelCommand>,
    paused: bool,
    /// Events of commands since the last row.
    command_events: Events,
    /// The diameter stated since the last row [m].
    stated: Option<f64>,
    /// Whether each tool was present in the step before.
    were_present: Vec<bool>,
    /// Time of the last call [s], and total time of pauses [s].
    last_call: f64,
    paused_time: f64,
    steps: u64,
    /// Start of the step.
    start: Instant,
    touch_times: Histogram,
    step_times: Histogram,
    error: ExtrapolationError,
    began: f64,
    now: f64,
    /// Time of the last row [s]; none before the first.
    last: Option<f64>,
    missed: u64,
    pub(super) priority: Priority,
}

/// Source of a model's commands, and destination of its rows.
pub(super) struct Channels {
    pub(super) commands: log::Reader<ModelCommand>,
    pub(super) rows: log::Writer<SessionRow>,
    pub(super) taking_over: ReplacementReceiver,
}

impl ModelLoop {
    pub(super) fn new(
        model: Box<Model>,
        endpoints: Vec<Option<ModelEndpoint>>,
        channels: Channels,
    ) -> Self {
        let Channels {
            commands,
            rows,
            taking_over,
        } = channels;
        let tools = endpoints.len();
        Self {
            model,
            taking_over,
            endpoints,
            samples: vec![None; tools],
            poses: vec![None; tools],
            rendered: vec![RenderedForce::NOTHING; tools],
            rows,
            commands,
            paused: false,
            command_events: Events::NONE,
            stated: None,
            were_present: vec![false; tools],
            last_call: 0.0,
            paused_time: 0.0,
            start: Instant::now(),
            touch_times: Histogram::default(),
            step_times: Histogram::default(),
            error: ExtrapolationError::default(),
            began: 0.0,
            now: 0.0,
            steps: 0,
            last: None,
            missed: 0,
            priority: Priority::Ordinary,
        }
    }

    /// The forces of a step at `time` [s] at the current hand positions.
    pub(super) fn touch(&mut self, time: f64) {
        self.start = Instant::now();
        self.read_hands();
        self.swap_model();
        self.process_commands();
        if self.paused {
            self.paused_time += time - self.last_call;
        }
        self.last_call = time;
        if self.paused {
            return;
        }
        // Time stops during a pause.
        let time = time - self.paused_time;
        // The first depth is a jump, as in a motion.
        let elapsed = self.last.map_or(0.0, |last| time - last);
        if self.steps == 0 {
            self.began = time;
        }
        self.steps += 1;
        self.now = time;
        let Model {
            simulation,
            state,
            workspace,
            ..
        } = &mut *self.model;
        touch(simulation, time, elapsed, &self.poses, state, workspace);
        self.touch_times.add(self.start.elapsed().as_secs_f64());
    }

    /// Hands the forces over to the servo loops.
    pub(super) fn hand_over(&mut self) {
        let model = &self.model;
        let tools = model.simulation.tools().iter().zip(&model.state.tools);
        for ((endpoint, sample), (tool, state)) in
            self.endpoints.iter_mut().zip(&self.samples).zip(tools)
        {
            if let (Some(endpoint), Some(sample)) = (endpoint, sample) {
                let time = sample.state.time;
                endpoint.answers.send(match self.paused {
                    true => AffineForce::none(time),
                    false => affine_force(tool, state, time),
                });
            }
        }
    }

    /// Completes the step, after the hand-over of its forces: display and recording.
    pub(super) fn shape(&mut self) {
        if self.paused {
            return;
        }
        let Model {
            simulation,
            state,
            workspace,
            ..
        } = &mut *self.model;
        shape(simulation, self.now, state, workspace);
        // After a restart, the rendered force still belongs to the earlier touch.
        if self.last.is_some() {
            self.compare();
        }
        self.record(self.now);
        self.step_times.add(self.start.elapsed().as_secs_f64());
    }

    /// Sends the snapshot of the step to the viewers.
    pub(super) fn show(&mut self) {
        let report = self.report();
        let Self {
            model,
            rendered,
            now,
            paused,
            ..
        } = self;
        let Model {
            snapshots, state, ..
        } = &mut **model;
        for snapshots in snapshots {
            snapshots.send_with(|snapshot| {
                snapshot.fill(*now, state, rendered);
                snapshot.report = report;
                snapshot.paused = *paused;
            });
        }
    }

    /// Counts missed steps.
    pub(super) fn count_missed(&mut self, steps: u64) {
        self.missed += steps;
    }

    pub(super) fn report(&self) -> ModelReport {
        let steps = self.step_times.count();
        let elapsed = self.now - self.began;
        ModelReport {
            steps,
            missed: self.missed,
            rate: if elapsed > 0.0 {
                (steps - 1) as f64 / elapsed
            } else {
                0.0
            },
            touch_times: self.touch_times.percentiles(),
            step_times: self.step_times.percentiles(),
            extrapolation: self.error,
            priority: self.priority,
        }
    }

    /// Continues with another model, the organ at rest, if one is ready.
    fn swap_model(&mut self) {
        let Some(next) = self.taking_over.next(&self.samples) else {
            return;
        };
        let old = std::mem::replace(&mut self.model, next);
        self.mark_restart();
        self.taking_over.finish(old, self.paused);
    }

    /// Marks the next row as the first of a new touch.
    fn mark_restart(&mut self) {
        self.were_present.fill(false);
        self.last = None;
        self.command_events.insert(Event::Restart);
    }

    /// Processes commands. The next row records a change of the organ, one at a time.
    fn process_commands(&mut self) {
        while self.command_events.is_empty()
            && self.stated.is_none()
            && let Some(command) = self.commands.next_value()
        {
            match command {
                ModelCommand::Pause => self.paused = true,
                ModelCommand::Resume => self.paused = false,
                ModelCommand::Reset => {
                    let Model {
                        simulation, state, ..
                    } = &mut *self.model;
                    state.reset(simulation);
                    self.mark_restart();
                }
                ModelCommand::UndoCut => {
                    if self.model.state.undo_cut() {
                        self.command_events.insert(Event::UndoCut);
                    }
                }
                ModelCommand::Mark => self.command_events.insert(Event::Mark),
                ModelCommand::StateDiameter(diameter) => self.stated = Some(diameter),
            }
        }
    }

    fn read_hands(&mut self) {
        for (number, endpoint) in self.endpoints.iter_mut().enumerate() {
            let Some(endpoint) = endpoint else { continue };
            let sample = *endpoint.samples.latest();
            self.samples[number] = sample;
            self.poses[number] = sample.and_then(|sample| pose(&endpoint.placement, &sample));
            self.rendered[number] = sample.map_or(RenderedForce::NOTHING, |sample| RenderedForce {
                force: endpoint.placement.force_in_scene(&sample.output),
                fault: match sample.stage {
                    Stage::Faulted(fault) => Some(fault),
                    _ => None,
                },
            });
        }
    }

    /// Compares the rendered force at each hand position, from older answers, with the model's force for it.
    fn compare(&mut self) {
        let Model {
            simulation, state, ..
        } = &*self.model;
        for ((endpoint, sample), tool) in self.endpoints.iter().zip(&self.samples).zip(&state.tools)
        {
            let (Some(endpoint), Some(sample)) = (endpoint, sample) else {
                continue;
            };
            // Before the first answer the loop had no force.
            let answered = sample.age.is_some_and(f64::is_finite);
            let made = force_on_tool(simulation, &endpoint.placement, sample);
            if answered && made.iter().all(|component| component.is_finite()) {
                self.error.add(&made, &tool.force);
            }
        }
    }

    /// Records a row for each tool that is present or has just left; the first row has the events of commands.
    fn record(&mut self, time: f64) {
        let tools = &self.model.state.tools;
        let nobody = tools.iter().all(|tool| tool.pose.is_none());
        for (number, tool) in tools.iter().enumerate() {
            let is_there = tool.pose.is_some();
            let was_there = std::mem::replace(&mut self.were_present[number], is_there);
            let is_asked = !self.command_events.is_empty() || self.stated.is_some();
            let speaks = nobody && number == 0 && is_asked;
            if !is_there && !was_there && !speaks {
                continue;
            }
            let mut row = match is_there {
                true => tool.row,
                false => lifted(tool.row, time),
            };
            row.events = row.events | std::mem::take(&mut self.command_events);
            row.stated_diameter_m = self.stated.take();
            self.last = Some(time);
            self.rows.add(row);
        }
    }
}

/// The row of a tool that has just left.
fn lifted(last: SessionRow, time: f64) -> SessionRow {
    SessionRow {
        time_s: time,
        force_n: [0.0; 3],
        torque_nm: [0.0; 3],
        contact: false,
        depth_m: 0.0,
        grip_force_n: 0.0,
        stated_diameter_m: None,
        events: last.events | [Event::Lifted].into_iter().collect(),
        ..last
    }
}

/// The pose of a sample's hand in the scene; none without a hand.
pub(super) fn pose(placement: &DevicePlacement, sample: &Sample) -> Option<Pose> {
    let state = sample.state;
    let place = placement.tip(&state.position);
    let there = state.present && place.iter().all(|coordinate| coordinate.is_finite());
    there.then(|| Pose {
        position_m: place.into(),
        orientation: state.orientation.map(|turned| {
            let turned = placement.rotation * turned;
            [turned.i, turned.j, turned.k, turned.w]
        }),
        grip: state.grip,
        cut: state.buttons & CUTS != 0,
    })
}
