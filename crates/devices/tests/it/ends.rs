//! What the drivers of both libraries display in contact, at their end, and after what took their forces off.

use std::time::{Duration, Instant};

use palpate_device_stand_ins::StandInClock;
use palpate_devices::{Kind, Places};
use palpate_servo::{
    Clock, DeadMan, DeviceState, Fault, ForceState, ServoLoop, ServoSettings, ServoThread, Stage,
    Trajectory, Vec3, VirtualDevice, Waypoint,
};

use crate::hands::{Commanded, InTime, Ticked, press, pressing, wall};
use crate::libraries::{BOTH, CLOCK, carry_pressing, library, pressed};

/// The judge is the same hand on the same wall without a library between. One is asked at every tick; the loop ticks in
/// the scheduler of the other: both give the same forces.
#[test]
fn a_wall_feels_as_without_a_library() {
    for kind in BOTH {
        let (library, places) = library(kind);
        let device = kind.open(0, &places).unwrap();
        let direct = pressing().with_capabilities(device.capabilities().clone());
        let expected = press(&mut Ticked::new(Box::new(direct), None, wall)).unwrap();
        let (servo, found) = pressed(&library, device);
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            // Millimetres and back.
            assert!(
                (found.output - expected.output).norm() < 1e-9,
                "{kind}: {found:?}"
            );
        }
        assert_eq!(library.force(0), found.last().unwrap().applied);
        servo.end();
    }
}

/// The end of a loop in contact: zero is displayed although neither a closed device nor a stopped scheduler takes a force
/// off, and motors that are switched off keep theirs.
#[test]
fn the_end_of_a_loop_in_contact_leaves_no_force() {
    for kind in BOTH {
        let (library, places) = library(kind);
        if kind == Kind::OpenHaptics {
            library.set("stand_in_motors_stay", 1);
        }
        let device = kind.open(0, &places).unwrap();
        let (servo, _) = pressed(&library, device);
        assert!(library.force(0).norm() > 0.9);
        servo.end();
        assert_eq!(library.force(0), Vec3::zeros(), "{kind}");
        assert_eq!(library.open_devices(), 0, "{kind}");
    }
}

/// So does a panic in the callback, which does not unwind into the library: the frame that says so is a whole one.
#[test]
fn a_panic_in_contact_leaves_no_force() {
    let (library, places) = library(Kind::OpenHaptics);
    library.set("stand_in_motors_stay", 1);
    let device = Kind::OpenHaptics.open(0, &places).unwrap();
    let panics = |state: &DeviceState, dt: f64| {
        assert!(state.time < 1.05, "a defect");
        wall(state, dt)
    };
    let mut servo = Ticked::new(device, Some(&library), panics);
    carry_pressing(&library, &servo.time);
    press(&mut servo).unwrap();
    let frames = library.read("stand_in_frames");
    let ended = (0..100).find_map(|_| servo.tick().err());
    assert_eq!(ended, Some(Fault::Panicked));
    assert_eq!(library.force(0), Vec3::zeros());
    // Those until then, the one of the tick that panics, and the last.
    assert_eq!(library.read("stand_in_frames") - frames, 40 + 2);
    assert_eq!(library.read("stand_in_frames_outside"), 0);
    assert_eq!(servo.reader.supervisor.state(), ForceState::Tripped);
    servo.end();
    assert_eq!(library.open_devices(), 0);
}

/// A device that took its forces off displays none until it is enabled again, which arming does.
#[test]
fn arming_enables_the_forces_of_a_device_that_took_them_off() {
    let (library, places) = library(Kind::ForceDimension);
    let hand = VirtualDevice::new(Trajectory::Waypoints(vec![Waypoint::new(
        0.0,
        Vec3::zeros(),
    )]));
    library.carry(Box::new(hand), CLOCK, 0);
    let device = Kind::ForceDimension.open(0, &places).unwrap();
    let mut commanded = Commanded::new(device, Some(&library));
    commanded.exchange(Vec3::y());
    assert_eq!(library.force(0), Vec3::y());
    library.set("stand_in_cause", 1);
    commanded.exchange(Vec3::y());
    assert_eq!(library.force(0), Vec3::zeros());
    let pressed = Fault::Safety {
        what: "its button was pressed",
    };
    assert_eq!(commanded.servo.fault(), Some(pressed));
    commanded.servo.reader.supervisor.arm();
    commanded.exchange(Vec3::y());
    assert_eq!(library.force(0), Vec3::y());
    // One that refuses is a fault, until somebody arms once more.
    library.set("stand_in_refuses", 1);
    library.set("stand_in_cause", 1);
    commanded.exchange(Vec3::y());
    commanded.servo.reader.supervisor.arm();
    commanded.exchange(Vec3::y());
    let refused = Fault::Library {
        code: 6,
        what: "an error",
    };
    assert_eq!(commanded.servo.fault(), Some(refused));
    assert_eq!(library.force(0), Vec3::zeros());
}

