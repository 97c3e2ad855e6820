//! Organs of known law under a swinging probe, as in section 5.4.3.

use std::f64::consts::TAU;

use palpate_characterize::analyze::Sinusoid;
use palpate_characterize::inverse::CandidateLaw;
use palpate_characterize::{CleanRecording, analyze};
use palpate_mechanics::finite_elements::indentation::History;
use palpate_mechanics::{IndentationCurve, PronySeries};

use crate::Error;
use crate::published::{cell, prony};
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

/// An organ under the probe.
pub(super) struct Organ {
    name: &'static str,
    curve: IndentationCurve,
    series: PronySeries,
}

impl Organ {
    /// With the printed law of the organ of this `name`.
    pub(super) fn printed(name: &'static str) -> Result<Self, Error> {
        let (curve, series) = match name {
            "esophagus" => esophagus()?,
            _ => solid(name)?,
        };
        Ok(Self {
            name,
            curve,
            series,
        })
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
        let forces = self
            .curve
            .relaxed(&self.series, &course.times, &course.depths);
        let recording = recorded(self.name, 0, &course, &forces, 1)?;
        let found = analyze(&recording).sinusoids.first().copied();
        Ok((recording, found))
    }
}

fn solid(name: &str) -> Result<(IndentationCurve, PronySeries), Error> {
    let c10 = cell(&format!("table-6-4 {name} final_c10_pa"))?;
    let depth_mm = cell(&format!("table-6-4 {name} depth_mm"))?;
    let curve = elastic(CandidateLaw::NeoHookean, c10, &[])?;
    Ok((curve, prony(name, depth_mm as u32)?))
}

fn esophagus() -> Result<(IndentationCurve, PronySeries), Error> {
    let modulus = cell("section-6-4-5 youngs_modulus_kpa")?;
    let term = (
        cell("section-6-4-5 prony_g1")?,
        cell("section-6-4-5 relaxation_time_s")?,
    );
    let depth = DEPTH + AMPLITUDE;
    // (6.1) with ν = ½.
    let force = 1e3 * modulus / 0.75 * 2.0 * RADIUS * depth;
    let curve = IndentationCurve::through(&[depth], &[force]);
    Ok((curve, PronySeries::new(&[term])?))
}
