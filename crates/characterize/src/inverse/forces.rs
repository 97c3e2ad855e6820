use nalgebra::DMatrix;
use palpate_mechanics::{PronySeries, branch};

use super::curves::UnitCurve;

/// What was done to the tissue and felt in one recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indentation<'a> {
    /// Times [s], ascending.
    pub time: &'a [f64],
    /// Depths [m].
    pub depth: &'a [f64],
    /// Forces on the tissue [N].
    pub force: &'a [f64],
}

/// Forces [N] of a unit curve times `modulus` [Pa] in an indentation, and their change with the modulus, the
/// shape, and the ratio ρᵢ = gᵢ/(1 − Σ g) and the logarithm of the time of each term.
pub(super) fn forces(
    (time, depth): (&[f64], &[f64]),
    curve: &UnitCurve,
    modulus: f64,
    series: &PronySeries,
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let elastic: Vec<f64> = depth.iter().map(|&d| curve.force.force(d)).collect();
    let by_shape: Vec<f64> = depth.iter().map(|&d| curve.by_shape.force(d)).collect();
    let left = 1.0 - series.terms().iter().map(|(g, _)| g).sum::<f64>();
    let branches: Vec<_> = series
        .terms()
        .iter()
        .map(|&(_, tau)| (branch(tau, time, &elastic), branch(tau, time, &by_shape).0))
        .collect();
    let (mut lost, mut shape) = (vec![0.0; time.len()], by_shape);
    for ((g, _), ((values, _), of_shape)) in series.terms().iter().zip(&branches) {
        for row in 0..time.len() {
            lost[row] += g * values[row];
            shape[row] -= g * of_shape[row];
        }
    }
    let unit: Vec<f64> = elastic.iter().zip(&lost).map(|(e, l)| e - l).collect();
    let mut columns = vec![unit.clone(), shape.iter().map(|s| modulus * s).collect()];
    for ((g, _), ((values, slopes), _)) in series.terms().iter().zip(&branches) {
        let ratio = lost
            .iter()
            .zip(values)
            .map(|(l, h)| modulus * left * (l - h));
        columns.push(ratio.collect());
        columns.push(slopes.iter().map(|s| -modulus * g * s).collect());
    }
    (unit.iter().map(|f| modulus * f).collect(), columns)
}

/// Writes the columns of one recording into the rows from `start` on.
pub(super) fn write(columns: &[Vec<f64>], start: usize, jacobian: &mut DMatrix<f64>) {
    for (place, column) in columns.iter().enumerate() {
        for (row, value) in column.iter().enumerate() {
            jacobian[(start + row, place)] = *value;
        }
    }
}