/// A stylus in its inkwell is held by nobody; one that is put there later is calibrated then.
#[test]
fn an_inkwell_calibrates_and_takes_the_force_off() {
    let (library, places) = library(Kind::OpenHaptics);
    library.set("stand_in_calibration", 0x5002);
    let device = Kind::OpenHaptics.open(0, &places).unwrap();
    let mut servo = Ticked::new(device, Some(&library), |_: &DeviceState, _: f64| {
        Vec3::y() * 0.1
    });
    let after = |servo: &mut Ticked<'_>, ticks: usize| {
        let samples = (0..ticks).map(|_| servo.tick().unwrap());
        samples.last().unwrap()
    };
    let uncalibrated = after(&mut servo, 700);
    assert!(!uncalibrated.state.ready && uncalibrated.stage == Stage::Off);
    library.set("stand_in_inkwell", 1);
    let inside = after(&mut servo, 700);
    assert!(inside.state.ready && !inside.state.present);
    assert_eq!((inside.stage, inside.output), (Stage::Off, Vec3::zeros()));
    library.set("stand_in_inkwell", 0);
    let taken = after(&mut servo, 700);
    assert!(taken.state.present && taken.stage == Stage::Live);
    assert_eq!(library.force(0), Vec3::y() * 0.1);
    library.set("stand_in_inkwell", 1);
    after(&mut servo, 2);
    assert_eq!(library.force(0), Vec3::zeros());
    servo.end();
}

/// A scheduler that calls twice, or from two threads at once, makes whole frames, one after another; one that calls after
/// it was stopped finds nobody.
#[test]
fn a_scheduler_that_calls_too_often_does_no_harm() {
    for switch in ["stand_in_twice", "stand_in_at_once", "stand_in_after_stop"] {
        let (library, places) = library(Kind::OpenHaptics);
        let device = Kind::OpenHaptics.open(0, &places).unwrap();
        let (mut servo, _) = pressed(&library, device);
        library.set(switch, 1);
        for _ in 0..200 {
            let sample = servo.tick().unwrap();
            assert_eq!(sample.stage, Stage::Live, "{switch}");
            assert!(library.force(0).norm() <= 1.5, "{switch}");
        }
        assert_eq!(library.read("stand_in_frames_outside"), 0);
        servo.end();
        let frames = library.read("stand_in_frames");
        std::thread::sleep(std::time::Duration::from_millis(60));
        assert_eq!(library.force(0), Vec3::zeros(), "{switch}");
        assert_eq!(library.read("stand_in_frames"), frames, "{switch}");
    }
}

#[test]
fn buttons_are_dead_mans_switches_where_that_is_asked_for() {
    for kind in BOTH {
        let (library, places) = library(kind);
        let places = Places {
            dead_man: true,
            ..places
        };
        for (buttons, most) in [(0b10, 3.0), (0b01, 0.0)] {
            let hand = VirtualDevice::new(Trajectory::Waypoints(vec![Waypoint {
                buttons,
                ..Waypoint::new(0.0, Vec3::zeros())
            }]));
            library.carry(Box::new(hand), CLOCK, 0);
            let device = kind.open(0, &places).unwrap();
            let Some(DeadMan::Buttons(which)) = device.capabilities().dead_man else {
                panic!("{kind}: none");
            };
            assert_eq!(which & 0b11, 0b10);
            let push =
                |state: &DeviceState, _: f64| Vec3::y() * if state.time < 0.7 { 0.0 } else { 5.0 };
            let mut servo = Ticked::new(device, Some(&library), push);
            assert!((0..800).all(|_| servo.tick().is_ok()));
            assert_eq!(library.force(0).norm(), most, "{kind}: {buttons:#b}");
            servo.end();
        }
    }
}

