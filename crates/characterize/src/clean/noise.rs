//! How much a signal trembles from sample to sample.

/// Samples that are enough for a mean with an error.
pub(super) const ENOUGH: usize = 5;
/// Parts into which a signal is cut to see whether it goes anywhere.
const PARTS: usize = 40;
/// How far apart means must lie, in their own standard errors [-].
const FAR: f64 = 8.0;

/// Standard deviation of the noise, from second differences, which a smooth curve hardly has: their
/// median size is 0.6745 · √6 deviations.
pub(super) fn deviation(values: &[f64]) -> f64 {
    let differences: Vec<f64> = values
        .windows(3)
        .map(|three| (three[0] - 2.0 * three[1] + three[2]).abs())
        .collect();
    if differences.is_empty() {
        return 0.0;
    }
    median(&differences) / (0.6745 * 6f64.sqrt())
}

/// Whether the values go anywhere beyond their noise.
pub(super) fn stands_out(values: &[f64]) -> bool {
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
