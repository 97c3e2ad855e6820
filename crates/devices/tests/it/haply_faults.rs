//! Whatever goes wrong with the service: no force, and a fault with a name that stays, within 25 ms of the virtual
//! clock. The wall's is printed.

use std::time::{Duration, Instant};

use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, Misbehaviour};
use palpate_devices::haply::HaplyDevice;
use palpate_servo::{Fault, Stage, Vec3};

use crate::hands::{PATIENT, Ticked, press, pressing, wall};

/// A loop whose hand presses. With a short timeout a machine that is busy elsewhere may be a fault before it should:
/// then it begins anew.
fn pressed(timeout: Duration) -> (HaplyStandIn, Ticked<'static>) {
    for _ in 0..10 {
        let settings = HaplyStandInSettings::default();
        let service = HaplyStandIn::start(vec![Box::new(pressing())], settings).unwrap();
        let device = HaplyDevice::open(service.address(), 0).unwrap();
        let device = device.with_timeout(timeout);
        let mut servo = Ticked::new(Box::new(device), None, wall);
        if press(&mut servo).is_ok() {
            return (service, servo);
        }
    }
    panic!("this machine is too busy");
}

/// As it comes.
const USUAL: Duration = Duration::from_millis(20);

/// What is done at the time, and which fault comes of it; none when nothing may.
fn after(begin: impl FnOnce(&HaplyStandIn), expected: Option<Fault>) -> Duration {
    let timeout = if expected == Some(Fault::Silent) {
        USUAL
    } else {
        PATIENT
    };
    let (service, mut servo) = pressed(timeout);
    let commanded = service.forces(0).len();
    begin(&service);
    let (began, mut wall) = (Instant::now(), None);
    let mut faulted_after = None;
    for tick in 0..150u32 {
        // Answers that nobody asked for have time to come, as between ticks of the machine's clock.
        std::thread::sleep(Duration::from_micros(500));
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
        if let (Some(fault), None) = (fault, faulted_after) {
            wall = Some(began.elapsed());
            faulted_after = Some(tick + 1);
            assert_eq!(Some(fault), expected);
        }
        // Once it is there it stays.
        assert!(faulted_after.is_none() || servo.fault() == expected);
    }
    assert_eq!(faulted_after.is_some(), expected.is_some(), "{expected:?}");
    if let Some(ticks) = faulted_after {
        assert!(ticks <= 25, "{ticks} ticks until {expected:?}");
        // Nothing but zero was commanded from the fault on.
        let forces = service.forces(0);
        let from = (commanded + ticks as usize).min(forces.len());
        assert!(forces[from..].iter().all(|force| *force == Vec3::zeros()));
        let until = Instant::now() + Duration::from_secs(5);
        while service.force(0) != Vec3::zeros() {
            assert!(Instant::now() < until, "a force stays");
        }
    }
    wall.unwrap_or_default()
}

fn bad(what: &'static str) -> Option<Fault> {
    Some(Fault::BadMessage { what })
}

const NOT_AS_DOCUMENTED: &str = "a message that is not as its documents have it";

