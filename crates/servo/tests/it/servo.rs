//! The loop on a virtual clock, and its ends.

use std::sync::atomic::Ordering;
use std::time::Duration;

use palpate_servo::{
    Capabilities, Clock, Command, Controller, Device, DeviceState, Disabled, Fault, Sample,
    ServoLoop, ServoReader, ServoSettings, ServoThread, Stage, Trajectory, Vec3, VirtualDevice,
};

fn sine() -> Trajectory {
    Trajectory::Sine {
        center: Vec3::zeros(),
        amplitude: Vec3::z() * 2e-3,
        frequency: 2.0,
    }
}

fn spring(state: &DeviceState, _dt: f64) -> Vec3 {
    state.position * -100.0
}

fn servo(device: impl Device + 'static) -> (ServoLoop, ServoReader) {
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    ServoLoop::new(Box::new(device), Box::new(spring), settings).unwrap()
}

fn played() -> Vec<Sample> {
    let (mut servo, mut reader) = servo(VirtualDevice::new(sine()));
    servo.run(&mut Clock::virtual_time(), |tick| tick < 3000);
    reader.log.drain().collect()
}

#[test]
fn the_same_script_gives_the_same_bytes() {
    let (one, two) = (played(), played());
    assert_eq!(one.len(), 3000);
    assert_eq!(format!("{one:?}"), format!("{two:?}"));
}

/// Nothing is lost, nothing is twice, and a force is sent with the next tick.
#[test]
fn every_tick_is_in_the_log() {
    let samples = played();
    for (number, pair) in samples.windows(2).enumerate() {
        assert_eq!(pair[0].tick, number as u64);
        assert_eq!(pair[1].applied, pair[0].output);
        let expected = spring(&pair[0].state, 0.0);
        assert_eq!(pair[0].commanded, expected);
    }
}

/// Judge: the sum of −k x_n (x_{n+2} − x_{n+1}) over a cycle of a sine, k A² π (cos ωT − cos 2ωT)/(ωT): a
/// spring whose force is held for a tick and sent a tick late.
#[test]
fn energy_at_the_port_is_that_of_the_lag() {
    let (mut servo, _reader) = servo(VirtualDevice::new(sine()));
    let mut clock = Clock::virtual_time();
    let before = servo.run(&mut clock, |tick| tick < 1000);
    let after = servo.run(&mut clock, |tick| tick < 3000);
    let per_cycle = (after.energy - before.energy) / 4.0;
    let turn = std::f64::consts::TAU * 2.0 * 1e-3;
    let lag = (turn.cos() - (2.0 * turn).cos()) / turn;
    let expected = 100.0 * 4e-6 * std::f64::consts::PI * lag;
    // Rounding of times of seconds in steps of a millisecond.
    assert!(
        (per_cycle / expected - 1.0).abs() < 1e-9,
        "{per_cycle} {expected}"
    );
}

/// A device that takes its time on the machine's clock.
struct Slow {
    capabilities: Capabilities,
    exchanges: u32,
}

impl Device for Slow {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        self.exchanges += 1;
        if self.exchanges == 10 {
            std::thread::sleep(Duration::from_millis(30));
        }
        if self.exchanges == 40 {
            return Err(Fault::Silent);
        }
        Ok(DeviceState::at(command.time, Vec3::zeros()))
    }

    fn disable(&mut self) -> Disabled {
        Disabled::Unknown
    }
}

/// One tick of 30 ms leaves some 29 out; the next ones are at their times, not all at once.
#[test]
fn skips_and_never_bursts() {
    let capabilities = Capabilities::without_force("slow");
    let (mut servo, mut reader) = servo(Slow {
        capabilities,
        exchanges: 0,
    });
    let report = servo.run(&mut Clock::real(), |_| true);
    // A busy machine leaves out more.
    assert!(report.missed >= 29, "{report:?}");
    assert_eq!(report.fault, Some(Fault::Silent));
    let mut samples: Vec<_> = reader.log.drain().collect();
    // The last says why there are no more.
    let last = samples.pop().unwrap();
    assert_eq!(last.stage, Stage::Faulted(Fault::Silent));
    assert_eq!((last.output, last.state.present), (Vec3::zeros(), false));
    assert_eq!(samples.len(), 39);
    let first = samples[0].state.time;
    for sample in &samples {
        let due = first + sample.tick as f64 * 1e-3;
        // The first may itself be late; never is one early by more than that.
        assert!(
            sample.state.time > due - 0.9e-3 || sample.tick == 0,
            "{sample:?}"
        );
    }
    assert!(samples[10].tick > samples[9].tick + 28);
}

struct Panics;

impl Controller for Panics {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        assert!(state.time < 0.02, "a defect");
        Vec3::zeros()
    }
}

#[test]
fn a_panic_stops_the_device() {
    let device = VirtualDevice::new(sine());
    let stops = device.disable_count();
    let (servo, _reader) =
        ServoLoop::new(Box::new(device), Box::new(Panics), ServoSettings::default()).unwrap();
    let thread = ServoThread::start(servo, Clock::real()).unwrap();
    while thread.is_running() {
        std::thread::yield_now();
    }
    assert_eq!(thread.stop(), Err(Fault::Panicked));
    assert!(stops.load(Ordering::Relaxed) >= 1);
}

#[test]
fn a_loop_that_is_dropped_or_stopped_stops_its_device() {
    let device = VirtualDevice::new(sine());
    let stops = device.disable_count();
    drop(servo(device));
    assert!(stops.load(Ordering::Relaxed) >= 1);
    let device = VirtualDevice::new(sine());
    let stops = device.disable_count();
    let thread = ServoThread::start(servo(device).0, Clock::real()).unwrap();
    let report = thread.stop().unwrap();
    assert!(stops.load(Ordering::Relaxed) >= 1 && report.fault.is_none());
}
