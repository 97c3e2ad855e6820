//! Whatever goes wrong with a library: no force, and a fault with a name that stays, within 25 ms of the virtual
//! clock. The wall's is printed.

use std::time::Instant;

use palpate_devices::{Kind, Places};
use palpate_servo::{Fault, Stage, Vec3};

use crate::hands::{DOWN, press, servo};
use crate::libraries::{carry_pressing, library, until};

/// What becomes of a `switch` that is set to `value` while a hand presses.
fn after(kind: Kind, (switch, value): (&'static str, i32), expected: Fault) {
    let (library, mut places, _folder) = library(kind);
    if expected == Fault::Silent {
        places.patience = Places::default().patience;
    }
    let time_of_hand = carry_pressing(&library);
    // With little patience a machine that is busy elsewhere may be a fault before it should.
    let pressed = (0..10).find_map(|_| {
        let device = kind.open(0, &places).unwrap();
        let (mut servo, mut reader) = servo(device);
        let done = press(&mut servo, &mut reader, &time_of_hand);
        done.is_ok().then_some(servo)
    });
    let mut servo = pressed.expect("a machine that is not too busy");
    library.set(switch, value);
    let began = Instant::now();
    let mut faulted = None;
    for tick in 0..100u32 {
        let time = DOWN + 0.010 + f64::from(tick) * 1e-3;
        let fault = match servo.tick(time, 0.0) {
            Err(fault) => Some(fault),
            Ok(sample) => match sample.stage {
                Stage::Faulted(fault) => {
                    assert_eq!(sample.sent, Vec3::zeros());
                    Some(fault)
                }
                _ => None,
            },
        };
        if let (Some(fault), None) = (fault, faulted) {
            let wall = 1e3 * began.elapsed().as_secs_f64();
            println!("{kind}: {switch} {value:#x} → {fault:?}: tick {tick}, {wall:.1} ms");
            faulted = Some(tick);
            assert_eq!(fault, expected, "{kind}: {switch}");
        }
        assert!(faulted.is_none() || servo.report().fault == Some(expected));
    }
    let ticks = faulted.unwrap_or(u32::MAX);
    assert!(ticks < 25, "{kind}: {switch}: {ticks}");
    // A library that came back has heard it too.
    library.set("stand_in_stalls", 0);
    until(|| library.force(0) == Vec3::zeros());
}

fn reports(code: u32, what: &'static str) -> Fault {
    Fault::Library { code, what }
}

fn safety(what: &'static str) -> Fault {
    Fault::Safety { what }
}

#[test]
fn of_open_haptics() {
    let error = "stand_in_error";
    let table = [
        ((error, 0x200), reports(0x200, "hot motors")),
        ((error, 0x201), reports(0x201, "a force that is too large")),
        (
            (error, 0x202),
            reports(0x202, "a force that changes too fast"),
        ),
        ((error, 0x203), reports(0x203, "a handle that is too fast")),
        (
            (error, 0x204),
            reports(0x204, "forces that it cannot display"),
        ),
        ((error, 0x300), reports(0x300, "a fault of the device")),
        (
            (error, 0x302),
            reports(0x302, "a lost connection to the device"),
        ),
        ((error, 0x304), reports(0x304, "a clock that fails")),
        ((error, 0x400), reports(0x400, "frames out of order")),
        ((error, 0x600), reports(0x600, "a missing licence")),
        ((error, 0x999), reports(0x999, "an error")),
        (("stand_in_calibration", 0x5002), Fault::Uncalibrated),
        (("stand_in_nan", 1), Fault::NonFiniteState),
        (("stand_in_stalls", 1), Fault::Silent),
    ];
    for (switch, expected) in table {
        after(Kind::OpenHaptics, switch, expected);
    }
}

#[test]
fn of_force_dimension() {
    let cause = "stand_in_cause";
    let table = [
        (("stand_in_error", 12), reports(12, "an error")),
        (("stand_in_power", 0), Fault::Unpowered),
        (("stand_in_connected", 0), Fault::Vanished),
        ((cause, 1), safety("its button was pressed")),
        ((cause, 2), safety("its handle was too fast")),
        ((cause, 3), safety("its watchdog bit")),
        ((cause, 4), safety("a program did it")),
        ((cause, 5), Fault::Vanished),
        ((cause, 6), safety("its dead-man's switch was let go of")),
        ((cause, 99), safety("for a reason of its own")),
        (
            ("stand_in_error_state", 1),
            safety("it reports an error of its own"),
        ),
        (("stand_in_nan", 1), Fault::NonFiniteState),
        (("stand_in_stalls", 300), Fault::Silent),
    ];
    for (switch, expected) in table {
        after(Kind::ForceDimension, switch, expected);
    }
}

/// A device that was never calibrated is never armed.
#[test]
fn a_device_without_calibration_has_no_force() {
    let (library, places, _folder) = library(Kind::OpenHaptics);
    library.set("stand_in_calibration", 0x5002);
    carry_pressing(&library);
    let (mut servo, mut reader) = servo(Kind::OpenHaptics.open(0, &places).unwrap());
    for tick in 0..800u32 {
        servo.tick(f64::from(tick) * 1e-3, 0.0).unwrap();
    }
    assert!(reader.log.drain().all(|sample| sample.stage == Stage::Off));
    // What needs only an inkwell is brought up to date at opening.
    drop(servo);
    library.set("stand_in_calibration", 0x5001);
    let found = Kind::OpenHaptics.list(&places).unwrap();
    assert!(found[0].remarks[0].contains("inkwell"));
    let (mut servo, _reader) = crate::hands::servo(Kind::OpenHaptics.open(0, &places).unwrap());
    assert!(servo.tick(0.0, 0.0).unwrap().state.ready);
}
