use std::time::Instant;

use palpate_files::{Event, Events, Pose, SessionRow};
use palpate_servo::{AffineForce, Histogram, Priority, Sample, Stage, log};

use super::endpoints::ModelEndpoint;
use super::hand_over::affine_force;
use super::judge::made;
use super::model::{Model, TakingOver};
use super::quality::ExtrapolationError;
use super::snapshot::RenderedForce;
use super::{DevicePlacement, ModelCommand, ModelReport};
use crate::{shape, touch};

/// The period of a display [s], with some room: a step that is a little early counts.
pub(crate) const DISPLAY: f64 = 0.9 / 60.0;

/// The button that cuts.
pub const CUTS: u32 = 1;

/// The model and its ends of all channels. A step allocates nothing and waits for nobody.
pub(super) struct ModelLoop {
    model: Box<Model>,
    taking_over: TakingOver,
    lines: Vec<Option<ModelEndpoint>>,
    samples: Vec<Option<Sample>>,
    poses: Vec<Option<Pose>>,
    felt: Vec<RenderedForce>,
    rows: log::Writer<SessionRow>,
    commands: log::Reader<ModelCommand>,
    paused: bool,
    /// What was ordered since the last row.
    ordered: Events,
    /// The diameter that was stated since the last row [m].
    stated: Option<f64>,
    /// Which tools were there in the step before.
    were_there: Vec<bool>,
    /// When it was asked last [s], and how long it stood still in all [s].
    asked: f64,
    stood: f64,
    steps: u64,
    /// When the step began.
    start: Instant,
    touch_times: Histogram,
    step_times: Histogram,
    error: ExtrapolationError,
    began: f64,
    now: f64,
    /// The step of the last row [s]; none before the first.
    last: Option<f64>,
    missed: u64,
    pub(super) priority: Priority,
}

/// Where a model gets its commands from, and where its rows go.
pub(super) struct Channels {
    pub(super) commands: log::Reader<ModelCommand>,
    pub(super) rows: log::Writer<SessionRow>,
    pub(super) taking_over: TakingOver,
}

impl ModelLoop {
    pub(super) fn new(
        model: Box<Model>,
        lines: Vec<Option<ModelEndpoint>>,
        channels: Channels,
    ) -> Self {
        let Channels {
            commands,
            rows,
            taking_over,
        } = channels;
        let tools = lines.len();
        Self {
            model,
            taking_over,
            lines,
            samples: vec![None; tools],
            poses: vec![None; tools],
            felt: vec![RenderedForce::NOTHING; tools],
            rows,
            commands,
            paused: false,
            ordered: Events::NONE,
            stated: None,
            were_there: vec![false; tools],
            asked: 0.0,
            stood: 0.0,
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

    /// The forces of a step at `time` [s] with the hands where they are.
    pub(super) fn touch(&mut self, time: f64) {
        self.start = Instant::now();
        self.read_hands();
        self.let_another_take_over();
        self.process_commands();
        if self.paused {
            self.stood += time - self.asked;
        }
        self.asked = time;
        if self.paused {
            return;
        }
        // Time stands still with the organ.
        let time = time - self.stood;
        // The first depth comes as a step, as in a motion.
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
        for ((line, sample), (tool, state)) in self.lines.iter_mut().zip(&self.samples).zip(tools) {
            if let (Some(line), Some(sample)) = (line, sample) {
                let time = sample.state.time;
                line.answers.send(match self.paused {
                    true => AffineForce::none(time),
                    false => affine_force(tool, state, time),
                });
            }
        }
    }

    /// Completes the step, after its forces were handed over: what is seen and recorded of it.
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
        // After a new beginning, what was felt was made of another touch.
        if self.last.is_some() {
            self.compare();
        }
        self.record(self.now);
        self.step_times.add(self.start.elapsed().as_secs_f64());
    }

    /// Shows the step.
    pub(super) fn show(&mut self) {
        let report = self.report();
        let Self {
            model,
            felt,
            now,
            paused,
            ..
        } = self;
        let Model {
            snapshots, state, ..
        } = &mut **model;
        for snapshots in snapshots {
            snapshots.send_with(|snapshot| {
                snapshot.fill(*now, state, felt);
                snapshot.report = report;
                snapshot.paused = *paused;
            });
        }
    }

    /// Counts steps that were left out.
    pub(super) fn miss(&mut self, steps: u64) {
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

    /// Goes on with another model, the organ at rest, where one is ready.
    fn let_another_take_over(&mut self) {
        let Some(next) = self.taking_over.next(&self.samples) else {
            return;
        };
        let old = std::mem::replace(&mut self.model, next);
        self.note_new_beginning();
        self.taking_over.finish(old, self.paused);
    }

    /// The next row is the first of a new touch, and says so.
    fn note_new_beginning(&mut self) {
        self.were_there.fill(false);
        self.last = None;
        self.ordered.insert(Event::BeginAnew);
    }

    /// Does what was ordered. What changes the organ is told by the next row, one thing at a time.
    fn process_commands(&mut self) {
        while self.ordered.is_empty()
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
                    self.note_new_beginning();
                }
                ModelCommand::UndoCut => {
                    if self.model.state.undo_cut() {
                        self.ordered.insert(Event::UndoCut);
                    }
                }
                ModelCommand::Mark => self.ordered.insert(Event::Mark),
                ModelCommand::StateDiameter(diameter) => self.stated = Some(diameter),
            }
        }
    }

    fn read_hands(&mut self) {
        for (number, line) in self.lines.iter_mut().enumerate() {
            let Some(line) = line else { continue };
            let sample = *line.samples.latest();
            self.samples[number] = sample;
            self.poses[number] = sample.and_then(|sample| pose(&line.placement, &sample));
            self.felt[number] = sample.map_or(RenderedForce::NOTHING, |sample| RenderedForce {
                force: line.placement.force_in_scene(&sample.sent),
                fault: match sample.stage {
                    Stage::Faulted(fault) => Some(fault),
                    _ => None,
                },
            });
        }
    }

    /// What was felt at the place of a hand, made of older answers, beside what is found for it now.
    fn compare(&mut self) {
        let Model {
            simulation, state, ..
        } = &*self.model;
        for ((line, sample), tool) in self.lines.iter().zip(&self.samples).zip(&state.tools) {
            let (Some(line), Some(sample)) = (line, sample) else {
                continue;
            };
            // Before the first answer nothing was handed over.
            let answered = sample.age.is_some_and(f64::is_finite);
            let made = made(simulation, &line.placement, sample);
            if answered && made.iter().all(|component| component.is_finite()) {
                self.error.add(&made, &tool.force);
            }
        }
    }

    /// A row for each tool that is there or has just gone; what was ordered is told by the first.
    fn record(&mut self, time: f64) {
        let tools = &self.model.state.tools;
        let nobody = tools.iter().all(|tool| tool.pose.is_none());
        for (number, tool) in tools.iter().enumerate() {
            let is_there = tool.pose.is_some();
            let was_there = std::mem::replace(&mut self.were_there[number], is_there);
            let is_asked = !self.ordered.is_empty() || self.stated.is_some();
            let speaks = nobody && number == 0 && is_asked;
            if !is_there && !was_there && !speaks {
                continue;
            }
            let mut row = match is_there {
                true => tool.row,
                false => lifted(tool.row, time),
            };
            row.events = row.events | std::mem::take(&mut self.ordered);
            row.stated_diameter_m = self.stated.take();
            self.last = Some(time);
            self.rows.add(row);
        }
    }
}

/// The row of a tool that is no longer there.
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

/// Where a sample's hand is in the scene; none where nobody is.
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
