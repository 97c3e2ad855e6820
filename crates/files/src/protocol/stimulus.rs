use crate::recording::StimulusKind;
use std::ops::Bound::{Excluded, Included};

use crate::{Domain, Error, Key, Keys};

/// A motion of the indenter, from first contact (figure 5-8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stimulus {
    /// A ramp to a depth, and a hold.
    RampAndHold {
        /// The depth [m].
        depth_m: f64,
        /// Duration of the ramp [s].
        ramp_s: f64,
        /// Duration of the hold [s].
        hold_s: f64,
    },
    /// An oscillation about a depth, beginning downward.
    Swing {
        /// Amplitude [m].
        amplitude_m: f64,
        /// Mean depth [m].
        pre_indentation_m: f64,
        /// Frequency.
        sweep: Sweep,
        /// Duration [s].
        duration_s: f64,
    },
}

/// Frequency of an oscillation, from its beginning to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep {
    /// Constant [Hz].
    Constant(f64),
    /// A linear chirp, from one frequency to another [Hz].
    Linear([f64; 2]),
    /// An exponential chirp, from one frequency to another [Hz].
    Exponential([f64; 2]),
}

impl Sweep {
    /// The first and the last frequency [Hz].
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Constant(frequency) => [frequency; 2],
            Self::Linear(ends) | Self::Exponential(ends) => ends,
        }
    }
}

impl Stimulus {
    /// The word for it in documents.
    pub fn kind(&self) -> StimulusKind {
        match self {
            Self::RampAndHold { .. } => StimulusKind::RampAndHold,
            Self::Swing { sweep, .. } => match sweep {
                Sweep::Constant(_) => StimulusKind::Sine,
                Sweep::Linear(_) => StimulusKind::ChirpLinear,
                Sweep::Exponential(_) => StimulusKind::ChirpExponential,
            },
        }
    }
}

/// A stimulus and how often it is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StimulusPlan {
    /// The motion of the indenter.
    pub stimulus: Stimulus,
    /// Number of repetitions.
    pub repeats: u64,
}

impl StimulusPlan {
    pub(super) const KEYS: &[Key] = &[
        Key::word(
            "kind",
            StimulusKind::MEANINGS,
            "What the indenter does: `ramp_and_hold`, `sine`, `chirp_linear` or `chirp_exponential`.",
        )
        .required("\"ramp_and_hold\""),
        Key::integer("repeats", 1, 1000, "How often it is done.").default("1"),
        Key::number("depth_m", Domain::DEPTH, "`ramp_and_hold`: the depth of the hold.")
            .required_without("depths_m", "0.004"),
        Key::numbers("depths_m", Domain::DEPTH, "`ramp_and_hold`: a depth for each of several holds.")
            .optional("[0.002, 0.004]", "one depth"),
        Key::number("ramp_s", Domain::DURATION, "`ramp_and_hold`: how long the way takes.")
            .default("0.5"),
        Key::number("hold_s", Domain::DURATION, "`ramp_and_hold`: how long it stays.")
            .default("20.0"),
        Key::number("amplitude_m", Domain::DEPTH, "`sine`, chirps: from the middle to an end.")
            .optional("0.0005", "another kind"),
        Key::number("pre_indentation_m", Domain::DEPTH, "`sine`, chirps: the middle.")
            .optional("0.002", "another kind"),
        Key::number(
            "frequency_hz",
            Domain::FREQUENCY,
            "`sine`: how often it swings; chirps: with which frequency they begin.",
        )
        .optional("1.0", "another kind, or several frequencies"),
        Key::numbers(
            "frequencies_hz",
            Domain::FREQUENCY,
            "`sine`: a frequency for each of several sines.",
        )
        .optional("[1.0, 2.0]", "one frequency"),
        Key::number(
            "end_frequency_hz",
            Domain::FREQUENCY,
            "Chirps: with which frequency they end.",
        )
        .optional("3.0", "another kind"),
        Key::number("duration_s", Domain::DURATION, "Chirps: how long they swing.")
            .optional("15.0", "15.0"),
        Key::number("cycles", CYCLES, "`sine`: how often it swings in all.").optional("10.0", "10.0"),
    ];

