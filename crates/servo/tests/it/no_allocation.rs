//! A tick that allocates may wait for the allocator longer than it has time.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_servo::dynamics::{Compensation, Linkage};
use palpate_servo::{
    AffineForce, Clock, Controller, Device, DeviceState, Extrapolator, HandImpedance, HandOver,
    Limits, NoDevice, Pointer, ServoLoop, ServoSettings, Trajectory, Vec3, VirtualDevice, latest,
};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

struct Rendered {
    answers: latest::Receiver<AffineForce>,
    extrapolator: Extrapolator,
}

impl Controller for Rendered {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        self.extrapolator.receive(self.answers.latest());
        self.extrapolator.force(state.time, &state.position)
    }

    fn age(&self) -> Option<f64> {
        Some(1e-3)
    }
}

/// 10,000 ticks of each device and hand-over, with reports, log and new answers; the log fills up.
#[test]
fn a_tick_allocates_nothing() {
    let sine = Trajectory::Sine {
        center: Vec3::zeros(),
        amplitude: Vec3::z() * 2e-3,
        frequency: 2.0,
    };
    let yielding = VirtualDevice::new(sine.clone())
        .with_hand(HandImpedance::default())
        .unwrap();
    let (pointer, mut mouse) = Pointer::new();
    mouse.move_to(Vec3::zeros());
    let devices: [Box<dyn Device>; 4] = [
        Box::new(VirtualDevice::new(sine)),
        Box::new(yielding),
        Box::new(pointer),
        Box::new(NoDevice::new(Vec3::zeros())),
    ];
    let mut all_damped = 0;
    let kinds = [HandOver::LocalModel, HandOver::Linear, HandOver::Hold];
    for (device, kind) in devices.into_iter().zip(kinds.into_iter().cycle()) {
        let (mut answers, heard) = latest::channel(&AffineForce::none(0.0));
        let controller = Rendered {
            answers: heard,
            extrapolator: Extrapolator::new(kind, 5e-3, 1e-3),
        };
        let weight = Compensation {
            weight: Some(Linkage::premium()),
            stiffness: 10.0,
            mass: 0.02,
            cutoff: 30.0,
        };
        // No energy at all may come out, so that the stage that sees to it has to work.
        let limits = Limits {
            energy_budget: 1e-12,
            ..Limits::default()
        };
        let settings = ServoSettings {
            compensation: Some(weight),
            limits: Some(limits),
            ..ServoSettings::default()
        };
        let (mut servo, reader) = ServoLoop::new(device, Box::new(controller), settings).unwrap();
        let mut clock = Clock::virtual_time();
        reset_violation_count();
        assert_no_alloc(|| {
            let report = servo.run(&mut clock, |tick| {
                let time = tick as f64 * 1e-3;
                let gradient = -50.0 * nalgebra::Matrix3::identity();
                answers.send(AffineForce::new(
                    time,
                    Vec3::zeros(),
                    Vec3::z() * 0.01,
                    gradient,
                ));
                tick < 10_000
            });
            all_damped += report.interventions.damped;
        });
        assert_eq!(violation_count(), 0, "{kind:?}");
        assert_eq!(reader.log.lost(), 10_000 - 4096);
    }
    assert!(all_damped > 1000, "{all_damped}");
}
