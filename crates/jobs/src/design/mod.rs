//! Design of experiments: the protocol that is expected to determine the parameters of a tissue best, from a guess of
//! the tissue or a first recording of it.

mod answer;
mod first;
mod request_document;

use std::path::PathBuf;

use palpate_characterize::design::{
    Criterion, ExpectedCurve, Guess, Instrument, Limits, Presses, design as best,
};
use palpate_characterize::inverse::{CandidateLaw, ZeroErrors};
use palpate_files::tissue::LawName;
use palpate_files::{Estimate, PronyTerm, Tissue};
use palpate_mechanics::PronySeries;

pub use answer::{Answer, ParameterEstimate, PressesAnswer};

use crate::{Error, ProgressCallback, Recordings, VERSION};

/// A request for a design.
#[derive(Debug, Clone)]
pub struct Request {
    /// Prior knowledge of the tissue.
    pub known: Known,
    /// The parameters to determine, by their keys; empty: those of the law, and the times of the relaxation.
    pub parameters: Vec<String>,
    /// The criterion to optimize.
    pub criterion: Criterion,
    /// The limits.
    pub within: Within,
}

/// Prior knowledge of a tissue.
#[derive(Debug, Clone)]
pub enum Known {
    /// A guess: a tissue's file.
    Tissue(PathBuf),
    /// First recordings of one specimen, and the law to fit to them.
    Recordings(Recordings, Option<CandidateLaw>),
}

/// Limits of a protocol; one that is not given comes from the recordings, or from the default protocol.
#[derive(Debug, Clone, Default, PartialEq, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Within {
    /// [m]
    pub depth_m: Option<f64>,
    /// [N]
    pub force_n: Option<f64>,
    /// Of all presses, without the rest between them [s].
    pub time_s: Option<f64>,
    /// Of one press, such as a held breath [s].
    pub press_s: Option<f64>,
    /// Mean speed of a ramp [m/s].
    pub speed_m_per_s: Option<f64>,
    /// Most presses.
    pub presses: Option<usize>,
    /// Radii of the available indenters [m].
    pub radii_m: Vec<f64>,
}

/// A designed protocol.
#[derive(Debug)]
pub struct Designed {
    /// The answer that `--json` prints.
    pub answer: Answer,
    /// The text of the protocol's file.
    pub protocol: String,
}

/// The guessed tissue, and the presses without a design.
struct Start {
    tissue: Tissue,
    guess: Guess,
    /// Uncertainty factors of moduli and times [-].
    factors: [f64; 2],
    before: Presses,
    instrument: Instrument,
}

/// Default force limit [N]: three quarters of the rig's limit.
const FORCE: f64 = 1.5;
/// Speed [m/s]: three quarters of the rig's.
const SPEED: f64 = 0.045;
/// Presses, as in the default protocol.
const PRESSES: usize = 3;
/// Default candidate radii, over the earlier radius [-].
const RADII: [f64; 4] = [0.5, 1.0, 2.0, 3.0];
/// Uncertainty factor of a bare guess, up and down [-].
const BARE: f64 = 1.5;
/// Radii of the indenter for which a force is precomputed [-].
const DEEPEST: f64 = 6.0;

/// Designs the protocol.
///
/// # Errors
/// When the guess or a limit cannot be used, or no protocol satisfies the limits.
pub fn design(request: &Request, watch: &dyn ProgressCallback) -> Result<Designed, Error> {
    let start = match &request.known {
        Known::Tissue(path) => of_tissue(Tissue::read(path)?)?,
        Known::Recordings(recordings, law) => first::of_recordings(recordings, *law, watch)?,
    };
    let limits = limits(&request.within, &start)?;
    watch.report_step("comparing protocols");
    let first = ExpectedCurve::new(start.guess.clone(), DEEPEST)?;
    let guesses = guesses(&first, start.factors)?;
    let wanted = match request.parameters.as_slice() {
        [] => usual(&start.guess),
        chosen => chosen.to_vec(),
    };
    let found = best(
        &guesses,
        &start.instrument,
        &limits,
        &wanted,
        request.criterion,
        &mut |part| watch.report_fraction(part),
    )?;
    let (before, ..) = first.expected(&start.before, &start.instrument)?;
    let answer = Answer::new(&start.before, &before, &found, request.criterion, &wanted);
    Ok(Designed {
        protocol: protocol(&start.tissue, &found.presses, &limits, &answer),
        answer,
    })
}

/// The law's parameters, and the times of the relaxation.
fn usual(guess: &Guess) -> Vec<String> {
    let own = guess.law.names().into_iter();
    let times = (1..=guess.series.terms().len()).map(|place| format!("tau_{place}_s"));
    own.map(str::to_owned).chain(times).collect()
}

fn guesses(first: &ExpectedCurve, [modulus, time]: [f64; 2]) -> Result<Vec<ExpectedCurve>, Error> {
    let mut all = vec![first.clone()];
    for (stiffer, slower) in [
        (modulus, 1.0),
        (modulus.recip(), 1.0),
        (1.0, time),
        (1.0, time.recip()),
    ] {
        all.push(first.with(first.guess().changed(stiffer, slower)?));
    }
    Ok(all)
}