#[test]
#[ignore = "long"]
fn every_fault_takes_the_force_off_and_has_a_name() {
    use Misbehaviour::*;
    let says = |text: &str| SendsText(text.to_owned());
    let table = [
        (Disconnects, Some(Fault::Disconnected)),
        (NoReply, Some(Fault::Silent)),
        (Stalls(Duration::from_millis(200)), Some(Fault::Silent)),
        (SendsBytewise(Duration::from_millis(1)), Some(Fault::Silent)),
        (says("{"), bad(NOT_AS_DOCUMENTED)),
        (says(""), bad(NOT_AS_DOCUMENTED)),
        (says("[]"), Some(Fault::Vanished)),
        (says("null"), bad(NOT_AS_DOCUMENTED)),
        (says("{}"), Some(Fault::Vanished)),
        (says(r#"{"inverse3": []}"#), Some(Fault::Vanished)),
        (
            says(r#"{"inverse3": [{"device_id": "1"}]}"#),
            Some(Fault::Vanished),
        ),
        (
            says(r#"{"inverse3": [{"device_id": "0"}]}"#),
            bad("a device without a state"),
        ),
        (says(&"[".repeat(100_000)), bad(NOT_AS_DOCUMENTED)),
        (
            says(&" ".repeat(2 << 20)),
            bad("a message that is too long"),
        ),
        (SendsBinary(vec![0xff; 100]), bad("bytes instead of a text")),
        (Truncates(100), bad(NOT_AS_DOCUMENTED)),
        (Repeats(20), bad("more than it was asked for")),
        (DevicesMissing, Some(Fault::Vanished)),
        (NoPosition, bad("a state without a position")),
        (Coordinate("NaN"), bad(NOT_AS_DOCUMENTED)),
        (Coordinate("null"), bad(NOT_AS_DOCUMENTED)),
        (Coordinate("1e999"), bad(NOT_AS_DOCUMENTED)),
        (Coordinate("\"0.1\""), bad(NOT_AS_DOCUMENTED)),
        (Coordinate("-Infinity"), bad(NOT_AS_DOCUMENTED)),
        (NoPower, Some(Fault::Unpowered)),
        (NoCalibration, Some(Fault::Uncalibrated)),
        (NoForce, Some(Fault::Ignored)),
        // What is odd, and no fault.
        (Fragments(7), None),
        (UnknownKeys, None),
    ];
    for (wrong, expected) in table {
        let name: String = format!("{wrong:?}").chars().take(40).collect();
        let wall = after(|service| service.misbehave(Some(wrong)), expected);
        println!("{:6.1} ms  {name} → {expected:?}", 1e3 * wall.as_secs_f64());
    }
}

/// A handle that leaps is a hand that is too fast, whoever says so.
#[test]
fn a_place_out_of_this_world_is_no_force() {
    for place in ["1e300", "-1e308", "5.0"] {
        let leap =
            |service: &HaplyStandIn| service.misbehave(Some(Misbehaviour::Coordinate(place)));
        let (service, mut servo) = pressed(PATIENT);
        leap(&service);
        let sample = servo.tick().unwrap();
        assert_eq!(sample.output, Vec3::zeros());
        // The way over the time is itself beyond all numbers, at times.
        let expected = [Stage::Faulted(Fault::NonFiniteState)];
        let is_too_fast = matches!(sample.stage, Stage::Faulted(Fault::TooFast { .. }));
        assert!(
            is_too_fast || expected.contains(&sample.stage),
            "{:?}",
            sample.stage
        );
    }
}

#[test]
fn events_of_the_service_are_faults() {
    let event = |name: &str, level: &str, data: &str| {
        format!(
            r#"{{"name":"{name}","category":"device","level":"{level}","data":{data},"message":"m"}}"#
        )
    };
    let safety = |kind: &str| {
        let data = format!(r#"{{"device_id":"0","safety_type":"{kind}"}}"#);
        event("device-safety-triggered", "warning", &data)
    };
    let of = |what| Some(Fault::Safety { what });
    let table = [
        (safety("ebrake_triggered"), of("its brake came on")),
        (safety("stall_detected"), of("its motors stalled")),
        (safety("stability_ceiling"), of("it began to swing")),
        (safety("new_in_9.9"), of("one of its safeties came on")),
        (safety("ebrake_released"), None),
        (safety("fod_stage_changed"), None),
        (
            event("device-disconnected", "warning", "{}"),
            Some(Fault::Vanished),
        ),
        (
            event("device-disconnected", "warning", r#"{"device_id":"7"}"#),
            None,
        ),
        (
            event("device-busy", "warning", "null"),
            of("another program drives it"),
        ),
        (event("device-battery-low", "notice", "{}"), None),
        (
            event("device-battery-low", "critical", "{}"),
            of("its battery is low"),
        ),
        (
            event("invalid-value", "error", "3"),
            of("its service refused a value"),
        ),
        (event("system-rate-report", "info", "{}"), None),
        (
            event("new", "panic", "[]"),
            of("its service is in distress"),
        ),
        (
            "{".to_owned(),
            bad("an event that is not as its documents have it"),
        ),
    ];
    for (event, expected) in table {
        let wall = after(|service| service.send_event(&event), expected);
        println!(
            "{:6.1} ms  {event} → {expected:?}",
            1e3 * wall.as_secs_f64()
        );
    }
}

/// A fault that the device lives through is armed again by asking, once what it was is over.
#[test]
fn what_a_device_lives_through_is_armed_again() {
    let (service, mut servo) = pressed(PATIENT);
    let stage_after = |servo: &mut Ticked<'_>, ticks: u32| {
        let stages = (0..ticks).map(|_| servo.tick().unwrap().stage);
        stages.last().unwrap()
    };
    service.misbehave(Some(Misbehaviour::NoPower));
    assert_eq!(stage_after(&mut servo, 1), Stage::Faulted(Fault::Unpowered));
    servo.reader.supervisor.arm();
    // Still without power.
    assert_eq!(stage_after(&mut servo, 100), Stage::Off);
    service.misbehave(None);
    // The force of 1 N is too large to begin with.
    assert_eq!(stage_after(&mut servo, 700), Stage::Ready);
    service.misbehave(Some(Misbehaviour::NoPower));
    assert_eq!(stage_after(&mut servo, 1), Stage::Faulted(Fault::Unpowered));
    service.misbehave(None);
    // Power alone is not enough.
    assert_eq!(
        stage_after(&mut servo, 700),
        Stage::Faulted(Fault::Unpowered)
    );
}
