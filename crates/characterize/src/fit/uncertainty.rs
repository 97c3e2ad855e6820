//! Uncertainty of fitted parameters: covariance, intervals, correlation.

use nalgebra::{DMatrix, DVectorView};

use super::Fit;
use super::correlated::score_covariance;
use super::student::student_quantile;
use super::triangle::triangularize;

/// Uncertainty of the parameters of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    /// The indices of its parameters: those that the fit chose, neither fixed nor on a bound.
    pub chosen: Vec<usize>,
    /// Their covariance [products of their units].
    pub covariance: DMatrix<f64>,
    /// The part of it that is estimated from residuals, of noise; the rest is known of the influences behind it.
    pub of_noise: DMatrix<f64>,
    /// Their covariance for independent residuals of variance one.
    pub unit_covariance: DMatrix<f64>,
    /// Effective number of independent samples [-].
    pub effective_samples: f64,
    /// The degrees of freedom that the part of noise is known with [-].
    pub freedom: f64,
}

/// The uncertainty when residuals are independent and of one size: s² (JᵀJ)⁻¹.
pub fn uncertainty(fit: &Fit) -> Uncertainty {
    let whitened = Whitened::new(fit);
    let count = whitened.count() as f64;
    let freedom = (fit.residuals.len() as f64 - count).max(1.0);
    let covariance = &whitened.unit_covariance() * (fit.sum_of_squares() / freedom);
    Uncertainty {
        of_noise: covariance.clone(),
        covariance,
        unit_covariance: whitened.unit_covariance(),
        effective_samples: fit.residuals.len() as f64,
        freedom,
        chosen: whitened.chosen,
    }
}

/// The uncertainty when neighbouring residuals of a recording are correlated: the beat of a heart, noise
/// that is filtered, a sensor with steps. `recordings` are the lengths of the recordings, in the order of
/// the residuals, each sampled evenly.
///
/// Their correlation is taken from the residuals (`fit/correlated.rs`); the parameters
/// are those of least squares all the same.
pub fn correlated_uncertainty(fit: &Fit, recordings: &[usize]) -> Uncertainty {
    let independent = uncertainty(fit);
    let whitened = Whitened::new(fit);
    if whitened.chosen.is_empty() {
        return independent;
    }
    let (middle, freedom) = score_covariance(&whitened.directions, &fit.residuals, recordings);
    let covariance = &whitened.back * &middle * whitened.back.transpose();
    let samples = fit.residuals.len() as f64;
    let count = whitened.count() as f64;
    let variance = fit.sum_of_squares() / (samples - count).max(1.0);
    // How many times smaller the variance would be without correlation, in the direction that suffers most.
    let share = variance / middle.symmetric_eigenvalues().max();
    Uncertainty {
        of_noise: covariance.clone(),
        covariance,
        effective_samples: (samples * share.min(1.0)).max(1.0),
        freedom: freedom.min(independent.freedom),
        ..independent
    }
}

/// The same with systematic influences: each column of `systematic` is the change of the residuals by one standard
/// deviation of one influence [unit of the residuals]. An influence moves the parameters by −J⁺
/// times its column, to first order, and these changes add up as their squares [JCGM 100:2008].
pub fn with_systematic(known: Uncertainty, fit: &Fit, systematic: &[Vec<f64>]) -> Uncertainty {
    let whitened = Whitened::new(fit);
    let mut all = known;
    for column in systematic {
        let change = DVectorView::from_slice(column, column.len());
        let way = &whitened.back * whitened.directions.tr_mul(&change);
        all.covariance += &way * way.transpose();
    }
    all
}

/// The derivatives of a fit in coordinates in which they are orthonormal.
struct Whitened {
    chosen: Vec<usize>,
    /// Orthonormal columns that span those of J.
    directions: DMatrix<f64>,
    /// From these coordinates to parameters.
    back: DMatrix<f64>,
}

impl Whitened {
    fn new(fit: &Fit) -> Self {
        let chosen = fit.chosen();
        let count = chosen.len();
        if count == 0 {
            return Self {
                chosen,
                directions: DMatrix::zeros(fit.residuals.len(), 0),
                back: DMatrix::zeros(0, 0),
            };
        }
        let scale = |&i: &usize| match fit.jacobian.column(i).norm() {
            0.0 => fit.parameters[i].scale.recip(),
            norm => norm,
        };
        let scales: Vec<f64> = chosen.iter().map(scale).collect();
        let scaled = DMatrix::from_fn(fit.residuals.len(), count, |row, k| {
            fit.jacobian[(row, chosen[k])] / scales[k]
        });
        let mut triangle = scaled.clone();
        triangularize(&mut triangle, count);
        let decomposition = triangle.rows(0, count).upper_triangle().svd(false, true);
        let largest = decomposition.singular_values.max();
        let right = decomposition.v_t.expect("asked for").transpose();
        let mut within = right;
        for (k, mut column) in within.column_iter_mut().enumerate() {
            // What the recording says nothing about stays finite, and enormous.
            let floor = f64::EPSILON * largest;
            column /= decomposition.singular_values[k].max(floor);
        }
        let directions = scaled * &within;
        for (mut row, scale) in within.row_iter_mut().zip(&scales) {
            row /= *scale;
        }
        Self {
            chosen,
            directions,
            back: within,
        }
    }

