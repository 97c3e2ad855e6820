//! Hands that keys, sticks and a mouse move. Judges: the camera's own projection, and a way is a speed
//! times a time.

use std::collections::BTreeSet;

use nalgebra::UnitQuaternion;
use palpate_geometry::Vec3;
use palpate_viewer::gesture::{Aim, Mouse};
use palpate_viewer::hands::gamepad::{Gamepad, Pad};
use palpate_viewer::hands::keys::{ACTIONS, CUTS, HANDS, JAWS};
use palpate_viewer::hands::{Drive, Hand, Room};
use palpate_viewer::{Camera, Orbit};

const ORBIT: Orbit = Orbit {
    target: Vec3::new(0.0, 0.0, 0.0),
    distance: 0.2,
    azimuth: 0.3,
    elevation: 0.4,
    field_of_view: 0.8,
};

fn room(camera: &Camera) -> Room<'_> {
    Room {
        camera,
        aspect: 1.6,
        middle: (Vec3::zeros(), 0.1),
    }
}

/// A hand that a mouse has put somewhere.
fn placed() -> Hand {
    let mut hand = Hand::default();
    hand.follow(&Aim {
        tip: Vec3::new(0.01, -0.01, 0.02),
        turned: UnitQuaternion::identity(),
        from: None,
        over: Vec3::zeros(),
        depth: 0.0,
    });
    hand
}

fn mouse(x: f64, y: f64, pressed: bool) -> Mouse {
    Mouse {
        place: Some((x, y)),
        pressed,
        wheel: 0.0,
        cuts: false,
        elapsed: 1.0 / 60.0,
    }
}

const CLOSE: Drive = Drive {
    way: [0.0; 3],
    roll: 0.0,
    fine: false,
    jaws: true,
    cuts: false,
};

#[test]
fn a_hand_that_nobody_moves_keeps_what_it_holds() {
    let camera = ORBIT.camera();
    let mut hand = placed();
    hand.drive(&CLOSE, 0.02, None, &room(&camera));
    let held = hand.place;
    for _ in 0..500 {
        hand.drive(&Drive::default(), 0.02, None, &room(&camera));
        hand.pull(&mouse(0.7, 0.2, false), &room(&camera));
    }
    assert_eq!(hand.place, held);
    assert!(hand.holds() && hand.grip == 1.0);
}

/// 30 mm/s along the picture's axes, a fifth of that when it shall be fine, and along the shaft to the trocar.
#[test]
fn a_way_is_a_speed_times_a_time() {
    let camera = ORBIT.camera();
    let [right, up, _] = camera.axes();
    let trocar = Vec3::new(0.05, -0.15, 0.1);
    let moved = |way: [f64; 3], fine: bool| {
        let mut hand = placed();
        let from = hand.place.unwrap().0;
        let drive = Drive {
            way,
            fine,
            ..Drive::default()
        };
        for _ in 0..10 {
            hand.drive(&drive, 0.02, Some(&trocar), &room(&camera));
        }
        assert!(hand.by_keys);
        (from, hand.place.unwrap().0 - from)
    };
    // Rounding of ten additions.
    assert!((moved([1.0, 0.0, 0.0], false).1 - 0.006 * right).norm() < 1e-12);
    assert!((moved([0.0, -1.0, 0.0], true).1 + 0.0012 * up).norm() < 1e-12);
    let (from, inward) = moved([0.0, 0.0, 1.0], false);
    assert!((inward - 0.006 * (from - trocar).normalize()).norm() < 1e-12);
}

/// However long a key is held, a tool is not lost.
#[test]
fn a_hand_stays_near_the_organ() {
    let camera = ORBIT.camera();
    let mut hand = Hand::default();
    let drive = Drive {
        way: [1.0, 1.0, -1.0],
        roll: 1.0,
        ..Drive::default()
    };
    for _ in 0..10_000 {
        hand.drive(&drive, 0.05, None, &room(&camera));
    }
    assert!(hand.place.unwrap().0.norm() < 0.2 + 1e-9);
    let turned = hand.turned().unwrap();
    assert!(turned.coords.iter().all(|c| c.is_finite()));
}

