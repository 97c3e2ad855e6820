//! What the drivers of both libraries have in common: axes, limits, walls, and what is missing.

use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::{Duration, Instant};

use nalgebra::UnitQuaternion;
use palpate_devices::stand_in::{StandInClock, StandInLibrary};
use palpate_devices::{Kind, Origin, Places};
use palpate_servo::{Command, Device, Trajectory, Vec3, VirtualDevice, Waypoint};
use tempfile::TempDir;

use crate::hands::{InTime, PATIENT, STIFFNESS, press, pressing, servo};

pub(crate) const BOTH: [Kind; 2] = [Kind::OpenHaptics, Kind::ForceDimension];

/// A library of its own, with where it is looked for.
pub(crate) fn library(kind: Kind) -> (StandInLibrary, Places, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let library = StandInLibrary::build(kind, folder.path()).unwrap();
    let mut places = Places {
        patience: PATIENT,
        ..Places::default()
    };
    let path = Some(library.path().to_owned());
    match kind {
        Kind::OpenHaptics => {
            places.openhaptics = path;
            library.set("stand_in_period_us", 50);
        }
        _ => places.force_dimension = path,
    }
    (library, places, folder)
}

pub(crate) const CLOCK: StandInClock = StandInClock::PerCommand(1e-3);

/// Exchanges until `holds`, for a few seconds.
pub(crate) fn until(holds: impl Fn() -> bool) {
    let end = Instant::now() + Duration::from_secs(5);
    while !holds() {
        assert!(Instant::now() < end, "it did not come");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A hand that presses in the time of the loop, which is returned.
pub(crate) fn carry_pressing(library: &StandInLibrary) -> Arc<AtomicU64> {
    let time = Arc::new(AtomicU64::new(0));
    let hand = InTime {
        device: Box::new(pressing()),
        time: time.clone(),
    };
    library.carry(Box::new(hand), CLOCK, 0);
    time
}

fn exchange(device: &mut dyn Device, force: Vec3) -> palpate_servo::DeviceState {
    let command = Command { time: 0.0, force };
    device.exchange(&command, Duration::from_millis(1)).unwrap()
}

#[test]
fn places_turns_buttons_and_forces_are_in_our_axes() {
    let turned = UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9);
    let place = Vec3::new(0.01, 0.02, -0.03);
    for kind in BOTH {
        let (library, places, _folder) = library(kind);
        let hand = VirtualDevice::new(Trajectory::Way(vec![Waypoint {
            orientation: Some(turned),
            buttons: 0b11,
            ..Waypoint::new(0.0, place)
        }]));
        library.carry(Box::new(hand), CLOCK, 0);
        let mut device = kind.open(0, &places).unwrap();
        let force = Vec3::new(0.1, 0.2, -0.3);
        // One answer may be that to an older force.
        exchange(&mut *device, force);
        exchange(&mut *device, force);
        let state = exchange(&mut *device, force);
        // Millimetres and back.
        assert!((state.position - place).norm() < 1e-15, "{kind}: {state:?}");
        assert!(
            state.orientation.unwrap().angle_to(&turned) < 1e-7,
            "{kind}"
        );
        assert_eq!((state.buttons, state.grip, state.ready), (0b11, 1.0, true));
        assert!((library.force(0) - force).norm() < 1e-15, "{kind}");
        // Whoever sends nothing any more hangs.
        until(|| library.force(0) == Vec3::zeros());
        exchange(&mut *device, force);
        until(|| library.force(0) == Vec3::zeros());
        drop(device);
        assert_eq!(library.open_devices(), 0, "{kind}");
    }
}

#[test]
fn what_is_found_has_its_limits() {
    for kind in BOTH {
        let (library, places, _folder) = library(kind);
        let found = kind.list(&places).unwrap();
        assert_eq!(library.open_devices(), 0);
        let device = &found[0];
        match kind {
            Kind::OpenHaptics => {
                assert_eq!(
                    (device.spec.peak_force, device.spec.continuous_force),
                    (3.3, 0.88)
                );
                assert_eq!(device.forces, Origin::Device);
                let [least, greatest] = device.spec.workspace.unwrap();
                assert!((greatest - least - Vec3::new(0.16, 0.12, 0.07)).norm() < 1e-12);
                assert_eq!((&*device.model, &*device.serial), ("Stand-in Touch", "S-1"));
            }
            _ => {
                assert_eq!(device.forces, Origin::Ours);
                assert_eq!(device.model, "stand-in.3");
            }
        }
    }
}

/// The wall's own law is the judge: what is sent is the stiffness times the depth that the device said.
#[test]
fn a_wall_is_felt_through_a_library() {
    for kind in BOTH {
        let (library, places, _folder) = library(kind);
        let time = carry_pressing(&library);
        let device = kind.open(0, &places).unwrap();
        let (mut servo, mut reader) = servo(device);
        let samples = press(&mut servo, &mut reader, &time).unwrap();
        let last = samples.last().unwrap();
        let expected = STIFFNESS * -last.state.position.y;
        assert!((last.sent.y - expected).abs() < 1e-9, "{kind}: {last:?}");
        let (sent, shown) = (last.held, library.force(0));
        // A frame takes the newest force when it comes.
        assert!(
            (sent - shown).norm() < 1e-9 || shown == Vec3::zeros(),
            "{kind}: {shown}"
        );
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
    let (_hd, mut places, _folder) = library(Kind::OpenHaptics);
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
        let (library, places, _folder) = library(kind);
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
    let (library, places, _folder) = library(Kind::ForceDimension);
    library.set("stand_in_devices", 2);
    let places_of_hands = [Vec3::x() * 0.05, Vec3::x() * -0.05];
    for (number, place) in (0..).zip(places_of_hands) {
        let still = Trajectory::way(vec![Waypoint::new(0.0, place)]).unwrap();
        library.carry(Box::new(VirtualDevice::new(still)), CLOCK, number);
    }
    let mut hands = [0, 1].map(|number| Kind::ForceDimension.open(number, &places).unwrap());
    for (number, hand) in (0..).zip(&mut hands) {
        let force = Vec3::y() * (0.1 + f64::from(number));
        let state = exchange(&mut **hand, force);
        assert_eq!(state.position, places_of_hands[number as usize]);
        assert_eq!(library.force(number), force);
    }
}