/// Without a dead-man's switch the same buttons stop: the first tick that sees one is the last with a force, and a
/// button that is released again arms nothing.
#[test]
fn buttons_are_stops_where_no_dead_mans_switch_is_asked_for() {
    for kind in BOTH {
        let (library, places) = library(kind);
        let at = |time, height, buttons| Waypoint {
            buttons,
            ..Waypoint::new(time, Vec3::new(0.02, height, -0.01))
        };
        let way = vec![
            at(0.0, 2e-3, 1),
            at(0.7, 2e-3, 1),
            at(1.0, -5e-3, 1),
            at(1.1, -5e-3, 0b10),
            at(1.2, -5e-3, 0),
        ];
        let device = kind.open(0, &places).unwrap();
        let mut servo = Ticked::new(device, Some(&library), wall);
        let hand = InTime {
            device: VirtualDevice::new(Trajectory::waypoints(way).unwrap()),
            time: servo.time.clone(),
        };
        library.carry(Box::new(hand), CLOCK, 0);
        let mut pressed = None;
        for tick in 0..1500 {
            let sample = servo.tick().unwrap();
            let stops = sample.state.buttons & 0b10 != 0;
            match pressed {
                None if stops => pressed = Some(library.force(0)),
                None if tick > 1050 => assert!(library.force(0).norm() > 0.9, "{kind}"),
                None => {}
                Some(_) => assert_eq!(library.force(0), Vec3::zeros(), "{kind}: {tick}"),
            }
        }
        assert!(pressed.is_some(), "{kind}");
        assert_eq!(servo.fault(), Some(Fault::DeviceButton), "{kind}");
        servo.end();
    }
}

/// A library that hangs while it stops its scheduler, or while it switches its forces off, keeps nobody waiting. Judge:
/// the time, half a second for the loop and half for the scheduler.
#[test]
fn a_library_that_hangs_at_the_end_is_not_waited_for() {
    for hangs in ["stand_in_stop_hangs", "stand_in_disable_hangs"] {
        let (library, places) = library(Kind::OpenHaptics);
        library.carry(Box::new(pressing()), StandInClock::Wall, 0);
        let device = Kind::OpenHaptics.open(0, &places).unwrap();
        let settings = ServoSettings::default();
        let (servo, mut reader) = ServoLoop::new(device, Box::new(wall), settings).unwrap();
        let thread = ServoThread::start(servo, Clock::real()).unwrap();
        while reader.latest.latest().is_none() {
            std::thread::yield_now();
        }
        // No more calls, so that the loop is ended from outside.
        library.set("stand_in_stalls", 1);
        library.set(hangs, 1);
        let began = Instant::now();
        assert_eq!(thread.stop(), Err(Fault::Hung { limit: 0.5 }), "{hangs}");
        // Twice that on a busy machine.
        assert!(began.elapsed() < Duration::from_secs(2), "{hangs}");
        library.set(hangs, 0);
        library.set("stand_in_stalls", 0);
    }
}

/// A device that comes with an error is not left open.
#[test]
fn a_device_that_fails_to_open_is_closed() {
    let (library, places) = library(Kind::OpenHaptics);
    library.set("stand_in_opens_with_error", 0x300);
    let said = Kind::OpenHaptics
        .open(0, &places)
        .err()
        .unwrap()
        .to_string();
    assert!(said.contains("a fault of the device (0x0300)"), "{said}");
    assert_eq!(library.open_devices(), 0);
}

/// A library whose scheduler may not be left out says so, and displays nothing.
#[test]
fn a_device_with_a_scheduler_is_called_from_there_alone() {
    let (library, places) = library(Kind::OpenHaptics);
    let mut device = Kind::OpenHaptics.open(0, &places).unwrap();
    let command = palpate_servo::Command::without_force(0.0);
    assert_eq!(device.exchange(&command), Err(Fault::OutsideScheduler));
    drop(device);
    assert_eq!(library.read("stand_in_frames"), 0);
}