    fn count(&self) -> usize {
        self.chosen.len()
    }

    fn unit_covariance(&self) -> DMatrix<f64> {
        &self.back * self.back.transpose()
    }
}

impl Uncertainty {
    /// The covariance of all of so many parameters, and its part of noise: nothing is uncertain of those that were
    /// not chosen.
    pub fn of_all(&self, parameters: usize) -> [DMatrix<f64>; 2] {
        [&self.covariance, &self.of_noise].map(|chosen| {
            let mut all = DMatrix::zeros(parameters, parameters);
            for (row, &i) in self.chosen.iter().enumerate() {
                for (column, &j) in self.chosen.iter().enumerate() {
                    all[(i, j)] = chosen[(row, column)];
                }
            }
            all
        })
    }

    /// Degrees of freedom of Student's distribution [-] for what has this `variance`, `of_noise` of it by noise: more,
    /// the less of it noise makes [Welch 1947].
    pub fn degrees_of_freedom(&self, variance: f64, of_noise: f64) -> f64 {
        if of_noise > 0.0 {
            self.freedom * (variance / of_noise).powi(2).max(1.0)
        } else {
            f64::INFINITY
        }
    }

    /// The t [-] of intervals that hold a parameter with the probability `level`, when the fit chose it.
    pub fn quantile(&self, parameter: usize, level: f64) -> Option<f64> {
        let place = self.place(parameter)?;
        let [all, noise] = [&self.covariance, &self.of_noise].map(|each| each[(place, place)]);
        Some(student_quantile(self.degrees_of_freedom(all, noise), level))
    }

    /// The same for the parameters alone whose index `is_kept` accepts; the uncertainty of the others stays in their errors.
    pub(crate) fn among(&self, is_kept: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<usize> = (0..self.chosen.len())
            .filter(|&k| is_kept(self.chosen[k]))
            .collect();
        let of = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        Self {
            chosen: kept.iter().map(|&k| self.chosen[k]).collect(),
            covariance: of(&self.covariance),
            of_noise: of(&self.of_noise),
            unit_covariance: of(&self.unit_covariance),
            ..*self
        }
    }

    /// Index of a parameter among those that the fit chose.
    fn place(&self, parameter: usize) -> Option<usize> {
        self.chosen.iter().position(|&i| i == parameter)
    }

    /// The standard error of a parameter [its unit], when the fit chose it.
    pub fn standard_error(&self, parameter: usize) -> Option<f64> {
        let place = self.place(parameter)?;
        Some(self.covariance[(place, place)].sqrt())
    }

    /// The standard error that residuals of standard deviation one, independent of one another, would give.
    pub fn unit_error(&self, parameter: usize) -> Option<f64> {
        let place = self.place(parameter)?;
        Some(self.unit_covariance[(place, place)].sqrt())
    }

    /// Half the width of the intervals that hold what the model gives for each sample with the probability `level`
    /// [unit of the residuals].
    pub fn prediction_half_widths(&self, fit: &Fit, level: f64) -> Vec<f64> {
        let derivatives = fit.jacobian.select_columns(&self.chosen);
        let [all, noise] = [&self.covariance, &self.of_noise].map(|covariance| {
            let spread = &derivatives * covariance;
            let products = spread.row_iter().zip(derivatives.row_iter());
            products
                .map(|(a, b)| a.dot(&b).max(0.0))
                .collect::<Vec<_>>()
        });
        let freedom = self.degrees_of_freedom(all.iter().sum(), noise.iter().sum());
        let quantile = student_quantile(freedom, level);
        all.into_iter().map(|v| quantile * v.sqrt()).collect()
    }

    /// The interval that holds a parameter [its unit] with the probability `level`.
    pub fn interval(&self, fit: &Fit, parameter: usize, level: f64) -> Option<[f64; 2]> {
        let reach = self.quantile(parameter, level)? * self.standard_error(parameter)?;
        let value = fit.parameters[parameter].value;
        Some([value - reach, value + reach])
    }

    /// Correlations of the parameters [-], in the order of `chosen`.
    pub fn correlation(&self) -> DMatrix<f64> {
        let errors = self.covariance.diagonal().map(f64::sqrt);
        self.covariance
            .map_with_location(|row, column, value| value / (errors[row] * errors[column]))
    }
}
