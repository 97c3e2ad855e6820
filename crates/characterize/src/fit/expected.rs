use nalgebra::DMatrix;

use super::{Fit, Parameter, Stop, Uncertainty, uncertainty, with_systematic};

/// A fit that has not been made, as its uncertainty sees it.
pub(crate) struct Expected {
    /// With rows that each stand for as many samples as they should, of noise of the standard deviation one.
    pub(crate) fit: Fit,
    /// What changes its residuals and is no noise: of the zeros of recordings first.
    pub(crate) systematic: Vec<Vec<f64>>,
}

impl Fit {
    /// At the start, before anything is evaluated.
    pub(crate) fn at(parameters: Vec<Parameter>, samples: usize) -> Self {
        let jacobian = DMatrix::zeros(samples, parameters.len());
        Self {
            parameters,
            residuals: vec![0.0; samples],
            jacobian,
            iterations: Vec::new(),
            stop: Stop::Converged,
            evaluations: 0,
        }
    }
}

impl Expected {
    /// Of derivatives and influences, whose rows stand for the squares of `weights` in samples of unit noise.
    pub(crate) fn of(mut fit: Fit, systematic: &[Vec<f64>], weights: &[f64]) -> Self {
        for (mut row, weight) in fit.jacobian.row_iter_mut().zip(weights) {
            row *= *weight;
        }
        let weighted = |column: &Vec<f64>| {
            let each = column.iter().zip(weights);
            each.map(|(change, weight)| change * weight).collect()
        };
        // So that the variance that is estimated from them is one.
        let rows = weights.len() as f64;
        let free = (rows - fit.chosen().len() as f64).max(1.0);
        fit.residuals = vec![(free / rows).sqrt(); weights.len()];
        Self {
            systematic: systematic.iter().map(weighted).collect(),
            fit,
        }
    }

    /// How well its parameters are known. The first `zeros` of what is no noise, an influence on each of `recordings`,
    /// is seen in the residuals: as noise that is known from as many degrees of freedom.
    pub(crate) fn known(&self, fit: &Fit, zeros: usize, recordings: usize) -> Uncertainty {
        let (of_zeros, of_model) = self.systematic.split_at(zeros.min(self.systematic.len()));
        let noise = with_systematic(uncertainty(fit), fit, of_zeros);
        let noise = Uncertainty {
            of_noise: noise.covariance.clone(),
            freedom: recordings as f64,
            ..noise
        };
        with_systematic(noise, fit, of_model)
    }
}
