//! Organs of known law that a probe swings in, as section 5.4.3 did.

use std::f64::consts::TAU;

use palpate_characterize::analyze::Sinusoid;
use palpate_characterize::inverse::SoughtLaw;
use palpate_characterize::{CleanRecording, analyze};
use palpate_mechanics::finite_elements::indentation::History;
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::Error;
use crate::published::{SECTION_6_4_5, TABLE_6_4, prony};
use crate::virtual_rig::{RADIUS, RAMP, elastic, recorded};

/// The organs of figure 5-16.
pub(super) const ORGANS: [&str; 3] = ["liver", "kidney", "esophagus"];

/// 2 mm from peak to peak about 2 mm [m].
const AMPLITUDE: f64 = 1e-3;
const DEPTH: f64 = 2e-3;
/// How long the organ relaxes before the probe swings [s].
const REST: f64 = 20.0;
/// How often it swings.
const PERIODS: f64 = 10.0;
/// Samples per second, as the source's [Hz].
const RATE: f64 = 1000.0;

/// What the notes say of the laws.
pub(super) const NOTE: &str = "the source draws this without numbers; ours: `analyze` on a virtual recording, 2 mm from peak \
    to peak about 2 mm at 1 kHz with noise of 0.225 mN, of the printed laws read as instantaneous: neo-Hookean of table 6-4 with table 6-3 for liver and \
    kidney, (6.1) with the modulus and the term of section 6.4.5 for the esophagus";

/// An organ under the probe.
pub(super) struct Organ {
    name: &'static str,
    curve: IndentationCurve,
    series: PronySeries,
}

impl Organ {
    /// With the printed law of the organ of this `name`; none without one.
    pub(super) fn printed(name: &'static str) -> Result<Option<Self>, Error> {
        let printed = match name {
            "esophagus" => esophagus()?,
            _ => solid(name)?,
        };
        Ok(printed.map(|(curve, series)| Self {
            name,
            curve,
            series,
        }))
    }

    /// What is recorded at `frequency` [Hz], and what it shows.
    pub(super) fn swung(
        &self,
        frequency: f64,
    ) -> Result<(CleanRecording, Option<Sinusoid>), Error> {
        let end = REST + PERIODS / frequency;
        let times: Vec<f64> = (0..=(RATE * end).round() as usize)
            .map(|i| i as f64 / RATE)
            .collect();
        let depth = |time: f64| match time < REST {
            true => DEPTH * (time / RAMP).min(1.0),
            false => DEPTH + AMPLITUDE * (TAU * frequency * (time - REST)).sin(),
        };
        let course = History {
            depths: times.iter().map(|time| depth(*time)).collect(),
            times,
        };
        let felt = self
            .curve
            .relaxed(&self.series, &course.times, &course.depths);
        let recording = recorded((self.name, 0), &course, &felt, 1)?;
        let found = analyze(&recording).sinusoids.first().copied();
        Ok((recording, found))
    }
}

fn solid(name: &str) -> Result<Option<(IndentationCurve, PronySeries)>, Error> {
    let cells = ["final_c10_pa", "depth_mm"].map(|column| TABLE_6_4.value(name, column));
    let [Some(c10), Some(depth_mm)] = cells else {
        return Ok(None);
    };
    let curve = elastic(SoughtLaw::NeoHookean, (c10, 0.0))?;
    Ok(Some((curve, prony(name, depth_mm as u32)?)))
}

fn esophagus() -> Result<Option<(IndentationCurve, PronySeries)>, Error> {
    let cells = ["youngs_modulus_kpa", "prony_g1", "relaxation_time_s"];
    let [Some(modulus), Some(g), Some(tau)] = cells.map(|column| SECTION_6_4_5.first(column))
    else {
        return Ok(None);
    };
    let depth = DEPTH + AMPLITUDE;
    // (6.1) with ν = ½.
    let force = 1e3 * modulus / 0.75 * 2.0 * RADIUS * depth;
    let curve = IndentationCurve::through(&[depth], &[force]);
    Ok(Some((curve, PronySeries::new(&[(g, tau)])?)))
}
