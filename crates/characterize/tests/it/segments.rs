//! Stimuli that are recognised, by those that were made up.

use std::f64::consts::TAU;

use palpate_characterize::clean::SegmentKind::{self, Chirp, Hold, Ramp, Retreat, Sine};
use palpate_characterize::{CleanRecording, CleanSettings, clean};
use palpate_files::Recording;
use palpate_files::recording::{RecordingHeader, Samples, StimulusKind};

use crate::made_up::{Dice, own, times};

fn cleaned(rate: f64, end: f64, depth: impl Fn(f64) -> f64 + Copy) -> CleanRecording {
    // The device's own step, 0.03 mm, as a tremble.
    let mut dice = Dice(3);
    let time = times(rate, end);
    let noise: Vec<f64> = time.iter().map(|_| 3e-6 * dice.normal()).collect();
    let moved = |t: f64| depth(t) + noise[(rate * t).round() as usize];
    clean(
        &own(&time, moved, |t| 20.0 * depth(t)),
        &CleanSettings::default(),
    )
    .unwrap()
}

fn kinds(clean: &CleanRecording) -> Vec<SegmentKind> {
    clean.segments.iter().map(|segment| segment.kind).collect()
}

/// Judge: the corners of the stimulus. Tolerance: the ramp passes through 1.5 % of its travel, the
/// width of a line, in 3 ms; two samples.
#[test]
fn ramp_hold_and_retreat() {
    let depth = |t: f64| {
        (0.03 * (t - 0.5))
            .min(0.006)
            .min(0.03 * (20.7 - t))
            .max(0.0)
    };
    let clean = cleaned(500.0, 22.0, depth);
    assert_eq!(kinds(&clean), [Ramp, Hold, Retreat]);
    for (segment, corner) in clean.segments.iter().zip([0.0, 0.2, 20.0]) {
        let off = clean.time[segment.first] - corner;
        assert!(off.abs() < 0.01, "{segment:?} begins {off} s late");
    }
    let [ramp, hold, _] = clean.segments.as_slice() else {
        unreachable!()
    };
    assert_eq!(ramp.end, hold.first);
    assert!((clean.duration(ramp) - 0.2).abs() < 0.01);
}

/// Judge: the steps of a staircase.
#[test]
fn several_ramps() {
    let depth = |t: f64| {
        [1.0, 4.0, 7.0]
            .map(|start| (0.02 * (t - start)).clamp(0.0, 0.002))
            .iter()
            .sum()
    };
    let clean = cleaned(200.0, 10.0, depth);
    assert_eq!(kinds(&clean), [Ramp, Hold, Ramp, Hold, Ramp, Hold]);
}

/// Judge: the frequency of the sine, known to a hundredth of one period over its length.
#[test]
fn sine_after_a_hold() {
    for frequency in [0.5, 2.0, 5.0] {
        let depth = |t: f64| {
            let swings = if (3.0..11.0).contains(&t) {
                (TAU * frequency * (t - 3.0)).sin()
            } else {
                0.0
            };
            (0.004 * (t - 0.5)).clamp(0.0, 0.002) + 0.001 * swings
        };
        let clean = cleaned(200.0, 12.0, depth);
        let found = kinds(&clean);
        let [Ramp, Hold, Sine(seen), Hold] = found.as_slice() else {
            panic!("{frequency} Hz: {found:?}");
        };
        assert!(
            (seen - frequency).abs() < 0.01 / 8.0,
            "{seen} for {frequency}"
        );
        let swing = clean.segments[2];
        // Contact is half a second after the recording begins.
        assert!((clean.time[swing.first] - 2.5).abs() < 0.25 / frequency);
        assert!((clean.time[swing.end - 1] - 10.5).abs() < 0.25 / frequency);
    }
}

