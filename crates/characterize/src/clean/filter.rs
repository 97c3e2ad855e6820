//! A zero-phase low-pass filter.
//!
//! A filter of third order [Butterworth 1930], |H(f)|² = 1 / (1 + (f/f_c)⁶), made digital by the bilinear
//! transform with its cut-off unchanged, f → tan(π f Δt), and run forward and then backward as in
//! the source: the phases cancel and the gain is |H|², one half at the cut-off.
//!
//! *How we know*: `filter::gain_is_that_of_butterworth`, `filter::nothing_is_shifted`,
//! `filter::constants_and_lines_are_kept`.
//!
//! *Limits*: even sampling. Beyond its ends a signal is taken to go on turned about the end of a line
//! through its last samples, over five times the inverse cut-off or as far as the signal is long; nearer
//! to an end than the inverse cut-off what comes out rests on that.

use std::f64::consts::PI;

use crate::Error;

/// The signal beyond an end that is run through, in inverse cut-offs [-]: the slowest pole has then
/// lost all but 1.5e-7 of what it began with, exp(−π · 5).
const LEAD_IN: f64 = 5.0;

/// A low-pass filter for one rate of sampling.
#[derive(Debug, Clone, PartialEq)]
pub struct LowPass {
    sections: [Section; 2],
    lead_in: usize,
    /// Samples of an inverse cut-off.
    end: usize,
}

/// y = b₀ x + b₁ x₁ + b₂ x₂ − a₁ y₁ − a₂ y₂, in the transposed form with two stored sums.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

impl LowPass {
    /// With a `cutoff` [Hz] for `rate` [Hz] samples a second.
    ///
    /// # Errors
    /// Unless the cut-off is above zero and below half the rate.
    pub fn new(cutoff: f64, rate: f64) -> Result<Self, Error> {
        if !(cutoff > 0.0 && cutoff < 0.5 * rate && rate.is_finite()) {
            return Err(Error::BadCutoff { cutoff, rate });
        }
        let w = (PI * cutoff / rate).tan();
        // s + 1 and s² + s + 1, s = (1 − z⁻¹) / (w (1 + z⁻¹)).
        let first = 1.0 + w;
        let second = 1.0 + w + w * w;
        let square = w * w / second;
        let sections = [
            Section {
                b: [w / first, w / first, 0.0],
                a: [(w - 1.0) / first, 0.0],
            },
            Section {
                b: [square, 2.0 * square, square],
                a: [2.0 * (w * w - 1.0) / second, (1.0 - w + w * w) / second],
            },
        ];
        let lead_in = (LEAD_IN * rate / cutoff).ceil() as usize;
        Ok(Self {
            sections,
            lead_in,
            end: (rate / cutoff).ceil() as usize,
        })
    }

    /// The signal forward and backward through the filter.
    pub fn smooth(&self, signal: &[f64]) -> Vec<f64> {
        if signal.is_empty() {
            return Vec::new();
        }
        // Turned about a last sample as it is, the noise of that one would stay.
        let near = self.end.min(signal.len());
        let first = end_of_line(signal[..near].iter().rev());
        let last = end_of_line(signal[signal.len() - near..].iter());
        let lead_in = self.lead_in.min(signal.len() - 1);
        let before = signal[1..=lead_in].iter().rev().map(|x| 2.0 * first - x);
        let after = signal[signal.len() - 1 - lead_in..signal.len() - 1]
            .iter()
            .rev()
            .map(|x| 2.0 * last - x);
        let mut all: Vec<f64> = before.chain(signal.iter().copied()).chain(after).collect();
        for _ in 0..2 {
            for section in &self.sections {
                section.run(&mut all);
            }
            all.reverse();
        }
        all[lead_in..lead_in + signal.len()].to_vec()
    }
}

/// The last value of the straight line nearest to `signal`.
fn end_of_line<'s>(signal: impl ExactSizeIterator<Item = &'s f64>) -> f64 {
    let count = signal.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let (mut sum, mut moment) = (0.0, 0.0);
    for (place, value) in signal.enumerate() {
        sum += value;
        moment += (place as f64 - middle) * value;
    }
    // Σ (k − m)² over 0 .. n − 1.
    let squares = count * (count * count - 1.0) / 12.0;
    let slope = if squares > 0.0 { moment / squares } else { 0.0 };
    sum / count + slope * middle
}

impl Section {
    /// From rest at the first value, since the gain of a constant is one.
    fn run(&self, signal: &mut [f64]) {
        let start = signal[0];
        let mut second = (self.b[2] - self.a[1]) * start;
        let mut first = (self.b[1] - self.a[0]) * start + second;
        for value in signal {
            let x = *value;
            *value = self.b[0] * x + first;
            first = self.b[1] * x - self.a[0] * *value + second;
            second = self.b[2] * x - self.a[1] * *value;
        }
    }
}
