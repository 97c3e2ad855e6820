//! Least squares between bounds, and the uncertainty of the result.
//!
//! [`least_squares`] makes Σ r² least by a damped Gauss-Newton method [Levenberg 1944, Marquardt 1963]:
//! with J scaled by the largest norms of its columns so far [Moré 1978], a step solves
//!
//! ```text
//! min |J s + r|² + μ |D s|²,   lower ≤ p + s ≤ upper
//! ```
//!
//! by reflections, never by JᵀJ. Parameters beyond their bounds are put on them [Kanzow, Yamashita and Fukushima
//! 2004]; μ follows the ratio of gained to promised reduction [Nielsen 1999]. Where the residuals cannot be
//! found the step is shortened. [`uncertainty`] and [`correlated_uncertainty`] then say how well the
//! parameters are known, [`warnings`] in words.
//!
//! *How we know*: `fit::certified` (the certified problems of NIST, with their standard deviations),
//! `fit::agreement` (another library), `fit::bounds` (closed forms), `fit::coverage` (intervals that hold the
//! truth as often as they say).
//!
//! *Limits*: a local minimum; [`multi_start`] looks for others.

mod correlated;
mod criterion;
mod derivatives;
mod expected;
mod least_squares;
mod misfit;
mod multi_start;
mod parameter;
mod pooled;
mod profile;
mod random;
mod resample;
mod student;
mod triangle;
mod uncertainty;
mod verdict;
mod warnings;

use nalgebra::DMatrix;

pub use criterion::{MIN_IMPROVEMENT, information_criterion, simplest};
pub use derivatives::Differences;
pub(crate) use expected::Expected;
pub use least_squares::{Settings, least_squares, least_squares_with_jacobian};
pub(crate) use misfit::{misfit, missed};
pub use multi_start::{Minimum, multi_start};
pub(crate) use multi_start::{another_minimum, distinct_minima};
pub use parameter::Parameter;
pub use pooled::{PooledMean, pooled_mean};
pub use profile::{Profile, profile};
pub use random::Random;
pub use resample::{Draws, Spread, block_bootstrap, noise_study};
pub(crate) use student::student_quantile;
pub use uncertainty::{Uncertainty, correlated_uncertainty, uncertainty, with_systematic};
pub use verdict::{CORRELATED, HARDLY_KNOWN, Verdict, correlated_pairs, verdicts};
pub use warnings::warnings;

/// The result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The parameters, with the values where the fit ended.
    pub parameters: Vec<Parameter>,
    /// The residuals there [unit of the residuals].
    pub residuals: Vec<f64>,
    /// Their derivatives there, a column for each parameter; those of fixed ones mean nothing.
    pub jacobian: DMatrix<f64>,
    /// The iterations, beginning with the start.
    pub iterations: Vec<Iteration>,
    /// Why it ended.
    pub stop: Stop,
    /// How often residuals were evaluated, for derivatives too.
    pub evaluations: usize,
}

/// An iteration of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Iteration {
    /// The values of all parameters.
    pub values: Vec<f64>,
    /// Σ r² [square of the unit of the residuals].
    pub sum_of_squares: f64,
    /// The damping μ of the step that led here [-].
    pub damping: f64,
    /// The length |D s| of that step [unit of the residuals].
    pub step: f64,
    /// How often residuals had been evaluated.
    pub evaluations: usize,
}

/// Why a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// It arrived: the residuals are orthogonal to what the parameters can change, or the last step was
    /// shorter than asked for.
    Converged,
    /// No step, however short, was better, though one was promised; the residuals are less precise than
    /// the settings say.
    NoBetter,
    /// The derivatives could not be found.
    NoDerivatives,
    /// The steps were used up.
    Iterations,
}

impl Fit {
    /// Σ r² [square of the unit of the residuals].
    pub fn sum_of_squares(&self) -> f64 {
        self.residuals.iter().map(|r| r * r).sum()
    }

    /// The value of the parameter of this name.
    pub fn value(&self, name: &str) -> Option<f64> {
        let found = self.parameters.iter().find(|p| p.name == name);
        found.map(|parameter| parameter.value)
    }

    /// The same without bounds: one that ended on a bound has an uncertainty like any other.
    pub fn unbounded(&self) -> Self {
        let free = |parameter: &Parameter| {
            let free = parameter.clone().within(f64::NEG_INFINITY, f64::INFINITY);
            if parameter.fixed {
                parameter.clone()
            } else {
                free
            }
        };
        Self {
            parameters: self.parameters.iter().map(free).collect(),
            ..self.clone()
        }
    }

    /// How many parameters the fit could choose, those that ended on a bound among them.
    pub fn free(&self) -> usize {
        self.parameters.iter().filter(|p| !p.fixed).count()
    }

    /// The parameters that the fit chose: neither fixed nor on a bound.
    pub fn chosen(&self) -> Vec<usize> {
        let chosen = |&i: &usize| !self.parameters[i].fixed && !self.parameters[i].at_bound();
        (0..self.parameters.len()).filter(chosen).collect()
    }
}
