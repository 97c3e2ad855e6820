//! The tissue of a full viscoelastic run comes back: within its stated errors by the product of an elastic force and
//! G(t), and to the errors of the elements with finite elements in the loop.

use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::inverse::{Body, SoughtLaw};
use palpate_characterize::viscoelastic::RelaxationSettings;
use palpate_characterize::{CharacterizeSettings, CleanRecording, characterize};
use palpate_files::Recording;
use palpate_files::recording::{IndenterShape, RecordingHeader, Samples, StimulusKind};
use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::indentation::{IndentationRun, IndentationSettings};

use crate::specimen::LIVER;

const RADIUS: f64 = 1e-3;

/// A tissue, and how it is pressed.
#[derive(Debug, Clone, Copy)]
struct Press {
    law: SoughtLaw,
    /// [Pa]
    modulus: f64,
    /// [-]
    shape: f64,
    /// [m]
    depth: f64,
    /// Duration of the ramp [s].
    ramp: f64,
    halvings: i32,
}

/// The force of a full run, without noise: a ramp and a hold of 20 s.
fn recorded(press: Press) -> CleanRecording {
    let Body::Block { block, indenter } = Body::under_punch(RADIUS) else {
        panic!("a punch is pressed into a block");
    };
    let mut run = IndentationRun::new(&IndentationSettings {
        block,
        indenter,
        law: press.law.of(press.modulus, press.shape).unwrap(),
        prony: PronySeries::new(&LIVER).unwrap(),
        deepest: press.depth,
        halvings: press.halvings,
    })
    .unwrap();
    let ramp = (0..=20).map(|i| press.ramp * f64::from(i) / 20.0);
    let hold = (1..=80).map(|i| press.ramp + 0.25 * f64::from(i));
    let times: Vec<f64> = ramp.chain(hold).collect();
    let depths: Vec<f64> = times
        .iter()
        .map(|t| press.depth * (t / press.ramp).min(1.0))
        .collect();
    let felt = |(t, d): (&f64, &f64)| run.press(*t, *d, |_| ()).unwrap().force;
    let forces = times.iter().zip(&depths).map(felt).collect();
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

/// What a fit says of each parameter: value and standard error over the truth [-].
struct Found {
    parameters: Vec<[f64; 2]>,
    terms: Vec<[[f64; 2]; 2]>,
    solves: usize,
}

fn found(press: Press, recording: &CleanRecording, in_loop: bool) -> Found {
    let settings = CharacterizeSettings {
        relaxation: RelaxationSettings { terms: Some(2) },
        laws: vec![press.law],
        draws: None,
        in_loop,
    };
    let begin = std::time::Instant::now();
    let answer = characterize(std::slice::from_ref(recording), &settings, &mut |_| ());
    let law = answer.laws[0].1.as_ref().unwrap();
    let relaxation = answer.relaxation.as_ref().unwrap();
    let truth = press.law.parameters(press.modulus, press.shape);
    let over = |known: &palpate_files::Estimate, truth: f64| {
        [
            known.value / truth,
            known.standard_error.unwrap_or(f64::INFINITY) / truth,
        ]
    };
    let each = law.parameters.iter().zip(&truth);
    let parameters: Vec<_> = each
        .map(|((_, known), own)| over(known, own.value))
        .collect();
    let each = relaxation.terms.iter().zip(LIVER);
    let terms: Vec<_> = each
        .map(|([g, tau], own)| [over(g, own.0), over(tau, own.1)])
        .collect();
    println!(
        "{press:?}, in loop {in_loop}: {parameters:.4?}, terms {terms:.3?}, {} runs, {:.1?}",
        law.found.solves,
        begin.elapsed()
    );
    Found {
        parameters,
        terms,
        solves: law.found.solves,
    }
}

#[test]
#[ignore = "helper: prints"]
fn many() {
    use SoughtLaw::{Exponential, MooneyRivlin, NeoHookean};
    let halvings = std::env::var("HALVINGS").map_or(0, |text| text.parse().unwrap());
    for (law, modulus, shape) in [
        (NeoHookean, 731.0, 0.0),
        (MooneyRivlin, 612.0, 0.37),
        (MooneyRivlin, 612.0, 0.8),
        (Exponential, 900.0, 1.7),
    ] {
        for (depth, ramp) in [(6e-3, 0.5), (3e-3, 2.0), (5e-3, 5.0)] {
            let press = Press {
                law,
                modulus,
                shape,
                depth,
                ramp,
                halvings,
            };
            let recording = recorded(press);
            found(press, &recording, false);
            found(press, &recording, true);
        }
    }
}
