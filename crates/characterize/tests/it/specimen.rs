//! From recordings to a tissue, judged by finite elements on meshes that the fits do not use.

use std::sync::Arc;

use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::fit::Random;
use palpate_characterize::inverse::{Body, CandidateLaw, PUNCH};
use palpate_characterize::{Characterization, CharacterizeSettings, CleanRecording, characterize};
use palpate_files::Recording;
use palpate_files::recording::{IndenterShape, RecordingHeader, Samples, StimulusKind};
use palpate_mechanics::finite_elements::indentation::{
    History, IndentationProblem, RelaxationMethod, solve_history,
};
use palpate_mechanics::{IndentationCurve, Law, MooneyRivlin, NeoHookean, PronySeries};

/// Table 6-3's liver.
pub(super) const LIVER: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.090)];
const RADIUS: f64 = 1e-3;

/// A ramp of 0.2 s to `depth` [m] and a hold, at 50 Hz, under a punch of 1 mm.
pub(super) fn history(depth: f64) -> History {
    let times: Vec<f64> = (0..=1500).map(|i| f64::from(i) * 0.02).collect();
    History {
        depths: times.iter().map(|t| depth * (t / 0.2).min(1.0)).collect(),
        times,
    }
}

/// What a sensor with white noise of 20 µN records of `forces` [N]: little, since bias is asked for here.
pub(super) fn recording(history: &History, forces: &[f64], seed: u64) -> CleanRecording {
    let mut random = Random::new(seed);
    let mut felt = |force: &f64| force + 2e-5 * random.normal();
    let header = RecordingHeader {
        organ: Some("liver".into()),
        stimulus: Some(StimulusKind::RampAndHold),
        indenter_shape: Some(IndenterShape::Flat),
        indenter_radius_m: Some(RADIUS),
        ..RecordingHeader::default()
    };
    let samples = Samples {
        time_s: history.times.clone(),
        depth_m: history.depths.clone(),
        force_n: forces.iter().map(&mut felt).collect(),
    };
    let recording = Recording::new(header, samples).unwrap();
    clean(&recording, &CleanSettings::default()).unwrap()
}

/// Forces [N] of a law in the block of the fits, on a mesh to 2 %, and their error [-].
fn forces(law: Arc<dyn Law>, history: &History, relaxing: RelaxationMethod) -> (Vec<f64>, f64) {
    let Body::Block { block, indenter } = Body::under_punch(RADIUS) else {
        panic!("a punch is pressed into a block");
    };
    let series = PronySeries::new(&LIVER).unwrap();
    let problem = IndentationProblem {
        block,
        indenter,
        law,
    };
    let solved = solve_history(&problem, &series, relaxing, history, 0.02, &mut |_| ()).unwrap();
    let points = solved.answer.points.iter();
    (points.map(|point| point.force).collect(), solved.error)
}

fn found(recordings: &[CleanRecording], laws: &[CandidateLaw]) -> Characterization {
    let settings = CharacterizeSettings {
        laws: laws.to_vec(),
        draws: None,
        ..CharacterizeSettings::default()
    };
    characterize(recordings, &settings, &mut |_| ())
}

/// Mooney-Rivlin tissue, whose two parameters can hardly be told apart: their sum and the force curve to
/// 2 %, G(t) to 2 % (the bounds of the elements: 0.5 % tabulated, 2 % asked of the recording).
#[test]
#[ignore = "long"]
fn a_law_is_found_from_finite_elements() {
    let law = Arc::new(MooneyRivlin::incompressible(322.96, 161.47).unwrap());
    let history = history(1.5e-3);
    let (forces, _) = forces(law, &history, RelaxationMethod::Convolution);
    let found = found(
        &[recording(&history, &forces, 3)],
        &[CandidateLaw::NeoHookean, CandidateLaw::MooneyRivlin],
    );
    let relaxation = found.relaxation.as_ref().unwrap();
    let truth = PronySeries::new(&LIVER).unwrap();
    for time in [0.2, 1.0, 5.0, 30.0] {
        let ratio = relaxation.series.relaxation(time) / truth.relaxation(time);
        assert!((ratio - 1.0).abs() < 0.02, "G({time}): {ratio}");
    }
    // So little noise tells the laws apart.
    assert_eq!(
        found.preferred().unwrap().found.law,
        CandidateLaw::MooneyRivlin
    );
    let answer = found.laws[1].1.as_ref().unwrap();
    let sum: f64 = answer
        .parameters
        .iter()
        .map(|(_, estimate)| estimate.value)
        .sum();
    assert!((sum / 484.43 - 1.0).abs() < 0.03, "{sum}");
    for (ours, theirs) in answer.found.forces[0].iter().zip(&forces).skip(5) {
        assert!((ours / theirs - 1.0).abs() < 0.02, "{ours} {theirs}");
    }
}

