use super::Fit;

/// Akaike's criterion with the correction for few samples [Hurvich and Tsai 1989], as if the samples were
/// `effective_samples` [-] independent ones. Of several models of the same data, asked with the same
/// `effective_samples`, the one with the least is to be preferred.
pub fn information_criterion(fit: &Fit, effective_samples: f64) -> f64 {
    // The size of the noise is a parameter too, and one that ended on a bound was free to go elsewhere.
    let count = fit.free() as f64 + 1.0;
    let mean_square = fit.sum_of_squares() / fit.residuals.len() as f64;
    let left = (effective_samples - count - 1.0).max(f64::MIN_POSITIVE);
    effective_samples * mean_square.ln() + 2.0 * count * (1.0 + (count + 1.0) / left)
}

/// By how much a model with more parameters must be better [-]: "strong" in [Burnham and Anderson 2002].
pub const MIN_IMPROVEMENT: f64 = 10.0;
/// Samples for each parameter that are taken for granted [-]: what no model follows looks like noise of which
/// hardly two samples are independent.
const ENOUGH: f64 = 4.0;

/// Which of `fits` to the same data is to be preferred: of those that none beats by much, the best of those with the
/// fewest parameters; and the criterion of each. All are compared as if the noise had `effective_samples` [-] independent
/// samples: those of the nearest fit, which leaves hardly more than noise.
pub fn simplest(fits: &[&Fit], effective_samples: f64) -> (usize, Vec<f64>) {
    let most = fits.iter().map(|fit| fit.free()).max().unwrap_or(0);
    let samples = effective_samples.max(ENOUGH * most as f64);
    let each: Vec<f64> = fits
        .iter()
        .map(|fit| information_criterion(fit, samples))
        .collect();
    let least = each.iter().copied().fold(f64::INFINITY, f64::min);
    let near = (0..fits.len()).filter(|&place| each[place] <= least + MIN_IMPROVEMENT);
    let simplest = near.min_by(|&a, &b| {
        let fewest = fits[a].free().cmp(&fits[b].free());
        fewest.then(each[a].total_cmp(&each[b]))
    });
    (simplest.unwrap_or(0), each)
}
