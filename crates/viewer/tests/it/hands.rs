//! Hands that keys, sticks and a mouse move. Judges: the camera's own projection, and a way is a speed
//! times a time.

use std::collections::BTreeSet;

use nalgebra::UnitQuaternion;
use palpate_geometry::Vec3;
use palpate_viewer::gesture::{Aim, Mouse};
use palpate_viewer::hands::gamepad::{Layout, Pad, PadEvent, PadPart, PadRequests};
use palpate_viewer::hands::keys::{ACTIONS, CUTS, HANDS, JAWS};
use palpate_viewer::hands::{Drive, Hand, HandContext};
use palpate_viewer::{Camera, Orbit};

const ORBIT: Orbit = Orbit {
    target: Vec3::new(0.0, 0.0, 0.0),
    distance: 0.2,
    azimuth: 0.3,
    elevation: 0.4,
    field_of_view: 0.8,
};

fn room(camera: &Camera) -> HandContext<'_> {
    HandContext {
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

/// An event of a button, and one of an axis with the range that its driver states.
fn button(code: u16, is_down: bool) -> PadEvent {
    PadEvent::Button { code, is_down }
}

fn axis(code: u16, value: i32, [least, most]: [i32; 2]) -> PadEvent {
    PadEvent::Axis {
        code,
        part: f64::from(value - least) / f64::from(most - least),
    }
}

const XPAD_STICK: [i32; 2] = [-32_768, 32_767];
const XPAD_TRIGGER: [i32; 2] = [0, 1023];
const BYTE: [i32; 2] = [0, 255];

/// A pad of `xpad`: at rest its sticks are a little off the middle, and a button is held from before.
fn xpad() -> Pad {
    let mut pad = Pad::new(Layout::of(&[0, 1, 2, 3, 4, 5, 0x10, 0x11]));
    for code in [0, 1, 3, 4] {
        pad.begin(axis(code, 900, XPAD_STICK));
    }
    for code in [2, 5] {
        pad.begin(axis(code, 0, XPAD_TRIGGER));
    }
    pad.begin(button(0x130, true));
    pad
}

/// Halves of one gamepad move both hands. Judge: the codes and ranges in the sources of the driver `xpad`.
#[test]
fn halves_of_a_gamepad_move_both_hands() {
    let mut pad = xpad();
    assert!(!pad.drive(PadPart::Left).moves() && !pad.drive(PadPart::Right).moves());
    assert_eq!(
        pad.requests(),
        PadRequests::default(),
        "what is held was not pressed"
    );
    pad.take(axis(0, 32_767, XPAD_STICK));
    // Up is negative on a stick; a pulled trigger goes in, a shoulder out.
    pad.take(axis(4, -32_768, XPAD_STICK));
    pad.take(axis(5, 1023, XPAD_TRIGGER));
    pad.take(button(0x136, true));
    // The range has no middle: half a count off, and the other axis rests.
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        let off = (0..3).map(|k| (found[k] - wanted[k]).abs());
        assert!(off.fold(0.0, f64::max) < 1e-4, "{found:?} {wanted:?}");
    };
    near(pad.drive(PadPart::Left).way, [1.0, 0.0, -1.0]);
    near(pad.drive(PadPart::Right).way, [0.0, 1.0, 1.0]);
    pad.take(button(0x13e, true));
    pad.take(button(0x133, true));
    let seen = pad.look();
    assert!(seen.drive(PadPart::Right).jaws && !seen.drive(PadPart::Left).jaws);
    assert!(seen.drive(PadPart::Left).cuts && !seen.drive(PadPart::Right).cuts);
    assert!(!pad.drive(PadPart::Right).jaws, "jaws change once");
    assert!(pad.drive(PadPart::Left).cuts, "a cut lasts");
    // What has no use here changes nothing.
    let before = pad;
    for event in [button(0x2c0, true), axis(0x28, 5, BYTE), button(1, true)] {
        pad.take(event);
    }
    assert_eq!(pad, before);
}

/// A gamepad of `hid-playstation` moves one tool whole; `hid-generic` has its right stick elsewhere.
#[test]
fn a_whole_gamepad_moves_one_tool() {
    let mut pad = Pad::new(Layout::of(&[0, 1, 2, 3, 4, 5]));
    for code in [0, 1, 3, 4] {
        pad.begin(axis(code, 128, BYTE));
    }
    pad.take(axis(2, 255, BYTE));
    pad.take(axis(3, 255, BYTE));
    pad.take(button(0x137, true));
    let drive = pad.drive(PadPart::Whole);
    assert_eq!((drive.way[2], drive.roll, drive.jaws), (-1.0, -1.0, true));
    let mut pad = Pad::new(Layout::of(&[0, 1, 2, 5, 9, 10]));
    pad.take(axis(9, 1023, XPAD_TRIGGER));
    pad.take(axis(2, 0, BYTE));
    let drive = pad.drive(PadPart::Whole);
    assert_eq!((drive.way[2], drive.roll), (1.0, 1.0));
}

/// A marks, the menu button pauses, the view button undoes, and the digital pad, an axis or buttons, sets a diameter.
#[test]
fn buttons_of_a_gamepad_ask_once() {
    let mut pad = xpad();
    pad.take(button(0x130, false));
    for code in [0x130, 0x13b, 0x13a] {
        pad.take(button(code, true));
    }
    pad.take(axis(0x10, 1, [-1, 1]));
    pad.take(axis(0x10, 0, [-1, 1]));
    let wanted = PadRequests {
        mark: true,
        pause: true,
        undo: true,
        larger: 1,
    };
    assert_eq!(pad.look().requests(), wanted);
    assert_eq!(pad.look().requests(), PadRequests::default());
    pad.take(axis(0x10, -1, [-1, 1]));
    assert_eq!(pad.look().requests().larger, -1);
    pad.take(axis(0x10, 0, [-1, 1]));
    pad.take(button(0x223, true));
    assert_eq!(pad.look().requests().larger, 1);
}

/// Who moves what: one gamepad both tools, two gamepads a tool each, any gamepad a single tool.
#[test]
fn gamepads_share_the_tools() {
    use PadPart::{Left, Right, Whole};
    for (pad, side, tools, part) in [
        ([0, 1], 1, 1, Some(Whole)),
        ([1, 2], 1, 1, Some(Whole)),
        ([0, 1], 0, 2, Some(Left)),
        ([0, 1], 1, 2, Some(Right)),
        ([0, 2], 0, 2, Some(Whole)),
        ([0, 2], 1, 2, None),
        ([1, 2], 1, 2, Some(Whole)),
        ([2, 3], 1, 2, None),
    ] {
        assert_eq!(
            PadPart::of(pad, side, tools),
            part,
            "{pad:?} {side} {tools}"
        );
    }
}
