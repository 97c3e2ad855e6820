use std::sync::Arc;

use palpate_files::SessionRow;
use palpate_servo::{Fault, Sample, ServoLoop, ServoSettings, Supervisor, latest, log};

use super::command::commands;
use super::endpoints::{LoopReaders, PlacedDevice, device_endpoints};
use super::model::{PreparedModel, ReplacementSender, replacement};
use super::model_loop::{Channels, ModelLoop};
use super::{ModelCommand, Quality, Snapshot};
use crate::{Error, Simulation};

/// An interaction on a virtual clock, in one thread: the same motions give the same bytes. The model's answer arrives
/// one period after its input, the largest delay of a model that keeps its deadline.
pub struct VirtualInteraction {
    model: ModelLoop,
    model_period: f64,
    servos: Vec<Option<ServoLoop>>,
    watches: Vec<Option<LoopReaders>>,
    rows: log::Reader<SessionRow>,
    commands: log::Writer<ModelCommand>,
    snapshots: latest::Receiver<Snapshot>,
    replacing: ReplacementSender,
    supervisor: Supervisor,
    period: f64,
    tick: u64,
    steps: u64,
}

impl VirtualInteraction {
    /// An interaction before its first tick; one station, or none, per tool.
    ///
    /// # Errors
    /// When the stations are not those of the tools, or a setting is out of range.
    pub fn new(
        simulation: Arc<Simulation>,
        devices: Vec<Option<PlacedDevice>>,
        settings: ServoSettings,
    ) -> Result<Self, Error> {
        let supervisor = Supervisor::armed();
        let parts = device_endpoints(&simulation, devices, settings, &supervisor)?;
        let (rows, read_rows) = log::ring(settings.log.max(1) * parts.len());
        let (give, commands) = commands();
        let PreparedModel { model, viewer } = PreparedModel::new(simulation.clone());
        let (replacing, taking_over) = replacement(&simulation, &supervisor);
        let channels = Channels {
            commands,
            rows,
            taking_over,
        };
        let (mut servos, mut endpoints, mut watches) = (Vec::new(), Vec::new(), Vec::new());
        for parts in parts {
            let (servo, endpoint, watch) = parts.map_or((None, None, None), |parts| {
                (Some(parts.servo), Some(parts.endpoint), Some(parts.watch))
            });
            servos.push(servo);
            endpoints.push(endpoint);
            watches.push(watch);
        }
        Ok(Self {
            model_period: simulation.step(),
            model: ModelLoop::new(model, endpoints, channels),
            servos,
            watches,
            rows: read_rows,
            commands: give,
            snapshots: viewer,
            replacing,
            supervisor,
            period: settings.period,
            tick: 0,
            steps: 0,
        })
    }

    /// The time of the next tick [s].
    pub fn time(&self) -> f64 {
        self.tick as f64 * self.period
    }

    /// One tick of every servo loop, and a step of the model where one is due.
    ///
    /// # Errors
    /// When a device fails.
    pub fn advance(&mut self) -> Result<(), Fault> {
        let time = self.time();
        // A millionth of a tick: rounding of the times.
        let due = time >= self.steps as f64 * self.model_period - 1e-6 * self.period;
        if due && self.steps > 0 {
            self.model.hand_over();
            self.model.show();
        }
        for servo in self.servos.iter_mut().flatten() {
            servo.tick(time, 0.0)?;
        }
        if due {
            self.model.touch(time);
            self.model.shape();
            self.steps += 1;
        }
        self.tick += 1;
        Ok(())
    }

    /// The latest snapshot.
    pub fn snapshot(&mut self) -> &Snapshot {
        self.snapshots.latest()
    }

    /// Sends a command to the model, which processes it before its next step; in a pause every device is without force
    /// from its next tick on.
    pub fn send(&mut self, command: ModelCommand) {
        command.supervise(&self.supervisor);
        self.commands.add(command);
    }

    /// Continues with another model, the organ at rest, while the loops run.
    ///
    /// # Errors
    /// When the loops do not serve the other model.
    pub fn replace_model(&mut self, prepared: PreparedModel) -> Result<(), Error> {
        self.snapshots = self.replacing.replace(prepared)?;
        Ok(())
    }

    /// Arms the forces of all devices and takes them off.
    pub fn supervisor(&self) -> &Supervisor {
        &self.supervisor
    }

    /// The unread rows of the session.
    pub fn rows(&mut self) -> impl Iterator<Item = SessionRow> + '_ {
        self.rows.drain()
    }

    /// The unread samples of a tool's servo loop.
    pub fn samples(&mut self, tool: usize) -> impl Iterator<Item = Sample> + '_ {
        let watch = self.watches.get_mut(tool).and_then(Option::as_mut);
        watch.into_iter().flat_map(|watch| watch.samples.drain())
    }

    /// The quality of the touch so far.
    pub fn quality(&self) -> Quality {
        let report = |servo: &Option<ServoLoop>| servo.as_ref().map(ServoLoop::report);
        Quality {
            model: self.model.report(),
            loops: self.servos.iter().map(report).collect(),
        }
    }
}
