use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use palpate_devices::publisher::Publisher;
use palpate_files::SessionRow;
use palpate_servo::watch::{Watch as LoopWatch, WatchThread};
use palpate_servo::{
    Clock, Fault, LoopReport, Sample, ServoSettings, ServoThread, Supervisor, latest, log,
    raise_model_priority,
};

use super::command::commands;
use super::endpoints::{DeviceEndpoints, PlacedDevice, Watch, device_endpoints};
use super::model::{PreparedModel, Replacing, take_over};
use super::model_loop::{Channels, ModelLoop};
use super::recorder::{SessionRecorder, Unwritten};
use super::{ModelCommand, ModelReport, Quality, ROWS, Snapshot};
use crate::{Error, SessionFolderWriter, Simulation};

/// The model on a thread and a servo loop per device on others, on the machine's clock. Dropping it takes all forces off,
/// ends the threads and stops the devices.
pub struct Interaction {
    stop: Arc<AtomicBool>,
    model: Option<JoinHandle<ModelReport>>,
    servos: Vec<Option<ServoThread>>,
    watches: Vec<Option<Watch>>,
    /// After the loops that it watches.
    watch: WatchThread,
    recorder: SessionRecorder,
    rows: log::Reader<SessionRow>,
    commands: log::Writer<ModelCommand>,
    snapshots: latest::Receiver<Snapshot>,
    replacing: Replacing,
    supervisor: Supervisor,
    clock: Clock,
}

/// What surrounds a touch.
#[derive(Clone, Copy)]
pub struct Environment<'a> {
    /// Servers that send it to other programs.
    pub publishers: &'a [Publisher],
    /// Whether the program was asked to end; no device has a force then.
    pub is_ended: fn() -> bool,
}

impl Default for Environment<'_> {
    /// Nothing.
    fn default() -> Self {
        Self {
            publishers: &[],
            is_ended: || false,
        }
    }
}

/// What runs beside the model, in the order of the tools.
#[derive(Default)]
struct Running {
    servos: Vec<Option<ServoThread>>,
    lines: Vec<Option<super::endpoints::ModelEndpoint>>,
    watches: Vec<Option<Watch>>,
}

impl Interaction {
    /// Starts all threads; one station, or none, per tool.
    ///
    /// # Errors
    /// When the stations are not those of the tools, a setting is out of range, or there is no thread.
    pub fn start(
        simulation: Arc<Simulation>,
        devices: Vec<Option<PlacedDevice>>,
        settings: ServoSettings,
    ) -> Result<Self, Error> {
        let prepared = PreparedModel::new(simulation);
        Self::start_in(&Environment::default(), prepared, devices, settings)
    }

    /// The same with a model that was prepared beside the caller, in an `environment`.
    ///
    /// # Errors
    /// As for [`start`](Self::start).
    pub fn start_in(
        environment: &Environment<'_>,
        prepared: PreparedModel,
        devices: Vec<Option<PlacedDevice>>,
        settings: ServoSettings,
    ) -> Result<Self, Error> {
        let supervisor = Supervisor::armed();
        let PreparedModel { model, seen } = prepared.published_by(environment.publishers);
        let simulation = model.simulation.clone();
        let parts = device_endpoints(&simulation, devices, settings, &supervisor)?;
        let displays = parts.iter().flatten().any(|parts| parts.displays_force);
        let (rows, read_rows) = log::ring(ROWS);
        let stops = displays.then(|| supervisor.clone());
        let recorder = SessionRecorder::start(read_rows, stops);
        let (recorder, read_rows) = recorder.ok_or(Fault::NoThread)?;
        let (give, commands) = commands();
        let (replacing, taking_over) = take_over(&simulation, &supervisor);
        let clock = Clock::real();
        let watched = parts.iter().flatten().map(|parts| parts.watched.clone());
        let watch = LoopWatch::new(supervisor.clone(), watched.collect(), environment.is_ended);
        let watch = WatchThread::start(watch, clock)?;
        let Running {
            servos,
            lines,
            watches,
        } = Running::start(parts, clock)?;
        let channels = Channels {
            commands,
            rows,
            taking_over,
        };
        let stop = Arc::new(AtomicBool::new(false));
        let (asked, period) = (stop.clone(), simulation.step());
        let model = ModelLoop::new(model, lines, channels);
        let thread = std::thread::Builder::new().name("model".to_owned());
        let handle = thread.spawn(move || run(model, clock, period, &asked));
        Ok(Self {
            stop,
            model: Some(handle.map_err(|_| Fault::NoThread)?),
            servos,
            watches,
            watch,
            recorder,
            rows: read_rows,
            commands: give,
            snapshots: seen,
            replacing,
            supervisor,
            clock,
        })
    }

    /// Goes on with another model, the organ at rest, while all devices stay open and their loops run: forces are off for
    /// some milliseconds and are armed again. `environment` is that of the start.
    ///
    /// # Errors
    /// When the loops of this touch do not serve the other model, or the model thread has ended.
    pub fn replace_model(
        &mut self,
        environment: &Environment<'_>,
        prepared: PreparedModel,
    ) -> Result<(), Error> {
        let prepared = prepared.published_by(environment.publishers);
        self.snapshots = self.replacing.replace(prepared)?;
        Ok(())
    }

    /// The latest that there is to see.
    pub fn snapshot(&mut self) -> &Snapshot {
        self.snapshots.latest()
    }

    /// Sends a command to the model, which processes it before its next step; in a pause no device has a force from its next
    /// tick on.
    pub fn send(&mut self, command: ModelCommand) {
        command.supervise(&self.supervisor);
        self.commands.add(command);
    }

