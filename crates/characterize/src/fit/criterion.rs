use super::Fit;

/// Akaike's criterion with the correction for few samples [Hurvich and Tsai 1989], as if the samples were
/// `effective_samples` [-] independent ones. Of several models of the same data, asked with the same
/// `effective_samples`, the one with the least is to be preferred.
pub fn information_criterion(fit: &Fit, effective_samples: f64) -> f64 {
    // The size of the noise is a parameter too.
    let count = fit.chosen().len() as f64 + 1.0;
    let mean_square = fit.sum_of_squares() / fit.residuals.len() as f64;
    let left = (effective_samples - count - 1.0).max(f64::MIN_POSITIVE);
    effective_samples * mean_square.ln() + 2.0 * count * (1.0 + (count + 1.0) / left)
}
