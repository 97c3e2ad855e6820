use super::Fit;

/// A misfit from which on a law is said to miss the curve [-].
const MISSES: f64 = 0.05;

/// The part of the measured values that a fit does not follow: its root mean square over the `largest` [-].
pub(crate) fn misfit(fit: &Fit, largest: f64) -> f64 {
    (fit.sum_of_squares() / fit.residuals.len() as f64).sqrt() / largest
}

/// The sentence on a law that misses the shape of `what` was measured; none when it does not.
pub(crate) fn missed(law: &str, what: &str, misfit: f64) -> Option<String> {
    (misfit > MISSES).then(|| {
        format!(
            "{law} misses the shape of the {what}: {:.0} % of the largest {what} on average",
            100.0 * misfit
        )
    })
}
