//! No recording makes a panic or a number that is none.

use palpate_characterize::{CleanSettings, analyze, clean};
use palpate_files::Recording;
use palpate_files::recording::{RecordingHeader, Samples};
use proptest::prelude::*;
use proptest::test_runner::Config;

use crate::made_up::foreign;

fn tries(full: u32) -> Config {
    let wants_full = std::env::var("PALPATE_FULL").is_ok_and(|value| value == "1");
    Config {
        failure_persistence: None,
        ..Config::with_cases(if wants_full { full } else { full.div_ceil(10) })
    }
}

/// Any samples: even or uneven, smooth or not, of any size that a recording may have.
fn recordings() -> impl Strategy<Value = Recording> {
    let value = prop_oneof![
        4 => -1.0..1.0f64,
        1 => Just(0.0),
        1 => Just(1.0),
    ];
    let interval = prop_oneof![4 => Just(0.01), 1 => 1e-6..10.0f64];
    let size = prop_oneof![Just(1.0), Just(1e-9), Just(1e3), Just(1e-300)];
    let row = (interval, value.clone(), value);
    let scales = prop::array::uniform3(size);
    let shape = 0usize..4;
    (prop::collection::vec(row, 1..300), scales, shape)
        .prop_map(|(rows, scales, shape)| made(&rows, scales, shape))
}

fn made(
    rows: &[(f64, f64, f64)],
    [time_size, depth_size, force_size]: [f64; 3],
    shape: usize,
) -> Recording {
    let mut samples = Samples::default();
    let mut time = 0.0;
    for (count, (interval, depth, force)) in rows.iter().enumerate() {
        let count = count as f64;
        let depth = match shape {
            0 => *depth,
            1 => (0.05 * count).min(1.0),
            2 => (0.1 * count).sin() + 1.0,
            _ => (0.05 * count).min(1.0) + 0.01 * depth,
        };
        samples.time_s.push(time * time_size);
        samples.depth_m.push(depth * depth_size);
        samples.force_n.push(force * force_size);
        time += interval;
    }
    Recording::new(RecordingHeader::default(), samples).unwrap()
}

proptest! {
    #![proptest_config(tries(5000))]

    #[test]
    fn any_recording_is_analyzed_or_refused(recording in recordings(), removes_ripple in any::<bool>()) {
        let settings = CleanSettings { removes_ripple, ..CleanSettings::default() };
        for recording in [foreign(&recording), recording] {
            let Ok(clean) = clean(&recording, &settings) else {
                continue;
            };
            let samples = recording.time_s().len();
            for column in [&clean.time, &clean.depth, &clean.force, &clean.filtered_force] {
                prop_assert_eq!(column.len(), samples);
                prop_assert!(column.iter().all(|value| value.is_finite()));
            }
            for segment in &clean.segments {
                prop_assert!(segment.first < segment.end && segment.end <= samples);
            }
            for pair in clean.segments.windows(2) {
                prop_assert!(pair[0].end <= pair[1].first);
            }
            let analysis = format!("{:?}", analyze(&clean));
            prop_assert!(!analysis.contains("NaN") && !analysis.contains("inf"), "{}", analysis);
            prop_assert!(clean.warnings.iter().all(|warning| !warning.contains("NaN")));
        }
    }
}
