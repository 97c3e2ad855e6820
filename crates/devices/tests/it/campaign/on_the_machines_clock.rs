//! The campaign on the machine's clock, with the threads of a session.
//!
//! A time is from the fault to the first look that finds zero; looks are some 0.2 ms apart. A machine that is busy
//! elsewhere is late for everybody: by how much is measured beside each case, by a thread that sleeps for a millisecond at
//! a time, and granted. Where it is later than a session allows, its own lateness ends the session before the fault
//! does: such a case is tried again.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use palpate_device_stand_ins::StandInClock;
use palpate_servo::supervisor::REPORT_TIMEOUT;
use palpate_servo::{
    Clock, Fault, ServoLoop, ServoReader, ServoSettings, ServoThread, Stage, StopReason,
    Supervisor, Vec3,
};

use super::world::{CONTACT, World, hand};
use super::{Chance, DRIVERS, Driver, LIMIT, Row, TROUBLES, Trouble, befalls, is_named, print};

/// How long a loop may make no tick before it is ended from outside, as a watch of its session does.
const WATCH: Duration = Duration::from_millis(50);
/// How long zero has to stay.
const STAYS: Duration = Duration::from_millis(100);
/// How long a busy machine may take until a session is in contact: it trips those whose ticks it delays by 20 ms.
const COMES_INTO_CONTACT: Duration = Duration::from_secs(60);
/// A machine that is as late as this may trip a session by itself [ms]: the least of the timeouts, of the devices'
/// watchdogs and of the loop, is 20 ms, and the session's own work is in it.
const TRIPS: f64 = 15.0;
/// From one look at the device to the next.
const LOOK: Duration = Duration::from_micros(200);

/// What takes the force off from outside.
#[derive(Clone, Copy)]
struct Order {
    name: &'static str,
    /// At a time [s].
    give: fn(&Supervisor, f64),
    /// The time [ms] within which zero is displayed.
    promised: f64,
    fault: Option<Fault>,
}

impl Order {
    /// One that is zero within 5 ms, as the session promises.
    const fn new(name: &'static str, give: fn(&Supervisor, f64), fault: Option<Fault>) -> Self {
        Self {
            name,
            give,
            promised: 5.0,
            fault,
        }
    }
}

const ORDERS: [Order; 6] = [
    Order::new(
        "emergency stop",
        |session, _| session.trip(),
        Some(Fault::EmergencyStop),
    ),
    Order {
        name: "killed window",
        // It never reports again.
        give: |session, now| session.report(now),
        promised: 1e3 * REPORT_TIMEOUT + 5.0,
        fault: Some(Fault::ProgramSilent {
            limit: REPORT_TIMEOUT,
        }),
    },
    Order::new(
        "Ctrl-C or SIGTERM",
        |session, _| session.trip_with_reason(StopReason::Signal),
        Some(Fault::Interrupted),
    ),
    Order::new(
        "disk full",
        |session, _| session.trip_with_reason(StopReason::Unrecorded),
        Some(Fault::Unrecorded),
    ),
    Order::new("pause", |session, _| session.pause(), None),
    Order::new(
        "end of the session",
        |session, _| session.switch_off(),
        None,
    ),
];

/// The time [ms] within which zero is displayed.
fn promised(driver: Driver, trouble: Trouble) -> f64 {
    match (trouble, driver) {
        // Nobody but the watch can see it, and the end of a loop then gives its scheduler 50 ms.
        (Trouble::Silence | Trouble::Hung, Driver::OpenHaptics) => 120.0,
        // A call, or a scheduler's period, of 40 ms that nobody can shorten, and a tick.
        (Trouble::Late, Driver::OpenHaptics | Driver::Virtual) => 45.0,
        // The device's watchdog, 20 ms, or the timeout of the driver, 20 ms; a model that is silent fades in 21 ms.
        // The timeout of 20 ms, up to 4 ms of the system's timer, a tick, and a message.
        (Trouble::Silence | Trouble::Hung, Driver::Haply) => 30.0,
        // A service that takes 40 ms for a message takes as long for the one with zero.
        (Trouble::Late, Driver::Haply) => 90.0,
        _ => 25.0,
    }
}

