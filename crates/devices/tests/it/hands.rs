//! Hands, walls and loops for all drivers.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use palpate_device_stand_ins::{Mechanics, StandInLibrary};
use palpate_servo::{
    Clock, Controller, Device, DeviceState, Fault, Limits, Sample, ServoLoop, ServoReader,
    ServoSettings, ServoThread, Stage, Trajectory, Vec3, VirtualDevice, Waypoint, latest,
};

/// How stiff the wall is [N/m], and how deep a hand presses [m]: 1 N, below what a device without a dead-man's switch
/// may display.
pub(crate) const STIFFNESS: f64 = 200.0;
pub(crate) const DEPTH: f64 = 5e-3;

/// When the hand is all the way down [s].
pub(crate) const DOWN: f64 = 1.0;

/// A stiff hand that rests above a wall, then presses into it and stays.
pub(crate) fn pressing() -> VirtualDevice {
    let place = |time, height| Waypoint::new(time, Vec3::new(0.02, height, -0.01));
    let places = vec![place(0.0, 2e-3), place(0.7, 2e-3), place(DOWN, -DEPTH)];
    VirtualDevice::new(Trajectory::waypoints(places).unwrap())
}

/// A wall below y = 0.
pub(crate) fn wall(state: &DeviceState, _: f64) -> Vec3 {
    Vec3::y() * (-state.position.y).max(0.0) * STIFFNESS
}

/// For all that does not try how long a device may be silent: a machine that is busy elsewhere is no fault.
pub(crate) const PATIENT: Duration = Duration::from_secs(5);

/// Mechanics in the time of a loop on the virtual clock, however often they are asked.
pub(crate) struct InTime {
    pub(crate) device: VirtualDevice,
    pub(crate) time: Arc<AtomicU64>,
}

impl Mechanics for InTime {
    fn advance(&mut self, _time: f64, force: &Vec3) -> DeviceState {
        let time = f64::from_bits(self.time.load(Ordering::Acquire));
        self.device.advance(time, force)
    }
}

/// A loop on the virtual clock that a test ticks: itself, or by the periods of the scheduler of a library.
pub(crate) struct Ticked<'l> {
    host: Host<'l>,
    pub(crate) reader: ServoReader,
    number: u64,
    /// The time of a hand under a stand-in.
    pub(crate) time: Arc<AtomicU64>,
}

enum Host<'l> {
    Gone,
    Here(Box<ServoLoop>),
    Scheduler(ServoThread, Box<dyn Fn() -> i32 + Send + Sync + 'l>),
}

impl<'l> Ticked<'l> {
    pub(crate) fn new(
        device: Box<dyn Device>,
        library: Option<&'l StandInLibrary>,
        controller: impl Controller + 'static,
    ) -> Self {
        let settings = ServoSettings::default();
        Self::with(device, library, Box::new(controller), settings)
    }

    pub(crate) fn with(
        device: Box<dyn Device>,
        library: Option<&'l StandInLibrary>,
        controller: Box<dyn Controller>,
        settings: ServoSettings,
    ) -> Self {
        let (servo, reader) = ServoLoop::new(device, controller, settings).unwrap();
        let host = match (servo.scheduler(), library) {
            (Some(_), Some(library)) => {
                library.set("stand_in_manual", 1);
                let thread = ServoThread::start(servo, Clock::virtual_time());
                Host::Scheduler(thread.unwrap(), Box::new(library.function("stand_in_step")))
            }
            _ => Host::Here(Box::new(servo)),
        };
        Self {
            host,
            reader,
            number: 0,
            time: Arc::default(),
        }
    }

    /// The next tick.
    pub(crate) fn tick(&mut self) -> Result<Sample, Fault> {
        let time = self.number as f64 * 1e-3;
        self.number += 1;
        self.time.store(time.to_bits(), Ordering::Release);
        let (thread, step) = match &mut self.host {
            Host::Here(servo) => {
                let sample = servo.tick(time, 0.0);
                self.reader.log.drain().for_each(drop);
                return sample;
            }
            Host::Scheduler(thread, step) => (thread, step),
            Host::Gone => return Err(Fault::Panicked),
        };
        step();
        let sample = self.reader.log.drain().last();
        match (thread.is_running(), sample) {
            (true, Some(sample)) => Ok(sample),
            _ => Err(self.reader.report.latest().fault.unwrap()),
        }
    }

    /// The fault that keeps forces off, if one does.
    pub(crate) fn fault(&mut self) -> Option<Fault> {
        match &self.host {
            Host::Here(servo) => servo.report().fault,
            Host::Scheduler(..) | Host::Gone => self.reader.report.latest().fault,
        }
    }

    /// Drops the loop, as a thread that panicked does.
    pub(crate) fn lose(&mut self) {
        self.host = Host::Gone;
    }

    /// Ends the loop, whose last call a scheduler that a test paces has to make.
    pub(crate) fn end(self) {
        let Host::Scheduler(thread, step) = self.host else {
            return;
        };
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for _ in 0..300 {
                    std::thread::sleep(Duration::from_millis(1));
                    step();
                }
            });
            // What it says is for others to test.
            let _ = thread.stop();
        });
    }
}

/// A hand that presses into the wall, until its force is whole.
///
/// # Errors
/// When the device fails.
pub(crate) fn press(servo: &mut Ticked<'_>) -> Result<Vec<Sample>, Fault> {
    let last = (1e3 * DOWN) as u64 + 10;
    let samples: Result<Vec<Sample>, Fault> = (0..last).map(|_| servo.tick()).collect();
    let samples = samples?;
    let end = samples.last().unwrap();
    assert_eq!(end.stage, Stage::Live);
    assert!(
        (end.output.norm() - STIFFNESS * DEPTH).abs() < 1e-3,
        "{end:?}"
    );
    Ok(samples)
}

/// A loop that commands what a test says, as far as the device displays it.
pub(crate) struct Commanded<'l> {
    pub(crate) servo: Ticked<'l>,
    force: latest::Sender<Vec3>,
}

impl<'l> Commanded<'l> {
    pub(crate) fn new(device: Box<dyn Device>, library: Option<&'l StandInLibrary>) -> Self {
        let limits = Limits {
            force: f64::MAX,
            slew: f64::MAX,
            speed: f64::INFINITY,
            arming_speed: f64::INFINITY,
            arming_force: f64::INFINITY,
            ramp: 1e-9,
            without_dead_man: 1.0,
            energy_budget: f64::INFINITY,
            ..Limits::of(device.capabilities())
        };
        let settings = ServoSettings {
            limits: Some(limits),
            ..ServoSettings::default()
        };
        let (force, mut read) = latest::channel(&Vec3::zeros());
        let controller = move |_: &DeviceState, _: f64| *read.latest();
        let servo = Ticked::with(device, library, Box::new(controller), settings);
        Self { servo, force }
    }

    /// What the device answers to `force` [N], once forces are on and it has arrived.
    pub(crate) fn exchange(&mut self, force: Vec3) -> DeviceState {
        self.force.send(force);
        (0..5)
            .map(|_| self.servo.tick().unwrap().state)
            .last()
            .unwrap()
    }
}
