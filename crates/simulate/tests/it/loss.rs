//! A device or a model that is lost while an organ is pressed. Judge: 25 ms on the virtual clock.

use std::sync::atomic::Ordering;
use std::time::Duration;

use palpate_geometry::Vec3;
use palpate_servo::{
    AffineForce, Capabilities, Clock, Command, Device, DeviceState, Disabled, Extrapolator, Fault,
    HandOver, Sample, ServoLoop, ServoSettings, Stage, VirtualDevice, latest,
};
use palpate_simulate::interactive::{
    DevicePlacement, ForceRenderer, Interaction, PlacedDevice, VirtualInteraction,
};

use crate::interactive::{POLE, advance, palpating, simulation};

/// A device that is unplugged at a time [s].
struct Unplugged(VirtualDevice, f64);

impl Device for Unplugged {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.0.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if command.time > self.1 {
            return Err(Fault::Silent);
        }
        self.0.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.0.disable()
    }
}

#[test]
fn a_device_that_fails_ends_its_loop_and_says_why() {
    let simulation = simulation("", "slip", "[]");
    let device = palpating(2.0);
    let stops = device.disable_count();
    let devices = vec![Some(PlacedDevice::new(Unplugged(device, 0.1)))];
    let mut interaction =
        Interaction::start(simulation, devices, ServoSettings::default()).unwrap();
    while interaction.is_running() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let quality = interaction.stop().unwrap();
    assert_eq!(quality.loops[0].unwrap().fault, Some(Fault::Silent));
    assert!(stops.load(Ordering::Relaxed) > 0);
}

/// On the virtual clock, in contact: the next sample has no force and says why, and the tool leaves the organ.
#[test]
fn a_device_lost_in_contact_leaves_no_force() {
    let simulation = simulation("", "slip", "[]");
    let device = palpating(2.0);
    let stops = device.disable_count();
    // Deep: a quarter of half a second into the third cycle.
    let devices = vec![Some(PlacedDevice::new(Unplugged(device, 1.1255)))];
    let settings = ServoSettings::default();
    let mut interaction = VirtualInteraction::new(simulation, devices, settings).unwrap();
    advance(&mut interaction, 1126);
    assert_eq!(interaction.advance(), Err(Fault::Silent));
    assert!(stops.load(Ordering::Relaxed) > 0);
    let samples: Vec<Sample> = interaction.samples(0).collect();
    let [.., before, last] = samples[..] else {
        panic!("{samples:?}");
    };
    assert!(before.output.z > 0.01, "{before:?}");
    assert_eq!((last.tick, last.output), (1126, Vec3::zeros()));
    assert_eq!(last.stage, Stage::Faulted(Fault::Silent));
    assert!(!last.state.present);
    let report = interaction.quality().loops[0].unwrap();
    assert_eq!((report.fault, report.faults), (Some(Fault::Silent), 1));
}

/// A model that dies while its organ is pressed, on the virtual clock: no force and a fault that stays, within 25 ms.
#[test]
fn a_model_lost_in_contact_is_a_fault_within_25_ms() {
    let (mut answers, heard) = latest::channel(&AffineForce::none(f64::NEG_INFINITY));
    let extrapolator = Extrapolator::new(HandOver::LocalModel, 5e-3, 1e-3);
    let renderer = ForceRenderer::new(heard, extrapolator, DevicePlacement::default(), 1.0);
    let settings = ServoSettings::default();
    // On its way in, so that the hand does work.
    let (mut servo, mut reader) =
        ServoLoop::new(Box::new(palpating(0.25)), Box::new(renderer), settings).unwrap();
    let lost = 800;
    servo.run(&mut Clock::virtual_time(), |tick| {
        if tick % 5 == 0 && tick < lost {
            let time = (tick as f64 - 5.0) * 1e-3;
            let pressed = if time < 0.6 { 0.0 } else { 0.5 };
            let stiff = -50.0 * nalgebra::Matrix3::identity();
            let force = Vec3::z() * pressed;
            answers.send(AffineForce {
                trust_radius: 1e-9,
                ..AffineForce::new(time, POLE, force, stiff)
            });
        }
        tick < 1500
    });
    let samples: Vec<Sample> = reader.log.drain().collect();
    assert!((samples[lost as usize - 1].output.z - 0.5).abs() < 1e-6);
    let faulted = |s: &&Sample| matches!(s.stage, Stage::Faulted(Fault::StaleModel { .. }));
    let first = samples.iter().find(faulted).unwrap().tick;
    println!("{} ms", first - lost);
    assert!(first - lost <= 25, "{first}");
    let tail = &samples[first as usize..];
    assert!(
        tail.iter()
            .all(|s| s.output == Vec3::zeros() && faulted(&s))
    );
}
