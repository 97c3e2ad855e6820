//! A servo loop that runs by itself: on a thread of its own, or in the scheduler of its device.
//!
//! Both hosts make the same ticks. A panic in a tick disables the device, on the thread that called it, and takes off
//! the forces of all loops of the session. Every wait for a host has a timeout: a call into a device that does not
//! return is [`Fault::Hung`], and its memory is never freed.
//!
//! *How we know*: `hosts::…`, `servo::a_panic_stops_the_device`.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::panics::{self, Panic, catch_panic};
use crate::{Clock, Fault, LoopReport, Next, Scheduler, ServoLoop};

/// Timeout for a scheduler's next call, after which the device is disabled from here: longer than the guard lets a tick
/// be late.
const CALL: Duration = Duration::from_millis(50 * SLOWER);

/// Timeout for the end of a loop: some of the longest calls that a driver makes, of 20 ms each.
const END: Duration = Duration::from_millis(500 * SLOWER);

/// A tick in Miri takes as long as hundreds elsewhere.
const SLOWER: u64 = if cfg!(miri) { 1000 } else { 1 };

/// A servo loop that runs by itself. Dropping it ends it.
pub struct ServoThread {
    signals: Signals,
    ended: Receiver<Result<LoopReport, Fault>>,
    /// None after the thread has been joined.
    host: Option<Host>,
}

enum Host {
    Ours(JoinHandle<()>),
    Device(Box<dyn Scheduler>),
}

/// State that both sides of a host share.
#[derive(Clone)]
struct Signals {
    stop: Arc<AtomicBool>,
    running: Arc<AtomicBool>,
}

/// A loop in its host.
struct Hosted {
    servo: ServoLoop,
    clock: Clock,
    signals: Signals,
    end: SyncSender<Result<LoopReport, Fault>>,
}

impl ServoThread {
    /// Starts `servo` on `clock`: in the scheduler of its device if it has one, otherwise on a thread with the highest
    /// available priority.
    ///
    /// # Errors
    /// When the operating system gives no thread, or the scheduler does not start.
    pub fn start(servo: ServoLoop, clock: Clock) -> Result<Self, Fault> {
        let signals = Signals {
            stop: Arc::new(AtomicBool::new(false)),
            running: Arc::new(AtomicBool::new(true)),
        };
        let (end, ended) = sync_channel(1);
        panics::prepare();
        let scheduler = servo.scheduler();
        servo.begin(clock.now());
        let mut hosted = Hosted {
            servo,
            clock,
            signals: signals.clone(),
            end,
        };
        let host = match scheduler {
            Some(mut scheduler) => {
                scheduler.start(Box::new(move || hosted.tick()))?;
                Host::Device(scheduler)
            }
            None => {
                let thread = std::thread::Builder::new().name("servo".to_owned());
                let handle = thread.spawn(move || hosted.run());
                Host::Ours(handle.map_err(|_| Fault::NoThread)?)
            }
        };
        Ok(Self {
            signals,
            ended,
            host: Some(host),
        })
    }

    /// Whether it still runs; it ends by itself when its device fails.
    pub fn is_running(&self) -> bool {
        self.signals.running.load(Ordering::Acquire)
    }

    /// Ends the loop, which disables its device, and waits for it, for half a second.
    ///
    /// # Errors
    /// When it panicked; its device was disabled then. When a call into its device does not return.
    pub fn stop(mut self) -> Result<LoopReport, Fault> {
        self.join()
    }

    fn join(&mut self) -> Result<LoopReport, Fault> {
        self.signals.stop.store(true, Ordering::Release);
        let Some(mut host) = self.host.take() else {
            return Ok(LoopReport::default());
        };
        let mut ended = self.ended.recv_timeout(CALL);
        if ended == Err(RecvTimeoutError::Timeout) {
            if let Host::Device(scheduler) = &mut host {
                // Its state is unknown: the loop is marked as hung.
                scheduler.disable();
            }
            ended = self.ended.recv_timeout(END.saturating_sub(CALL));
        }
        let hung = Fault::Hung {
            limit: END.as_secs_f64(),
        };
        let left = match host {
            // A loop whose call does not return is abandoned; it disables its device if the call ever returns.
            Host::Ours(_) if ended == Err(RecvTimeoutError::Timeout) => Err(hung),
            Host::Ours(handle) => handle.join().map_err(|_| Fault::Panicked),
            Host::Device(mut scheduler) => scheduler.stop(END),
        };
        match ended {
            Ok(report) => left.and(report),
            Err(RecvTimeoutError::Timeout) => Err(hung),
            Err(RecvTimeoutError::Disconnected) => Err(Fault::Panicked),
        }
    }
}

impl Drop for ServoThread {
    fn drop(&mut self) {
        // `stop` returns the result.
        let _ = self.join();
    }
}

impl Hosted {
    /// All ticks, on the calling thread.
    fn run(mut self) {
        let ran = catch_panic(|| {
            let stop = self.signals.stop.clone();
            self.servo.raise_priority();
            self.servo
                .run(&mut self.clock, |_| !stop.load(Ordering::Acquire))
        });
        self.ended(ran);
    }

    /// One tick, called by a scheduler.
    fn tick(&mut self) -> Next {
        if !self.signals.running.load(Ordering::Acquire) {
            return Next::End;
        }
        let ticked = catch_panic(|| {
            let stops = self.signals.stop.load(Ordering::Acquire);
            let goes_on = !stops && self.servo.tick_as_called(&mut self.clock).is_ok();
            (!goes_on).then(|| self.servo.finish())
        });
        match ticked {
            Ok(None) => return Next::Continue,
            Ok(Some(report)) => self.ended(Ok(report)),
            Err(panic) => self.ended(Err(panic)),
        }
        Next::End
    }

    fn ended(&mut self, how: Result<LoopReport, Panic>) {
        let how = how.map_err(|panic| {
            // The device itself may have panicked.
            let abandoned = catch_panic(|| self.servo.abandon());
            panic.report();
            abandoned.map_or_else(Panic::report, |()| ());
            Fault::Panicked
        });
        self.signals.running.store(false, Ordering::Release);
        // Nothing receives it if the other end was dropped.
        let _ = self.end.try_send(how);
    }
}
