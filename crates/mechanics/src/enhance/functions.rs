//! Shepard's functions and those of moving least squares, at one point, from the weights of its nodes.

use nalgebra::{Matrix2, SymmetricEigen, Vector2};

/// A point further out of its nodes than this is no longer met by a line through them, squared and in
/// standard deviations: the functions would grow without bound [-].
const FARTHEST: f64 = 9.0;

/// Directions in which the nodes spread less than this, squared and relative to the widest, have no slope [-].
const FLATTEST: f64 = 1e-12;

/// Makes Shepard's functions of the nodes' weights (4.12): they sum to one.
pub fn shepard(weights: &mut [f64]) {
    let sum: f64 = weights.iter().sum();
    for weight in weights {
        *weight /= sum;
    }
}

/// Makes functions of moving least squares of the nodes' weights, `offset` being where a node lies from the
/// point in two coordinates [m]: besides summing to one, they reproduce what is linear in these (4.11).
///
/// With mean m and covariance C of the nodes under Shepard's functions φ, Φ = φ (1 − (C⁻¹ m) · (s − m)),
/// which is pᵀ A⁻¹ B with the basis {1, s, t}.
pub fn moving_least_squares(weights: &mut [f64], offset: impl Fn(usize) -> Vector2<f64>) {
    shepard(weights);
    let nodes = || weights.iter().enumerate();
    let mean: Vector2<f64> = nodes().map(|(i, w)| *w * offset(i)).sum();
    let covariance: Matrix2<f64> = nodes()
        .map(|(i, w)| {
            let away = offset(i) - mean;
            *w * away * away.transpose()
        })
        .sum();
    let slope = slope(&covariance, &mean);
    for (i, weight) in weights.iter_mut().enumerate() {
        *weight *= 1.0 - slope.dot(&(offset(i) - mean));
    }
}

/// C⁻¹ m, direction by direction, so that nodes in a line are no exception.
fn slope(covariance: &Matrix2<f64>, mean: &Vector2<f64>) -> Vector2<f64> {
    let eigen = SymmetricEigen::new(*covariance);
    let widest = eigen.eigenvalues.max();
    let mut slope = Vector2::zeros();
    for (spread, direction) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        let along = direction.dot(mean);
        if *spread > FLATTEST * widest {
            let trusted = (FARTHEST * spread / (along * along)).min(1.0);
            slope += direction * (along / spread * trusted);
        }
    }
    slope
}
