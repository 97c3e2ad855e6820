//! Finite elements in the loop: the tissue of a full viscoelastic run comes back.

use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::inverse::{Body, SoughtLaw};
use palpate_characterize::viscoelastic::RelaxationSettings;
use palpate_characterize::{
    Characterization, CharacterizeSettings, CleanRecording, characterize, characterize_in_loop,
};
use palpate_files::Recording;
use palpate_files::recording::{IndenterShape, RecordingHeader, Samples, StimulusKind};
use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::indentation::{IndentationRun, IndentationSettings};

use crate::specimen::LIVER;

const RADIUS: f64 = 1e-3;

/// The force of a full run, without noise: a ramp of half a second to `depth` [m] and a hold of 20 s.
fn recorded(law: SoughtLaw, modulus: f64, shape: f64, depth: f64, halvings: i32) -> CleanRecording {
    let Body::Block { block, indenter } = Body::under_punch(RADIUS) else {
        panic!("a punch is pressed into a block");
    };
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law: law.of(modulus, shape).unwrap(),
        prony: PronySeries::new(&LIVER).unwrap(),
        deepest: depth,
        halvings,
    })
    .unwrap();
    let ramp = (0..=20).map(|i| 0.025 * f64::from(i));
    let hold = (1..=130).map(|i| 0.5 + 0.15 * f64::from(i));
    let times: Vec<f64> = ramp.chain(hold).collect();
    let depths: Vec<f64> = times.iter().map(|t| depth * (t / 0.5).min(1.0)).collect();
    let press = |(t, d): (&f64, &f64)| run.press(*t, *d, |_| ()).unwrap().force;
    let forces = times.iter().zip(&depths).map(press).collect();
    let header = RecordingHeader {
        organ: Some("liver".into()),
        stimulus: Some(StimulusKind::RampAndHold),
        indenter_shape: Some(IndenterShape::Flat),
        indenter_radius_m: Some(RADIUS),
        ..RecordingHeader::default()
    };
    let samples = Samples {
        time_s: times,
        depth_m: depths,
        force_n: forces,
    };
    let recording = Recording::new(header, samples).unwrap();
    clean(&recording, &CleanSettings::default()).unwrap()
}

fn settings(law: SoughtLaw) -> CharacterizeSettings {
    CharacterizeSettings {
        relaxation: RelaxationSettings { terms: Some(2) },
        laws: vec![law],
        draws: None,
    }
}

/// Prints what was found; each parameter's distance from the truth, in its standard errors [-].
fn distances(found: &Characterization, truth: &[f64]) -> Vec<f64> {
    let answer = found.laws[0].1.as_ref().unwrap();
    let each = answer.parameters.iter().zip(truth);
    let distances = each.map(|((name, known), truth)| {
        let error = known.standard_error.unwrap_or(f64::INFINITY);
        println!("{name} {} ± {error} of {truth}", known.value);
        (known.value - truth) / error
    });
    let distances = distances.collect();
    for ([g, tau], truth) in found.relaxation.as_ref().unwrap().terms.iter().zip(LIVER) {
        println!("g {} tau {} of {truth:?}", g.value, tau.value);
    }
    println!("{} runs of finite elements", answer.found.solves);
    distances
}

/// Judge: the full run itself, on the mesh of the loop, which is corrected by its tabulated trend: of that half a per
/// cent is left in the mean, and a tenth of the correction of 1.3 % besides.
fn assert_comes_back(modulus: f64, depth: f64) {
    let law = SoughtLaw::NeoHookean;
    let recording = [recorded(law, modulus, 0.0, depth, 0)];
    let found = characterize_in_loop(&recording, law, &settings(law), &mut |_| ()).unwrap();
    distances(&found, &[modulus]);
    let answer = found.laws[0].1.as_ref().unwrap();
    let too_stiff = 1.0 - 0.0022 * depth / RADIUS;
    let off = answer.parameters[0].1.value * too_stiff / modulus - 1.0;
    assert!(off.abs() < 6e-3, "{off}");
    assert!(answer.found.solves >= 2 && answer.found.solves <= 5);
}

#[test]
fn a_shallow_full_run_comes_back() {
    assert_comes_back(731.0, 2e-3);
}

#[test]
fn a_full_run_to_six_radii_comes_back() {
    assert_comes_back(731.0, 6e-3);
}

/// What is stated holds the truth without the loop, too: within twice its standard error.
#[test]
fn stated_errors_hold_a_full_run() {
    // The mesh of the recording is too stiff by its trend for each radius.
    for (law, modulus, shape, trend) in [
        (SoughtLaw::NeoHookean, 731.0, 0.0, 0.0022),
        (SoughtLaw::MooneyRivlin, 612.0, 0.37, 0.0014),
    ] {
        let depth = 6e-3;
        let recording = [recorded(law, modulus, shape, depth, 0)];
        let found = characterize(&recording, &settings(law), &mut |_| ());
        let truth = law.parameters(modulus, shape);
        let truth = truth.iter();
        let truth: Vec<f64> = truth.map(|p| p.value / (1.0 - 6.0 * trend)).collect();
        let off = distances(&found, &truth);
        assert!(off.iter().all(|off| off.abs() < 2.0), "{off:?}");
    }
}
