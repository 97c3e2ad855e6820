//! Strain gauges at a data acquisition device of National Instruments, through the C library of NI-DAQmx. A separate
//! thread reads, so that a call that does not return blocks nothing else; it averages the readings of a millisecond.

mod functions;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use palpate_servo::{ForceSensor, ForceSensorSpec, ForceTorque, SensorFault, latest};

use super::freshness::Freshness;
use super::{Gauges, SensorLimits};
use crate::OpenError;
use functions::{Functions, Task, Volts};

/// Means per second that the thread sends [Hz].
const MEANS: f64 = 1000.0;
/// A voltage this near to the end of its range is at it [-].
const NEAR_END: f64 = 0.995;
/// Timeout for the thread, at its start and its end.
const BEGINS: Duration = Duration::from_secs(10);
const FAREWELL: Duration = Duration::from_millis(200);

/// The thread's last reading.
type Read = Result<ForceTorque, SensorFault>;

/// Six strain gauges.
pub struct NiDaq {
    spec: ForceSensorSpec,
    read: latest::Receiver<Read>,
    freshness: Freshness,
    last: Read,
    end: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl NiDaq {
    /// Loads the library, `named` or of the usual name, and starts to read.
    ///
    /// # Errors
    /// When the library is missing, or refuses the channels.
    pub fn open(
        gauges: &Gauges,
        limits: SensorLimits,
        named: Option<&Path>,
    ) -> Result<Self, OpenError> {
        let functions = Functions::load(named)?;
        let (send, read) = latest::channel(&Ok(ForceTorque::zero()));
        let end = Arc::new(AtomicBool::new(false));
        let (opened, was_opened) = sync_channel(1);
        let (own, seen) = (gauges.clone(), end.clone());
        let thread = std::thread::Builder::new().name("ni-daq".to_owned());
        let thread = thread
            .spawn(move || serve(functions, &own, &opened, send, &seen))
            .map_err(|cause| OpenError::NoSensor {
                place: gauges.channels.clone(),
                cause,
            })?;
        let silent = || OpenError::SensorLibrary {
            code: 0,
            what: "no answer for 10 s".to_owned(),
        };
        was_opened.recv_timeout(BEGINS).map_err(|_| silent())??;
        Ok(Self {
            spec: ForceSensorSpec {
                name: format!("NI-DAQmx at {}", gauges.channels),
                range: limits.range,
                has_six_axes: true,
            },
            read,
            freshness: Freshness::new(limits.timeout),
            last: Ok(ForceTorque::zero()),
            end,
            thread: Some(thread),
        })
    }
}

fn serve(
    functions: Functions,
    gauges: &Gauges,
    opened: &SyncSender<Result<(), OpenError>>,
    mut send: latest::Sender<Read>,
    end: &AtomicBool,
) {
    let task = match Task::start(functions, gauges) {
        Ok(task) => task,
        Err(error) => {
            let _ = opened.send(Err(error));
            return;
        }
    };
    if opened.send(Ok(())).is_err() {
        return;
    }
    let scans = (gauges.rate / MEANS).ceil().max(1.0) as usize;
    let mut volts = Volts::new(scans);
    while !end.load(Ordering::Relaxed) {
        match task.read(&mut volts) {
            Ok(0) => {}
            Ok(read) => send.send(reading(volts.scans(read), gauges)),
            Err(code) => {
                send.send(Err(SensorFault::Library { code }));
                // An error of the library is permanent.
                return;
            }
        }
    }
}

/// The mean of scans of six voltages as a force and a torque.
fn reading<'v>(scans: impl ExactSizeIterator<Item = &'v [f64]>, gauges: &Gauges) -> Read {
    let number = scans.len() as f64;
    let mut mean = [0.0; 6];
    for scan in scans {
        for (sum, volt) in mean.iter_mut().zip(scan) {
            if volt.is_nan() || volt.abs() > NEAR_END * gauges.range {
                let axis = "a strain gauge";
                return Err(SensorFault::Saturated { axis });
            }
            *sum += volt / number;
        }
    }
    let row = |row: &[f64; 6]| row.iter().zip(&mean).map(|(a, v)| a * v).sum::<f64>();
    Ok(ForceTorque::from_components(
        gauges.matrix.each_ref().map(row),
    ))
}

impl ForceSensor for NiDaq {
    fn spec(&self) -> &ForceSensorSpec {
        &self.spec
    }

    fn read(&mut self) -> Result<ForceTorque, SensorFault> {
        if self.read.has_update() {
            self.last = *self.read.latest();
            self.freshness.renew();
        }
        let reading = self.last?;
        self.freshness.check()?;
        Ok(reading)
    }
}

impl Drop for NiDaq {
    fn drop(&mut self) {
        self.end.store(true, Ordering::Relaxed);
        let Some(thread) = self.thread.take() else {
            return;
        };
        let naps = 100;
        for _ in 0..naps {
            if thread.is_finished() {
                // A thread that panicked has ended too.
                let _ = thread.join();
                return;
            }
            std::thread::sleep(FAREWELL / naps);
        }
        // A call that does not return; if it ever does, the thread clears its task.
    }
}
