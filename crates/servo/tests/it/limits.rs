//! Nothing but a bounded, slowly rising force reaches a hand.

use palpate_servo::limits::slew::reduced_towards;
use palpate_servo::limits::{CommandedForce, Guard, Limits};
use palpate_servo::{Capabilities, DeadMan, DeviceState, Fault, OutputForce, Stage, Vec3};
use proptest::prelude::*;

const PERIOD: f64 = 1e-3;

fn capabilities() -> Capabilities {
    Capabilities {
        workspace: Some([Vec3::repeat(-0.1), Vec3::repeat(0.1)]),
        dead_man: Some(DeadMan::Buttons(1)),
        ..Capabilities::premium("test")
    }
}

fn commanded(force: Vec3) -> CommandedForce {
    CommandedForce {
        force,
        compensation: Vec3::zeros(),
        velocity: Vec3::zeros(),
        overdue: None,
        gap: PERIOD,
        allowed: true,
        rearm_requested: false,
    }
}

fn guard() -> Guard {
    Guard::new(Limits::default(), &capabilities(), PERIOD).unwrap()
}

/// A guard that is live, with a hand in the middle.
fn live() -> (Guard, DeviceState) {
    let mut guard = guard();
    let mut state = DeviceState::at(0.0, Vec3::zeros());
    state.buttons = 1;
    for _ in 0..600 {
        guard.pass(&commanded(Vec3::zeros()), &state, PERIOD);
    }
    assert_eq!(guard.stage(), Stage::Live);
    (guard, state)
}

/// Any number, and what is none.
pub(crate) fn component() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -10.0..10.0f64,
        2 => any::<f64>(),
        1 => Just(f64::NAN),
        1 => Just(f64::INFINITY),
        1 => Just(f64::MAX),
    ]
}

pub(crate) fn vector(component: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Vec3> {
    [component.clone(), component.clone(), component].prop_map(Vec3::from)
}

/// How often a random test tries: `full` times when `PALPATE_FULL=1`, else a tenth of it.
pub(crate) fn tries(full: u32) -> ProptestConfig {
    let wants_full = std::env::var("PALPATE_FULL").is_ok_and(|value| value == "1");
    ProptestConfig::with_cases(if wants_full { full } else { full / 10 })
}

proptest! {
    #![proptest_config(tries(2000))]

    /// Judge: the two inequalities themselves, over whole courses of commanded_forces, places and requests to arm. What is added
    /// for the device itself is in the force that is bounded: by what the device displays, and in its rise.
    #[test]
    fn nothing_passes_the_limits_with_compensation(
        commanded_forces in prop::collection::vec(
            (vector(component().boxed()), vector(component().boxed()), vector((-0.2..0.2f64).boxed())),
            1..200,
        ),
    ) {
        let (mut guard, mut state) = live();
        let limits = Limits::default();
        let peak = capabilities().peak_force;
        let mut last = Vec3::zeros();
        for (force, compensation, position) in commanded_forces {
            state.position = position;
            let commanded = CommandedForce { compensation, ..commanded(force) };
            let sent = guard.pass(&commanded, &state, PERIOD).newtons();
            prop_assert!(sent.norm() <= peak, "{sent}");
            prop_assert!(guard.rendered().norm() <= limits.force, "{sent}");
            let rise = (sent - reduced_towards(&last, &sent)).norm();
            // Rounding of forces of 8.5 N.
            prop_assert!(rise <= limits.slew * PERIOD + 1e-14, "{last} {sent}");
            if !compensation.iter().all(|c| c.is_finite()) {
                prop_assert_eq!(sent, Vec3::zeros());
            }
            last = sent;
        }
    }

    /// Judge: the two inequalities themselves, over whole courses of commanded_forces, places and requests to arm.
    #[test]
    fn nothing_passes_the_limits(
        commanded_forces in prop::collection::vec(
            (vector(component().boxed()), vector((-0.2..0.2f64).boxed()), any::<bool>(), 0.5..30.0f64),
            1..200,
        ),
        begins_live in any::<bool>(),
    ) {
        let (mut guard, mut state) = if begins_live { live() } else { (guard(), live().1) };
        let limits = Limits::default();
        let mut last = Vec3::zeros();
        for (force, position, rearm_requested, gap) in commanded_forces {
            state.position = position;
            let commanded = CommandedForce { gap: gap * PERIOD, rearm_requested, ..commanded(force) };
            let sent = guard.pass(&commanded, &state, commanded.gap).newtons();
            prop_assert!(sent.iter().all(|c| c.is_finite()), "{sent}");
            prop_assert!(sent.norm() <= limits.force, "{sent}");
            let rise = (sent - reduced_towards(&last, &sent)).norm();
            // Rounding of forces of 3 N.
            prop_assert!(rise <= limits.slew * PERIOD + 1e-14, "{last} {sent}");
            if !force.iter().all(|c| c.is_finite()) {
                prop_assert_eq!(sent, Vec3::zeros());
            }
            last = sent;
        }
    }
}

#[test]
fn a_step_of_force_rises_at_its_rate() {
    let (mut guard, state) = live();
    let mut last = 0.0;
    for tick in 1..=20 {
        let sent = guard
            .pass(&commanded(Vec3::x() * 100.0), &state, PERIOD)
            .newtons()
            .x;
        // 400 N/s, until 3 N.
        let expected = (0.4 * f64::from(tick)).min(3.0);
        assert!((sent - expected).abs() < 1e-12, "{tick}: {sent}");
        last = sent;
    }
    assert_eq!(last, 3.0);
    assert_eq!(
        guard.pass(&commanded(Vec3::zeros()), &state, PERIOD),
        OutputForce::default()
    );
}

#[test]
fn what_is_no_number_latches_until_somebody_arms() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (mut guard, state) = live();
        let nothing = guard.pass(&commanded(Vec3::y() * value), &state, PERIOD);
        assert_eq!(nothing, OutputForce::default());
        for _ in 0..1000 {
            assert_eq!(
                guard.pass(&commanded(Vec3::x() * 0.1), &state, PERIOD),
                OutputForce::default()
            );
        }
        assert_eq!(guard.stage(), Stage::Faulted(Fault::NonFiniteForce));
        let rearm_requested = CommandedForce {
            rearm_requested: true,
            ..commanded(Vec3::x() * 0.1)
        };
        guard.pass(&rearm_requested, &state, PERIOD);
        for _ in 0..600 {
            guard.pass(&commanded(Vec3::x() * 0.1), &state, PERIOD);
        }
        assert_eq!((guard.stage(), guard.faults()), (Stage::Live, 1));
    }
}

