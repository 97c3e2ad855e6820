//! A loop whose caller waits for every tick, such as a rig that decides on its next target after each tick.
//!
//! If any thread may call the device, the caller's thread makes the ticks. If the device has a scheduler, the scheduler
//! makes them, and the caller waits for the next.
//!
//! *How we know*: `hosts::a_stepped_loop_gives_the_samples_of_its_host`.

use std::time::{Duration, Instant};

use crate::panics::{self, Panic, catch_panic};
use crate::{Clock, Fault, Sample, ServoLoop, ServoThread, Stage, log};

/// Timeout for a tick of a scheduler: longer than the guard lets one be late.
const LATEST: Duration = Duration::from_millis(100);
/// How long a waiting thread sleeps.
const NAP: Duration = Duration::from_micros(100);

/// A loop that is ticked one by one.
pub struct SteppedLoop {
    host: Host,
}

enum Host {
    Here(Box<ServoLoop>),
    Device {
        thread: ServoThread,
        samples: log::Reader<Sample>,
    },
}

impl SteppedLoop {
    /// From `servo` and the `samples` of its log. For a device with a scheduler the ticks begin at once, on `clock`.
    ///
    /// # Errors
    /// When the scheduler does not start.
    pub fn new(
        servo: ServoLoop,
        samples: log::Reader<Sample>,
        clock: Clock,
    ) -> Result<Self, Fault> {
        panics::prepare();
        let host = match servo.scheduler() {
            None => Host::Here(Box::new(servo)),
            Some(_) => Host::Device {
                thread: ServoThread::start(servo, clock)?,
                samples,
            },
        };
        Ok(Self { host })
    }

    /// Asks for real-time priority for the calling thread, if it makes the ticks.
    pub fn raise_priority(&mut self) {
        if let Host::Here(servo) = &mut self.host {
            servo.raise_priority();
        }
    }

    /// The tick at `time` [s], `lateness` [s] after it was due; for a device with a scheduler the newest unread tick,
    /// or else its next.
    ///
    /// # Errors
    /// When the device fails; it is disabled then.
    pub fn tick(&mut self, time: f64, lateness: f64) -> Result<Sample, Fault> {
        let (thread, samples) = match &mut self.host {
            Host::Here(servo) => return ticked(servo, time, lateness),
            Host::Device { thread, samples } => (thread, samples),
        };
        let until = Instant::now() + LATEST;
        loop {
            // In this order: an end follows its last sample.
            let runs = thread.is_running();
            match samples.drain().last() {
                Some(sample) if runs => return Ok(sample),
                Some(Sample {
                    stage: Stage::Faulted(fault),
                    ..
                }) => return Err(fault),
                _ if !runs => return Err(Fault::Panicked),
                _ if Instant::now() >= until => return Err(Fault::Silent),
                _ => std::thread::sleep(NAP),
            }
        }
    }
}

/// A tick of a loop on the caller's thread.
fn ticked(servo: &mut ServoLoop, time: f64, lateness: f64) -> Result<Sample, Fault> {
    catch_panic(|| servo.tick(time, lateness)).unwrap_or_else(|panic| {
        let abandoned = catch_panic(|| servo.abandon());
        panic.report();
        abandoned.map_or_else(Panic::report, |()| ());
        Err(Fault::Panicked)
    })
}
