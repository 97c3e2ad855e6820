//! Least squares with few columns, by orthogonal factors.

use nalgebra::{DMatrix, DVector};

/// A fit of `values` by a sum of columns.
#[derive(Debug, Clone)]
pub(crate) struct Regression {
    pub(crate) coefficients: Vec<f64>,
    /// Standard errors if what is left is independent from sample to sample.
    pub(crate) standard_errors: Vec<f64>,
    pub(crate) sum_squared_error: f64,
}

/// Fits `values` by columns, `row(sample)` giving their entries; none when there are not more samples
/// than columns or the columns depend on one another.
pub(crate) fn regress<const N: usize>(
    values: &[f64],
    row: impl Fn(usize) -> [f64; N],
) -> Option<Regression> {
    if values.len() <= N {
        return None;
    }
    let mut matrix = DMatrix::zeros(values.len(), N);
    for sample in 0..values.len() {
        for (column, entry) in row(sample).into_iter().enumerate() {
            matrix[(sample, column)] = entry;
        }
    }
    let scales: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    if scales
        .iter()
        .any(|scale| !(scale.is_finite() && *scale > 0.0))
    {
        return None;
    }
    for (mut column, scale) in matrix.column_iter_mut().zip(&scales) {
        column /= *scale;
    }
    let right = DVector::from_column_slice(values);
    let factors = matrix.clone().qr();
    let upper = factors.r();
    let is_singular = upper.diagonal().iter().any(|pivot| pivot.abs() < 1e-10);
    if is_singular {
        return None;
    }
    let scaled = upper.solve_upper_triangular(&(factors.q().transpose() * &right))?;
    let sum_squared_error = (right - matrix * &scaled).norm_squared();
    let variance = sum_squared_error / (values.len() - N) as f64;
    let inverse = upper.try_inverse()?;
    let errors = inverse
        .row_iter()
        .map(|row| (variance * row.norm_squared()).sqrt());
    Some(Regression {
        coefficients: scaled
            .iter()
            .zip(&scales)
            .map(|(x, scale)| x / scale)
            .collect(),
        standard_errors: errors.zip(&scales).map(|(x, scale)| x / scale).collect(),
        sum_squared_error,
    })
}

/// Times of the exponentials below, in lengths of the part [-].
const TIMES: [f64; 3] = [1.0 / 40.0, 1.0 / 10.0, 1.0 / 3.0];

/// Columns that take up relaxation at `share` [-] of a part, from 0 to 1: a constant, a slope and three
/// exponentials.
pub(crate) fn relaxation(share: f64) -> [f64; 5] {
    let [a, b, c] = TIMES.map(|time| (-share / time).exp());
    [1.0, share, a, b, c]
}
