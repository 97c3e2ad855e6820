use nalgebra::{DMatrix, DVectorView};

use super::derivatives::{Differenced, Differences, Given, Problem};
use super::triangle::{bounded_step, triangularize};
use super::{Fit, Iteration, Parameter, Stop};
use crate::Error;

/// How far a fit goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The relative change of the parameters below which the fit has arrived [-].
    pub tolerance: f64,
    /// How many steps it may take.
    pub iterations: usize,
    /// How derivatives are found, when the residuals do not bring theirs.
    pub differences: Differences,
    /// The relative precision of the residuals [-], from which the steps of differences follow.
    pub precision: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            iterations: 500,
            differences: Differences::Forward,
            precision: f64::EPSILON,
        }
    }
}

/// Makes the sum of squares of `samples` residuals least. `residuals` fills its second argument from the
/// values of all parameters, and gives `None` where it cannot.
///
/// # Errors
/// When a parameter does not lie between its bounds, the residuals are fewer than the free parameters, or
/// cannot be found where the fit starts.
pub fn least_squares(
    parameters: &[Parameter],
    samples: usize,
    settings: &Settings,
    residuals: impl FnMut(&[f64], &mut [f64]) -> Option<()>,
) -> Result<Fit, Error> {
    let problem = Differenced::new(parameters, settings, residuals);
    Search::start(parameters, samples, settings, problem).map(Search::run)
}

/// The same when the residuals bring their derivatives: one column for each parameter, also for a fixed
/// one, which nobody reads.
///
/// # Errors
/// As [`least_squares`].
pub fn least_squares_with_jacobian(
    parameters: &[Parameter],
    samples: usize,
    settings: &Settings,
    residuals: impl FnMut(&[f64], &mut [f64], &mut DMatrix<f64>) -> Option<()>,
) -> Result<Fit, Error> {
    let problem = Given::new(DMatrix::zeros(samples, parameters.len()), residuals);
    Search::start(parameters, samples, settings, problem).map(Search::run)
}

/// Where a search is. Steps are in scaled parameters, y = D s, of those that are not fixed.
struct Search<'a, P> {
    settings: &'a Settings,
    problem: P,
    fit: Fit,
    free: Vec<usize>,
    sum: f64,
    trial: Vec<f64>,
    trial_residuals: Vec<f64>,
    scaled: DMatrix<f64>,
    scaling: Vec<f64>,
    damping: f64,
}

/// What became of an attempt to go on.
enum Attempt {
    /// A better place, and whether the way there was too short to go on.
    Better { arrived: bool },
    /// No place that was tried is better.
    Stuck { arrived: bool },
}

