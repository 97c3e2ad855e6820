//! Whatever goes wrong with a library: no force, and a fault with a name that stays, within 25 ms of the virtual
//! clock.

use palpate_devices::Kind;
use palpate_servo::{Fault, Stage, Vec3};

use crate::hands::Ticked;
use crate::libraries::{carry_pressing, library, pressed};

/// What becomes of a `switch` that is set to `value` while a hand presses.
fn after(kind: Kind, switch: &'static str, value: i32, expected: Fault) {
    let (library, places) = library(kind);
    let (mut servo, _) = pressed(&library, kind.open(0, &places).unwrap());
    library.set(switch, value);
    let mut faulted = None;
    for tick in 0..100u32 {
        let fault = match servo.tick() {
            Err(fault) => Some(fault),
            Ok(sample) => match sample.stage {
                Stage::Faulted(fault) => {
                    assert_eq!(sample.output, Vec3::zeros());
                    Some(fault)
                }
                _ => None,
            },
        };
        if let (Some(fault), None) = (fault, faulted) {
            println!("{kind}: {switch} {value:#x} → {fault:?}: tick {tick}");
            faulted = Some(tick);
            assert_eq!(fault, expected, "{kind}: {switch}");
            // A library that answers nothing but errors takes no zero either, but it is told that forces are off.
            assert_eq!(library.force(0), Vec3::zeros(), "{kind}: {switch}");
        }
    }
    let ticks = faulted.unwrap_or(u32::MAX);
    assert!(ticks < 25, "{kind}: {switch}: {ticks}");
    servo.end();
    assert_eq!(library.force(0), Vec3::zeros());
}

fn reports(code: u32, what: &'static str) -> Fault {
    Fault::Library { code, what }
}

fn safety(what: &'static str) -> Fault {
    Fault::Safety { what }
}

#[test]
#[ignore = "long"]
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
    ];
    for ((switch, value), expected) in table {
        after(Kind::OpenHaptics, switch, value, expected);
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
        ((cause, 3), safety("its watchdog tripped")),
        ((cause, 4), safety("a program did it")),
        ((cause, 5), Fault::Vanished),
        ((cause, 6), safety("its dead-man's switch was released")),
        ((cause, 99), safety("for a reason of its own")),
        (
            ("stand_in_error_state", 1),
            safety("it reports an error of its own"),
        ),
        (("stand_in_nan", 1), Fault::NonFiniteState),
    ];
    for ((switch, value), expected) in table {
        after(Kind::ForceDimension, switch, value, expected);
    }
}

/// A device that was never calibrated is never armed.
#[test]
fn a_device_without_calibration_has_no_force() {
    let (library, places) = library(Kind::OpenHaptics);
    library.set("stand_in_calibration", 0x5002);
    let found = Kind::OpenHaptics.list(&places).unwrap();
    assert!(found[0].remarks[0].contains("inkwell"));
    let device = Kind::OpenHaptics.open(0, &places).unwrap();
    let mut servo = Ticked::new(device, Some(&library), crate::hands::wall);
    carry_pressing(&library, &servo.time);
    for _ in 0..800 {
        assert_eq!(servo.tick().unwrap().stage, Stage::Off);
    }
    servo.end();
}
