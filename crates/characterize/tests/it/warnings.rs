//! Warnings.

use palpate_characterize::{CleanSettings, clean};
use palpate_files::Recording;

use crate::made_up::{Dice, own, ramp_and_hold, times};

fn warnings(recording: &Recording) -> Vec<String> {
    clean(recording, &CleanSettings::default())
        .unwrap()
        .warnings
}

fn tells(recording: &Recording, words: &str) -> bool {
    warnings(recording)
        .iter()
        .any(|warning| warning.contains(words))
}

/// Depth in metres and force of a 6 mm touch, in other sizes.
fn touch(depth_size: f64, force_size: f64) -> Recording {
    let depth = ramp_and_hold(0.5, 0.02, 0.006);
    own(
        &times(100.0, 5.0),
        |t| depth_size * depth(t),
        |t| force_size * 30.0 * depth(t),
    )
}

#[test]
fn nothing_is_told_of_a_good_recording() {
    assert_eq!(warnings(&touch(1.0, 1.0)), Vec::<String>::new());
}

#[test]
fn units_gone_wrong_are_told() {
    let units = "check the units";
    assert!(tells(&touch(1e3, 1.0), units), "millimetres called metres");
    assert!(tells(&touch(1e-3, 1.0), units), "metres called millimetres");
    assert!(
        tells(&touch(1.0, 1e6), units),
        "micronewtons called newtons"
    );
    let mut small = touch(1e-3, 1e-3);
    assert!(!tells(&small, units), "a small touch of something small");
    small.header.indenter_radius_m = Some(0.01);
    assert!(tells(&small, units), "but not by a large indenter");
}

#[test]
fn a_sensor_at_its_end_is_told() {
    let mut dice = Dice(2);
    let depth = ramp_and_hold(0.5, 0.02, 0.006);
    let force = |t: f64| (30.0 * depth(t) + 0.001 * dice.normal()).min(0.15);
    let recording = own(&times(100.0, 5.0), depth, force);
    assert!(tells(&recording, "as a sensor does at its end"));
}

#[test]
fn gaps_and_uneven_samples_are_told() {
    let depth = ramp_and_hold(0.5, 0.02, 0.006);
    let mut time = times(100.0, 5.0);
    time.drain(300..350);
    let recording = own(&time, depth, |t| 30.0 * depth(t));
    assert!(tells(&recording, "missing in 1 places, for up to 0.510 s"));
    let uneven: Vec<f64> = times(100.0, 5.0)
        .iter()
        .map(|t| t + 0.003 * (70.0 * t).sin())
        .collect();
    let recording = own(&uneven, depth, |t| 30.0 * depth(t));
    assert!(tells(&recording, "do not come evenly"));
}

/// Judge: the even recording of the same forces, at its own samples. Tolerance: a straight line
/// between samples 10 ms apart misses the corner of the ramp by at most 2 mN, the filter spreads it.
#[test]
fn uneven_samples_are_filtered_as_even_ones() {
    let depth = |t: f64| 0.003 * (1.0 - (2.0 * t).cos());
    let settings = CleanSettings {
        cutoff_hz: Some(10.0),
        ..CleanSettings::default()
    };
    let uneven: Vec<f64> = times(100.0, 5.0)
        .iter()
        .map(|t| t + 0.003 * (70.0 * t).sin())
        .collect();
    let recording = own(&uneven, depth, |t| 30.0 * depth(t));
    let clean = clean(&recording, &settings).unwrap();
    for (sample, filtered) in clean.filtered_force.iter().enumerate().skip(50).take(400) {
        let off = filtered - clean.force[sample];
        assert!(off.abs() < 1e-4, "sample {sample}: {off} N");
    }
}

#[test]
fn what_the_source_never_measured_is_told() {
    let depth = ramp_and_hold(0.5, 0.02, 0.012);
    let deep = own(&times(100.0, 5.0), depth, |t| 30.0 * depth(t));
    assert!(tells(&deep, "to 12.0 mm, beyond 10 mm"));
    let fast = |t: f64| {
        (0.004 * t).min(0.004) * (1.0 + 0.5 * (60.0 * (t - 1.0)).sin() * f64::from(t > 1.0))
    };
    let fast = own(&times(500.0, 5.0), fast, |t| 30.0 * fast(t));
    assert!(tells(&fast, "to 9.5 Hz, beyond 8 Hz"));
}
