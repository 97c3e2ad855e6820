use crate::words::words;
use crate::{Domain, Error, Keys};

words! {
    /// What the indenter does.
    pub enum StimulusKind {
        /// It goes to a depth and stays there.
        RampAndHold = "ramp_and_hold",
        /// It swings with one frequency.
        Sine = "sine",
        /// It swings with a frequency that grows linearly.
        ChirpLinear = "chirp_linear",
        /// It swings with a frequency that grows exponentially.
        ChirpExponential = "chirp_exponential",
    }
}

/// A stimulus and how often it is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StimulusPlan {
    /// What the indenter does.
    pub kind: StimulusKind,
    /// The depth of a hold, or the amplitude of a swing [m].
    pub amplitude_m: f64,
    /// The depth that is swung about [m]; zero for a hold.
    pub pre_indentation_m: f64,
    /// Duration of the ramp [s]; zero for a swing.
    pub ramp_s: f64,
    /// How long it is held, or a chirp takes [s]; zero for a sine.
    pub duration_s: f64,
    /// Frequency of a sine, or the one with which a chirp begins [Hz]; zero for a hold.
    pub frequency_hz: f64,
    /// Frequency with which a chirp ends [Hz]; zero for others.
    pub end_frequency_hz: f64,
    /// How often a sine swings [-]; zero for others.
    pub cycles: f64,
    /// How often it is done.
    pub repeats: u64,
}

impl StimulusPlan {
    pub(super) const KEYS: &[&str] = &[
        "kind",
        "depth_m",
        "depths_m",
        "ramp_s",
        "hold_s",
        "amplitude_m",
        "pre_indentation_m",
        "frequency_hz",
        "frequencies_hz",
        "end_frequency_hz",
        "duration_s",
        "cycles",
        "repeats",
    ];

    /// One for each depth or frequency of a table.
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        let kind = keys.word("kind", StimulusKind::WORDS)?;
        let kind = kind.ok_or_else(|| {
            keys.missing(
                "kind",
                "`ramp_and_hold`, `sine`, `chirp_linear` or `chirp_exponential`",
            )
        })?;
        let repeats = keys.integer("repeats", 1..=1000)?.unwrap_or(1);
        let plan = Self {
            kind,
            amplitude_m: 0.0,
            pre_indentation_m: 0.0,
            ramp_s: 0.0,
            duration_s: 0.0,
            frequency_hz: 0.0,
            end_frequency_hz: 0.0,
            cycles: 0.0,
            repeats,
        };
        match kind {
            StimulusKind::RampAndHold => plan.holds(keys),
            StimulusKind::Sine => plan.sines(keys),
            StimulusKind::ChirpLinear | StimulusKind::ChirpExponential => plan.chirps(keys),
        }
    }

    fn holds(self, keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        refuse(
            keys,
            &[
                "amplitude_m",
                "pre_indentation_m",
                "frequency_hz",
                "frequencies_hz",
                "end_frequency_hz",
                "duration_s",
                "cycles",
            ],
            "a ramp and hold has none",
        )?;
        let ramp_s = keys.number("ramp_s", Domain::POSITIVE)?.unwrap_or(0.5);
        let duration_s = keys.number("hold_s", Domain::POSITIVE)?.unwrap_or(20.0);
        let each = several(keys, ["depth_m", "depths_m"])?.into_iter();
        let hold = |amplitude_m| Self {
            amplitude_m,
            ramp_s,
            duration_s,
            ..self
        };
        Ok(each.map(hold).collect())
    }

    fn sines(self, keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        let of_others = [
            "depth_m",
            "depths_m",
            "ramp_s",
            "hold_s",
            "end_frequency_hz",
            "duration_s",
        ];
        refuse(keys, &of_others, "a sine has none")?;
        let swing = self.swing(keys)?;
        let cycles = keys.number("cycles", Domain::POSITIVE)?.unwrap_or(10.0);
        let each = several(keys, ["frequency_hz", "frequencies_hz"])?.into_iter();
        let sine = |frequency_hz| Self {
            frequency_hz,
            cycles,
            ..swing
        };
        Ok(each.map(sine).collect())
    }

    fn chirps(self, keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        let of_others = [
            "depth_m",
            "depths_m",
            "ramp_s",
            "hold_s",
            "frequencies_hz",
            "cycles",
        ];
        refuse(keys, &of_others, "a chirp has none")?;
        Ok(vec![Self {
            frequency_hz: keys.required_number("frequency_hz", Domain::POSITIVE)?,
            end_frequency_hz: keys.required_number("end_frequency_hz", Domain::POSITIVE)?,
            duration_s: keys.number("duration_s", Domain::POSITIVE)?.unwrap_or(15.0),
            ..self.swing(keys)?
        }])
    }

    fn swing(self, keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            amplitude_m: keys.required_number("amplitude_m", Domain::POSITIVE)?,
            pre_indentation_m: keys.required_number("pre_indentation_m", Domain::POSITIVE)?,
            ..self
        })
    }
}

fn refuse(keys: &Keys<'_>, unknown: &[&'static str], why: &'static str) -> Result<(), Error> {
    unknown.iter().try_for_each(|key| keys.refuse(key, why))
}

/// One number, or a list of them.
fn several(keys: &Keys<'_>, [one, many]: [&'static str; 2]) -> Result<Vec<f64>, Error> {
    match (
        keys.number(one, Domain::POSITIVE)?,
        keys.numbers(many, Domain::POSITIVE)?,
    ) {
        (Some(_), Some(_)) => Err(keys.given_twice(one, many)),
        (Some(one), None) => Ok(vec![one]),
        (None, Some(many)) if !many.is_empty() => Ok(many),
        _ => Err(keys.missing(one, format!("`{one}`, or a list `{many}`"))),
    }
}
