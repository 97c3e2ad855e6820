use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use palpate_servo::monitor::{LoopMonitor, MonitorThread};
use palpate_servo::{Clock, Fault, Supervisor, log};

use super::log_writer::LogWriter;
use super::{CommandedRig, Console, ConsoleEvent, RecordingRequest, RigCommand};
use crate::{DepthTrajectory, Error, Rig, RigSample};

/// A running rig with its console, samples and events. Dropping it withdraws the indenter and ends its threads.
pub struct LiveRig {
    /// The console that operates the rig.
    pub console: Console,
    /// Every sample; samples that nobody reads in time are lost.
    pub samples: log::Reader<RigSample>,
    /// Events of the rig and of its recordings.
    pub console_events: Receiver<ConsoleEvent>,
    commissions: Sender<RecordingRequest>,
    threads: Vec<JoinHandle<()>>,
    watch: MonitorThread,
    /// Supervisor that receives the sign of life of the operator; none without a real device.
    supervisor: Option<Supervisor>,
    clock: Clock,
}

/// Capacity of the sample ring to the window: a quarter of a minute.
const SAMPLES: usize = 1 << 14;

/// Interval at which the log writer reads events.
const WRITE_INTERVAL: Duration = Duration::from_millis(5);

impl LiveRig {
    /// Starts `rig`, which shall have a real clock.
    ///
    /// # Errors
    /// When the operating system gives no thread.
    pub fn start(rig: Rig) -> Result<Self, Error> {
        Self::start_until(rig, || false)
    }

    /// The same; a real device has no force once `is_ended` says that the program ends.
    ///
    /// # Errors
    /// As for [`start`](Self::start).
    pub fn start_until(rig: Rig, is_ended: fn() -> bool) -> Result<Self, Error> {
        // Over virtual tissue nobody can be hurt, and the indenter withdraws in good order.
        let ends = if rig.is_real() { is_ended } else { || false };
        let watch = LoopMonitor::new(rig.supervisor(), vec![rig.monitored_loop()], ends);
        let clock = rig.clock();
        let watch = MonitorThread::start(watch, clock)?;
        let supervisor = rig.is_real().then(|| rig.supervisor());
        let (operated, console, events) = CommandedRig::new(rig);
        let (samples, samples_reader) = log::ring(SAMPLES);
        let (console_events, console_events_reader) = mpsc::channel();
        let (commissions, commissioned) = mpsc::channel();
        let log_writer = LogWriter {
            events,
            requests: commissioned,
            samples,
            console_events,
            switches: console.switches(),
            open: None,
        };
        let mut live = Self {
            console,
            samples: samples_reader,
            console_events: console_events_reader,
            commissions,
            threads: Vec::new(),
            watch,
            supervisor,
            clock,
        };
        let ended = Arc::new(AtomicBool::new(false));
        let seen = ended.clone();
        live.spawn("rig", move || run(operated, &ended))?;
        live.spawn("clerk", move || write(log_writer, &seen))?;
        Ok(live)
    }

    /// Queues a press of `trajectory` and its recording.
    pub fn press(&mut self, trajectory: DepthTrajectory, commission: RecordingRequest) {
        let number = commission.number;
        // `is_running` reports a log writer that has ended.
        let _ = self.commissions.send(commission);
        self.console.send(RigCommand::Press(trajectory, number));
    }

    /// Reports that the operator is alive. After the first report, a real device loses its force when none follows within
    /// [`REPORT_TIMEOUT`](palpate_servo::supervisor::REPORT_TIMEOUT).
    pub fn report_alive(&self) {
        if let Some(supervisor) = &self.supervisor {
            supervisor.report(self.clock.now());
        }
    }

    /// Warning about a device that does not answer any more.
    pub fn hung_device(&self) -> Option<String> {
        self.watch.watch().warning()
    }

    /// Whether its threads still run.
    pub fn is_running(&self) -> bool {
        self.threads.iter().all(|thread| !thread.is_finished())
    }

    fn spawn(&mut self, name: &str, run: impl FnOnce() + Send + 'static) -> Result<(), Error> {
        let thread = Builder::new().name(name.to_owned());
        let thread = thread.spawn(run).map_err(|_| Fault::NoThread)?;
        self.threads.push(thread);
        Ok(())
    }
}

impl Drop for LiveRig {
    fn drop(&mut self) {
        self.console.end();
        if self.hung_device().is_some() {
            // Its thread never ends; without a force if it ever does.
            return;
        }
        for thread in self.threads.drain(..) {
            // One that panicked has stopped its device.
            let _ = thread.join();
        }
    }
}

fn run(mut operated: CommandedRig, ended: &AtomicBool) {
    operated.rig().raise_priority();
    while operated.process_next(&mut |_| ()) {}
    ended.store(true, Ordering::Release);
}

fn write(mut log_writer: LogWriter, ended: &AtomicBool) {
    loop {
        // Loaded first, so that no event follows the last reading.
        let last = ended.load(Ordering::Acquire);
        log_writer.read();
        if last {
            return;
        }
        std::thread::sleep(WRITE_INTERVAL);
    }
}
