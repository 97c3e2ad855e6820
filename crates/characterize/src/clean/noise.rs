//! Noise of a signal from sample to sample.

/// Samples that are enough for a mean with an error.
pub(crate) const ENOUGH: usize = 5;
/// Parts into which a signal is cut to see whether it goes anywhere.
const PARTS: usize = 40;
/// Steps of an encoder from sample to sample that are few, and how near they are to whole ones [-].
const FEW_STEPS: f64 = 8.5;
const WHOLE: f64 = 0.02;
/// How far apart means must lie, in their own standard errors [-].
const FAR: f64 = 8.0;

/// Standard deviation of the noise, from second differences, which a smooth curve hardly has: their
/// median size is 0.6745 · √6 deviations.
pub(crate) fn deviation(values: &[f64]) -> f64 {
    let differences: Vec<f64> = values
        .windows(3)
        .map(|three| (three[0] - 2.0 * three[1] + three[2]).abs())
        .collect();
    if differences.is_empty() {
        return 0.0;
    }
    median(&differences) / (0.6745 * 6f64.sqrt())
}

/// The step of an encoder that flickers in `values`: the smallest way from sample to sample, if nearly all ways
/// are few whole ones of it and many go back and forth; else zero.
pub(super) fn step(values: &[f64]) -> f64 {
    let ways: Vec<f64> = values
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|way| *way != 0.0)
        .collect();
    let step = ways
        .iter()
        .map(|way| way.abs())
        .fold(f64::INFINITY, f64::min);
    let is_whole = |way: &&f64| {
        let steps = way.abs() / step;
        steps < FEW_STEPS && (steps - steps.round()).abs() < WHOLE
    };
    let whole = ways.iter().filter(is_whole).count();
    let turns = ways
        .windows(2)
        .filter(|pair| pair[0] * pair[1] < 0.0)
        .count();
    let flickers = 10 * whole > 9 * ways.len() && 10 * turns > ways.len();
    if flickers { step } else { 0.0 }
}

/// Whether the values go anywhere beyond their noise.
pub(super) fn exceeds_noise(values: &[f64]) -> bool {
    let length = values.len().div_ceil(PARTS);
    let means = values
        .chunks(length)
        .map(|part| part.iter().sum::<f64>() / part.len() as f64);
    let low = means.clone().fold(f64::INFINITY, f64::min);
    let high = means.fold(f64::NEG_INFINITY, f64::max);
    high - low > FAR * deviation(values) / (length as f64).sqrt()
}

/// The median; zero of nothing.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

/// The running median of five, which leaves no trace of a single wild sample.
pub(super) fn without_spikes(values: &[f64]) -> Vec<f64> {
    let around = |sample: usize| {
        let near = sample.saturating_sub(2)..(sample + 3).min(values.len());
        // Ends and short signals stay as they are.
        if near.len() < 5 {
            return values[sample];
        }
        median(&values[near])
    };
    (0..values.len()).map(around).collect()
}