    /// One for each depth or frequency of a table.
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        const EXPECTED: &str = "`ramp_and_hold`, `sine`, `chirp_linear` or `chirp_exponential`";
        let kind = keys.word("kind", StimulusKind::WORDS)?;
        let stimuli = match kind.ok_or_else(|| keys.missing("kind", EXPECTED))? {
            StimulusKind::RampAndHold => holds(keys)?,
            StimulusKind::Sine => sines(keys)?,
            StimulusKind::ChirpLinear => chirp(keys, Sweep::Linear)?,
            StimulusKind::ChirpExponential => chirp(keys, Sweep::Exponential)?,
            StimulusKind::Uniaxial
            | StimulusKind::UniaxialTension
            | StimulusKind::PlanarTension
            | StimulusKind::SimpleShear
            | StimulusKind::Other => return Err(keys.invalid("kind", EXPECTED)),
        };
        let repeats = keys.integer("repeats")?.unwrap_or(1);
        let plan = |stimulus| Self { stimulus, repeats };
        Ok(stimuli.into_iter().map(plan).collect())
    }
}

const CYCLES: Domain =
    Domain::number("a number of cycles", [Excluded(0.0), Included(1e6)]).usually(0.5, 1000.0);

fn holds(keys: &Keys<'_>) -> Result<Vec<Stimulus>, Error> {
    let own = ["depth_m", "depths_m", "ramp_s", "hold_s"];
    only(keys, &own, "nothing: a ramp and hold has none")?;
    let ramp_s = keys.number("ramp_s")?.unwrap_or(0.5);
    let hold_s = keys.number("hold_s")?.unwrap_or(20.0);
    let hold = |depth_m| Stimulus::RampAndHold {
        depth_m,
        ramp_s,
        hold_s,
    };
    let depths = several(keys, ["depth_m", "depths_m"])?;
    Ok(depths.into_iter().map(hold).collect())
}

fn sines(keys: &Keys<'_>) -> Result<Vec<Stimulus>, Error> {
    let own = [
        "amplitude_m",
        "pre_indentation_m",
        "frequency_hz",
        "frequencies_hz",
        "cycles",
    ];
    only(keys, &own, "nothing: a sine has none")?;
    let [amplitude_m, pre_indentation_m] = swing(keys)?;
    let cycles = keys.number("cycles")?.unwrap_or(10.0);
    let sine = |frequency| Stimulus::Swing {
        amplitude_m,
        pre_indentation_m,
        sweep: Sweep::Constant(frequency),
        duration_s: cycles / frequency,
    };
    let frequencies = several(keys, ["frequency_hz", "frequencies_hz"])?;
    Ok(frequencies.into_iter().map(sine).collect())
}

fn chirp(keys: &Keys<'_>, sweep: fn([f64; 2]) -> Sweep) -> Result<Vec<Stimulus>, Error> {
    let own = [
        "amplitude_m",
        "pre_indentation_m",
        "frequency_hz",
        "end_frequency_hz",
        "duration_s",
    ];
    only(keys, &own, "nothing: a chirp has none")?;
    let [amplitude_m, pre_indentation_m] = swing(keys)?;
    Ok(vec![Stimulus::Swing {
        amplitude_m,
        pre_indentation_m,
        sweep: sweep([
            keys.required_number("frequency_hz")?,
            keys.required_number("end_frequency_hz")?,
        ]),
        duration_s: keys.number("duration_s")?.unwrap_or(15.0),
    }])
}

/// Amplitude and mean depth of an oscillation [m].
fn swing(keys: &Keys<'_>) -> Result<[f64; 2], Error> {
    Ok([
        keys.required_number("amplitude_m")?,
        keys.required_number("pre_indentation_m")?,
    ])
}

/// Rejects every key that belongs to another kind.
fn only(keys: &Keys<'_>, own: &[&str], why: &'static str) -> Result<(), Error> {
    const OF_ALL: [&str; 2] = ["kind", "repeats"];
    let is_foreign = |key: &&'static str| !own.contains(key) && !OF_ALL.contains(key);
    let mut foreign = StimulusPlan::KEYS
        .iter()
        .map(|key| key.name)
        .filter(is_foreign);
    foreign.try_for_each(|key| keys.refuse(key, why))
}

/// One number, or a list of them.
fn several(keys: &Keys<'_>, [one, many]: [&'static str; 2]) -> Result<Vec<f64>, Error> {
    match (keys.number(one)?, keys.numbers(many)?) {
        (Some(_), Some(_)) => Err(keys.given_twice(one, many)),
        (Some(one), None) => Ok(vec![one]),
        (None, Some(many)) if !many.is_empty() => Ok(many),
        _ => Err(keys.missing(one, format!("`{one}`, or a list `{many}`"))),
    }
}
