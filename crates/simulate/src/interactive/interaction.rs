use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use palpate_devices::publisher::Publisher;
use palpate_files::SessionRow;
use palpate_servo::monitor::{LoopMonitor, MonitorThread};
use palpate_servo::{
    Clock, Fault, LoopReport, Sample, ServoSettings, ServoThread, Supervisor, latest, log,
    raise_model_priority,
};

use super::command::commands;
use super::endpoints::{DeviceEndpoints, LoopReaders, PlacedDevice, device_endpoints};
use super::model::{PreparedModel, ReplacementSender, replacement};
use super::model_loop::{Channels, ModelLoop};
use super::recorder::{RecordingFailure, SessionRecorder};
use super::{ModelCommand, ModelReport, Quality, ROWS, Snapshot};
use crate::{Error, SessionFolderWriter, Simulation};

/// An interaction on the machine's clock: the model on a thread and a servo loop per device on others. Dropping it
/// takes all forces off, ends the threads and stops the devices.
pub struct Interaction {
    stop: Arc<AtomicBool>,
    model: Option<JoinHandle<ModelReport>>,
    servos: Vec<Option<ServoThread>>,
    watches: Vec<Option<LoopReaders>>,
    /// Dropped after the loops that it watches.
    watch: MonitorThread,
    recorder: SessionRecorder,
    rows: log::Reader<SessionRow>,
    commands: log::Writer<ModelCommand>,
    snapshots: latest::Receiver<Snapshot>,
    replacing: ReplacementSender,
    supervisor: Supervisor,
    clock: Clock,
}

/// The environment of a touch.
#[derive(Clone, Copy)]
pub struct Environment<'a> {
    /// Servers that publish it to other programs.
    pub publishers: &'a [Publisher],
    /// Whether the program received a request to end; every device is then without force.
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

/// The background parts next to the model, in the order of the tools.
#[derive(Default)]
struct Running {
    servos: Vec<Option<ServoThread>>,
    endpoints: Vec<Option<super::endpoints::ModelEndpoint>>,
    watches: Vec<Option<LoopReaders>>,
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

    /// The same with a model that the caller has prepared, in an `environment`.
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
        let PreparedModel { model, viewer } = prepared.published_by(environment.publishers);
        let simulation = model.simulation.clone();
        let parts = device_endpoints(&simulation, devices, settings, &supervisor)?;
        let displays = parts.iter().flatten().any(|parts| parts.displays_force);
        let (rows, read_rows) = log::ring(ROWS);
        let stops = displays.then(|| supervisor.clone());
        let recorder = SessionRecorder::start(read_rows, stops);
        let (recorder, read_rows) = recorder.ok_or(Fault::NoThread)?;
        let (give, commands) = commands();
        let (replacing, taking_over) = replacement(&simulation, &supervisor);
        let clock = Clock::real();
        let watched = parts.iter().flatten().map(|parts| parts.watched.clone());
        let watch = LoopMonitor::new(supervisor.clone(), watched.collect(), environment.is_ended);
        let watch = MonitorThread::start(watch, clock)?;
        let Running {
            servos,
            endpoints,
            watches,
        } = Running::start(parts, clock)?;
        let channels = Channels {
            commands,
            rows,
            taking_over,
        };
        let stop = Arc::new(AtomicBool::new(false));
        let (asked, period) = (stop.clone(), simulation.step());
        let model = ModelLoop::new(model, endpoints, channels);
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
            snapshots: viewer,
            replacing,
            supervisor,
            clock,
        })
    }

    /// Continues with another model, the organ at rest, while all devices stay open and their loops run: forces are off
    /// for some milliseconds and are armed again. `environment` is that of the start.
    ///
    /// # Errors
    /// When the loops of this touch do not fit the other model, or the model thread has ended.
    pub fn replace_model(
        &mut self,
        environment: &Environment<'_>,
        prepared: PreparedModel,
    ) -> Result<(), Error> {
        let prepared = prepared.published_by(environment.publishers);
        self.snapshots = self.replacing.replace(prepared)?;
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

    /// Takes the forces of all devices off at their next tick, until [`arm`](Self::arm).
    pub fn emergency_stop(&self) {
        self.supervisor.trip();
    }

    /// Arms the forces of all devices and takes them off.
    pub fn supervisor(&self) -> &Supervisor {
        &self.supervisor
    }

    /// Reports that the program that shows the touch is alive. After the first report, forces go off if the next one
    /// does not come within [`REPORT_TIMEOUT`](palpate_servo::supervisor::REPORT_TIMEOUT).
    pub fn report_alive(&self) {
        self.supervisor.report(self.clock.now());
    }

    /// Records a session: everything restarts, and every row from then on is written.
    pub fn record(&mut self, writer: SessionFolderWriter) {
        self.recorder.record(writer);
        self.send(ModelCommand::Reset);
    }

    /// Ends the recording; its rows are then on the disk. Rows of the last twentieth of a second may still be missing.
    ///
    /// # Errors
    /// When a row could not be written; all rows are then in memory, for [`record_elsewhere`](Self::record_elsewhere).
    pub fn end_recording(&mut self) -> Result<(), Error> {
        self.recorder.end()
    }

    /// Why the rows of the recording can no longer be written, if they cannot: known within a twentieth of a second.
    pub fn recording_failure(&self) -> Option<RecordingFailure> {
        self.recorder.recording_failure()
    }

    /// Writes the recording from its start to another folder, also after its end; a running one continues there.
    ///
    /// # Errors
    /// When a row cannot be written there either, or not all are in memory.
    pub fn record_elsewhere(&mut self, writer: SessionFolderWriter) -> Result<(), Error> {
        self.recorder.record_elsewhere(writer)
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

    /// The quality of the touch so far; loops report ten times a second.
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

    /// A sentence for a person about a device whose driver does not return from a call; none if all answer.
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

    /// Takes all forces off, ends all threads, devices first, and returns the quality of the touch. Unread values can
    /// still be read.
    ///
    /// # Errors
    /// When a thread panicked, a loop hangs in its device (it is abandoned, without a force if it ever returns), or the
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
        // By then all rows have arrived.
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
        // `stop` returns the result.
        let _ = self.stop();
    }
}

impl Running {
    /// Starts the loops; each is watched from here on.
    fn start(parts: Vec<Option<DeviceEndpoints>>, clock: Clock) -> Result<Self, Fault> {
        let mut running = Self::default();
        for parts in parts {
            let (servo, endpoint, watch) = match parts {
                None => (None, None, None),
                Some(parts) => {
                    let servo = ServoThread::start(parts.servo, clock)?;
                    (Some(servo), Some(parts.endpoint), Some(parts.watch))
                }
            };
            running.servos.push(servo);
            running.endpoints.push(endpoint);
            running.watches.push(watch);
        }
        Ok(running)
    }
}

/// Steps at whole multiples of the period; late steps are skipped, never caught up.
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
        model.count_missed(next.saturating_sub(number + 1));
        number = next.max(number + 1);
    }
    model.report()
}
