//! A thread that monitors the loops of a session from outside, a thousand times a second.
//!
//! - A loop whose device has not answered for [`HANG_TIMEOUT`] hangs inside a call of the driver. The supervisor takes all
//!   forces off. The hung device itself is out of reach: its force is unknown, and a person has to cut its power.
//! - After a request to end the program (Ctrl-C, SIGTERM) all forces are off, whatever its window does.
//! - The loops monitor this thread in turn: when it is silent, they take their forces off ([`crate::supervisor`]).
//!
//! *How we know*: `watch::…`, and `session_end::…` of the crates `simulate` and `measure`.
//!
//! *Limits*: a computer that stops as a whole is left to the device's own watchdog.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::priority::raise_monitor_priority;
use crate::supervisor::{ForceState, StopReason};
use crate::{Clock, Fault, Supervisor};

/// Timeout for an answer of a device [s]: many ticks, less than it takes a person to pull a hand away.
pub const HANG_TIMEOUT: f64 = 0.1;

/// Additional timeout for the first answer of a device [s].
const FIRST: f64 = 1.0;

/// Period of the watch.
const PERIOD: Duration = Duration::from_millis(1);

/// Time of the last answer of a loop's device: the loop writes it, the watch reads it.
#[derive(Debug, Clone)]
pub struct Heartbeat(Arc<AtomicU64>);

/// A loop that is watched.
#[derive(Debug, Clone)]
pub struct MonitoredLoop {
    /// Its name for people, such as the tool and its device.
    pub name: String,
    /// Time of its last tick.
    pub pulse: Heartbeat,
}

/// The watched loops, and the hung ones.
#[derive(Debug, Clone)]
pub struct LoopMonitor {
    supervisor: Supervisor,
    loops: Vec<MonitoredLoop>,
    is_ended: fn() -> bool,
    /// Bit mask of the hung loops.
    hung: Arc<AtomicU64>,
}

/// A watch on its own thread. Dropping it ends the watch, which then takes no force off.
pub struct MonitorThread {
    watch: LoopMonitor,
    stop: Arc<AtomicBool>,
    handle: Option<JoinHandle<()>>,
}

impl Default for Heartbeat {
    /// For a loop that does not run.
    fn default() -> Self {
        Self(Arc::new(AtomicU64::new(f64::INFINITY.to_bits())))
    }
}

impl Heartbeat {
    /// The loop ticks at `time` [s].
    pub fn beat(&self, time: f64) {
        self.0.store(time.to_bits(), Ordering::Relaxed);
    }

    /// The loop begins at `time` [s]; its device may take a second for its first answer.
    pub fn begin(&self, time: f64) {
        self.beat(time + FIRST);
    }

    /// The loop has ended, and is not watched any more.
    pub fn end(&self) {
        self.beat(f64::INFINITY);
    }

    fn last(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }
}

impl LoopMonitor {
    /// A watch over `loops`, 64 at most, of the session of `supervisor`; `is_ended` returns whether the program
    /// received a request to end.
    pub fn new(supervisor: Supervisor, loops: Vec<MonitoredLoop>, is_ended: fn() -> bool) -> Self {
        Self {
            supervisor,
            loops,
            is_ended,
            hung: Arc::default(),
        }
    }

    /// One check at `time` [s] of the loops' clock.
    pub fn check_loops(&self, time: f64) {
        let silent = |watched: &MonitoredLoop| time - watched.pulse.last() > HANG_TIMEOUT;
        let bits = self.loops.iter().enumerate();
        let hung = bits.fold(0, |hung, (bit, watched)| {
            hung | u64::from(silent(watched)) << bit
        });
        self.hung.store(hung, Ordering::Relaxed);
        self.supervisor.report_monitor(time);
        if self.supervisor.state() == ForceState::Off {
            return;
        }
        if (self.is_ended)() {
            self.supervisor.trip_with_reason(StopReason::Signal);
        }
        if hung != 0 {
            self.supervisor.trip_with_reason(StopReason::HungDevice);
        }
    }

    /// The names of the hung loops.
    pub fn hung(&self) -> Vec<&str> {
        let hung = self.hung.load(Ordering::Relaxed);
        let loops = self.loops.iter().enumerate();
        let hung = loops.filter(|(bit, _)| hung >> bit & 1 == 1);
        hung.map(|(_, watched)| watched.name.as_str()).collect()
    }

    /// A sentence for a person about the hung loops; none if no loop hangs.
    pub fn warning(&self) -> Option<String> {
        let hung = self.hung();
        (!hung.is_empty()).then(|| {
            format!(
                "{} does not return from a call of its driver and may still display its last force; cut its power",
                hung.join(" and ")
            )
        })
    }
}

impl MonitorThread {
    /// Watches on `clock`, which is that of the loops.
    ///
    /// # Errors
    /// When the operating system provides no thread.
    pub fn start(watch: LoopMonitor, clock: Clock) -> Result<Self, Fault> {
        let stop = Arc::new(AtomicBool::new(false));
        let (stopped, own) = (stop.clone(), watch.clone());
        let run = move || {
            raise_monitor_priority();
            while !stopped.load(Ordering::Relaxed) {
                own.check_loops(clock.now());
                std::thread::sleep(PERIOD);
            }
        };
        let thread = std::thread::Builder::new().name("watch".to_owned());
        let handle = thread.spawn(run).map_err(|_| Fault::NoThread)?;
        Ok(Self {
            watch,
            stop,
            handle: Some(handle),
        })
    }

    /// The watched loops, and the hung ones.
    pub fn watch(&self) -> &LoopMonitor {
        &self.watch
    }

    /// Whether it still runs.
    pub fn is_running(&self) -> bool {
        self.handle
            .as_ref()
            .is_some_and(|handle| !handle.is_finished())
    }
}

impl Drop for MonitorThread {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let ended = self.handle.take().map(JoinHandle::join);
        if matches!(ended, Some(Ok(()))) {
            self.watch.supervisor.report_monitor(f64::INFINITY);
        }
    }
}
