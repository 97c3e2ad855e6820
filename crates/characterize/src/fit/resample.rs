//! Uncertainty by repetition: other noise.
//!
//! Fits are repeated on residuals r(p) − r̂ + e, which are those of data whose noise is e. For
//! [`block_bootstrap`] e is put together from runs of the residuals themselves [Künsch 1989], for
//! [`noise_study`] it is drawn.

use nalgebra::DMatrix;

use super::{Fit, Random, Settings, least_squares_with_jacobian};

/// How often something is drawn, and from which seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Draws {
    /// How many times.
    pub count: usize,
    /// The seed; the same gives the same.
    pub seed: u64,
}

/// The parameters' values in repeated fits.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// The values of all parameters, for each fit that could be made.
    pub values: Vec<Vec<f64>>,
    /// How many fits could not.
    pub failed: usize,
}

impl Spread {
    /// What holds the middle part `level` of a parameter's values [its unit].
    pub fn interval(&self, parameter: usize, level: f64) -> [f64; 2] {
        let values = self.values.iter().map(|values| values[parameter]);
        middle(values.collect(), level)
    }
}

/// Fits of the same model to other residuals: runs of `block` samples, drawn from the recording they belong
/// to. A block should hold several correlation times. `recordings` are the lengths of the recordings.
pub fn block_bootstrap(
    fit: &Fit,
    recordings: &[usize],
    block: usize,
    draws: Draws,
    settings: &Settings,
    evaluate: impl FnMut(&[f64], &mut [f64], &mut DMatrix<f64>) -> Option<()>,
) -> Spread {
    let count = fit.residuals.len();
    // The fit has taken part of the noise.
    let left = (count - fit.chosen().len()).max(1);
    let raise = (count as f64 / left as f64).sqrt();
    let drawn = |random: &mut Random, noise: &mut Vec<f64>| {
        let mut start = 0;
        for &length in recordings {
            let block = block.clamp(1, length.max(1));
            while noise.len() < start + length {
                let first = start + random.below(length - block + 1);
                let rest = block.min(start + length - noise.len());
                noise.extend(fit.residuals[first..first + rest].iter().map(|r| raise * r));
            }
            start += length;
        }
    };
    repeat(fit, draws, settings, drawn, evaluate)
}

/// Fits to what the model itself gives at the parameters of `fit`, with independent normal noise of the
/// standard deviation `noise` [unit of the residuals] (6.4.6).
pub fn noise_study(
    fit: &Fit,
    noise: f64,
    draws: Draws,
    settings: &Settings,
    evaluate: impl FnMut(&[f64], &mut [f64], &mut DMatrix<f64>) -> Option<()>,
) -> Spread {
    let count = fit.residuals.len();
    let drawn = |random: &mut Random, values: &mut Vec<f64>| {
        values.extend((0..count).map(|_| noise * random.normal()));
    };
    repeat(fit, draws, settings, drawn, evaluate)
}

fn repeat(
    fit: &Fit,
    draws: Draws,
    settings: &Settings,
    drawn: impl Fn(&mut Random, &mut Vec<f64>),
    mut evaluate: impl FnMut(&[f64], &mut [f64], &mut DMatrix<f64>) -> Option<()>,
) -> Spread {
    let mut random = Random::new(draws.seed);
    let mut noise = Vec::with_capacity(fit.residuals.len());
    let mut spread = Spread {
        values: Vec::with_capacity(draws.count),
        failed: 0,
    };
    for _ in 0..draws.count {
        noise.clear();
        drawn(&mut random, &mut noise);
        let with_noise = |values: &[f64], found: &mut [f64], jacobian: &mut DMatrix<f64>| {
            evaluate(values, found, jacobian)?;
            for (i, residual) in found.iter_mut().enumerate() {
                *residual += noise[i] - fit.residuals[i];
            }
            Some(())
        };
        let samples = fit.residuals.len();
        match least_squares_with_jacobian(&fit.parameters, samples, settings, with_noise) {
            Ok(again) => spread
                .values
                .push(again.parameters.iter().map(|p| p.value).collect()),
            Err(_) => spread.failed += 1,
        }
    }
    spread
}

/// The middle part `level` of some values.
fn middle(mut values: Vec<f64>, level: f64) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1) as f64;
    [0.5 - 0.5 * level, 0.5 + 0.5 * level].map(|part| {
        let place = part * last;
        let (below, above) = (place.floor(), place.ceil());
        let (low, high) = (values[below as usize], values[above as usize]);
        low + (place - below) * (high - low)
    })
}
