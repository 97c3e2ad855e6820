//! Forces between the answers of a model.

use palpate_servo::{AffineForce, Extrapolator, HandOver, HandOverCost, HandOverStudy, Vec3};

const KINDS: [HandOver; 3] = [HandOver::Hold, HandOver::Linear, HandOver::LocalModel];

/// A fit to the published kidney, F = 0.020 d + 0.0046 d² with N and mm, and its stiffness.
fn kidney(depth: f64) -> (f64, f64) {
    (20.0 * depth + 4600.0 * depth * depth, 20.0 + 9200.0 * depth)
}

/// 3 mm ± 4 mm: contact is made and lost in every cycle.
fn study(hand_over: HandOver, rate: f64, frequency: f64) -> HandOverStudy {
    HandOverStudy {
        hand_over,
        model_period: 1.0 / rate,
        period: 1e-3,
        middle: 3e-3,
        amplitude: 4e-3,
        frequency,
        cycles: 20,
    }
}

fn percent(cost: &HandOverCost) -> [f64; 2] {
    [cost.rms, cost.max].map(|error| 100.0 * error / cost.peak)
}

/// RMS and largest error in percent of the peak for hold, line and local model, at a rate of the model and
/// a frequency of the hand: an independent program's.
const REFERENCE: [(f64, f64, [[f64; 2]; 3]); 5] = [
    (200.0, 1.0, [[1.74, 3.5], [0.11, 0.9], [0.06, 0.9]]),
    (200.0, 2.0, [[3.48, 7.1], [0.37, 1.4], [0.14, 1.3]]),
    (200.0, 5.0, [[8.7, 17.6], [2.2, 5.7], [0.74, 3.4]]),
    (60.0, 2.0, [[12.3, 25.6], [4.3, 11.3], [1.3, 3.8]]),
    (60.0, 5.0, [[29.7, 59.8], [23.6, 64.3], [7.9, 26.0]]),
];

/// Within 20 %, which leaves room for how the two programs place ticks that do not divide a period.
#[test]
fn errors_are_those_of_an_independent_program() {
    for (rate, frequency, expected) in REFERENCE {
        for (kind, expected) in KINDS.into_iter().zip(expected) {
            let cost = study(kind, rate, frequency).run(kidney).unwrap();
            let found = percent(&cost);
            println!("{rate} Hz, {frequency} Hz, {kind:?}: {found:.2?}, there {expected:?}");
            for (found, expected) in found.into_iter().zip(expected) {
                // Half of the last digit that is given.
                let room = 0.2 * expected + if expected < 0.1 { 0.005 } else { 0.05 };
                assert!(
                    (found - expected).abs() <= room,
                    "{rate} Hz, {frequency} Hz, {kind:?}: {found:.3} %, there {expected} %"
                );
            }
        }
    }
}

/// Energy per cycle over the energy stored at the deepest place, in percent.
const GENERATED: [(f64, f64, [f64; 3]); 2] = [
    (200.0, 2.0, [21.6, 1.6, 1.5]),
    (60.0, 5.0, [162.0, 81.0, 16.0]),
];

#[test]
fn generated_energy_is_that_of_an_independent_program() {
    // ∫ F from 0 to 7 mm.
    let stored = 10.0 * 49e-6 + 4600.0 / 3.0 * 343e-9;
    for (rate, frequency, expected) in GENERATED {
        for (kind, expected) in KINDS.into_iter().zip(expected) {
            let cost = study(kind, rate, frequency).run(kidney).unwrap();
            let [found, sent] = [cost.energy, cost.energy_sent].map(|e| 100.0 * e / stored);
            println!("{rate} Hz, {frequency} Hz, {kind:?}: {found:.2} %, sent {sent:.2} %");
            assert!(
                (found / expected - 1.0).abs() <= 0.2,
                "{rate} Hz, {frequency} Hz, {kind:?}: {found:.2} %, there {expected} %"
            );
        }
    }
}

/// In contact throughout, the errors have closed forms: an age that is evenly spread over 5 to 9 ms, times
/// the largest rate of the force over √2 for a hold; half the curvature of F along the way for the local
/// model.
#[test]
fn errors_of_a_spring_are_those_of_the_closed_form() {
    let spring = |depth: f64| (50.0 * depth, 50.0);
    let study = |hand_over| HandOverStudy {
        middle: 3e-3,
        amplitude: 1e-3,
        ..self::study(hand_over, 200.0, 0.5)
    };
    let hold = study(HandOver::Hold).run(spring).unwrap();
    let omega = std::f64::consts::TAU * 0.5;
    let square: f64 = [5.0, 6.0, 7.0, 8.0, 9.0f64]
        .map(|age| (age * 1e-3).powi(2))
        .iter()
        .sum();
    let expected = 50.0 * 1e-3 * omega * (square / 5.0).sqrt() / 2.0f64.sqrt();
    // The next term of the sine over an age: (ω t)²/24 = 3·10⁻⁵.
    assert!(
        (hold.rms / expected - 1.0).abs() < 1e-4,
        "{} {expected}",
        hold.rms
    );
    let local = study(HandOver::LocalModel).run(spring).unwrap();
    // A spring is its own local model: rounding.
    assert!(local.max < 1e-12, "{}", local.max);
    // The line: its error is ω² A (age² + age T)/2.
    let linear = study(HandOver::Linear).run(spring).unwrap();
    let error = |age: f64| 0.5 * omega * omega * 0.05 * (age * age + age * 5.0) * 1e-6;
    let square: f64 = [5.0, 6.0, 7.0, 8.0, 9.0]
        .map(|age: f64| error(age).powi(2))
        .iter()
        .sum();
    let expected = (square / 5.0).sqrt() / 2.0f64.sqrt();
    // The next term: ω (age + T) of the size of the last.
    assert!(
        (linear.rms / expected - 1.0).abs() < 0.05,
        "{} {expected}",
        linear.rms
    );
}

/// A model that falls silent lets the force fall to nothing.
#[test]
fn a_stale_model_fades_to_zero() {
    for kind in KINDS {
        let mut extrapolator = Extrapolator::new(kind, 5e-3, 1e-3);
        let pressed = AffineForce {
            normal: Vec3::z(),
            ..AffineForce::new(
                0.0,
                Vec3::zeros(),
                Vec3::z(),
                -50.0 * nalgebra::Matrix3::identity(),
            )
        };
        extrapolator.receive(&pressed);
        let mut last = f64::INFINITY;
        for tick in 11..22 {
            let force = extrapolator
                .force(f64::from(tick) * 1e-3, &Vec3::zeros())
                .norm();
            assert!(force < last || force == 0.0, "{kind:?}, {tick} ms: {force}");
            last = force;
        }
        assert_eq!(last, 0.0, "{kind:?}");
    }
}

#[test]
fn a_study_wants_numbers_above_zero() {
    let none = HandOverStudy {
        model_period: 0.0,
        ..study(HandOver::Hold, 200.0, 1.0)
    };
    let text = none.run(kidney).unwrap_err().to_string();
    assert_eq!(
        text,
        "the period of the model [s] is 0; set a number above zero"
    );
}