#[test]
fn each_fault_has_its_cause() {
    let still = commanded(Vec3::x() * 0.1);
    let fast = CommandedForce {
        velocity: Vec3::y() * 1.5,
        ..still
    };
    let stale = CommandedForce {
        overdue: Some(0.02),
        ..still
    };
    let late = CommandedForce { gap: 0.05, ..still };
    let causes = [fast, stale, late].map(|commanded| {
        let (mut guard, state) = live();
        assert_eq!(
            guard.pass(&commanded, &state, PERIOD),
            OutputForce::default()
        );
        guard.stage()
    });
    let [
        Stage::Faulted(Fault::TooFast { .. }),
        Stage::Faulted(Fault::StaleModel { .. }),
        Stage::Faulted(Fault::Late { .. }),
    ] = causes
    else {
        panic!("{causes:?}");
    };
    let (mut guard, mut state) = live();
    state.position.z = f64::NAN;
    guard.pass(&still, &state, PERIOD);
    assert_eq!(guard.stage(), Stage::Faulted(Fault::NonFiniteState));
}

/// 6 ms too late: one tick without force, then it rises again.
#[test]
fn a_late_tick_has_no_force() {
    let (mut guard, state) = live();
    let pressed = commanded(Vec3::x() * 0.3);
    assert!(guard.pass(&pressed, &state, PERIOD).newtons().x > 0.0);
    let late = CommandedForce {
        gap: 7e-3,
        ..pressed
    };
    assert_eq!(guard.pass(&late, &state, 7e-3), OutputForce::default());
    assert!(guard.pass(&pressed, &state, PERIOD).newtons().x > 0.0);
    assert_eq!(guard.stage(), Stage::Live);
}

#[test]
fn a_wall_keeps_the_hand_inside() {
    let (mut guard, mut state) = live();
    state.position.x = 0.095;
    let mut sent = Vec3::zeros();
    for _ in 0..20 {
        sent = guard
            .pass(&commanded(Vec3::zeros()), &state, PERIOD)
            .newtons();
    }
    // Half of the wall's 3 N.
    assert!((sent - Vec3::x() * -1.5).norm() < 1e-12, "{sent}");
}

/// A mouse cannot hurt: it is as fast as it likes, and a fault is over when its cause is.
#[test]
fn a_device_without_force_recovers_by_itself() {
    let mouse = Capabilities::without_force("mouse");
    let mut guard = Guard::new(Limits::of(&mouse), &mouse, PERIOD).unwrap();
    let state = DeviceState::at(0.0, Vec3::zeros());
    let fast = CommandedForce {
        velocity: Vec3::x() * 50.0,
        ..commanded(Vec3::x() * 0.1)
    };
    for _ in 0..600 {
        guard.pass(&fast, &state, PERIOD);
    }
    assert_eq!(guard.stage(), Stage::Live);
    guard.pass(&commanded(Vec3::x() * f64::NAN), &state, PERIOD);
    assert!(matches!(guard.stage(), Stage::Faulted(_)));
    for _ in 0..600 {
        guard.pass(&fast, &state, PERIOD);
    }
    assert_eq!((guard.stage(), guard.faults()), (Stage::Live, 1));
}

/// Judge: the closed form of the heat, as for a force of the same size that is rendered: 8.5 N are folded back to what
/// the motors bear.
#[test]
fn compensation_warms_the_motors() {
    let (mut guard, state) = live();
    let borne = CommandedForce {
        compensation: Vec3::y() * 100.0,
        ..commanded(Vec3::zeros())
    };
    let mut sent = 0.0;
    for _ in 0..200_000 {
        sent = guard.pass(&borne, &state, PERIOD).newtons().y;
    }
    assert!((sent - 1.4).abs() < 1e-3, "{sent}");
}
