//! The response to a chirp: a transfer function with its coherence.
//!
//! Depth and force are freed of relaxation (a constant, a slope and three exponentials) and transformed
//! whole, at the multiples of 1/T, T the length of the chirp. With the transforms X of the depth and Y of
//! the force, and sums over nine neighbouring multiples [Daniell 1946],
//!   H(f) = Σ X* Y / Σ X* X,  coherence = |Σ X* Y|² / (Σ X* X · Σ Y* Y):
//! H takes all noise to be in the force. Windows in time would be no longer than the memory of the
//! tissue, and a chirp passes each frequency but once. The transforms are direct, on the few
//! frequencies wanted.
//!
//! *How we know*: `sinusoid::chirps_give_the_same_stiffness`, `sinusoid::noise_is_marked`.
//!
//! *Limits*: no finer in frequency than 9/T. Where the chirp has little power, at its ends, the
//! coherence shows how much of the response is noise.

use std::f64::consts::TAU;

use super::sinusoid::wrapped;
use crate::CleanRecording;
use crate::clean::Segment;
use crate::clean::regression::{regress, relaxation};

/// Multiples of the lowest frequency that are summed.
const TOGETHER: usize = 9;
/// Coherence below which an answer is not to be trusted [-].
pub const COHERENT: f64 = 0.9;

/// The answer to a chirp.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(transparent)]
pub struct Sweep {
    /// By ascending frequency.
    pub points: Vec<SweepPoint>,
}

/// The answer at one frequency.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SweepPoint {
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// Amplitude of the force over that of the depth [N/m].
    pub stiffness_n_per_m: f64,
    /// Phase of the force before that of the depth [rad], positive when the force leads.
    pub phase_rad: f64,
    /// Part of the force's power that goes with the depth [-].
    pub coherence: f64,
    /// Whether the coherence is 0.9 or more.
    pub is_coherent: bool,
}

impl Sweep {
    pub(super) fn of(
        recording: &CleanRecording,
        segment: &Segment,
        [first, last]: [f64; 2],
        warnings: &mut Vec<String>,
    ) -> Option<Self> {
        let (low, high) = (first.min(last), first.max(last));
        let samples = segment.first..segment.end;
        let time = &recording.time[samples.clone()];
        let length = time[time.len() - 1] - time[0];
        let multiples: Vec<f64> = ((low * length).ceil() as usize
            ..=(high * length).floor() as usize)
            .map(|multiple| multiple as f64 / length)
            .collect();
        if multiples.len() < TOGETHER {
            warnings.push(format!(
                "the chirp from {first:.2} to {last:.2} Hz is too short to be analyzed; sweep for {:.0} s or more",
                TOGETHER as f64 / (high - low)
            ));
            return None;
        }
        let depth = without_relaxation(time, &recording.depth[samples.clone()])?;
        let force = without_relaxation(time, &recording.force[samples])?;
        let points: Vec<_> = multiples
            .chunks_exact(TOGETHER)
            .map(|frequencies| point(time, [&depth, &force], frequencies))
            .collect();
        let poor = points.iter().filter(|point| !point.is_coherent).count();
        if poor > 0 {
            warnings.push(format!(
                "at {poor} of {} frequencies of the chirp the force goes with the depth by less than {COHERENT}; they are marked",
                points.len()
            ));
        }
        Some(Self { points })
    }
}

fn without_relaxation(time: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    let (start, end) = (time.first()?, time.last()?);
    let columns = |sample: usize| relaxation((time[sample] - start) / (end - start));
    let fit = regress(values, columns)?;
    let left = values.iter().enumerate().map(|(sample, value)| {
        let along = columns(sample).into_iter().zip(&fit.coefficients);
        value
            - along
                .map(|(column, coefficient)| column * coefficient)
                .sum::<f64>()
    });
    Some(left.collect())
}

/// Real and imaginary part of the transforms of depth and force at a frequency [Hz].
fn transforms(time: &[f64], signals: [&[f64]; 2], frequency: f64) -> [[f64; 2]; 2] {
    let mut sums = [[0.0; 2]; 2];
    for (sample, time) in time.iter().enumerate() {
        let (sine, cosine) = (TAU * frequency * time).sin_cos();
        for (sum, signal) in sums.iter_mut().zip(signals) {
            sum[0] += signal[sample] * cosine;
            sum[1] -= signal[sample] * sine;
        }
    }
    sums
}

fn point(time: &[f64], signals: [&[f64]; 2], frequencies: &[f64]) -> SweepPoint {
    let mut cross = [0.0; 2];
    let (mut depth_power, mut force_power) = (0.0, 0.0);
    for frequency in frequencies {
        let [x, y] = transforms(time, signals, *frequency);
        cross[0] += x[0] * y[0] + x[1] * y[1];
        cross[1] += x[0] * y[1] - x[1] * y[0];
        depth_power += x[0] * x[0] + x[1] * x[1];
        force_power += y[0] * y[0] + y[1] * y[1];
    }
    let size = cross[0].hypot(cross[1]);
    let over = |power: f64| if power > 0.0 { size / power } else { 0.0 };
    let coherence = over(depth_power) * over(force_power);
    SweepPoint {
        frequency_hz: frequencies.iter().sum::<f64>() / frequencies.len() as f64,
        stiffness_n_per_m: over(depth_power),
        phase_rad: wrapped(cross[1].atan2(cross[0])),
        coherence,
        is_coherent: coherence >= COHERENT,
    }
}