/// Shut jaws follow the mouse: what is dragged by a fifth of the picture is seen a fifth further.
#[test]
fn shut_jaws_are_pulled_with_the_mouse() {
    let camera = ORBIT.camera();
    let mut hand = placed();
    hand.drive(&CLOSE, 0.3, None, &room(&camera));
    let (before, _) = camera.project(&hand.place.unwrap().0, 1.6).unwrap();
    for step in 0..=10 {
        let part = 0.02 * f64::from(step);
        hand.pull(&mouse(0.4 + part, 0.5 - part, true), &room(&camera));
    }
    assert!(hand.is_pulling());
    let (after, _) = camera.project(&hand.place.unwrap().0, 1.6).unwrap();
    // The plane of the pull is that of the picture: rounding.
    assert!(
        (after.0 - before.0 - 0.2).abs() < 1e-9,
        "{before:?} {after:?}"
    );
    assert!(
        (after.1 - before.1 + 0.2).abs() < 1e-9,
        "{before:?} {after:?}"
    );
    let held = hand.place;
    hand.pull(&mouse(0.1, 0.9, false), &room(&camera));
    assert_eq!(hand.place, held);
    assert!(!hand.is_pulling());
}

/// Open jaws wait for the mouse to move; closing takes a quarter of a second.
#[test]
fn jaws_close_and_open_again() {
    let camera = ORBIT.camera();
    let mut hand = placed();
    hand.drive(&CLOSE, 0.0, None, &room(&camera));
    for _ in 0..12 {
        hand.drive(&Drive::default(), 0.02, None, &room(&camera));
    }
    assert!(hand.grip < 1.0);
    hand.drive(&Drive::default(), 0.02, None, &room(&camera));
    assert_eq!(hand.grip, 1.0);
    assert!(!hand.by_keys);
    hand.drive(&CLOSE, 0.02, None, &room(&camera));
    assert!(!hand.holds() && hand.by_keys && hand.grip < 1.0);
    // What cuts shuts its blades as long as it does.
    let cutting = Drive {
        cuts: true,
        ..Drive::default()
    };
    for _ in 0..20 {
        hand.drive(&cutting, 0.02, None, &room(&camera));
    }
    assert!(hand.cuts && hand.grip == 1.0 && !hand.holds());
    hand.drive(&Drive::default(), 0.02, None, &room(&camera));
    assert!(!hand.cuts && hand.grip < 1.0);
}

#[test]
fn no_key_does_two_things() {
    let of_hands = HANDS.iter().flat_map(|hand| {
        let own = [hand.jaws, hand.cuts].into_iter().chain(hand.roll);
        hand.ways.into_iter().chain(own)
    });
    let once = ACTIONS.iter().map(|(key, _)| *key);
    let keys: Vec<_> = of_hands.chain(once).chain([JAWS, CUTS]).collect();
    let different: BTreeSet<_> = keys.iter().collect();
    assert_eq!(different.len(), keys.len());
}

/// An event as the kernel writes it.
fn event(kind: u8, number: u8, value: i16) -> [u8; 8] {
    let [low, high] = value.to_le_bytes();
    [1, 2, 3, 4, low, high, kind, number]
}

#[test]
fn a_gamepad_moves_both_hands() {
    let mut pad = Pad::default();
    assert!(!pad.drive(0).moves() && !pad.drive(1).moves());
    // What is told at the start: a stick at rest, triggers let go, a button that is held.
    for (kind, number, value) in [(0x82, 0, 900), (0x82, 2, -32_767), (0x81, 9, 1)] {
        pad.take(event(kind, number, value));
    }
    assert!(!pad.drive(0).moves() && !pad.drive(0).jaws);
    pad.take(event(2, 0, i16::MAX));
    pad.take(event(2, 4, i16::MIN));
    pad.take(event(2, 5, i16::MAX));
    assert_eq!(pad.drive(0).way, [1.0, 0.0, 0.0]);
    // Up is negative on a stick; a pressed trigger goes in.
    assert_eq!(pad.drive(1).way, [0.0, 1.0, 1.0]);
    pad.take(event(1, 10, 1));
    pad.take(event(1, 2, 1));
    assert!(pad.drive(1).jaws && pad.drive(0).cuts && !pad.drive(1).cuts);
    // What is no event of a known kind changes nothing.
    let before = pad;
    pad.take(event(7, 0, 1));
    pad.take(event(2, 200, 1));
    pad.take(event(1, 200, 1));
    assert_eq!(pad, before);
}

#[test]
fn a_machine_without_a_gamepad_does_without() {
    assert!(Gamepad::open(std::path::Path::new("/there/is/none")).is_none());
}

/// What a gamepad tells comes from its thread, and an unplugged one moves nothing.
#[test]
fn an_unplugged_gamepad_lets_go() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("js0");
    let mut events = event(2, 0, i16::MAX).to_vec();
    events.extend([1, 2, 3]);
    std::fs::write(&path, events).unwrap();
    let gamepad = Gamepad::open(&path).unwrap();
    let waited = (0..500).find(|_| {
        std::thread::sleep(std::time::Duration::from_millis(2));
        gamepad.is_gone()
    });
    assert!(waited.is_some());
    assert_eq!(gamepad.look(), Pad::default());
}
