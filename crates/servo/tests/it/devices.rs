//! One battery for all devices, and what each does of its own.

use std::sync::atomic::Ordering;

use palpate_servo::{
    Command, Device, DeviceState, Disabled, HandImpedance, NoDevice, Pointer, PointerHand,
    Trajectory, Vec3, VirtualDevice,
};

fn exchange(device: &mut dyn Device, time: f64) -> DeviceState {
    device.exchange(&Command::without_force(time)).unwrap()
}

fn still() -> Trajectory {
    Trajectory::Sine {
        center: Vec3::zeros(),
        amplitude: Vec3::zeros(),
        frequency: 1.0,
    }
}

fn pointer() -> (Pointer, PointerHand) {
    let (pointer, mut hand) = Pointer::new();
    hand.move_to(Vec3::zeros());
    (pointer, hand)
}

fn all() -> Vec<Box<dyn Device>> {
    vec![
        Box::new(NoDevice::new(Vec3::zeros())),
        Box::new(pointer().0),
        Box::new(VirtualDevice::new(still())),
        Box::new(
            VirtualDevice::new(still())
                .with_hand(HandImpedance::default())
                .unwrap(),
        ),
    ]
}

#[test]
fn every_device_answers_is_finite_and_can_be_disabled_twice() {
    for mut device in all() {
        let name = device.capabilities().name.clone();
        assert!(device.capabilities().peak_force > 0.0, "{name}");
        for tick in 0..100 {
            let time = f64::from(tick) * 1e-3;
            let state = exchange(&mut *device, time);
            assert_eq!((state.time, state.present), (time, true), "{name}");
            assert!(state.position.iter().all(|x| x.is_finite()), "{name}");
        }
        assert_eq!(device.disable(), Disabled::NoForce, "{name}");
        assert_eq!(device.disable(), Disabled::NoForce, "{name}");
        device.enable().unwrap();
        exchange(&mut *device, 1.0);
    }
}

/// Judge: the exponential itself. Nobody is there before the hand and after it has left.
#[test]
fn a_pointer_glides_to_its_hand() {
    let (pointer, mut hand) = Pointer::new();
    let mut pointer = pointer.with_smoothing(0.01);
    assert!(!exchange(&mut pointer, 0.0).present);
    hand.move_to(Vec3::x());
    assert_eq!(exchange(&mut pointer, 0.001).position, Vec3::x());
    hand.move_to(Vec3::zeros());
    for tick in 1..50 {
        let time = 1e-3 * f64::from(tick);
        let place = exchange(&mut pointer, 0.001 + time).position.x;
        // Rounding.
        assert!(
            (place - (-time / 0.01).exp()).abs() < 1e-12,
            "{time}: {place}"
        );
    }
    hand.leave();
    assert!(!exchange(&mut pointer, 0.1).present);
    hand.move_to(Vec3::y());
    assert_eq!(exchange(&mut pointer, 0.2).position, Vec3::y());
}

/// Judge: the exponential from where it was put. What the hand says next does not undo it.
#[test]
fn a_pointer_that_is_put_down_glides_from_there() {
    let (pointer, mut hand) = Pointer::new();
    let mut pointer = pointer.with_smoothing(0.01);
    hand.move_to(Vec3::x());
    exchange(&mut pointer, 0.0);
    hand.move_from(Vec3::y(), Vec3::zeros());
    hand.move_to(Vec3::zeros());
    for tick in 1..20 {
        let time = 1e-3 * f64::from(tick);
        let place = exchange(&mut pointer, time).position;
        // Rounding.
        assert!((place - Vec3::y() * (-time / 0.01).exp()).norm() < 1e-12);
    }
}

/// Judge: F = k x.
#[test]
fn a_hand_yields_as_its_spring_says() {
    let hand = HandImpedance::default();
    let mut device = VirtualDevice::new(still()).with_hand(hand).unwrap();
    let mut place = Vec3::zeros();
    for tick in 0..3000 {
        place = device.advance(f64::from(tick) * 1e-3, &Vec3::z()).position;
    }
    // 3 s are 40 times b/2m's, so that nothing swings any more.
    assert!((place.z * hand.stiffness - 1.0).abs() < 1e-9, "{place}");
}

/// Judge: a damped oscillator let go, x = x₀ e^(−βt) (cos ω₁t + β/ω₁ sin ω₁t).
#[test]
fn a_hand_swings_at_its_frequency() {
    let hand = HandImpedance::default();
    let mut device = VirtualDevice::new(still()).with_hand(hand).unwrap();
    for tick in 0..3000 {
        device.advance(f64::from(tick) * 1e-3, &Vec3::z());
    }
    let start = exchange(&mut device, 3.0).position.z;
    let beta = hand.damping / (2.0 * hand.mass);
    let omega = (hand.stiffness / hand.mass - beta * beta).sqrt();
    for tick in 1..300 {
        let time = f64::from(tick) * 1e-3;
        let place = exchange(&mut device, 3.0 + time).position.z;
        let (sine, cosine) = (omega * time).sin_cos();
        let expected = start * (-beta * time).exp() * (cosine + beta / omega * sine);
        // First order in the step: ω h = 1.3 %.
        assert!(
            (place - expected).abs() < 0.013 * start,
            "{time}: {place} {expected}"
        );
    }
}

#[test]
fn a_virtual_device_is_disabled_when_it_is_dropped() {
    let device = VirtualDevice::new(still());
    let stops = device.disable_count();
    drop(device);
    assert_eq!(stops.load(Ordering::Relaxed), 1);
}