/// A bare guess, pressed by the default protocol on the virtual rig: its steps of depth and force, and its noise.
fn of_tissue(tissue: Tissue) -> Result<Start, Error> {
    const DEPTH_STEP: f64 = 30e-6;
    const NOISE: f64 = 0.5e-3;
    Ok(Start {
        guess: guess(&tissue)?,
        tissue,
        factors: [BARE; 2],
        before: Presses {
            radius: 1e-3,
            depths: vec![2e-3, 4e-3, 6e-3],
            ramp: 0.5,
            hold: 20.0,
        },
        instrument: Instrument {
            noise: NOISE,
            rate: 1000.0,
            zeros: ZeroErrors {
                depth: DEPTH_STEP / 12.0_f64.sqrt(),
                force: 0.0,
                ..ZeroErrors::default()
            },
        },
    })
}

/// A tissue, as a fit parametrizes it.
fn guess(tissue: &Tissue) -> Result<Guess, Error> {
    let elasticity = &tissue.elasticity;
    let name = elasticity.law();
    let values = elasticity.values();
    let law = CandidateLaw::with_parameters(name, values.len());
    let law = law.filter(|law| !law.name().has_fibres()).ok_or_else(|| {
        let names = CandidateLaw::NAMES
            .into_iter()
            .filter(|own| !own.has_fibres());
        Error::input(format!(
            "the law `{}` is not one that indentations are fitted with; guess one of {}",
            name.word(),
            names.map(LawName::word).collect::<Vec<_>>().join(", ")
        ))
    })?;
    let (modulus, shape) = law.as_shape(&values).ok_or_else(|| {
        Error::input(format!(
            "no fit of `{}` ends at these parameters; guess moduli above zero, with c01_pa at most nine times c10_pa, and \
             of `ogden` alpha_1 above 1 and alpha_2 below -1",
            name.word()
        ))
    })?;
    let terms = tissue
        .prony
        .iter()
        .map(|term| (term.g.value, term.tau_s.value));
    let series = PronySeries::new(&terms.collect::<Vec<_>>())?;
    Ok(Guess {
        law,
        modulus,
        shape,
        series,
    })
}

fn limits(within: &Within, start: &Start) -> Result<Limits, Error> {
    let before = &start.before;
    let or = |value: Option<f64>, usual: f64, name: &str, unit: &str| match value {
        Some(value) if !(value > 0.0 && value.is_finite()) => Err(Error::input(format!(
            "{name} is {value}; give a number of {unit} above zero"
        ))),
        value => Ok(value.unwrap_or(usual)),
    };
    let time = or(within.time_s, before.duration(), "the time", "seconds")?;
    let radii = match within.radii_m.as_slice() {
        [] => RADII.map(|times| times * before.radius).to_vec(),
        own => own.to_vec(),
    };
    if let Some(radius) = radii.iter().find(|radius| !(1e-6..=0.1).contains(*radius)) {
        return Err(Error::input(format!(
            "an indenter's radius is {radius} m; give radii from 1e-6 m to 0.1 m"
        )));
    }
    let presses = within.presses.unwrap_or(PRESSES);
    if !(1..=10).contains(&presses) {
        return Err(Error::input(format!(
            "the most presses are {presses}; give 1 to 10"
        )));
    }
    Ok(Limits {
        depth: or(within.depth_m, before.deepest(), "the depth", "metres")?,
        force: or(within.force_n, FORCE, "the force", "newtons")?,
        speed: or(
            within.speed_m_per_s,
            SPEED,
            "the speed",
            "metres per second",
        )?,
        press: or(within.press_s, time, "the time of a press", "seconds")?,
        time,
        presses,
        radii,
    })
}

/// The text of a protocol for the rig.
fn protocol(tissue: &Tissue, presses: &Presses, limits: &Limits, answer: &Answer) -> String {
    let term =
        |term: &PronyTerm| format!("{{ g = {}, tau_s = {} }}", term.g.value, term.tau_s.value);
    let value = |(key, known): (&'static str, Estimate)| format!("{key} = {}, ", known.value);
    let own: String = tissue
        .elasticity
        .parameters()
        .into_iter()
        .map(value)
        .collect();
    let prony: Vec<String> = tissue.prony.iter().map(term).collect();
    let depths: Vec<String> = presses
        .depths
        .iter()
        .map(|depth| format!("{depth:.6}"))
        .collect();
    // The detected contact is not exact.
    let depth_limit = limits.depth + 0.5e-3;
    let name = tissue
        .name
        .as_ref()
        .map(|name| format!("organ = {name:?}\n"));
    format!(
        "# Designed by palpate {VERSION}.\n{}format = 1\n\n[rig]\nforce_limit_n = {}\ndepth_limit_m = {:.6}\n\n\
         # The guess. For a real specimen name a device in [rig] and a sensor in [sensor].\n[[specimen]]\n{}\
         tissue = {{ law = \"{}\", {own}prony = [{}] }}\nindenter_radius_m = {}\n\n[[stimulus]]\n\
         kind = \"ramp_and_hold\"\ndepths_m = [{}]\nramp_s = {:.4}\nhold_s = {:.3}\n",
        answer.comments(),
        limits.force,
        depth_limit,
        name.unwrap_or_default(),
        tissue.elasticity.law().word(),
        prony.join(", "),
        presses.radius,
        depths.join(", "),
        presses.ramp,
        presses.hold,
    )
}
