//! Several loops in one session. Judge: the table of `palpate_servo::supervisor`, at every tick.

use palpate_servo::dynamics::Compensation;
use palpate_servo::supervisor::REPORT_TIMEOUT;
use palpate_servo::{
    Capabilities, DeviceState, Fault, ForceState, NoDevice, Sample, ServoLoop, ServoSettings,
    Stage, Supervisor, Trajectory, Vec3, VirtualDevice, Waypoint,
};
use proptest::prelude::*;

use crate::limits::tries;

const PERIOD: f64 = 1e-3;

/// Two hands that stay 2 mm in springs of 500 N/m after half a second, on handles whose own spring is borne.
struct Session {
    loops: [ServoLoop; 2],
    supervisor: Supervisor,
    tick: u64,
}

impl Session {
    fn new(supervisor: Supervisor) -> Self {
        let pressed = Vec3::z() * -2e-3;
        let loops = [1.0, -1.0].map(|side| {
            let way = vec![
                Waypoint::new(0.0, Vec3::zeros()),
                Waypoint::new(0.2, Vec3::zeros()),
                Waypoint::new(0.6, pressed * side),
            ];
            let device = VirtualDevice::new(Trajectory::waypoints(way).unwrap())
                .with_capabilities(Capabilities::premium("test"));
            let law = |state: &DeviceState, _: f64| match state.time {
                // What a fault looks like from inside a loop.
                time if (7.0..7.0005).contains(&time) && state.position.z > 0.0 => {
                    Vec3::repeat(f64::NAN)
                }
                _ => state.position * -500.0,
            };
            let settings = ServoSettings {
                compensation: Some(Compensation {
                    weight: None,
                    stiffness: 100.0,
                    mass: 0.0,
                    cutoff: 30.0,
                }),
                ..ServoSettings::default()
            };
            let whole = supervisor.clone();
            ServoLoop::supervised(Box::new(device), Box::new(law), settings, whole)
                .unwrap()
                .0
        });
        Self {
            loops,
            supervisor,
            tick: 0,
        }
    }

    fn tick(&mut self) -> [Sample; 2] {
        let time = self.tick as f64 * PERIOD;
        self.tick += 1;
        self.loops
            .each_mut()
            .map(|each| each.tick(time, 0.0).unwrap())
    }

    fn after(&mut self, ticks: u64) -> [Sample; 2] {
        for _ in 1..ticks {
            self.tick();
        }
        self.tick()
    }
}

/// Whether a loop that ticks at `time` [s] finds the session tripped.
pub(crate) fn is_tripped_at(supervisor: &Supervisor, time: f64) -> bool {
    let law = |_: &DeviceState, _: f64| Vec3::zeros();
    let device = NoDevice::new(Vec3::zeros());
    let settings = ServoSettings::default();
    let loops = ServoLoop::supervised(
        Box::new(device),
        Box::new(law),
        settings,
        supervisor.clone(),
    );
    let (mut servo, _reader) = loops.unwrap();
    servo.tick(time, 0.0).unwrap();
    supervisor.state() == ForceState::Tripped
}

fn is_forceless(sample: &Sample) -> bool {
    let forces = [sample.applied, sample.output, sample.compensation];
    forces.iter().all(|force| *force == Vec3::zeros())
}

fn fault(sample: &Sample) -> Option<Fault> {
    match sample.stage {
        Stage::Faulted(fault) => Some(fault),
        _ => None,
    }
}

#[test]
fn an_emergency_stop_takes_every_force_at_the_next_tick_until_somebody_arms() {
    let mut session = Session::new(Supervisor::armed());
    let pressed = session.after(2000);
    assert!(pressed.iter().all(|sample| sample.output.norm() > 0.9));
    assert!(
        pressed
            .iter()
            .all(|sample| sample.compensation.norm() > 0.0)
    );
    assert_eq!(session.supervisor.state(), ForceState::Running);
    session.supervisor.trip();
    for _ in 0..1000 {
        let samples = session.tick();
        assert!(samples.iter().all(is_forceless));
        assert!(
            samples
                .iter()
                .all(|s| fault(s) == Some(Fault::EmergencyStop))
        );
    }
    // A pause that ends is no arming.
    session.supervisor.pause();
    session.supervisor.resume();
    assert!(session.after(1000).iter().all(is_forceless));
    session.supervisor.arm();
    let on_the_way = session.after(10);
    // The force is too large to be armed at once: a hand would be pushed.
    assert!(
        on_the_way
            .iter()
            .all(|s| s.stage == Stage::Ready && is_forceless(s))
    );
    assert_eq!(session.supervisor.state(), ForceState::Armed);
}

