//! Protocols that were designed, on specimens that know nothing of the design.

use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::design::{
    Criterion, ExpectedCurve, Guess, Instrument, Limits, OptimizedProtocol, Presses, design,
};
use palpate_characterize::fit::{Draws, Random};
use palpate_characterize::inverse::{Body, CandidateLaw, Curves, ZeroErrors};
use palpate_characterize::viscoelastic::RelaxationSettings;
use palpate_characterize::{Characterization, CharacterizeSettings, characterize};
use palpate_files::Recording;
use palpate_files::recording::{RecordingHeader, Samples, StimulusKind};
use palpate_mechanics::PronySeries;

use crate::specimen::LIVER;

const RATE: f64 = 500.0;
/// Steps of the encoder [m] and of the force sensor [N], and its noise [N].
const DEPTH_STEP: f64 = 30e-6;
const FORCE_STEP: f64 = 0.78e-3;
const NOISE: f64 = 0.3e-3;
/// How long before the contact a recording begins [s].
const BEFORE: f64 = 0.3;

/// What `palpate measure` does without a protocol.
fn default_presses() -> Presses {
    Presses {
        radius: 1e-3,
        depths: vec![2e-3, 4e-3, 6e-3],
        ramp: 0.5,
        hold: 20.0,
    }
}

fn limits() -> Limits {
    Limits {
        depth: 6e-3,
        force: 1.5,
        speed: 0.045,
        time: default_presses().duration(),
        press: 60.0,
        presses: 3,
        radii: vec![0.5e-3, 1e-3, 2e-3, 3e-3],
    }
}

fn instrument() -> Instrument {
    let step = |step: f64| step / 12.0_f64.sqrt();
    Instrument {
        noise: NOISE.hypot(step(FORCE_STEP)),
        rate: RATE,
        zeros: ZeroErrors {
            depth: step(DEPTH_STEP),
            force: 0.0,
            ..ZeroErrors::default()
        },
    }
}

fn guess() -> Guess {
    Guess {
        law: CandidateLaw::MooneyRivlin,
        modulus: 612.0,
        shape: vec![0.37],
        series: PronySeries::new(&LIVER).unwrap(),
    }
}

