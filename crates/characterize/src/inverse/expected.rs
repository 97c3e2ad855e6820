use nalgebra::DMatrix;

use super::correlations::Correlations;
use super::curves::{BaseSensitivity, Curves, UnitCurve};
use super::description::in_own_parameters;
use super::law_fit::{LawData, found, parameters};
use crate::fit::{Expected, Fit};

impl UnitCurve {
    /// That of an indenter of unit radius for one of `radius` [m] on a specimen of the same shape.
    pub(crate) fn scaled(&self, radius: f64) -> Self {
        let scaled =
            |curve: &palpate_mechanics::IndentationCurve| curve.scaled(radius, radius * radius);
        Self {
            force: scaled(&self.force),
            by_shape: self.by_shape.iter().map(scaled).collect(),
            base: self.base.as_ref().map(|base| BaseSensitivity {
                by_stiffness: scaled(&base.by_stiffness),
                ..*base
            }),
            ..self.clone()
        }
    }
}

/// How well the parameters of the law of `curves` are expected to be known, standard errors and the t of their intervals
/// of 95 %, from `data`, whose forces are taken for those of `curve` times `modulus` [Pa], and the correlations of their
/// errors with those of the relaxation.
/// `weights` are the roots of how many samples of unit noise [1 N] each row stands for.
pub(crate) fn expected_law(
    curves: &Curves,
    curve: &UnitCurve,
    modulus: f64,
    data: LawData<'_>,
    weights: &[f64],
) -> (Vec<(f64, f64)>, Correlations) {
    let mut start = parameters(curves.law(), data.series, modulus);
    for (parameter, shape) in start[1..].iter_mut().zip(&curve.shape) {
        parameter.value = *shape;
    }
    let samples = weights.len();
    let fit = Fit::at(start, samples);
    let mut law = found(fit, curves, curve, data);
    let expected = Expected::of(law.fit.clone(), &law.systematic, weights);
    law.fit = expected.fit.clone();
    let own = in_own_parameters(&law);
    let free = own.unbounded();
    // The last three are of the model.
    let zeros = law.systematic.len() - 3;
    let known = expected.known(&free, zeros, data.indentations.len());
    let count = law.law.count();
    let error = |place| {
        let error = known.standard_error(place).unwrap_or(f64::INFINITY);
        (error, known.quantile(place, 0.95).unwrap_or(f64::INFINITY))
    };
    let errors = (0..count).map(error).collect();
    let [covariance, _]: [DMatrix<f64>; 2] = known.of_all(own.parameters.len());
    (errors, Correlations::of_law(&own, count, covariance))
}
