use nalgebra::DMatrix;

use super::description::{LawDescription, in_own_parameters};
use crate::fit::Fit;
use crate::viscoelastic::{even, quasi_linear};

/// Correlations of the errors of parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Correlations {
    /// The parameters, by their names.
    pub names: Vec<String>,
    /// Their correlations [-].
    pub matrix: DMatrix<f64>,
    /// Their covariance [products of their units].
    pub covariance: DMatrix<f64>,
}

impl Correlations {
    /// Of parameters with a `covariance`; those without an error are left out.
    pub fn of(names: Vec<String>, covariance: &DMatrix<f64>) -> Self {
        let chosen: Vec<usize> = (0..names.len())
            .filter(|&i| covariance[(i, i)] > 0.0)
            .collect();
        let covariance = covariance.select_rows(&chosen).select_columns(&chosen);
        let errors = covariance.diagonal().map(f64::sqrt);
        let matrix = covariance
            .map_with_location(|row, column, value| value / (errors[row] * errors[column]));
        Self {
            covariance,
            names: chosen.iter().map(|&i| names[i].clone()).collect(),
            matrix,
        }
    }
}

impl LawDescription {
    /// Correlations and covariance of its parameters and of gᵢ and τᵢ of the relaxation it was found with.
    pub fn correlations(&self) -> Correlations {
        let own = in_own_parameters(&self.found);
        let [covariance, _] = self.uncertainty.of_all(own.parameters.len());
        Correlations::of_law(&own, self.found.law.count(), covariance)
    }
}

impl Correlations {
    /// Of a fit in the own parameters of a law, so many as `count`, which has this `covariance`.
    pub(super) fn of_law(own: &Fit, count: usize, covariance: DMatrix<f64>) -> Self {
        let relaxation = &own.parameters[count..];
        let ratios: Vec<f64> = relaxation.iter().step_by(2).map(|p| p.value).collect();
        let whole = 1.0 + ratios.iter().sum::<f64>();
        let times = relaxation.iter().skip(1).step_by(2);
        let times: Vec<f64> = times.map(|p| p.value.exp()).collect();
        // gᵢ = ρᵢ/(1 + Σ ρ); the fit has ln τ.
        let mut to_terms = DMatrix::identity(own.parameters.len(), own.parameters.len());
        for (i, ratio) in ratios.iter().enumerate() {
            for j in 0..ratios.len() {
                let own = if i == j { 1.0 } else { 0.0 };
                to_terms[(count + 2 * i, count + 2 * j)] = (own - ratio / whole) / whole;
            }
            to_terms[(count + 1 + 2 * i, count + 1 + 2 * i)] = times[i];
        }
        let of_terms = (1..=ratios.len()).flat_map(|i| [format!("g_{i}"), format!("tau_{i}_s")]);
        let of_law = own.parameters[..count].iter().map(|p| p.name.clone());
        let mut covariance = &to_terms * covariance * to_terms.transpose();
        // As in the errors of the terms.
        let off = quasi_linear(1.0 - 1.0 / whole);
        for (i, ratio) in ratios.iter().enumerate() {
            covariance[(count + 2 * i, count + 2 * i)] += even(off * ratio / whole);
            covariance[(count + 1 + 2 * i, count + 1 + 2 * i)] += even(off * times[i]);
        }
        Self::of(of_law.chain(of_terms).collect(), &covariance)
    }
}
