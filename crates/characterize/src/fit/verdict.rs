//! How well each parameter is known, decided from its numbers in one place, for texts, answers and reports alike.
//!
//! A standard error of more than a quarter of the value says only that the parameter is hardly known. A
//! correlation ρ with another parameter says how much smaller the error would be if the other were known: by
//! the factor √(1 − ρ²). From |ρ| = √0.9 on the variance is ten times what it would be then, the inflation from
//! which a parameter does not count as known by itself [Marquardt 1970].
//!
//! *How we know*: `fit::words::…`.
//!
//! *Limits*: correlations two by two; three parameters that go together only as three are seen by
//! [`warnings`](super::warnings) alone.

use nalgebra::DMatrix;

/// A relative standard error above which a parameter counts as hardly known [-].
pub const HARDLY_KNOWN: f64 = 0.25;
/// A correlation from which on two parameters are known together and not each by itself [-]: √0.9.
pub const CORRELATED: f64 = 0.948_683_298_050_513_8;

/// How well a parameter is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// By itself.
    Known,
    /// Its error goes with that of another: what one gains the other loses, or gains too.
    Correlated {
        /// The place of the other, that of the largest correlation.
        with: usize,
        /// Their correlation [-].
        correlation: f64,
    },
    /// Its standard error is more than [`HARDLY_KNOWN`] of its value.
    HardlyKnown,
    /// It has no error: it ended on a bound, or was fixed.
    NoEstimate,
}

/// The verdict on each parameter, from its standard error relative to its size [-] (none where it has none), and
/// from the correlations of all, in the same order.
pub fn verdicts(relative_errors: &[Option<f64>], correlations: &DMatrix<f64>) -> Vec<Verdict> {
    let has_error = |place: usize| relative_errors[place].is_some();
    let of = |(place, relative): (usize, &Option<f64>)| {
        let Some(relative) = relative else {
            return Verdict::NoEstimate;
        };
        if relative.is_nan() || *relative > HARDLY_KNOWN {
            return Verdict::HardlyKnown;
        }
        let others = (0..relative_errors.len()).filter(|&other| other != place && has_error(other));
        let strongest = others
            .map(|other| (other, correlations[(place, other)]))
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        match strongest {
            Some((with, correlation)) if correlation.abs() >= CORRELATED => {
                Verdict::Correlated { with, correlation }
            }
            _ => Verdict::Known,
        }
    };
    relative_errors.iter().enumerate().map(of).collect()
}

/// The pairs of parameters whose errors go together so far that neither is known by itself, by their places, each with
/// a sentence that calls them by their `names`.
pub fn correlated_pairs(
    names: &[String],
    correlations: &DMatrix<f64>,
) -> Vec<([usize; 2], String)> {
    let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
    let close = pairs.filter(|&(i, j)| correlations[(i, j)].abs() >= CORRELATED);
    close
        .map(|(i, j)| {
            let correlation = correlations[(i, j)];
            let times = (1.0 - correlation * correlation).max(0.0).sqrt().recip();
            let times = match times {
                times if times < 100.0 => format!("{times:.0} times"),
                _ => "more than 100 times".to_owned(),
            };
            let said = format!(
                "{} and {} are known together, not each by itself: their errors correlate by {correlation:.3}, \
                 and if one were known, the other would be known {times} better",
                names[i], names[j]
            );
            ([i, j], said)
        })
        .collect()
}
