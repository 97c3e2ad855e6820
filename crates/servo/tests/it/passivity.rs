//! A loop gives a hand no energy that the hand did not put in. Judges: the energy at the port itself, and the
//! same loop without the stage.

use palpate_servo::{
    Clock, Device, HandImpedance, HandOver, Limits, Sample, ServoLoop, ServoSettings, Trajectory,
    Vec3, VirtualDevice, Waypoint,
};

use crate::slow_model::{Law, SlowModel};

/// 1 N/mm, as stiff as what devices of this kind are asked to render.
fn wall(depth: f64) -> (f64, f64) {
    (1000.0 * depth, 1000.0)
}

/// A fit to the published kidney, F = 0.020 d + 0.0046 d² with N and mm, and its stiffness.
fn kidney(depth: f64) -> (f64, f64) {
    (20.0 * depth + 4600.0 * depth * depth, 20.0 + 9200.0 * depth)
}

/// Forces are armed by then; who is in contact meanwhile gets what he did not put in.
const ARMED: usize = 2000;

/// Its samples, and in how many ticks after the first two seconds energy was kept from the hand.
fn run(
    device: impl Device + 'static,
    model: SlowModel,
    watched: bool,
    seconds: f64,
) -> (Vec<Sample>, u64) {
    let ticks = (seconds * 1e3) as u64;
    let mut limits = Limits::default();
    if !watched {
        limits.energy_budget = f64::INFINITY;
    }
    let settings = ServoSettings {
        limits: Some(limits),
        log: ticks as usize,
        ..ServoSettings::default()
    };
    let (mut servo, mut reader) =
        ServoLoop::new(Box::new(device), Box::new(model), settings).unwrap();
    let mut clock = Clock::virtual_time();
    let armed = servo.run(&mut clock, |tick| tick < ARMED as u64);
    let report = servo.run(&mut clock, |tick| tick < ticks);
    assert_eq!(report.fault, None);
    let damped = report.interventions.damped - armed.interventions.damped;
    (reader.log.drain().collect(), damped)
}

/// Energy that the hand had put in by each tick [J]: −Σ F·Δx.
fn put_in(samples: &[Sample]) -> Vec<f64> {
    let pairs = samples.windows(2);
    let mut sum = 0.0;
    let course = pairs.map(|pair| {
        let moved = pair[1].state.position - pair[0].state.position;
        sum -= pair[0].applied.dot(&moved);
        sum
    });
    course.collect()
}

fn least(course: &[f64]) -> f64 {
    course.iter().copied().fold(0.0, f64::min)
}

/// A hand that comes down and leans on the wall.
fn leaning(hand: HandImpedance) -> VirtualDevice {
    let places = [(0.0, 5.0), (1.0, 5.0), (1.3, -2.0)];
    let places = places.map(|(time, mm)| Waypoint::new(time, Vec3::z() * (1e-3 * mm)));
    VirtualDevice::new(Trajectory::waypoints(places.to_vec()).unwrap())
        .with_hand(hand)
        .unwrap()
}

/// Asked for: a held wall of 1 N/mm at 60 Hz gives out less than 1 mJ, whoever leans on it for ten seconds.
/// Without the stage it shakes every hand and gives out many times that.
#[test]
fn a_stiff_wall_at_a_slow_rate_gives_out_less_than_a_millijoule() {
    let hands = [(0.18, 5.0, 500.0), (0.1, 5.0, 1000.0), (0.12, 2.0, 300.0)];
    for (mass, damping, stiffness) in hands {
        let hand = HandImpedance {
            mass,
            damping,
            stiffness,
        };
        let found = [true, false].map(|watched| {
            let model = SlowModel::new(wall, 60.0, HandOver::Hold);
            let (samples, damped) = run(leaning(hand), model, watched, 12.0);
            let course = put_in(&samples);
            let last = samples[11_000..].iter().map(|s| s.state.position.z);
            let swing = last.clone().fold(f64::MIN, f64::max) - last.fold(f64::MAX, f64::min);
            println!(
                "{hand:?}, watched {watched}: {:.3} mJ at least, {:.3} mm of swing, {damped} ticks",
                1e3 * least(&course),
                1e3 * swing
            );
            (least(&course), swing)
        });
        let [(with, calm), (without, wild)] = found;
        assert!(with >= -1e-3, "{hand:?}: {with} J");
        assert!(without < -10e-3, "{hand:?}: {without} J");
        assert!(calm < wild, "{hand:?}: {calm} {wild}");
    }
}

fn palpating(frequency: f64, middle: f64, amplitude: f64) -> VirtualDevice {
    VirtualDevice::new(Trajectory::Sine {
        center: -Vec3::z() * middle,
        amplitude: -Vec3::z() * amplitude,
        frequency,
    })
}

/// A kidney that is palpated in and out at up to 5 Hz, with the model at its 200 Hz: the stage does not touch
/// a single tick, for ten seconds.
#[test]
fn normal_palpation_is_left_alone() {
    for hand_over in [HandOver::LocalModel, HandOver::Linear] {
        for frequency in [0.5, 1.0, 2.0, 5.0] {
            let model = SlowModel::new(kidney as Law, 200.0, hand_over);
            let device = palpating(frequency, 3e-3, 4e-3);
            let (samples, damped) = run(device, model, true, 12.0);
            let worst = least(&put_in(&samples[ARMED..]));
            println!(
                "{hand_over:?} {frequency} Hz: {:.3} mJ over all",
                1e3 * worst
            );
            assert_eq!(damped, 0, "{hand_over:?} {frequency} Hz");
        }
    }
}

/// The worst for it: tissue without any relaxation that is never let go of, for a minute. What the loop's own
/// tick gives out is taken back in the end; the force differs from that without the stage by little.
#[test]
fn a_minute_in_contact_is_changed_by_little() {
    let course = |watched| {
        let model = SlowModel::new(kidney as Law, 200.0, HandOver::LocalModel);
        run(palpating(2.0, 4e-3, 3e-3), model, watched, 60.0)
    };
    let (with, damped) = course(true);
    let (without, _) = course(false);
    let (with, without) = (&with[ARMED..], &without[ARMED..]);
    let square = |samples: &[Sample]| samples.iter().map(|s| s.output.norm_squared()).sum::<f64>();
    let apart: f64 = with
        .iter()
        .zip(without)
        .map(|(a, b)| (a.output - b.output).norm_squared())
        .sum();
    let part = (apart / square(without)).sqrt();
    println!("{:.2} % of the force, in {} ticks", 100.0 * part, damped);
    assert!(part < 0.05, "{part}");
}