/// The damping of the first step, relative to columns of norm one.
const FIRST_DAMPING: f64 = 1e-3;
/// What the damping is multiplied with until a step is short enough.
const MORE_DAMPING: f64 = 4.0;
/// The part of a step that is tried when the whole was not better, and when it had no residuals.
const SHORTER: [f64; 2] = [0.5, 0.25];
/// A sum of squares is not known better than to this part.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl<'a, P: Problem> Search<'a, P> {
    fn start(
        parameters: &[Parameter],
        samples: usize,
        settings: &'a Settings,
        mut problem: P,
    ) -> Result<Self, Error> {
        parameters.iter().try_for_each(Parameter::check)?;
        let free: Vec<usize> = (0..parameters.len())
            .filter(|&i| !parameters[i].fixed)
            .collect();
        if samples < free.len().max(1) {
            return Err(Error::TooShort {
                samples,
                task: "a fit of so many parameters",
                least: free.len().max(1),
            });
        }
        let values: Vec<f64> = parameters.iter().map(|p| p.value).collect();
        let mut residuals = vec![0.0; samples];
        let found = problem.residuals(&values, &mut residuals);
        let sum = sum_of_squares(&residuals);
        if found.is_none() || !sum.is_finite() {
            return Err(Error::NoStart {
                parameters: parameters.to_vec(),
            });
        }
        Ok(Self {
            settings,
            problem,
            scaled: DMatrix::zeros(samples, free.len() + 1),
            scaling: vec![0.0; free.len()],
            trial: values,
            trial_residuals: vec![0.0; samples],
            sum,
            damping: FIRST_DAMPING,
            fit: Fit {
                parameters: parameters.to_vec(),
                residuals,
                jacobian: DMatrix::zeros(samples, parameters.len()),
                iterations: Vec::new(),
                stop: Stop::Iterations,
                evaluations: 1,
            },
            free,
        })
    }

    fn run(mut self) -> Fit {
        self.log(0.0);
        self.fit.stop = loop {
            if !self.linearize() {
                break Stop::NoDerivatives;
            }
            if self.gradient() <= self.settings.tolerance {
                break Stop::Converged;
            }
            if self.fit.iterations.len() > self.settings.iterations {
                break Stop::Iterations;
            }
            match self.attempt() {
                Attempt::Better { arrived: true } if self.linearize() => break Stop::Converged,
                Attempt::Better { .. } => {}
                Attempt::Stuck { arrived: true } => break Stop::Converged,
                Attempt::Stuck { arrived: false } => break Stop::NoBetter,
            }
        };
        self.fit
    }

    fn log(&mut self, step: f64) {
        self.fit.iterations.push(Iteration {
            values: self.fit.parameters.iter().map(|p| p.value).collect(),
            sum_of_squares: self.sum,
            damping: self.damping,
            step,
            evaluations: self.fit.evaluations,
        });
    }

    /// Derivatives here, and from them the triangle of the scaled problem.
    fn linearize(&mut self) -> bool {
        let fit = &mut self.fit;
        let values: Vec<f64> = fit.parameters.iter().map(|p| p.value).collect();
        let found = self
            .problem
            .jacobian(&values, &fit.residuals, &mut fit.jacobian);
        fit.evaluations += found.unwrap_or(0);
        if found.is_none() || fit.jacobian.iter().any(|d| !d.is_finite()) {
            return false;
        }
        for (k, &i) in self.free.iter().enumerate() {
            let column = fit.jacobian.column(i);
            let least = f64::MIN_POSITIVE.sqrt() / fit.parameters[i].scale;
            self.scaling[k] = self.scaling[k].max(column.norm()).max(least);
            self.scaled.set_column(k, &(column / self.scaling[k]));
        }
        let right = DVectorView::from_slice(&fit.residuals, fit.residuals.len());
        self.scaled.set_column(self.free.len(), &right);
        triangularize(&mut self.scaled, self.free.len());
        true
    }

    /// The largest cosine between the residuals and what a parameter that can still move does to them.
    fn gradient(&self) -> f64 {
        let residuals = DVectorView::from_slice(&self.fit.residuals, self.fit.residuals.len());
        let cosine = |&i: &usize| {
            let (column, parameter) = (self.fit.jacobian.column(i), &self.fit.parameters[i]);
            let slope = column.dot(&residuals);
            let blocked = (slope >= 0.0 && parameter.value <= parameter.lower)
                || (slope <= 0.0 && parameter.value >= parameter.upper);
            let norms = column.norm() * residuals.norm();
            if blocked || norms == 0.0 {
                0.0
            } else {
                slope.abs() / norms
            }
        };
        self.free.iter().map(cosine).fold(0.0, f64::max)
    }

    /// Steps, each shorter than the one before, until one is better.
    fn attempt(&mut self) -> Attempt {
        let triangle = self.scaled.rows(0, self.free.len()).upper_triangle();
        let bounds = self.scaled_bounds();
        let size = self.size();
        let mut longest = f64::INFINITY;
        let mut promised = None;
        loop {
            let step = self.step(&triangle, &bounds, longest);
            let length = norm(&step);
            let predicted = reduction(&triangle, &step);
            let promise = *promised.get_or_insert(predicted);
            if length <= self.settings.tolerance * size && longest.is_finite() || length == 0.0 {
                let least = self.settings.tolerance.max(self.settings.precision);
                return Attempt::Stuck {
                    arrived: promise <= least * self.sum,
                };
            }
            let found = self.try_step(&step, &bounds);
            let gained = found.map(|sum| self.sum - sum);
            if let Some(gained) = gained.filter(|&gained| gained > 0.0) {
                let still = gained.max(predicted) <= ROUNDING * self.sum;
                // Damping too makes steps short.
                let short = length <= self.settings.tolerance * size;
                let arrived = still || (short && self.damping <= FIRST_DAMPING);
                self.accept(gained, predicted, length);
                return Attempt::Better { arrived };
            }
            longest = SHORTER[usize::from(found.is_none())] * length;
        }
    }

    fn scaled_bounds(&self) -> Vec<[f64; 2]> {
        let scaled = |(&i, scale): (&usize, &f64)| {
            let parameter = &self.fit.parameters[i];
            [parameter.lower, parameter.upper].map(|bound| (bound - parameter.value) * scale)
        };
        self.free.iter().zip(&self.scaling).map(scaled).collect()
    }

    /// The scaled size of the parameters.
    fn size(&self) -> f64 {
        let scaled = self.free.iter().zip(&self.scaling);
        norm(
            &scaled
                .map(|(&i, scale)| self.fit.parameters[i].value * scale)
                .collect::<Vec<_>>(),
        )
    }

    /// A step that is not longer than `longest`; for this the damping grows.
    fn step(&mut self, triangle: &DMatrix<f64>, bounds: &[[f64; 2]], longest: f64) -> Vec<f64> {
        loop {
            let step = bounded_step(triangle, self.damping, bounds);
            if norm(&step) <= longest {
                return step;
            }
            self.damping *= MORE_DAMPING;
        }
    }

    /// The sum of squares after a step, when there is one.
    fn try_step(&mut self, step: &[f64], bounds: &[[f64; 2]]) -> Option<f64> {
        for (k, &i) in self.free.iter().enumerate() {
            let parameter = &self.fit.parameters[i];
            self.trial[i] = if step[k] <= bounds[k][0] {
                parameter.lower
            } else if step[k] >= bounds[k][1] {
                parameter.upper
            } else {
                (parameter.value + step[k] / self.scaling[k])
                    .clamp(parameter.lower, parameter.upper)
            };
        }
        self.fit.evaluations += 1;
        self.problem
            .residuals(&self.trial, &mut self.trial_residuals)?;
        Some(sum_of_squares(&self.trial_residuals)).filter(|sum| sum.is_finite())
    }

    fn accept(&mut self, gained: f64, predicted: f64, length: f64) {
        for (parameter, &value) in self.fit.parameters.iter_mut().zip(&self.trial) {
            parameter.value = value;
        }
        std::mem::swap(&mut self.fit.residuals, &mut self.trial_residuals);
        self.sum = sum_of_squares(&self.fit.residuals);
        self.log(length);
        let ratio = gained / predicted;
        self.damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
    }
}

/// What the linear problem promises of a step: |q|² − |R y + q|².
fn reduction(triangle: &DMatrix<f64>, step: &[f64]) -> f64 {
    let count = step.len();
    let row = |row: usize| -> f64 {
        let change: f64 = (row..count).map(|k| triangle[(row, k)] * step[k]).sum();
        -change * (2.0 * triangle[(row, count)] + change)
    };
    (0..count).map(row).sum()
}

fn norm(values: &[f64]) -> f64 {
    DVectorView::from_slice(values, values.len()).norm()
}

fn sum_of_squares(values: &[f64]) -> f64 {
    DVectorView::from_slice(values, values.len()).norm_squared()
}
