//! A thread that looks at the loops of a session from outside, a thousand times a second.
//!
//! - A loop whose device has not answered for [`HUNG`] hangs inside a call of the driver. The supervisor takes all forces
//!   off. The device that hangs cannot be reached: nobody knows what it displays, and a person has to cut its power.
//! - A program that was asked to end (Ctrl-C, SIGTERM) has no force from then on, whatever its window does.
//! - The loops look at the watch in turn: when it is silent, they take their forces off ([`crate::supervisor`]).
//!
//! *How we know*: `watch::…`, and `session_end::…` of the crates `simulate` and `measure`.
//!
//! *Limits*: a computer that stops as a whole is left to the device's own watchdog.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::priority::raise_watch_priority;
use crate::supervisor::{ForceState, StopReason};
use crate::{Clock, Fault, Supervisor};

/// How long a device may take to answer [s]: many ticks, less than it takes a person to pull a hand away.
pub const HUNG: f64 = 0.1;

/// How long the first answer of a device may take besides [s].
const FIRST: f64 = 1.0;

/// Between two looks.
const PERIOD: Duration = Duration::from_millis(1);

/// When the device of a loop answered last: the loop writes it, the watch reads it.
#[derive(Debug, Clone)]
pub struct Pulse(Arc<AtomicU64>);

/// A loop that is watched.
#[derive(Debug, Clone)]
pub struct Watched {
    /// What a person calls it, such as the tool and its device.
    pub name: String,
    /// When it ticked.
    pub pulse: Pulse,
}

/// What is watched, and what hangs.
#[derive(Debug, Clone)]
pub struct Watch {
    supervisor: Supervisor,
    loops: Vec<Watched>,
    is_ended: fn() -> bool,
    /// Bit by bit, which of the loops hang.
    hung: Arc<AtomicU64>,
}

/// A watch on a thread of its own. Dropping it ends the watch, which then takes no force off.
pub struct WatchThread {
    watch: Watch,
    stop: Arc<AtomicBool>,
    handle: Option<JoinHandle<()>>,
}

impl Default for Pulse {
    /// Of a loop that does not run.
    fn default() -> Self {
        Self(Arc::new(AtomicU64::new(f64::INFINITY.to_bits())))
    }
}

impl Pulse {
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

impl Watch {
    /// A watch over `loops`, 64 at most, of the session of `supervisor`; `is_ended` says whether the program was asked to
    /// end.
    pub fn new(supervisor: Supervisor, loops: Vec<Watched>, is_ended: fn() -> bool) -> Self {
        Self {
            supervisor,
            loops,
            is_ended,
            hung: Arc::default(),
        }
    }

    /// One look at `time` [s] of the loops' clock.
    pub fn look(&self, time: f64) {
        let silent = |watched: &Watched| time - watched.pulse.last() > HUNG;
        let bits = self.loops.iter().enumerate();
        let hung = bits.fold(0, |hung, (bit, watched)| {
            hung | u64::from(silent(watched)) << bit
        });
        self.hung.store(hung, Ordering::Relaxed);
        self.supervisor.report_watch(time);
        if self.supervisor.state() == ForceState::Off {
            return;
        }
        if (self.is_ended)() {
            self.supervisor.trip_because(StopReason::Signal);
        }
        if hung != 0 {
            self.supervisor.trip_because(StopReason::HungDevice);
        }
    }

    /// The names of the loops that hang.
    pub fn hung(&self) -> Vec<&str> {
        let hung = self.hung.load(Ordering::Relaxed);
        let loops = self.loops.iter().enumerate();
        let hung = loops.filter(|(bit, _)| hung >> bit & 1 == 1);
        hung.map(|(_, watched)| watched.name.as_str()).collect()
    }

    /// What a person has to know of the loops that hang; none when none does.
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

impl WatchThread {
    /// Watches on `clock`, which is that of the loops.
    ///
    /// # Errors
    /// When the operating system gives no thread.
    pub fn start(watch: Watch, clock: Clock) -> Result<Self, Fault> {
        let stop = Arc::new(AtomicBool::new(false));
        let (asked, own) = (stop.clone(), watch.clone());
        let run = move || {
            raise_watch_priority();
            while !asked.load(Ordering::Relaxed) {
                own.look(clock.now());
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

    /// What it watches, and what hangs.
    pub fn watch(&self) -> &Watch {
        &self.watch
    }

    /// Whether it still runs.
    pub fn is_running(&self) -> bool {
        self.handle
            .as_ref()
            .is_some_and(|handle| !handle.is_finished())
    }
}

impl Drop for WatchThread {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        let ended = self.handle.take().map(JoinHandle::join);
        if matches!(ended, Some(Ok(()))) {
            self.watch.supervisor.report_watch(f64::INFINITY);
        }
    }
}