/// How late threads are woken, at most [ms].
struct Lateness {
    worst: Arc<AtomicU64>,
    ends: Arc<AtomicBool>,
}

impl Lateness {
    fn measure() -> Self {
        let (worst, ends) = (Arc::<AtomicU64>::default(), Arc::<AtomicBool>::default());
        let (own, stop) = (worst.clone(), ends.clone());
        std::thread::spawn(move || {
            let nap = Duration::from_millis(1);
            while !stop.load(Ordering::Relaxed) {
                let began = Instant::now();
                std::thread::sleep(nap);
                let late = began.elapsed().saturating_sub(nap);
                own.fetch_max(late.as_micros() as u64, Ordering::Relaxed);
            }
        });
        Self { worst, ends }
    }

    fn worst(&self) -> f64 {
        self.ends.store(true, Ordering::Relaxed);
        self.worst.load(Ordering::Relaxed) as f64 * 1e-3
    }
}

/// A session in contact, at a moment of `chance`; none when this machine was too busy to come there.
fn in_contact(
    world: &World,
    clock: Clock,
    chance: &mut Chance,
) -> Option<(ServoThread, ServoReader)> {
    let device = world.open(Duration::from_millis(20));
    let settings = ServoSettings::default();
    let (servo, mut reader) = ServoLoop::new(device, Box::new(world.law()), settings).unwrap();
    let thread = ServoThread::start(servo, clock).unwrap();
    let until = Instant::now() + Duration::from_secs_f64(CONTACT + 0.4 * chance.next());
    while Instant::now() < until {
        assert!(world.displayed().norm() <= LIMIT);
        std::thread::sleep(LOOK);
    }
    let live = reader.latest.latest().map(|sample| sample.stage) == Some(Stage::Live);
    (live && world.displayed().norm() > 0.3).then_some((thread, reader))
}

/// What became of a session.
struct Found {
    /// From the fault to zero [ms].
    time: f64,
    /// How late the machine was meanwhile [ms].
    late: f64,
    /// The longest time between two ticks until the fault had a name [ms].
    gap: f64,
    fault: Option<Fault>,
}

/// Looks at the device from `happen` on.
fn after(
    world: &World,
    thread: ServoThread,
    mut reader: ServoReader,
    happen: impl FnOnce(&Supervisor),
) -> Found {
    let lateness = Lateness::measure();
    let supervisor = reader.supervisor.clone();
    let began = Instant::now();
    happen(&supervisor);
    let (mut zero, mut fault) = (None, None);
    let (mut thread, mut ending, mut last_tick) = (Some(thread), None, Instant::now());
    // Between ticks, as long as nothing was found.
    let (mut gap, mut time) = (0.0_f64, None);
    while zero.is_none_or(|zero: Instant| zero.elapsed() < STAYS) {
        for sample in reader.log.drain() {
            last_tick = Instant::now();
            if fault.is_none() {
                gap = gap.max(sample.state.time - time.unwrap_or(sample.state.time));
                time = Some(sample.state.time);
            }
            if let Stage::Faulted(named) = sample.stage {
                fault = fault.or(Some(named));
            }
        }
        let hangs = last_tick.elapsed() > WATCH;
        if let Some(ended) = thread.take_if(|thread| hangs || !thread.is_running()) {
            ending = Some(std::thread::spawn(move || ended.stop()));
        }
        let displayed = world.displayed();
        assert!(displayed.norm() <= LIMIT, "{displayed}");
        match displayed == Vec3::zeros() {
            true => _ = zero.get_or_insert_with(Instant::now),
            // After a tick that was late.
            false if supervisor.state().allows_force() => zero = None,
            false => assert!(zero.is_none(), "a force comes back"),
        }
        assert!(began.elapsed() < Duration::from_secs(5), "a force stays");
        std::thread::sleep(LOOK);
    }
    let late = lateness.worst();
    // What hangs does so until its loop has given up.
    let ended = ending.and_then(|ending| ending.join().unwrap().err());
    world.release();
    let stopped = thread.and_then(|thread| thread.stop().err());
    fault = fault.or(ended).or(stopped);
    for sample in reader.log.drain() {
        if let Stage::Faulted(named) = sample.stage {
            fault = fault.or(Some(named));
        }
    }
    Found {
        time: 1e3 * (zero.unwrap() - began).as_secs_f64(),
        late,
        gap: 1e3 * gap,
        fault,
    }
}

