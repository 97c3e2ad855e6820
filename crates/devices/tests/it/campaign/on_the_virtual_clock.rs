//! The campaign in ticks: what does not need the machine's time. A silent scheduler, a late answer and a call that never
//! returns do; they are on the machine's clock.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::Duration;

use palpate_device_stand_ins::StandInClock;
use palpate_servo::{Fault, ForceState, Sample, Stage, Supervisor, Vec3};

use super::world::{CONTACT, World, hand};
use super::{Chance, DRIVERS, Driver, LIMIT, Row, TROUBLES, Trouble, befalls, is_named, print};
use crate::hands::{InTime, PATIENT, Ticked};

/// Ticks within which zero is displayed: 25 ms, of which a silent model takes the most.
const PROMISED: u32 = 25;
/// Ticks in which it stays so.
const STAYS: u32 = 100;

fn world(driver: Driver) -> (World, Arc<AtomicU64>) {
    let time = Arc::<AtomicU64>::default();
    let mechanics = InTime {
        device: hand(),
        time: time.clone(),
    };
    let clock = StandInClock::PerCommand(1e-3);
    (World::new(driver, Box::new(mechanics), clock), time)
}

/// A loop in contact, at a moment of `chance`.
fn in_contact<'w>(
    world: &'w World,
    time: &Arc<AtomicU64>,
    timeout: Duration,
    chance: &mut Chance,
) -> Ticked<'w> {
    let device = world.open(timeout);
    let mut servo = Ticked::new(device, world.library(), world.law());
    servo.time = time.clone();
    let moment = (1e3 * CONTACT) as u32 + (500.0 * chance.next()) as u32;
    let mut last = None;
    for _ in 0..moment {
        last = Some(servo.tick().unwrap());
        assert!(world.displayed().norm() <= LIMIT);
    }
    let last: Sample = last.unwrap();
    assert!(
        last.stage == Stage::Live && last.output.norm() > 0.3,
        "{last:?}"
    );
    servo
}

/// What a loop does after something happened to it.
struct After {
    /// Ticks until zero was displayed.
    ticks: u32,
    fault: Option<Fault>,
}

fn after(world: &World, servo: &mut Ticked<'_>) -> After {
    let mut found = After {
        ticks: u32::MAX,
        fault: None,
    };
    let mut ended = false;
    for tick in 0..PROMISED + STAYS {
        if !ended {
            match catch_unwind(AssertUnwindSafe(|| servo.tick())) {
                Ok(Ok(sample)) => {
                    if let Stage::Faulted(fault) = sample.stage {
                        found.fault = found.fault.or(Some(fault));
                    }
                }
                Ok(Err(fault)) => {
                    found.fault = found.fault.or(Some(fault));
                    ended = true;
                }
                Err(_) => {
                    // Its thread would be gone, and the loop with it.
                    servo.lose();
                    found.fault = found.fault.or(Some(Fault::Panicked));
                    ended = true;
                }
            }
        }
        if ended {
            // A service hears of it on the machine's clock.
            std::thread::sleep(Duration::from_micros(500));
        }
        let displayed = world.displayed();
        assert!(displayed.norm() <= LIMIT, "{displayed}");
        if displayed == Vec3::zeros() {
            found.ticks = found.ticks.min(tick + 1);
        } else {
            assert_eq!(found.ticks, u32::MAX, "a force comes back");
        }
    }
    found
}

/// Whether a trouble is one of ticks with a driver.
fn is_of_ticks(driver: Driver, trouble: Trouble) -> bool {
    let waits = match driver {
        Driver::Virtual => trouble == Trouble::Late,
        Driver::Haply => matches!(trouble, Trouble::Hung | Trouble::Late | Trouble::Doubled),
        _ => matches!(trouble, Trouble::Silence | Trouble::Late | Trouble::Hung),
    };
    befalls(driver, trouble) && !waits
}