/// A specimen as it may be, within a factor of about two around the guess.
fn specimen(seed: u64) -> Guess {
    let mut random = Random::new(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * random.uniform();
    let terms = [
        (between(0.2, 0.35), between(1.0, 2.2)),
        (between(0.15, 0.25), between(4.5, 8.5)),
    ];
    Guess {
        law: CandidateLaw::MooneyRivlin,
        modulus: between(400.0, 1000.0),
        shape: vec![between(0.25, 0.6)],
        series: PronySeries::new(&terms).unwrap(),
    }
}

fn recording(truth: &Guess, presses: &Presses, place: usize, seed: u64) -> Recording {
    let mut random = Random::new(seed);
    let body = Body::under_punch(presses.radius);
    let mut curves = Curves::new(body, truth.law, presses.deepest());
    let curve = curves.of(f64::INFINITY, &truth.shape).unwrap().force;
    let count = ((BEFORE + presses.ramp + presses.hold) * RATE) as usize;
    let time_s: Vec<f64> = (0..count).map(|i| i as f64 / RATE).collect();
    let depth = |time: &f64| presses.depths[place] * ((time - BEFORE) / presses.ramp).min(1.0);
    let depth: Vec<f64> = time_s.iter().map(depth).collect();
    let pressed: Vec<f64> = depth.iter().map(|d| d.max(0.0)).collect();
    let force = curve
        .scaled(1.0, truth.modulus)
        .relaxed(&truth.series, &time_s, &pressed);
    // Where the steps lie is another at each press.
    let offset = random.uniform();
    let told = |d: &f64| DEPTH_STEP * ((d / DEPTH_STEP + offset).round() - offset);
    let mut shown = |f: &f64| FORCE_STEP * ((f + NOISE * random.normal()) / FORCE_STEP).round();
    let samples = Samples {
        depth_m: depth.iter().map(told).collect(),
        force_n: force.iter().map(&mut shown).collect(),
        time_s,
    };
    let header = RecordingHeader {
        stimulus: Some(StimulusKind::RampAndHold),
        indenter_radius_m: Some(presses.radius),
        ..RecordingHeader::default()
    };
    Recording::new(header, samples).unwrap()
}

/// What is found of a specimen that is pressed: half of each interval of 95 % over the true value, and whether the
/// interval holds that, for C₁₀, C₀₁, τ₁ and τ₂.
fn found(truth: &Guess, presses: &Presses, seed: u64) -> Vec<(f64, bool)> {
    let settings = CleanSettings {
        contact_time_s: Some(BEFORE),
        ..CleanSettings::default()
    };
    let recordings: Vec<_> = (0..presses.depths.len())
        .map(|place| {
            let one = recording(truth, presses, place, 100 * seed + place as u64);
            clean(&one, &settings).unwrap()
        })
        .collect();
    let settings = CharacterizeSettings {
        laws: vec![truth.law],
        relaxation: RelaxationSettings { terms: Some(2) },
        draws: None::<Draws>,
        ..CharacterizeSettings::default()
    };
    let found = characterize(&recordings, &settings, &mut |_| ());
    intervals(truth, &found)
}

fn intervals(truth: &Guess, found: &Characterization) -> Vec<(f64, bool)> {
    let law = found.laws[0].1.as_ref().unwrap();
    let relaxation = found.relaxation.as_ref().unwrap();
    let own = truth.law.parameters(truth.modulus, &truth.shape);
    let of_law = own.iter().enumerate().map(|(place, parameter)| {
        let known = law.parameters[place].1;
        let reach = known.standard_error.map_or(f64::INFINITY, |error| {
            error * law.uncertainty.quantile(place, 0.95).unwrap()
        });
        (known.value, reach, parameter.value)
    });
    let of_times = relaxation.terms.iter().zip(&relaxation.quantiles);
    let of_times = of_times
        .zip(truth.series.terms())
        .map(|((term, t), (_, tau))| {
            let reach = term[1].standard_error.unwrap() * t[1];
            (term[1].value, reach, *tau)
        });
    let all = of_law.chain(of_times);
    all.map(|(value, reach, truth)| (reach / truth, (value - truth).abs() <= reach))
        .collect()
}

fn wanted() -> Vec<String> {
    ["c10_pa", "c01_pa", "tau_1_s", "tau_2_s"]
        .map(str::to_owned)
        .to_vec()
}

/// For tissue as guessed, and as it may be.
fn designed(wanted: &[String]) -> OptimizedProtocol {
    let base = ExpectedCurve::new(guess(), 6.0).unwrap();
    let other = |stiffer, slower| base.with(guess().changed(stiffer, slower).unwrap());
    let guesses = [
        base.clone(),
        other(0.6, 1.0),
        other(1.6, 1.0),
        other(1.0, 0.7),
        other(1.0, 1.4),
    ];
    design(
        &guesses,
        &instrument(),
        &limits(),
        wanted,
        Criterion::Minimax,
        &mut |_| (),
    )
    .unwrap()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Judge: fits of recordings that are made of other tissue than the guess, by the default protocol and by the designed one,
/// at equal time and depth. In the median of `specimens` the designed interval of the worst parameter `wanted` is at most
/// `half` of the default one, and found intervals are expected ones but for the factor `alike`. Intervals of 95 % hold the
/// truth in 9 of 10 cases at least.
fn judge(wanted: &[String], specimens: u64, [half, alike]: [f64; 2]) {
    let both = [default_presses(), designed(wanted).presses];
    let (mut worst, mut held) = (Vec::new(), 0);
    let mut ratios = vec![Vec::new(); wanted.len()];
    let mut of_expected = [ratios.clone(), ratios.clone()];
    for seed in 0..specimens {
        let truth = specimen(seed);
        let guess = ExpectedCurve::new(truth.clone(), 6.0).unwrap();
        let own = both.each_ref().map(|presses| {
            let (expected, ..) = guess.expected(presses, &instrument()).unwrap();
            let expected = |name: &String| {
                expected
                    .iter()
                    .find(|one| one.name == *name)
                    .unwrap()
                    .reach()
            };
            let found = found(&truth, presses, seed);
            let each = wanted.iter().map(|name| {
                let place = self::wanted().iter().position(|own| own == name).unwrap();
                (found[place].0, expected(name), found[place].1)
            });
            each.collect::<Vec<_>>()
        });
        let most = |own: &[(f64, f64, bool)]| own.iter().map(|one| one.0).fold(0.0, f64::max);
        worst.push(most(&own[1]) / most(&own[0]));
        for place in 0..wanted.len() {
            ratios[place].push(own[1][place].0 / own[0][place].0);
            for (of, own) in of_expected.iter_mut().zip(&own) {
                of[place].push(own[place].0 / own[place].1);
            }
        }
        held += own[1].iter().filter(|one| one.2).count();
    }
    let medians = |all: Vec<Vec<f64>>| all.into_iter().map(median).collect::<Vec<_>>();
    let (worst, of_expected) = (median(worst), of_expected.map(medians));
    println!(
        "{:?}: worst {worst:.3}, each {:.3?}, found over expected {of_expected:.2?}, held {held} of {}",
        both[1],
        medians(ratios),
        specimens as usize * wanted.len()
    );
    assert!(worst <= half, "{worst}");
    for of in of_expected.iter().flatten() {
        assert!((1.0 / alike..=alike).contains(of), "{of_expected:?}");
    }
    assert!(10 * held >= 9 * specimens as usize * wanted.len(), "{held}");
}

/// A few of the specimens below: an interval that comes from noise known from three presses spreads by a factor of about
/// two itself, which is allowed besides the factors there.
#[test]
#[ignore = "long"]
fn a_designed_protocol_tells_more() {
    judge(&wanted(), 3, [0.71, 4.0]);
}

/// Half the interval of the worst parameter, at least, is what a design is to gain; expected within a factor of two in the
/// median, in which noise that is not as was assumed shows.
#[test]
#[ignore = "slow: 50 specimens, pressed and fitted twice"]
fn designed_intervals_are_half_of_default_ones() {
    judge(&wanted(), 50, [0.5, 2.0]);
}

/// The same where the times of the relaxation alone are wanted.
#[test]
#[ignore = "slow: 50 specimens, pressed and fitted twice"]
fn designed_intervals_of_times_are_half_of_default_ones() {
    judge(&wanted()[2..], 50, [0.5, 2.0]);
}

/// Judge: the bound of any stimulus whatever. Without noise and with exact zeros only the error of the product of
/// an elastic force and G(t) is left, which no stimulus makes smaller. A tenth above it is less than what found intervals
/// spread by.
#[test]
#[ignore = "long"]
fn designed_times_are_near_the_bound_of_any_stimulus() {
    const NEAR: f64 = 1.1;
    let base = ExpectedCurve::new(guess(), 6.0).unwrap();
    let exact = Instrument {
        noise: 1e-9,
        zeros: ZeroErrors {
            depth: 0.0,
            force: 0.0,
            ..ZeroErrors::default()
        },
        ..instrument()
    };
    let wanted = &wanted()[2..];
    let worst = |presses: &Presses, instrument: &Instrument| {
        let (found, _) = base.expected(presses, instrument).unwrap();
        let own = found.iter().filter(|own| wanted.contains(&own.name));
        own.map(|own| own.reach()).fold(0.0, f64::max)
    };
    let before = worst(&default_presses(), &instrument());
    let presses = designed(wanted).presses;
    let (own, bound) = (worst(&presses, &instrument()), worst(&presses, &exact));
    println!(
        "expected: default {before:.5}, designed {own:.5}, bound {bound:.5}, which is {:.3} of the default",
        bound / before
    );
    // The bound is that of the default protocol too, and of a normal distribution.
    let of_default = worst(&default_presses(), &exact);
    let product = 0.02 * (1.0 - LIVER.iter().map(|(g, _)| g).sum::<f64>()) / 3.0_f64.sqrt();
    assert!(
        (of_default / bound - 1.0).abs() < 1e-3,
        "{of_default} {bound}"
    );
    assert!(
        (bound / (1.96 * product) - 1.0).abs() < 1e-3,
        "{bound} {product}"
    );
    assert!(
        own <= NEAR * bound && own <= 0.5 * before,
        "{own} {bound} {before}"
    );
}

#[test]
fn what_no_protocol_can_do_is_refused() {
    let base = ExpectedCurve::new(guess(), 6.0).unwrap();
    let asked = |limits: &Limits, name: &str| {
        let wanted = [name.to_owned()];
        let found = design(
            std::slice::from_ref(&base),
            &instrument(),
            limits,
            &wanted,
            Criterion::Determinant,
            &mut |_| (),
        );
        found.unwrap_err().to_string()
    };
    let weak = Limits {
        force: 1e-6,
        ..limits()
    };
    assert!(asked(&weak, "c10_pa").contains("no protocol keeps within the limits"));
    let unknown = asked(&limits(), "alpha");
    assert!(
        unknown.contains("no parameter `alpha`") && unknown.contains("tau_2_s"),
        "{unknown}"
    );
}

/// Judge: in the determinant's sense, the protocol that is the best of all is no worse than the minimax one.
#[test]
#[ignore = "long"]
fn each_criterion_is_best_in_its_own_sense() {
    let base = ExpectedCurve::new(guess(), 6.0).unwrap();
    let wanted = wanted();
    let of = |criterion| {
        design(
            std::slice::from_ref(&base),
            &instrument(),
            &limits(),
            &wanted,
            criterion,
            &mut |_| (),
        )
        .unwrap()
    };
    let [minimax, determinant] = [Criterion::Minimax, Criterion::Determinant].map(of);
    assert!(minimax.worst <= determinant.worst);
    assert!(minimax.presses.duration() <= limits().time * (1.0 + 1e-12));
    let volume = |designed: &OptimizedProtocol| {
        let (found, correlations) = base.expected(&designed.presses, &instrument()).unwrap();
        let chosen: Vec<usize> = correlations
            .names
            .iter()
            .enumerate()
            .filter(|(_, own)| wanted.contains(own))
            .map(|own| own.0)
            .collect();
        let errors = found
            .iter()
            .filter(|own| wanted.contains(&own.name))
            .map(|own| own.reach().ln());
        errors.sum::<f64>()
            + 0.5
                * correlations
                    .matrix
                    .select_rows(&chosen)
                    .select_columns(&chosen)
                    .determinant()
                    .ln()
    };
    assert!(volume(&determinant) <= volume(&minimax));
}
