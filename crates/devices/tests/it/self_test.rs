//! The self-test, on devices that are well and on some that are not.

use crate::hands::PATIENT;
use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, Misbehaviour};
use palpate_devices::haply::HaplyDevice;
use palpate_devices::self_test;
use palpate_servo::{Clock, Fault, HandImpedance, Trajectory, Vec3, VirtualDevice, Waypoint};

fn held() -> HaplyStandIn {
    let still = Trajectory::waypoints(vec![Waypoint::new(0.0, Vec3::zeros())]).unwrap();
    let hand = VirtualDevice::new(still)
        .with_hand(HandImpedance::default())
        .unwrap();
    HaplyStandIn::start(vec![Box::new(hand)], HaplyStandInSettings::default()).unwrap()
}

/// By hand: 0.2 N on a spring of 500 N/m is 0.4 mm, along each axis and to one side; a push of half a second is slow
/// for a hand that swings at 8 Hz.
#[test]
fn a_device_that_is_well_passes() {
    let service = held();
    let device = HaplyDevice::open(service.address(), 0)
        .unwrap()
        .with_timeout(PATIENT);
    let test = self_test(Box::new(device), Clock::virtual_time()).unwrap();
    assert!(test.passed() && test.ready, "{test:?}");
    assert!((test.sent - 0.2).abs() < 1e-4, "{}", test.sent);
    assert!((test.displayed.unwrap() - 0.2).abs() < 1e-4);
    let [least, greatest] = test.reached.unwrap();
    for axis in 0..3 {
        assert!((greatest[axis] - 0.4e-3).abs() < 0.04e-3, "{greatest}");
        assert!(least[axis] > -0.02e-3, "{least}");
    }
    let forces = service.forces(0);
    assert!(forces.iter().all(|force| force.norm() <= 0.3));
    assert_eq!(*forces.last().unwrap(), Vec3::zeros());
}

#[test]
fn one_that_is_not_does_not() {
    for (wrong, fault) in [
        (Misbehaviour::NoForce, Some(Fault::Ignored)),
        (Misbehaviour::DevicesMissing, Some(Fault::Vanished)),
        // It was never ready, and no force is armed.
        (Misbehaviour::NoCalibration, None),
    ] {
        let service = held();
        let device = HaplyDevice::open(service.address(), 0)
            .unwrap()
            .with_timeout(PATIENT);
        service.misbehave(Some(wrong));
        let test = self_test(Box::new(device), Clock::virtual_time()).unwrap();
        assert!(!test.passed(), "{test:?}");
        assert_eq!(test.fault, fault);
        assert_eq!(service.force(0), Vec3::zeros());
    }
}