fn faults(moments: u32) {
    let mut rows: Vec<(String, Row)> = Vec::new();
    let mut chance = Chance(26);
    for trouble in TROUBLES {
        let mut row = Row::default();
        for (driver, worst) in DRIVERS.into_iter().zip(&mut row) {
            if !is_of_ticks(driver, trouble) {
                continue;
            }
            for _ in 0..moments {
                let (world, time) = world(driver);
                let timeout = match trouble {
                    Trouble::Silence => Duration::from_millis(20),
                    _ => PATIENT,
                };
                let mut servo = in_contact(&world, &time, timeout, &mut chance);
                world.befall(trouble);
                let found = after(&world, &mut servo);
                servo.end();
                assert_eq!(world.displayed(), Vec3::zeros());
                assert!(
                    is_named(driver, trouble, found.fault),
                    "{driver:?}: {trouble:?}: {:?}",
                    found.fault
                );
                if driver == Driver::OpenHaptics && trouble == Trouble::Doubled {
                    // Nothing is wrong; its end is what took the force off.
                    continue;
                }
                assert!(found.ticks <= PROMISED, "{driver:?}: {trouble:?}");
                *worst = Some(worst.unwrap_or(0.0).max(f64::from(found.ticks)));
            }
        }
        rows.push((format!("{trouble:?}"), row));
    }
    print("ticks to zero", &rows);
}

/// An order of a person.
type Order = (&'static str, fn(&Supervisor));

const STOPS: [Order; 3] = [
    ("pause", Supervisor::pause),
    ("emergency stop", Supervisor::trip),
    ("switch off", Supervisor::switch_off),
];

/// A state, and how a session in contact comes into it.
type Entry = (ForceState, fn(&Supervisor));

const STATES: [Entry; 5] = [
    (ForceState::Off, Supervisor::switch_off),
    (ForceState::Armed, |session| {
        session.trip();
        session.arm();
    }),
    (ForceState::Running, |_| {}),
    (ForceState::Paused, Supervisor::pause),
    (ForceState::Tripped, Supervisor::trip),
];

fn stops(moments: u32) {
    let mut rows: Vec<(String, Row)> = Vec::new();
    let mut chance = Chance(5);
    for (name, stop) in STOPS {
        for (state, enter) in STATES {
            let mut row = Row::default();
            for (driver, worst) in DRIVERS.into_iter().zip(&mut row) {
                for _ in 0..moments {
                    let (world, time) = world(driver);
                    let mut servo = in_contact(&world, &time, PATIENT, &mut chance);
                    let session = servo.reader.supervisor.clone();
                    enter(&session);
                    if state != ForceState::Running {
                        servo.tick().unwrap();
                        assert_eq!(world.displayed(), Vec3::zeros());
                    }
                    assert_eq!(session.state(), state);
                    stop(&session);
                    let found = after(&world, &mut servo);
                    // 5 ms; at the first tick, for that is what the loop reads.
                    assert_eq!(found.ticks, 1, "{driver:?}: {name} in {state:?}");
                    let tripped = session.state() == ForceState::Tripped;
                    assert!(!tripped || found.fault == Some(Fault::EmergencyStop));
                    *worst = Some(worst.unwrap_or(0.0).max(f64::from(found.ticks)));
                    servo.end();
                }
            }
            rows.push((format!("{name}, {state:?}"), row));
        }
    }
    print("ticks to zero", &rows);
}

#[test]
#[ignore = "long"]
fn every_fault_once() {
    faults(1);
}

#[test]
#[ignore = "long"]
fn a_stop_in_every_state_once() {
    stops(1);
}

/// Judge: the limit of force, the time that is promised, and the name of the fault.
#[test]
#[ignore = "slow: five moments of each, a minute"]
fn every_fault_at_five_moments() {
    faults(5);
}

/// Judge: the limit of force, the time that is promised, and the name of the fault.
#[test]
#[ignore = "slow: five moments of each, a minute"]
fn a_stop_in_every_state_at_five_moments() {
    stops(5);
}
