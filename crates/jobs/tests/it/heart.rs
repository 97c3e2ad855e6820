//! Recordings of the virtual rig over a liver that a heart moves by 0.4 mm. Judge: the numbers that the specimens were made of.

use palpate_characterize::inverse::CandidateLaw;
use palpate_characterize::{
    CharacterizeSettings, CleanRecording, CleanSettings, characterize, clean,
};
use palpate_files::Recording;
use palpate_files::recording::Samples;
use palpate_measure::{Ended, RigSample};

use crate::online::{LIVER, rig, solved, trajectory};

/// Of c10 and the terms of as many `seeds`: intervals of `characterize` that contain the truth, from `presses` each over a
/// beating heart, and intervals.
fn held_in_recordings(seeds: u64, presses: u64) -> [[usize; 2]; 5] {
    let (tissue, curve) = solved();
    let settings = CharacterizeSettings {
        laws: vec![CandidateLaw::NeoHookean],
        draws: None,
        ..CharacterizeSettings::default()
    };
    let mut held = [[0; 2]; 5];
    for seed in 0..seeds {
        let factor = 0.6 + 0.008 * seed as f64;
        let mut rig = rig(&tissue, &curve, factor, true, seed);
        let recordings: Vec<CleanRecording> = (0..presses)
            .map(|repeat| {
                let mut samples = Samples::default();
                let listener = &mut |sample: &RigSample| {
                    samples.time_s.push(sample.time);
                    samples.depth_m.push(sample.depth.unwrap());
                    samples.force_n.push(sample.force);
                    true
                };
                assert_eq!(rig.press(&trajectory(), listener).unwrap(), Ended::Complete);
                rig.recover(&mut |_| true).unwrap();
                let header = rig.describe(&trajectory(), repeat);
                let recording = Recording::new(header, samples).unwrap();
                clean(&recording, &CleanSettings::default()).unwrap()
            })
            .collect();
        let found = characterize(&recordings, &settings, &mut |_| ());
        let (Ok(relaxation), (_, Ok(law))) = (&found.relaxation, &found.laws[0]) else {
            panic!("{seed}: {found:?}");
        };
        let modulus = (
            law.parameters[0].1,
            law.uncertainty.quantile(0, 0.95),
            factor * LIVER[0],
        );
        let terms = relaxation.terms.iter().zip(&relaxation.quantiles);
        let terms = terms.flat_map(|(term, quantiles)| {
            [0, 1].map(|place| (term[place], Some(quantiles[place])))
        });
        let terms = terms
            .zip(&LIVER[1..])
            .filter(|_| relaxation.terms.len() == 2)
            .map(|((estimate, quantile), truth)| (estimate, quantile, *truth));
        let all = std::iter::once(modulus).chain(terms);
        for (held, (estimate, quantile, truth)) in held.iter_mut().zip(all) {
            let half = quantile.unwrap() * estimate.standard_error.unwrap();
            held[1] += 1;
            held[0] += usize::from((estimate.value - truth).abs() <= half);
            println!("{seed} {} +- {half} of {truth}", estimate.value);
        }
    }
    println!("{presses} presses: {held:?}");
    held
}

/// Recordings over a beating heart, one and three of each specimen: nine of ten intervals of each parameter contain the truth.
#[test]
#[ignore = "slow: two hundred presses of the virtual rig, and their fits"]
fn intervals_of_recordings_over_a_heart_hold_the_truth() {
    for presses in [1, 3] {
        for [held, stated] in held_in_recordings(50, presses) {
            assert!(10 * held >= 9 * stated, "{held} of {stated}");
        }
    }
}

/// The same of three specimens: at 95 %, two of three intervals miss the true value with a probability of 0.7 %.
#[test]
#[ignore = "long"]
fn few_recordings_over_a_heart_are_fitted() {
    for [held, stated] in held_in_recordings(3, 1) {
        assert!(stated == 3 && held >= 2, "{held} of {stated}");
    }
}
