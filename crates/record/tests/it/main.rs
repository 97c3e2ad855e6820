//! The record as its users meet it.

#![allow(
    clippy::unwrap_used,
    reason = "clippy.toml allows it in tests, but does not see helpers as tests"
)]

mod class;
mod damaged;
mod kept;
mod killed;
mod learning;
mod proficiency;
mod refused;

use std::path::PathBuf;

use palpate_record::{Attempt, Better, Measure};

/// An attempt whose measures are numbers that follow from `seed`.
fn attempt(trainee: &str, task: &str, seed: i64) -> Attempt {
    let all = [Better::Less, Better::More, Better::Neither];
    let measures = (0..40).map(|place| Measure {
        key: format!("left.measure_{place}_s"),
        // No short number, neither in decimals nor in bits.
        value: (seed as f64 + 0.1 * f64::from(place)).sin() / 3.0,
        better: all[place as usize % 3],
    });
    Attempt {
        trainee: trainee.to_owned(),
        task: task.to_owned(),
        scene_digest: "1f3a".to_owned(),
        when: 1_700_000_000 + 60 * seed,
        session: PathBuf::from(format!("/sessions/{trainee}/{seed}")),
        session_digest: format!("{seed:x}"),
        passed: [None, Some(false), Some(true)][seed.rem_euclid(3) as usize],
        is_expert: seed % 2 == 0,
        measures: measures.collect(),
    }
}
