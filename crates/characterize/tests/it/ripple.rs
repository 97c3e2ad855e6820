//! The heart in a hold.

use std::f64::consts::TAU;

use palpate_characterize::{CleanSettings, clean};
use palpate_files::Recording;

use crate::made_up::{Dice, own, ramp_and_hold, times};

/// A relaxing hold of 20 s with a heart of 1.37 Hz that has a second harmonic.
fn recording(rate: f64, heart: f64, noise: f64) -> Recording {
    let mut dice = Dice(11);
    let depth = ramp_and_hold(0.5, 0.02, 0.006);
    let force = |time: f64| {
        let relaxed = 1.0 - 0.28 * -(-time / 1.5).exp_m1() - 0.2 * -(-time / 6.0).exp_m1();
        let beat = (TAU * 1.37 * time + 0.4).cos() + 0.3 * (2.0 * TAU * 1.37 * time).sin();
        let pressed = if depth(time) > 0.0 { heart * beat } else { 0.0 };
        30.0 * depth(time) * relaxed + pressed + noise * dice.normal()
    };
    own(&times(rate, 21.0), depth, force)
}

/// Judge: frequency and amplitude of the made-up heart. Tolerances: a hundredth of a period over the
/// hold, and four standard errors.
#[test]
fn a_heart_is_recognised_at_every_rate() {
    for rate in [10.0, 100.0, 1000.0] {
        let clean = clean(&recording(rate, 0.003, 0.0005), &CleanSettings::default()).unwrap();
        let ripple = clean.handling.ripple.expect("there is one");
        assert!(
            (ripple.frequency_hz - 1.37).abs() < 0.01 / 20.0 * 2.0,
            "{rate} Hz: {}",
            ripple.frequency_hz
        );
        let off = (ripple.amplitude_n - 0.003).abs();
        assert!(
            off < 4.0 * ripple.amplitude_error_n,
            "{rate} Hz: {ripple:?}"
        );
        assert!(clean.warnings.iter().any(|warning| warning.contains(
            "as over a heart; this is taken out of the force that is fitted; the tissue moves by"
        )));
    }
}

/// Judge: chance. Relaxation with noise alone, thirty times.
#[test]
fn noise_is_no_heart() {
    for seed in 0..30 {
        let mut dice = Dice(seed);
        let depth = ramp_and_hold(0.5, 0.02, 0.006);
        let force = |time: f64| {
            30.0 * depth(time) * (0.6 + 0.4 * (-time / 2.0).exp()) + 0.002 * dice.normal()
        };
        let recording = own(&times(100.0, 21.0), depth, force);
        let clean = clean(&recording, &CleanSettings::default()).unwrap();
        assert_eq!(clean.handling.ripple, None, "seed {seed}");
    }
}

/// Judge: the same recording without a heart, after the same filter. Tolerance: a tenth of the ripple,
/// away from the ends of the hold; what is measured stays as it was.
#[test]
fn a_heart_is_taken_out_of_the_drawn_force_alone() {
    let settings = CleanSettings {
        removes_ripple: true,
        ..CleanSettings::default()
    };
    let beating = clean(&recording(200.0, 0.003, 0.0), &settings).unwrap();
    let still = clean(&recording(200.0, 0.0, 0.0), &settings).unwrap();
    let hold = beating.segments[1];
    for sample in hold.first + 100..hold.end - 100 {
        let left = beating.filtered_force[sample] - still.filtered_force[sample];
        assert!(left.abs() < 0.0003, "sample {sample}: {left} N");
    }
    let kept = clean(&recording(200.0, 0.003, 0.0), &CleanSettings::default()).unwrap();
    assert_eq!(beating.force, kept.force);
}
