//! Fits of a law that are made again. Judge: what theory says of a force that is linear in its parameter.

use std::f64::consts::PI;

use palpate_characterize::fit::{Draws, Random};
use palpate_characterize::inverse::{CandidateLaw, LawDescription, PUNCH};
use palpate_characterize::{CharacterizeSettings, characterize};
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::specimen::{LIVER, history, recording};

/// Standard deviation of independent noise [N].
const NOISE: f64 = 1e-3;
const C10: f64 = 1872.74;
/// Samples of the recording.
const SAMPLES: f64 = 1501.0;

/// Laws of a press of 5 mm with independent noise, each made again 100 times; and the largest force [N].
fn laws() -> (Vec<LawDescription>, f64) {
    let mut random = Random::new(5);
    laws_felt_with(100, |_| NOISE * random.normal())
}

/// The same with what `noise` [N] adds at each part of the time [-], each made again so many times.
fn laws_felt_with(count: usize, mut noise: impl FnMut(f64) -> f64) -> (Vec<LawDescription>, f64) {
    let history = history(5e-3);
    let depths: Vec<f64> = PUNCH.iter().map(|row| 1e-3 * row.0).collect();
    let elastic: Vec<f64> = PUNCH.iter().map(|row| C10 * 1e-6 * row.1).collect();
    let curve = IndentationCurve::through(&depths, &elastic);
    let series = PronySeries::new(&LIVER).unwrap();
    let forces = curve.relaxed(&series, &history.times, &history.depths);
    let last = *history.times.last().unwrap();
    let felt = forces.iter().zip(&history.times);
    let felt: Vec<f64> = felt.map(|(f, t)| f + noise(t / last)).collect();
    let settings = CharacterizeSettings {
        laws: vec![CandidateLaw::NeoHookean, CandidateLaw::MooneyRivlin],
        draws: Some(Draws { count, seed: 2 }),
        ..CharacterizeSettings::default()
    };
    let found = characterize(&[recording(&history, &felt, 5)], &settings, &mut |_| ());
    let largest = forces.into_iter().fold(0.0, f64::max);
    let laws = found.laws.into_iter().map(|(_, law)| law.unwrap());
    (laws.collect(), largest)
}

/// A spread of 100 draws is known to 7 %, one of the 25 of each noise to 14 %; three times that, and what the
/// relaxation bends, is allowed.
#[test]
fn one_modulus_spreads_as_its_standard_error() {
    let (laws, largest) = laws();
    let law = &laws[0];
    // Fits to other noise know nothing of what else is in the errors.
    let error = law.uncertainty.of_noise[(0, 0)].sqrt();
    let repeated = law.repeated.clone().unwrap().unwrap();
    let ratio = repeated.bootstrap.unwrap()[0] / error;
    assert!((ratio - 1.0).abs() < 0.3, "{ratio}");
    // Standard errors count the samples that are independent as far as the residuals show.
    let independent = (law.uncertainty.effective_samples / SAMPLES).sqrt() * error;
    for effect in &repeated.noise {
        let expected = independent / NOISE * effect.noise * largest;
        let ratio = effect.spread[0] / expected;
        assert!((ratio - 1.0).abs() < 0.5, "{effect:?}: {ratio}");
    }
    // With the relaxation held, the modulus is known better than without.
    let [low, high] = repeated.profiles[0].unwrap().map(Option::unwrap);
    assert!(low < law.parameters[0].1.value && law.parameters[0].1.value < high);
    assert!(high - low < 2.0 * 1.97 * error, "{low} {high} {error}");
}

/// Two parameters that are hardly told apart: each alone is known worse than their sum.
#[test]
fn profiles_see_what_cannot_be_told_apart() {
    let (laws, _) = laws();
    let law = &laws[1];
    let repeated = law.repeated.clone().unwrap().unwrap();
    let [sum, each] = [
        laws[0].parameters[0].1.standard_error.unwrap(),
        repeated.bootstrap.unwrap()[0],
    ];
    // C01 is on its bound of zero, or near it.
    assert!(each.is_finite() && each >= 0.5 * sum, "{each} {sum}");
    assert_eq!(repeated.profiles.len(), 2);
}

/// Residuals that stay alike through the whole recording are one block, which has no other order: nothing is told
/// of their spread, and not zero.
#[test]
fn one_block_is_not_drawn_anew() {
    let (laws, _) = laws_felt_with(4, |part| 5.0 * NOISE * (2.0 * PI * part).sin());
    let repeated = laws[0].repeated.clone().unwrap().unwrap();
    assert!(repeated.block as f64 > SAMPLES, "{}", repeated.block);
    assert_eq!(repeated.bootstrap, None);
    assert!(!repeated.noise.is_empty());
}
