//! Hands and walls for all drivers.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use palpate_servo::{
    Command, Device, DeviceSpec, DeviceState, Fault, Sample, ServoLoop, ServoReader, ServoSettings,
    Stage, Trajectory, Vec3, VirtualDevice, Waypoint,
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
    VirtualDevice::new(Trajectory::way(places).unwrap())
}

/// A wall below y = 0.
pub(crate) fn wall(state: &DeviceState, _: f64) -> Vec3 {
    Vec3::y() * (-state.position.y).max(0.0) * STIFFNESS
}

pub(crate) fn servo(device: Box<dyn Device>) -> (ServoLoop, ServoReader) {
    ServoLoop::new(device, Box::new(wall), ServoSettings::default()).unwrap()
}

/// For all that does not try how long a device may be silent: a machine that is busy elsewhere is no fault.
pub(crate) const PATIENT: Duration = Duration::from_secs(5);

/// A device in the time of a loop on the virtual clock, however often it is asked.
pub(crate) struct InTime {
    pub(crate) device: Box<dyn Device>,
    pub(crate) time: Arc<AtomicU64>,
}

impl Device for InTime {
    fn spec(&self) -> &DeviceSpec {
        self.device.spec()
    }

    fn exchange(&mut self, command: &Command, patience: Duration) -> Result<DeviceState, Fault> {
        let time = f64::from_bits(self.time.load(Ordering::Acquire));
        self.device
            .exchange(&Command { time, ..*command }, patience)
    }

    fn stop(&mut self) {
        self.device.stop();
    }
}

/// Ticks on the virtual clock until the hand is down, and force is on. A device [in time](InTime) has it from `time`.
///
/// # Errors
/// When the device fails.
pub(crate) fn press(
    servo: &mut ServoLoop,
    reader: &mut ServoReader,
    time: &AtomicU64,
) -> Result<Vec<Sample>, Fault> {
    let last = (1e3 * DOWN) as u64 + 10;
    for tick in 0..last {
        let now = tick as f64 * 1e-3;
        time.store(now.to_bits(), Ordering::Release);
        servo.tick(now, 0.0)?;
    }
    let samples: Vec<Sample> = reader.log.drain().collect();
    let end = samples.last().unwrap();
    assert_eq!(end.stage, Stage::Live);
    assert!(
        (end.sent.norm() - STIFFNESS * DEPTH).abs() < 1e-3,
        "{end:?}"
    );
    Ok(samples)
}
