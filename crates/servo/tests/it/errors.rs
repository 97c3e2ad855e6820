//! Faults say their cause, then how to repair it; settings out of range are none.

use palpate_servo::{
    DeviceState, Fault, HandImpedance, Limits, NoDevice, ServoLoop, ServoSettings, Trajectory,
    Vec3, VirtualDevice, Waypoint,
};

#[test]
fn every_fault_is_one_sentence_with_its_mend() {
    let all = [
        Fault::NonFiniteForce,
        Fault::NonFiniteState,
        Fault::TooFast {
            speed: 1.234,
            limit: 1.0,
        },
        Fault::StaleModel {
            overdue: 0.0123,
            limit: 0.01,
        },
        Fault::Late {
            gap: 0.0321,
            limit: 0.021,
        },
        Fault::Silent,
        Fault::Device { code: 42 },
        Fault::Disconnected,
        Fault::BadMessage { what: "no state" },
        Fault::Vanished,
        Fault::Unpowered,
        Fault::Uncalibrated,
        Fault::Safety {
            what: "its brake is on",
        },
        Fault::Ignored,
        Fault::Library {
            code: 0x200,
            what: "hot motors",
        },
        Fault::EmergencyStop,
        Fault::Hung { limit: 0.5 },
        Fault::OutsideScheduler,
        Fault::Panicked,
        Fault::NoThread,
    ];
    for fault in all {
        let text = fault.to_string();
        assert!(text.contains("; "), "{text}");
        assert!(!text.ends_with('.'), "{text}");
    }
    assert_eq!(
        all[2].to_string(),
        "the hand moved at 1.23 m/s, beyond 1 m/s; hold it still and arm again"
    );
    assert!(all[6].to_string().contains("42"));
}

fn fault_of(settings: ServoSettings) -> String {
    let nothing = |_: &DeviceState, _: f64| Vec3::zeros();
    let device = Box::new(NoDevice::new(Vec3::zeros()));
    let made = ServoLoop::new(device, Box::new(nothing), settings);
    made.err().unwrap().to_string()
}

#[test]
fn settings_out_of_range_are_refused_by_name() {
    let default = ServoSettings::default();
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let text = fault_of(ServoSettings { period, ..default });
        assert!(text.starts_with("the period of the loop [s] is "), "{text}");
    }
    let limits = Some(Limits {
        force: f64::NAN,
        ..Limits::default()
    });
    let text = fault_of(ServoSettings { limits, ..default });
    assert_eq!(
        text,
        "the largest force [N] is NaN; set a finite number above zero"
    );
    let limp = HandImpedance {
        stiffness: 0.0,
        ..HandImpedance::default()
    };
    let still = Trajectory::waypoints(vec![Waypoint::new(0.0, Vec3::zeros())]).unwrap();
    let text = VirtualDevice::new(still)
        .with_hand(limp)
        .unwrap_err()
        .to_string();
    assert!(
        text.starts_with("the hand's stiffness [N/m] is 0;"),
        "{text}"
    );
}
