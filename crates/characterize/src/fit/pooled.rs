//! The mean over subjects, and where the mean of all such subjects lies.
//!
//! With n values of mean x̄ and standard deviation s, the mean of the population lies within
//!
//! ```text
//! x̄ ± t s/√n,   t of Student's distribution with n − 1 degrees of freedom [Student 1908]
//! ```
//!
//! with the probability asked for, exactly so where subjects differ as normal numbers do. Drawing few subjects
//! anew (a percentile bootstrap) cannot: of two it never sees more than these two, and its interval of 95 % holds
//! the mean half of the time.
//!
//! *How we know*: `fit::pooled::…`: the coverage of drawn populations.
//!
//! *Limits*: each value counts once, whatever its own error; subjects are independent of one another. Of a skewed
//! population the interval holds the mean less often: of lognormal ones, whose logarithm has the standard deviation
//! 0.5, 94, 92, 91 and 92 times in 100 for 2, 3, 5 and 10 subjects; with 0.8, 92, 88, 86 and 88 times.

use super::student::student_quantile;

/// A mean over subjects and how well it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PooledMean {
    /// The mean [unit of the values].
    pub mean: f64,
    /// The standard deviation between subjects [unit of the values]; none of one subject.
    pub deviation: Option<f64>,
    /// What holds the mean of all such subjects with the probability asked for [unit of the values]; none of one
    /// subject.
    pub interval: Option<[f64; 2]>,
}

/// The mean of `values`, one for each subject, and the interval that holds the mean of the population with the
/// probability `level` [-]. `None` without subjects.
pub fn pooled_mean(values: &[f64], level: f64) -> Option<PooledMean> {
    let count = values.len() as f64;
    if values.is_empty() {
        return None;
    }
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let deviation = (values.len() > 1).then(|| (squares / (count - 1.0)).sqrt());
    let interval = deviation.map(|deviation| {
        let reach = student_quantile(count - 1.0, level) * deviation / count.sqrt();
        [mean - reach, mean + reach]
    });
    Some(PooledMean {
        mean,
        deviation,
        interval,
    })
}