#[test]
fn a_fault_of_one_device_is_no_force_on_any() {
    let mut session = Session::new(Supervisor::armed());
    session.after(7000);
    let [first, second] = session.tick();
    // The second hand is the one that faults; the first is told at its next tick.
    assert!(fault(&first).is_none() && fault(&second) == Some(Fault::NonFiniteForce));
    let [first, second] = session.tick();
    assert_eq!(fault(&first), Some(Fault::OtherDevice));
    assert_eq!(fault(&second), Some(Fault::NonFiniteForce));
    assert!(is_forceless(&first) && is_forceless(&second));
}

#[test]
fn a_pause_has_no_force_and_a_silent_program_none_either() {
    let mut session = Session::new(Supervisor::default());
    assert!(session.after(700).iter().all(is_forceless));
    session.supervisor.arm();
    session.supervisor.report(0.7);
    // Silent until 0.7 s and the time it may be.
    let last = (REPORT_TIMEOUT / PERIOD) as u64 - 1;
    assert!(session.after(last).iter().all(|s| fault(s).is_none()));
    let samples = session.after(4);
    let silent = Some(Fault::ProgramSilent {
        limit: REPORT_TIMEOUT,
    });
    assert!(
        samples
            .iter()
            .all(|s| is_forceless(s) && fault(s) == silent)
    );
}

#[derive(Debug, Clone, Copy)]
enum Does {
    Arms,
    Pauses,
    Resumes,
    Stops,
    SwitchesOff,
}

proptest! {
    #![proptest_config(tries(60))]

    #[test]
    fn no_order_of_orders_leaves_a_force_where_none_is_allowed(
        orders in prop::collection::vec(
            (prop::sample::select(vec![
                Does::Arms, Does::Pauses, Does::Resumes, Does::Stops, Does::SwitchesOff,
            ]), 1u64..900),
            1..12,
        ),
    ) {
        // Two hands that are still at the surface can be armed at any time.
        let mut session = Session::new(Supervisor::armed());
        for (does, ticks) in orders {
            match does {
                Does::Arms => session.supervisor.arm(),
                Does::Pauses => session.supervisor.pause(),
                Does::Resumes => session.supervisor.resume(),
                Does::Stops => session.supervisor.trip(),
                Does::SwitchesOff => session.supervisor.switch_off(),
            }
            for _ in 0..ticks {
                let state = session.supervisor.state();
                let samples = session.tick();
                if state != ForceState::Running {
                    let begins = session.supervisor.state() == ForceState::Running;
                    prop_assert!(begins || samples.iter().all(is_forceless), "{state:?}");
                }
            }
        }
    }
}

/// A stop and an arming between two ticks are a stop. Judge: zero, for a hand whose force is too large to be armed.
#[test]
fn a_stop_is_not_lost_when_somebody_arms_before_the_next_tick() {
    let stops: [fn(&Supervisor); 2] = [Supervisor::trip, Supervisor::switch_off];
    for stop in stops {
        let mut session = Session::new(Supervisor::armed());
        session.after(2000);
        stop(&session.supervisor);
        session.supervisor.arm();
        for _ in 0..100 {
            let samples = session.tick();
            assert!(samples.iter().all(is_forceless));
        }
    }
    let mut session = Session::new(Supervisor::armed());
    session.after(2000);
    session.supervisor.pause();
    session.supervisor.resume();
    assert!(
        session
            .tick()
            .iter()
            .all(|sample| sample.output == Vec3::zeros())
    );
    // Who arms what runs changes nothing.
    let mut session = Session::new(Supervisor::armed());
    session.after(2000);
    session.supervisor.arm();
    assert!(
        session
            .tick()
            .iter()
            .all(|sample| sample.output.norm() > 0.9)
    );
}

/// The table of `docs/theory/haptics.md`, row by row, by what a session does.
#[test]
fn the_table_of_the_documents_is_that_of_the_code() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory/haptics.md");
    // Who embeds the crate alone has no such document.
    let Ok(document) = std::fs::read_to_string(path) else {
        return;
    };
    type Act = fn(&Supervisor);
    let orders: [(&str, Act); 5] = [
        ("arm", Supervisor::arm),
        ("pause", Supervisor::pause),
        ("resume", Supervisor::resume),
        ("trip", Supervisor::trip),
        ("switch off", Supervisor::switch_off),
    ];
    let word = |state: ForceState| format!("{state:?}").to_lowercase();
    for (order, act) in orders {
        let found = ["off", "armed", "running", "paused", "tripped"].map(|state| {
            let mut session = Session::new(Supervisor::default());
            if state != "off" {
                session.supervisor.arm();
            }
            match state {
                "running" => {
                    session.after(10);
                }
                "paused" => session.supervisor.pause(),
                "tripped" => session.supervisor.trip(),
                _ => {}
            }
            assert_eq!(word(session.supervisor.state()), state);
            act(&session.supervisor);
            word(session.supervisor.state())
        });
        let row = format!("| {order} | {} |", found.join(" | "));
        assert!(document.contains(&row), "{row}");
    }
}