/// Judge: the frequencies at both ends of the sweep, 5 %.
#[test]
fn linear_and_exponential_chirps() {
    let [begins, ends, length] = [0.5f64, 6.0, 20.0];
    let linear = move |t: f64| TAU * (begins * t + 0.5 * (ends - begins) / length * t * t);
    let growth = (ends / begins).ln() / length;
    let exponential = move |t: f64| TAU * begins * (growth * t).exp_m1() / growth;
    let phases: [&dyn Fn(f64) -> f64; 2] = [&linear, &exponential];
    for phase in phases {
        let depth = |t: f64| {
            let swings = if (3.0..23.0).contains(&t) {
                phase(t - 3.0).sin()
            } else {
                0.0
            };
            (0.004 * (t - 0.5)).clamp(0.0, 0.002) + 0.001 * swings
        };
        let clean = cleaned(500.0, 24.0, depth);
        let found = kinds(&clean);
        let [Ramp, Hold, Chirp(first, last), Hold] = found.as_slice() else {
            panic!("{found:?}");
        };
        assert!(
            (first / begins - 1.0).abs() < 0.05,
            "begins with {first} Hz"
        );
        assert!((last / ends - 1.0).abs() < 0.05, "ends with {last} Hz");
    }
}

/// Judge: a header made to contradict the samples.
#[test]
fn contradictions_are_told() {
    let depth = |t: f64| (0.03 * (t - 0.5)).clamp(0.0, 0.006);
    let mut recording = own(&times(500.0, 5.0), depth, |t| 20.0 * depth(t));
    recording.header.stimulus = Some(StimulusKind::RampAndHold);
    recording.header.ramp_s = Some(0.2);
    recording.header.amplitude_m = Some(0.006);
    recording.header.sample_rate_hz = Some(500.0);
    let settings = CleanSettings::default();
    let agreed = clean(&recording, &settings).unwrap().warnings;
    assert!(agreed.is_empty(), "{agreed:?}");
    recording.header.stimulus = Some(StimulusKind::Sine);
    recording.header.ramp_s = Some(2.0);
    recording.header.amplitude_m = Some(0.008);
    recording.header.sample_rate_hz = Some(1000.0);
    let told = clean(&recording, &settings).unwrap().warnings;
    for key in [
        "`stimulus` is sine",
        "`ramp_s` is 2",
        "`amplitude_m` is 0.008",
        "`sample_rate_hz` is 1000",
    ] {
        assert!(
            told.iter().any(|warning| warning.starts_with(key)),
            "{key}: {told:?}"
        );
    }
}

/// A ramp and a hold under an encoder of 30 µm at 1 kHz, which shows the ramp as stairs and the hold as a
/// flicker between two steps: one ramp, one hold, and no sensor at its end although a force with steps of 1/1280 N
/// stays at its largest for a while.
#[test]
fn the_steps_of_an_encoder_are_no_segments() {
    let to = |step: f64, value: f64| (value / step).round() * step;
    let times: Vec<f64> = (0..5000).map(|i| 1e-3 * f64::from(i)).collect();
    let depth = |t: f64| 2e-3 * ((t - 0.6) / 0.5).clamp(-0.25, 1.0);
    let samples = Samples {
        depth_m: times
            .iter()
            .map(|t| to(30e-6, depth(*t) + 1.5e-5 * (40.0 * t).sin()))
            .collect(),
        force_n: times
            .iter()
            .map(|t| {
                to(
                    1.0 / 1280.0,
                    7.0 * depth(*t).max(0.0) + 4e-4 * (911.0 * t).sin(),
                )
            })
            .collect(),
        time_s: times,
    };
    let recording = Recording::new(RecordingHeader::default(), samples).unwrap();
    let clean = clean(&recording, &CleanSettings::default()).unwrap();
    let kinds: Vec<SegmentKind> = clean.segments.iter().map(|own| own.kind).collect();
    assert_eq!(
        kinds,
        [SegmentKind::Ramp, SegmentKind::Hold],
        "{:?}",
        clean.segments
    );
    let said = clean.warnings.join("; ");
    assert!(
        !said.contains("as a sensor does at its end") && !said.contains("zero moved"),
        "{said}"
    );
}