/// What happens to a session at a time [s].
type Happening<'a> = &'a dyn Fn(&World, &Supervisor, f64);

/// The worst time to zero of `moments` sessions of `driver`.
fn worst(
    driver: Driver,
    name: &str,
    moments: u32,
    chance: &mut Chance,
    promised: f64,
    happen: Happening<'_>,
    is_named: &dyn Fn(Option<Fault>) -> bool,
) -> f64 {
    let mut worst: f64 = 0.0;
    for _ in 0..moments {
        let until = Instant::now() + COMES_INTO_CONTACT;
        let found = loop {
            let world = World::new(driver, Box::new(hand()), StandInClock::Wall);
            // The time of a virtual device is that of its loop.
            let clock = Clock::real();
            let in_time = Instant::now() < until;
            let Some((thread, reader)) = in_contact(&world, clock, chance) else {
                assert!(in_time, "a machine that is not too busy");
                continue;
            };
            let found = after(&world, thread, reader, |supervisor| {
                happen(&world, supervisor, clock.now());
            });
            if is_named(found.fault) {
                break found;
            }
            assert!(
                in_time && found.late.max(found.gap) > TRIPS,
                "{driver:?}, {name}: {:?}, on a machine that was {:.1} ms late, {:.1} ms between ticks",
                found.fault,
                found.late,
                found.gap
            );
        };
        assert!(
            found.time <= promised + 2.0 * found.late,
            "{driver:?}, {name}: {:.1} ms, promised {promised} ms, on a machine that was {:.1} ms late",
            found.time,
            found.late
        );
        worst = worst.max(found.time);
    }
    worst
}

/// A driver each on a thread of its own.
fn campaign(moments: u32, troubles: &[Trouble], orders: &[Order]) {
    let columns = DRIVERS.map(|driver| {
        let (troubles, orders) = (troubles.to_vec(), orders.to_vec());
        std::thread::spawn(move || {
            let mut chance = Chance(driver as u64 + 3);
            let mut times: Vec<Option<f64>> = Vec::new();
            for trouble in troubles {
                let doubled = trouble == Trouble::Doubled && driver == Driver::OpenHaptics;
                let befalls = befalls(driver, trouble) && !doubled;
                times.push(befalls.then(|| {
                    let happens = |world: &World, _: &Supervisor, _: f64| world.befall(trouble);
                    let named = |fault| is_named(driver, trouble, fault);
                    let promised = promised(driver, trouble);
                    let name = format!("{trouble:?}");
                    worst(
                        driver,
                        &name,
                        moments,
                        &mut chance,
                        promised,
                        &happens,
                        &named,
                    )
                }));
            }
            for Order {
                name,
                give,
                promised,
                fault,
            } in orders
            {
                let happens = |_: &World, session: &Supervisor, now: f64| give(session, now);
                let named = |found| found == fault;
                times.push(Some(worst(
                    driver,
                    name,
                    moments,
                    &mut chance,
                    promised,
                    &happens,
                    &named,
                )));
            }
            times
        })
    });
    let columns = columns.map(|column| column.join().unwrap());
    let mut names: Vec<String> = troubles
        .iter()
        .map(|trouble| format!("{trouble:?}"))
        .collect();
    names.extend(orders.iter().map(|order| order.name.to_owned()));
    let rows: Vec<(String, Row)> = names
        .into_iter()
        .enumerate()
        .map(|(row, name)| (name, columns.each_ref().map(|column| column[row])))
        .collect();
    print("ms to zero", &rows);
}

#[test]
#[ignore = "long"]
fn what_needs_the_machines_time_once() {
    let troubles = [Trouble::Silence, Trouble::Late, Trouble::Hung];
    campaign(1, &troubles, &ORDERS[..2]);
}

/// Judge: the limit of force, the time that is promised, and the name of the fault.
#[test]
#[ignore = "by hand: two minutes on the machine's clock, with nothing else running"]
fn every_fault_at_five_moments() {
    campaign(5, &TROUBLES, &ORDERS);
}
