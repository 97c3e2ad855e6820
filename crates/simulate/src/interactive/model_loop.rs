use std::sync::Arc;
use std::time::Instant;

use palpate_files::{Pose, SessionRow};
use palpate_geometry::Vec3;
use palpate_servo::{AffineForce, Histogram, Sample, latest, log};

use super::hand_over::affine_force;
use super::judge::made;
use super::quality::ExtrapolationError;
use super::stations::Line;
use super::{Happenings, ModelReport, Mount, Order, Snapshot};
use crate::{Simulation, SimulationState, SimulationWorkspace, step};

/// The period of a display [s], with some room: a step that is a little early counts.
const DISPLAY: f64 = 0.9 / 60.0;

/// The button that cuts.
pub const CUTS: u32 = 1;

/// The model and its ends of all channels. A step allocates nothing and waits for nobody.
pub(super) struct ModelLoop {
    simulation: Arc<Simulation>,
    state: SimulationState,
    workspace: SimulationWorkspace,
    lines: Vec<Option<Line>>,
    samples: Vec<Option<Sample>>,
    poses: Vec<Option<Pose>>,
    felt: Vec<Vec3>,
    rows: log::Writer<SessionRow>,
    orders: log::Reader<Order>,
    paused: bool,
    snapshots: latest::Sender<Snapshot>,
    happenings: Happenings,
    step_times: Histogram,
    error: ExtrapolationError,
    began: f64,
    last: Option<f64>,
    missed: u64,
}

impl ModelLoop {
    pub(super) fn new(
        simulation: Arc<Simulation>,
        lines: Vec<Option<Line>>,
        (orders, rows): (log::Reader<Order>, log::Writer<SessionRow>),
        snapshots: latest::Sender<Snapshot>,
    ) -> Self {
        let tools = lines.len();
        Self {
            state: SimulationState::new(&simulation).show_every(DISPLAY),
            workspace: SimulationWorkspace::new(&simulation),
            simulation,
            lines,
            samples: vec![None; tools],
            poses: vec![None; tools],
            felt: vec![Vec3::zeros(); tools],
            rows,
            orders,
            paused: false,
            snapshots,
            happenings: Happenings::default(),
            step_times: Histogram::default(),
            error: ExtrapolationError::default(),
            began: 0.0,
            last: None,
            missed: 0,
        }
    }

    /// A step at `time` [s] with the hands where they are.
    pub(super) fn step(&mut self, time: f64) {
        let start = Instant::now();
        self.read_hands();
        self.obey();
        if self.paused {
            // What was missed meanwhile is not made up for.
            self.last = self.last.map(|_| time);
            return;
        }
        // Before the first step nothing was touched; the first way in is taken as one period long.
        let elapsed = self.last.map_or(self.simulation.step(), |last| time - last);
        if self.last.is_none() {
            self.began = time;
        }
        self.last = Some(time);
        step(
            &self.simulation,
            (time, elapsed),
            &self.poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.compare();
        self.record(time);
        self.step_times.add(start.elapsed().as_secs_f64());
    }

    /// Hands the step over to the servo loops and to the display.
    pub(super) fn publish(&mut self) {
        let tools = self.simulation.tools().iter().zip(&self.state.tools);
        for ((line, sample), (tool, state)) in self.lines.iter_mut().zip(&self.samples).zip(tools) {
            if let (Some(line), Some(sample)) = (line, sample) {
                let time = sample.state.time;
                line.answers.send(match self.paused {
                    true => AffineForce::none(time),
                    false => affine_force(tool, state, time),
                });
            }
        }
        let report = self.report();
        let Self {
            snapshots,
            state,
            felt,
            happenings,
            last,
            paused,
            ..
        } = self;
        snapshots.send_with(|snapshot| {
            snapshot.fill(last.unwrap_or(0.0), state, felt);
            snapshot.happenings = *happenings;
            snapshot.report = report;
            snapshot.paused = *paused;
        });
    }

    /// Counts steps that were left out.
    pub(super) fn miss(&mut self, steps: u64) {
        self.missed += steps;
    }

    pub(super) fn report(&self) -> ModelReport {
        let steps = self.step_times.count();
        let elapsed = self.last.map_or(0.0, |last| last - self.began);
        ModelReport {
            steps,
            missed: self.missed,
            rate: if elapsed > 0.0 {
                (steps - 1) as f64 / elapsed
            } else {
                0.0
            },
            step_times: self.step_times.percentiles(),
            extrapolation: self.error,
        }
    }

    fn obey(&mut self) {
        while let Some(order) = self.orders.next_value() {
            match order {
                Order::Pause => self.paused = true,
                Order::Resume => self.paused = false,
                Order::Reset => self.state.begin_anew(&self.simulation),
                Order::UndoCut => {
                    self.state.undo_cut();
                }
            }
        }
    }

    fn read_hands(&mut self) {
        for (number, line) in self.lines.iter_mut().enumerate() {
            let Some(line) = line else { continue };
            let sample = *line.samples.latest();
            self.samples[number] = sample;
            self.poses[number] = sample.and_then(|sample| pose(&line.mount, &sample));
            self.felt[number] = sample.map_or(Vec3::zeros(), |sample| {
                line.mount.force_in_scene(&sample.sent)
            });
        }
    }

    /// What was felt at the place of a hand, made of older answers, beside what is found for it now.
    fn compare(&mut self) {
        for ((line, sample), tool) in self.lines.iter().zip(&self.samples).zip(&self.state.tools) {
            let (Some(line), Some(sample)) = (line, sample) else {
                continue;
            };
            // Before the first answer nothing was handed over.
            let answered = sample.age.is_some_and(f64::is_finite);
            let made = made(&self.simulation, &line.mount, sample);
            if answered && made.iter().all(|component| component.is_finite()) {
                self.error.add(&made, &tool.force);
            }
        }
    }

    fn record(&mut self, time: f64) {
        for (number, tool) in self.state.tools.iter().enumerate() {
            if tool.pose.is_none() {
                continue;
            }
            self.rows.add(tool.row);
            for event in tool.row.events.iter() {
                self.happenings.add(time, number, event);
            }
        }
    }
}

/// Where a sample's hand is in the scene; none where nobody is.
pub(super) fn pose(mount: &Mount, sample: &Sample) -> Option<Pose> {
    let state = sample.state;
    let place = mount.tip(&state.position);
    let there = state.present && place.iter().all(|coordinate| coordinate.is_finite());
    there.then(|| Pose {
        position_m: place.into(),
        orientation: state.orientation.map(|turned| {
            let turned = mount.rotation * turned;
            [turned.i, turned.j, turned.k, turned.w]
        }),
        grip: state.grip,
        cut: state.buttons & CUTS != 0,
    })
}