/// A hundred recordings of one tissue with a heart's ripple of random phase, noise that lasts 0.05 s and the
/// sensor's steps of 0.781 mN: each number lies in its 95 % interval in at least 90.
#[test]
#[ignore = "slow: a hundred fits"]
fn intervals_hold_the_truth() {
    let (c10, history) = (1872.74, history(5e-3));
    let known: Vec<(f64, f64)> = PUNCH
        .iter()
        .map(|row| (1e-3 * row.0, c10 * 1e-6 * row.1))
        .collect();
    let (depths, elastic): (Vec<f64>, Vec<f64>) = known.into_iter().unzip();
    let series = PronySeries::new(&LIVER).unwrap();
    let curve = IndentationCurve::through(&depths, &elastic);
    let forces = curve.relaxed(&series, &history.times, &history.depths);
    let mut held = [0; 5];
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let phase = random.uniform() * std::f64::consts::TAU;
        let mut noise = 0.0;
        let felt = history.times.iter().zip(&forces).map(|(t, force)| {
            // e^(−0.02/0.05), and a standard deviation of 1 mN.
            noise = 0.67 * noise + 1e-3 * (1.0 - 0.67_f64.powi(2)).sqrt() * random.normal();
            let ripple = 2e-3 * (7.5 * t + phase).sin();
            ((force + ripple + noise) / 0.781e-3).round() * 0.781e-3
        });
        let felt: Vec<f64> = felt.collect();
        let found = found(
            &[recording(&history, &felt, seed)],
            &[CandidateLaw::NeoHookean],
        );
        let relaxation = found.relaxation.as_ref().unwrap();
        let law = found.laws[0].1.as_ref().unwrap();
        let mut estimates = vec![(law.parameters[0].1, c10)];
        for (term, truth) in relaxation.terms.iter().zip(LIVER) {
            estimates.extend([(term[0], truth.0), (term[1], truth.1)]);
        }
        for (held, (estimate, truth)) in held.iter_mut().zip(estimates) {
            let reach = 1.96 * estimate.standard_error.unwrap();
            *held += usize::from((estimate.value - truth).abs() <= reach);
        }
    }
    println!("C10, g1, tau1, g2, tau2: {held:?}");
    assert!(held.iter().all(|held| *held >= 90), "{held:?}");
}

/// Whatever is in a recording: an answer or a reason, no panic and no number that is none.
#[test]
fn some_noise_is_answered() {
    assert_answered(0..3);
}

#[test]
#[ignore = "slow: springs are sought in noise, too"]
fn much_noise_is_answered() {
    assert_answered(3..40);
}

fn assert_answered(seeds: std::ops::Range<u64>) {
    for seed in seeds {
        let mut random = Random::new(seed);
        let count = 5 + random.below(60);
        let mut time = 0.0;
        let times: Vec<f64> = (0..count)
            .map(|_| {
                time += 1e-3 + random.uniform();
                time
            })
            .collect();
        let scale = 10_f64.powi(random.below(8) as i32 - 6);
        let history = History {
            depths: (0..count)
                .map(|i| scale * (random.normal() + i as f64))
                .collect(),
            times,
        };
        let samples = Samples {
            time_s: history.times.clone(),
            depth_m: history.depths.clone(),
            force_n: (0..count).map(|_| scale * random.normal()).collect(),
        };
        let header = RecordingHeader {
            indenter_radius_m: Some(10.0 * scale * count as f64),
            ..RecordingHeader::default()
        };
        let recording = Recording::new(header, samples).unwrap();
        let Ok(recording) = clean(&recording, &CleanSettings::default()) else {
            continue;
        };
        let found = found(
            &[recording],
            &[CandidateLaw::NeoHookean, CandidateLaw::MooneyRivlin],
        );
        for law in found.laws.iter().filter_map(|(_, law)| law.as_ref().ok()) {
            assert!(
                law.parameters
                    .iter()
                    .all(|(_, known)| known.value.is_finite()),
                "{seed}"
            );
        }
        let terms = found.relaxation.iter().flat_map(|found| &found.terms);
        assert!(
            terms.flatten().all(|known| known.value.is_finite()),
            "{seed}"
        );
    }
}

/// The full viscoelastic run with internal variables at ν = 0.49: G(t) and the force curve to 2 %.
#[test]
#[ignore = "slow: a viscoelastic run of 1,500 steps on two meshes"]
fn a_law_is_found_from_a_viscoelastic_run() {
    let law = Arc::new(NeoHookean::compressible(452.92, 49.33 * 2.0 * 452.92).unwrap());
    let history = history(4e-3);
    let (forces, error) = forces(law, &history, RelaxationMethod::Full);
    let found = found(
        &[recording(&history, &forces, 7)],
        &[CandidateLaw::NeoHookean],
    );
    let relaxation = found.relaxation.as_ref().unwrap();
    let truth = PronySeries::new(&LIVER).unwrap();
    for time in [0.2, 1.0, 5.0, 30.0] {
        let ratio = relaxation.series.relaxation(time) / truth.relaxation(time);
        println!("G({time}): {ratio}");
        assert!((ratio - 1.0).abs() < 0.02, "G({time}): {ratio}");
    }
    // What is stated, by noise and by the elements and the product form, holds the truth; the recording's own
    // elements are added.
    let answer = found.laws[0].1.as_ref().unwrap();
    println!(
        "{:?}, elements {:?}, of the recording {error}",
        answer.parameters, answer.discretisation
    );
    let c10 = answer.parameters[0].1;
    let stated = 1.96 * c10.standard_error.unwrap() + answer.discretisation[0];
    assert!(
        (c10.value - 452.92).abs() < stated + error * 452.92,
        "{c10:?} {stated}"
    );
    let off: f64 = relaxation
        .quasi_linear_errors()
        .iter()
        .map(|[g, _]| g)
        .sum();
    let total: f64 = relaxation.terms.iter().map(|[g, _]| g.value).sum();
    let spread: f64 = relaxation
        .terms
        .iter()
        .map(|[g, _]| g.standard_error.unwrap())
        .sum();
    let truth = LIVER.iter().map(|(g, _)| g).sum::<f64>();
    println!("sum of g {total} of {truth}, stated {off} and {spread}");
    assert!(
        (total - truth).abs() < off + 1.96 * spread,
        "{total} {truth}"
    );
    for (ours, theirs) in answer.found.forces[0].iter().zip(&forces).skip(5) {
        assert!((ours / theirs - 1.0).abs() < 0.02, "{ours} {theirs}");
    }
}
