//! A loop of which somebody waits for every tick, such as a rig that decides after each where it goes next.
//!
//! On a device that any thread may call the ticks are made by who asks for them. On one with a scheduler of its own
//! they are the scheduler's, and who asks waits for the next.
//!
//! *How we know*: `hosts::a_stepped_loop_gives_the_samples_of_its_host`.

use std::time::{Duration, Instant};

use crate::panics::{self, Panic, caught};
use crate::{Clock, Fault, Sample, ServoLoop, ServoThread, Stage, log};

/// How long a tick of a scheduler is waited for: longer than the guard lets one be late.
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
    /// Of `servo` and the `samples` of its log. What a device with a scheduler does begins at once, on `clock`.
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

    /// Asks for real-time priority for the thread that calls, where that is the one that makes the ticks.
    pub fn raise_priority(&mut self) {
        if let Host::Here(servo) = &mut self.host {
            servo.raise_priority();
        }
    }

    /// The tick at `time` [s], `lateness` [s] after it was due; of a device with a scheduler the newest that nobody
    /// has seen, or else its next.
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
            // In this order: an end comes after its last sample.
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

/// A tick of a loop on the thread of whoever asks.
fn ticked(servo: &mut ServoLoop, time: f64, lateness: f64) -> Result<Sample, Fault> {
    caught(|| servo.tick(time, lateness)).unwrap_or_else(|panic| {
        let abandoned = caught(|| servo.abandon());
        panic.report();
        abandoned.map_or_else(Panic::report, |()| ());
        Err(Fault::Panicked)
    })
}
