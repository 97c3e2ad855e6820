//! Relaxation in a hold, against Prony series.

use palpate_characterize::analyze::Relaxation;
use palpate_characterize::{CleanSettings, analyze, clean};

use crate::made_up::{Dice, own, ramp_and_hold, times};

const STIFFNESS: f64 = 30.0;
const DEPTH: f64 = 0.006;
const SPEED: f64 = 0.03;
/// The liver of table 6-3.
const TERMS: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.090)];

/// Force [N] of a linear tissue that relaxes, `time` [s] after its ramp began: F = k v ∫ G dt.
fn force(time: f64) -> f64 {
    let rising = time.clamp(0.0, DEPTH / SPEED);
    let held = time - rising;
    let relaxed: f64 = TERMS
        .iter()
        .map(|(g, tau)| {
            let kept = tau * -(-rising / tau).exp_m1() * (-held / tau).exp();
            g * (rising - kept)
        })
        .sum();
    STIFFNESS * SPEED * (rising - relaxed)
}

fn seen(hold: f64, noise: f64) -> (Relaxation, Vec<String>) {
    let mut dice = Dice(8);
    let depth = ramp_and_hold(0.5, SPEED, DEPTH);
    let end = 0.5 + DEPTH / SPEED + hold;
    let recording = own(&times(200.0, end), depth, |t| {
        force(t - 0.5) + noise * dice.normal()
    });
    let clean = clean(&recording, &CleanSettings::default()).unwrap();
    let analysis = analyze(&clean);
    (analysis.relaxation.unwrap(), analysis.warnings)
}

/// Judge: the closed integral of the Prony series over the ramp. Tolerances: peak and steady, rounding
/// and the two samples by which the corner of the ramp may be missed, over which the force hardly
/// changes; settling, two samples.
#[test]
fn prony_series() {
    let (seen, warnings) = seen(60.0, 0.0);
    let (start, end) = (DEPTH / SPEED, DEPTH / SPEED + 60.0);
    let peak = force(start);
    assert!(
        (seen.peak_n / peak - 1.0).abs() < 1e-9,
        "{} for {peak}",
        seen.peak_n
    );
    let steps = 1000;
    let last: f64 = (0..steps)
        .map(|step| force(end - 6.0 + 6.0 * (f64::from(step) + 0.5) / f64::from(steps)))
        .sum::<f64>()
        / f64::from(steps);
    assert!(
        (seen.steady_n / last - 1.0).abs() < 1e-6,
        "{} for {last}",
        seen.steady_n
    );
    assert_eq!(seen.ratio, seen.steady_n / seen.peak_n);
    let (mut low, mut high) = (start, end);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if force(middle) > 1.1 * last {
            low = middle;
        } else {
            high = middle;
        }
    }
    assert!(
        (seen.settle_s - high).abs() < 0.01,
        "{} for {high}",
        seen.settle_s
    );
    assert!((seen.hold_s - 60.0).abs() < 0.02 && (seen.hold_start_s - start).abs() < 0.02);
    assert!(warnings.is_empty(), "{warnings:?}");
}

/// Judge: the same without noise. Tolerances: four standard errors of a mean of 1200 samples, less one of
/// the 100 before contact; the largest of noisy samples lies up to four deviations above the truth.
#[test]
fn noise_moves_little() {
    let (still, _) = seen(60.0, 0.0);
    let (noisy, _) = seen(60.0, 0.0005);
    let known = 0.0005 * (1.0 / 1200.0 + 1.0 / 100.0f64).sqrt();
    assert!((noisy.steady_n - still.steady_n).abs() < 4.0 * known);
    assert!((0.0..0.002).contains(&(noisy.peak_n - still.peak_n)));
    // The force falls by 0.8 mN/s there and the filter leaves a third of the noise.
    assert!(
        (noisy.settle_s - still.settle_s).abs() < 0.6,
        "{} {}",
        noisy.settle_s,
        still.settle_s
    );
}

/// Judge: the force of a hold of 4 s, which then still falls.
#[test]
fn a_short_hold_is_told() {
    let (short, warnings) = seen(4.0, 0.0);
    let (long, _) = seen(60.0, 0.0);
    assert!(short.steady_n > 1.05 * long.steady_n);
    assert!(
        warnings
            .iter()
            .any(|warning| warning.contains("an upper bound; hold for longer")),
        "{warnings:?}"
    );
}

/// Judge: the steps of a staircase.
#[test]
fn every_hold_has_its_steady_force() {
    let depth = |t: f64| -> f64 {
        [1.0, 4.0, 7.0]
            .map(|start| (0.02 * (t - start)).clamp(0.0, 0.002))
            .iter()
            .sum()
    };
    let recording = own(&times(200.0, 10.0), depth, |t| 20.0 * depth(t));
    let clean = clean(&recording, &CleanSettings::default()).unwrap();
    let holds = analyze(&clean).holds;
    assert_eq!(holds.len(), 3);
    for (hold, depth) in holds.iter().zip([0.002, 0.004, 0.006]) {
        assert!((hold.depth_m - depth).abs() < 1e-12);
        assert!((hold.steady_n - 20.0 * depth).abs() < 1e-12);
    }
}
