//! What the drivers of both libraries have in common: axes, limits, walls, ends, and what is missing.

use std::sync::Arc;
use std::sync::atomic::AtomicU64;

use nalgebra::UnitQuaternion;
use palpate_device_stand_ins::{StandInClock, StandInLibrary};
use palpate_devices::{Kind, Origin, Places};
use palpate_servo::{Device, Sample, Trajectory, Vec3, VirtualDevice, Waypoint};

use crate::hands::{Commanded, InTime, PATIENT, Ticked, press, pressing, wall};

pub(crate) const BOTH: [Kind; 2] = [Kind::OpenHaptics, Kind::ForceDimension];

/// A library of its own, with where it is looked for.
pub(crate) fn library(kind: Kind) -> (StandInLibrary, Places) {
    let library = StandInLibrary::build(kind).unwrap();
    let mut places = Places {
        timeout: PATIENT,
        ..Places::default()
    };
    let path = Some(library.path().to_owned());
    match kind {
        Kind::OpenHaptics => places.openhaptics = path,
        _ => places.force_dimension = path,
    }
    (library, places)
}

pub(crate) const CLOCK: StandInClock = StandInClock::PerCommand(1e-3);

/// A hand that presses, in the `time` of the loop.
pub(crate) fn carry_pressing(library: &StandInLibrary, time: &Arc<AtomicU64>) {
    let hand = InTime {
        device: pressing(),
        time: time.clone(),
    };
    library.carry(Box::new(hand), CLOCK, 0);
}

/// A loop whose hand presses into the wall.
pub(crate) fn pressed<'l>(
    library: &'l StandInLibrary,
    device: Box<dyn Device>,
) -> (Ticked<'l>, Vec<Sample>) {
    let mut servo = Ticked::new(device, Some(library), wall);
    carry_pressing(library, &servo.time);
    let samples = press(&mut servo).unwrap();
    (servo, samples)
}

#[test]
fn places_turns_buttons_and_forces_are_in_our_axes() {
    let turned = UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9);
    // Clear of the walls before the ends of the workspace.
    let place = Vec3::new(0.01, 0.02, -0.02);
    for kind in BOTH {
        let (library, places) = library(kind);
        let hand = VirtualDevice::new(Trajectory::Waypoints(vec![Waypoint {
            orientation: Some(turned),
            buttons: 0b1,
            ..Waypoint::new(0.0, place)
        }]));
        library.carry(Box::new(hand), CLOCK, 0);
        let device = kind.open(0, &places).unwrap();
        let mut commanded = Commanded::new(device, Some(&library));
        let force = Vec3::new(0.1, 0.2, -0.3);
        let state = commanded.exchange(force);
        // Millimetres and back.
        assert!((state.position - place).norm() < 1e-15, "{kind}: {state:?}");
        assert!(
            state.orientation.unwrap().angle_to(&turned) < 1e-7,
            "{kind}"
        );
        assert_eq!((state.buttons, state.grip, state.ready), (0b1, 1.0, true));
        assert!((library.force(0) - force).norm() < 1e-15, "{kind}");
        commanded.servo.end();
        assert_eq!(library.open_devices(), 0, "{kind}");
    }
}

#[test]
fn what_is_found_has_its_limits() {
    for kind in BOTH {
        let (library, places) = library(kind);
        let found = kind.list(&places).unwrap();
        assert_eq!(library.open_devices(), 0);
        let device = &found[0];
        match kind {
            Kind::OpenHaptics => {
                assert_eq!(
                    (
                        device.capabilities.peak_force,
                        device.capabilities.continuous_force
                    ),
                    (3.3, 0.88)
                );
                assert_eq!(device.forces, Origin::Device);
                let [least, greatest] = device.capabilities.workspace.unwrap();
                assert!((greatest - least - Vec3::new(0.16, 0.12, 0.07)).norm() < 1e-12);
                assert_eq!((&*device.model, &*device.serial), ("Stand-in Touch", "S-1"));
            }
            _ => {
                assert_eq!(device.forces, Origin::Assumed);
                assert_eq!(device.model, "stand-in.3");
            }
        }
    }
}

#[test]
fn what_is_missing_is_one_sentence() {
    for kind in BOTH {
        let mut places = Places::default();
        let nowhere = Some("/nowhere/libnothing.so".into());
        (places.openhaptics, places.force_dimension) = (nowhere.clone(), nowhere);
        let said = kind.open(0, &places).err().unwrap().to_string();
        let begins = format!("the library of `{kind}` is not there: no /nowhere/libnothing.so");
        assert!(said.starts_with(&begins), "{said}");
        assert!(
            said.contains("; install its driver") && !said.contains('\n'),
            "{said}"
        );
        assert!(said.contains(kind.variable()), "{said}");
        // On a machine without SDKs, where the usual names are.
        let said = kind
            .list(&Places::default())
            .err()
            .map(|error| error.to_string());
        assert!(said.is_none_or(|said| said.contains(" or ") && !said.contains('\n')));
    }
    // Each is no library of the other kind.
    let (_hd, mut places) = library(Kind::OpenHaptics);
    places.force_dimension = places.openhaptics.clone();
    let said = Kind::ForceDimension
        .open(0, &places)
        .err()
        .unwrap()
        .to_string();
    assert!(
        said.contains("has no function dhdGetDeviceCount; "),
        "{said}"
    );
}

#[test]
fn a_device_that_is_taken_or_absent_is_one_sentence() {
    for kind in BOTH {
        let (library, places) = library(kind);
        library.set("stand_in_fails_to_open", 0x302);
        let said = kind.open(0, &places).err().unwrap().to_string();
        assert!(said.contains("opens no device and reports "), "{said}");
        library.set("stand_in_fails_to_open", 0);
        let first = kind.open(0, &places).unwrap();
        assert!(kind.open(0, &places).is_err());
        let said = kind.open(1, &places).err().unwrap().to_string();
        assert!(
            said.contains("has 1 devices, and number 2 is asked for"),
            "{said}"
        );
        drop(first);
        assert!(kind.open(0, &places).is_ok());
    }
}

#[test]
fn two_hands_of_a_library_have_a_device_each() {
    let (library, places) = library(Kind::ForceDimension);
    library.set("stand_in_devices", 2);
    let places_of_hands = [Vec3::x() * 0.05, Vec3::x() * -0.05];
    for (number, place) in (0..).zip(places_of_hands) {
        let still = Trajectory::waypoints(vec![Waypoint::new(0.0, place)]).unwrap();
        library.carry(Box::new(VirtualDevice::new(still)), CLOCK, number);
    }
    let hands = [0, 1].map(|number| Kind::ForceDimension.open(number, &places).unwrap());
    let mut hands = hands.map(|hand| Commanded::new(hand, None));
    for (number, hand) in (0..).zip(&mut hands) {
        let force = Vec3::y() * (0.1 + f64::from(number));
        let state = hand.exchange(force);
        assert_eq!(state.position, places_of_hands[number as usize]);
        assert_eq!(library.force(number), force);
    }
}