    /// Takes the forces of all devices off at their next tick, until [`arm`](Self::arm).
    pub fn emergency_stop(&self) {
        self.supervisor.trip();
    }

    /// What arms the forces of all devices and takes them off.
    pub fn supervisor(&self) -> &Supervisor {
        &self.supervisor
    }

    /// Says that who shows this to a person is alive. Forces are taken off when that is not said again within
    /// [`SILENCE`](palpate_servo::supervisor::SILENCE); who never says it need not.
    pub fn report_alive(&self) {
        self.supervisor.report(self.clock.now());
    }

    /// Records a session: everything begins anew, and every row from then on is written.
    pub fn record(&mut self, writer: SessionFolderWriter) {
        self.recorder.record(writer);
        self.send(ModelCommand::Reset);
    }

    /// Ends the recording; what was recorded is on the disk then. Rows that are a twentieth of a second old may
    /// still be missing.
    ///
    /// # Errors
    /// When a row could not be written; all are in memory then, for [`record_elsewhere`](Self::record_elsewhere).
    pub fn end_recording(&mut self) -> Result<(), Error> {
        self.recorder.end()
    }

    /// Why the rows of the recording can no longer be written, if they cannot: known within a twentieth of a second.
    pub fn unwritten(&self) -> Option<Unwritten> {
        self.recorder.unwritten()
    }

    /// Writes the recording elsewhere, from its beginning on, also when it has ended; one that goes on goes on there.
    ///
    /// # Errors
    /// When a row cannot be written there either, or not all are in memory.
    pub fn record_elsewhere(&mut self, writer: SessionFolderWriter) -> Result<(), Error> {
        self.recorder.record_elsewhere(writer)
    }

    /// The rows of the session that nobody has read yet.
    pub fn rows(&mut self) -> impl Iterator<Item = SessionRow> + '_ {
        self.rows.drain()
    }

    /// The samples of a tool's servo loop that nobody has read yet.
    pub fn samples(&mut self, tool: usize) -> impl Iterator<Item = Sample> + '_ {
        let watch = self.watches.get_mut(tool).and_then(Option::as_mut);
        watch.into_iter().flat_map(|watch| watch.samples.drain())
    }

    /// How good the touch was so far; loops tell ten times a second.
    pub fn quality(&mut self) -> Quality {
        let watches = self.watches.iter_mut();
        let loops = watches.map(|watch| watch.as_mut().map(|watch| *watch.report.latest()));
        Quality {
            loops: loops.collect(),
            model: self.snapshots.latest().report,
        }
    }

    /// Arms the forces of all devices again after a fault or an emergency stop.
    pub fn arm(&self) {
        self.supervisor.arm();
    }

    /// What a person has to know of a device whose driver does not return from a call; none when all answer.
    pub fn hung_device(&self) -> Option<String> {
        self.watch.watch().warning()
    }

    /// Whether all threads still run.
    pub fn is_running(&self) -> bool {
        let model = self
            .model
            .as_ref()
            .is_some_and(|model| !model.is_finished());
        model && self.servos.iter().flatten().all(ServoThread::is_running)
    }

    /// Takes all forces off, ends all threads, devices first, and tells how good the touch was. What nobody has read stays
    /// to be read.
    ///
    /// # Errors
    /// When a thread panicked, a loop hangs in its device (it is left behind, without a force if it ever returns), or the
    /// recording could not be written.
    pub fn stop(&mut self) -> Result<Quality, Error> {
        self.supervisor.switch_off();
        let stopped = |servo: &mut Option<ServoThread>| servo.take().map(ServoThread::stop);
        let loops: Vec<_> = self.servos.iter_mut().map(stopped).collect();
        self.stop.store(true, Ordering::Relaxed);
        let model = match self.model.take() {
            Some(model) => model.join().map_err(|_| Error::ModelPanicked)?,
            None => self.snapshots.latest().report,
        };
        // All rows have come through then.
        self.recorder.end()?;
        let loops: Result<Vec<Option<LoopReport>>, Fault> =
            loops.into_iter().map(Option::transpose).collect();
        Ok(Quality {
            model,
            loops: loops?,
        })
    }
}

impl Drop for Interaction {
    fn drop(&mut self) {
        // Who wants to know calls `stop`.
        let _ = self.stop();
    }
}

impl Running {
    /// Starts the loops; each is watched from here on.
    fn start(parts: Vec<Option<DeviceEndpoints>>, clock: Clock) -> Result<Self, Fault> {
        let mut running = Self::default();
        for parts in parts {
            let (servo, line, watch) = match parts {
                None => (None, None, None),
                Some(parts) => {
                    let servo = ServoThread::start(parts.servo, clock)?;
                    (Some(servo), Some(parts.line), Some(parts.watch))
                }
            };
            running.servos.push(servo);
            running.lines.push(line);
            running.watches.push(watch);
        }
        Ok(running)
    }
}

/// Steps at whole multiples of the period; what is late is left out, never made up for.
fn run(mut model: ModelLoop, mut clock: Clock, period: f64, stop: &AtomicBool) -> ModelReport {
    model.priority = raise_model_priority();
    let mut number = (clock.now() / period).ceil() as u64;
    while !stop.load(Ordering::Relaxed) {
        clock.sleep_until(number as f64 * period);
        model.touch(clock.now());
        model.hand_over();
        model.shape();
        model.show();
        let next = (clock.now() / period).ceil() as u64;
        model.miss(next.saturating_sub(number + 1));
        number = next.max(number + 1);
    }
    model.report()
}
