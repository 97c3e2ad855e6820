//! The heart in the force of a hold: a line of its spectrum between 0.7 and 3 Hz.
//!
//! Relaxation is taken off as a constant, a slope and three exponentials with fixed times; the line is
//! the frequency with the most power in the rest, detected when that is 25 times the usual power of
//! the band (in white noise one hold in ten thousand). Its amplitude is that of a regression with
//! two harmonics, together with the relaxation.
//!
//! *How we know*: `ripple::…`.
//!
//! *Limits*: one steady frequency. A heart that changes its pace leaves a part of its ripple.

use std::f64::consts::TAU;

use super::regression::{regress, relaxation};
use super::{Segment, SegmentKind, noise};

/// Frequencies of a heart [Hz].
const HEART: [f64; 2] = [0.7, 3.0];
/// Shortest hold in which a line is looked for [s].
const SHORTEST: f64 = 3.0;
/// Lowest rate at which the fastest heart is seen [Hz].
const SLOWEST: f64 = 8.0;
/// Rate at which it is looked for [Hz].
const ENOUGH_RATE: f64 = 25.0;
/// Power of the line over the usual power [-].
const STANDS_OUT: f64 = 25.0;

/// A line in the spectrum of the force, as a heart makes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Ripple {
    /// Its frequency [Hz].
    pub frequency_hz: f64,
    /// Its amplitude [N], half from peak to peak.
    pub amplitude_n: f64,
    /// Standard error of the amplitude [N].
    pub amplitude_error_n: f64,
    /// First sample of the hold in which it was seen.
    pub first: usize,
    /// One past the last sample.
    pub end: usize,
    /// Coefficients of cosine and sine of the frequency and its multiples [N].
    harmonics: Vec<[f64; 2]>,
}

impl Ripple {
    /// The ripple [N] at `time` [s].
    pub fn force(&self, time: f64) -> f64 {
        let turn = TAU * self.frequency_hz * time;
        let harmonics = (1..).zip(&self.harmonics);
        harmonics
            .map(|(order, [cosine, sine])| {
                let (s, c) = (f64::from(order) * turn).sin_cos();
                cosine * c + sine * s
            })
            .sum()
    }

    /// Takes it out of the `force` [N] of its hold at these times [s].
    pub(super) fn remove(&self, time: &[f64], force: &mut [f64]) {
        let hold = self.first..self.end;
        for (value, time) in force[hold.clone()].iter_mut().zip(&time[hold]) {
            *value -= self.force(*time);
        }
    }

    /// Looks for it in the longest hold.
    pub(crate) fn find(time: &[f64], force: &[f64], segments: &[Segment]) -> Option<Self> {
        let length = |own: &Segment| time[own.end - 1] - time[own.first];
        let hold = segments
            .iter()
            .filter(|own| own.kind == SegmentKind::Hold)
            .max_by(|a, b| length(a).total_cmp(&length(b)))?;
        let samples = hold.first..hold.end;
        let rate = (samples.len() - 1) as f64 / length(hold);
        if length(hold) < SHORTEST || rate < SLOWEST {
            return None;
        }
        let hold = HoldForce::new(&time[samples.clone()], &force[samples.clone()]);
        let frequency = hold
            .averaged((rate / ENOUGH_RATE).floor() as usize)
            .line()?;
        let fit = regress(&hold.force, |sample| {
            let [a, b, c, d, e] = hold.relaxation(sample);
            let turn = TAU * frequency * hold.time[sample];
            let [(s1, c1), (s2, c2), (s3, c3)] =
                [1.0, 2.0, 3.0].map(|order: f64| (order * turn).sin_cos());
            [a, b, c, d, e, c1, s1, c2, s2, c3, s3]
        })?;
        let harmonics: Vec<_> = fit.coefficients[5..]
            .chunks(2)
            .map(|pair| [pair[0], pair[1]])
            .collect();
        Some(Self {
            frequency_hz: frequency,
            amplitude_n: harmonics[0][0].hypot(harmonics[0][1]),
            amplitude_error_n: fit.standard_errors[5].hypot(fit.standard_errors[6]) / 2f64.sqrt(),
            first: samples.start,
            end: samples.end,
            harmonics,
        })
    }
}

/// The force of a hold.
struct HoldForce {
    time: Vec<f64>,
    force: Vec<f64>,
}

impl HoldForce {
    fn new(time: &[f64], force: &[f64]) -> Self {
        Self {
            time: time.to_vec(),
            force: force.to_vec(),
        }
    }

    /// Means of `together` samples each.
    fn averaged(&self, together: usize) -> Self {
        let means = |values: &[f64]| {
            let parts = values.chunks_exact(together.max(1));
            parts
                .map(|part| part.iter().sum::<f64>() / part.len() as f64)
                .collect()
        };
        Self {
            time: means(&self.time),
            force: means(&self.force),
        }
    }

    fn relaxation(&self, sample: usize) -> [f64; 5] {
        let length = self.time[self.time.len() - 1] - self.time[0];
        relaxation((self.time[sample] - self.time[0]) / length)
    }

    /// The frequency [Hz] of a line that stands out.
    fn line(&self) -> Option<f64> {
        let trend = regress(&self.force, |sample| self.relaxation(sample))?;
        let left: Vec<f64> = (0..self.force.len())
            .map(|sample| {
                let columns = self.relaxation(sample);
                let along = columns.iter().zip(&trend.coefficients).map(|(x, y)| x * y);
                self.force[sample] - along.sum::<f64>()
            })
            .collect();
        let power = |frequency: f64| {
            let both = self
                .time
                .iter()
                .zip(&left)
                .fold([0.0; 2], |[c, s], (time, left)| {
                    let (sine, cosine) = (TAU * frequency * time).sin_cos();
                    [c + left * cosine, s + left * sine]
                });
            both[0].powi(2) + both[1].powi(2)
        };
        let length = self.time[self.time.len() - 1] - self.time[0];
        let steps = ((HEART[1] - HEART[0]) * 4.0 * length).ceil();
        let frequency = |step: usize| HEART[0] + (HEART[1] - HEART[0]) * step as f64 / steps;
        let powers: Vec<f64> = (0..=steps as usize)
            .map(|step| power(frequency(step)))
            .collect();
        let top = (0..powers.len()).max_by(|a, b| powers[*a].total_cmp(&powers[*b]))?;
        let stands_out = powers[top] > STANDS_OUT * noise::median(&powers);
        if !stands_out || top == 0 || top + 1 == powers.len() {
            return None;
        }
        Some(largest(power, frequency(top - 1), frequency(top + 1)))
    }
}

/// Where a function with one top between `low` and `high` is largest, by the golden section.
fn largest(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..40 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if function(left) < function(right) {
            low = left;
        } else {
            high = right;
        }
    }
    0.5 * (low + high)
}
