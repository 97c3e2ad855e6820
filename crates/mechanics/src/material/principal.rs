//! An isotropic function of C = F^T F by its eigenvalues, and the stress F S(C) with its derivative.
//!
//! With the eigenvectors n of C, its eigenvalues c, and S = Σ s(c_i) n_i ⊗ n_i, an increment of S is in
//! the basis n that of C, entry by entry, times the divided differences h_ij of s between c_i and c_j
//! [Higham 2008, section 3.2]. With a_i = F n_i and V_ij = a_i ⊗ n_j + a_j ⊗ n_i that is
//!   ∂P/∂F = 1 ⊗ S + ½ Σ_i h_ii V_ii ⊗ V_ii + Σ_i<j h_ij V_ij ⊗ V_ij, where (1 ⊗ S):dF = dF S.
//!
//! *How we know*: `laws::tangent_is_the_derivative_of_stress_at_equal_stretches`.
//!
//! *Limits*: divided differences are the caller's, who can write them so that they do not cancel.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::law::Tangent;

/// More than the QR iteration for three eigenvalues ever needs.
const MAX_ITERATIONS: usize = 100;

/// Eigenvalues and eigenvectors of F^T F; NaN where they do not exist.
pub(crate) struct Principal {
    /// λ_i² [-].
    pub(crate) squares: Vector3<f64>,
    axes: Matrix3<f64>,
    moved: Matrix3<f64>,
}

impl Principal {
    pub(crate) fn of(f: &Matrix3<f64>) -> Self {
        let c = f.tr_mul(f);
        let (squares, axes) = match c[(2, 0)] == 0.0 && c[(2, 1)] == 0.0 {
            true => in_a_plane(&c),
            false => in_space(c),
        };
        Self {
            squares,
            axes,
            moved: f * axes,
        }
    }

    /// F S [Pa] from the eigenvalues of S [Pa].
    pub(crate) fn stress(&self, values: &Vector3<f64>) -> Matrix3<f64> {
        self.moved * Matrix3::from_diagonal(values) * self.axes.transpose()
    }

    /// ∂(F S)/∂F [Pa] from the eigenvalues of S [Pa] and the divided differences by those of C [Pa].
    pub(crate) fn tangent(&self, values: &Vector3<f64>, differences: &Matrix3<f64>) -> Tangent {
        let mut tangent = Tangent::zeros();
        for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
            let one = self.moved.column(i) * self.axes.column(j).transpose();
            let other = self.moved.column(j) * self.axes.column(i).transpose();
            let both = one + other;
            let weight = if i == j { 0.5 } else { 1.0 } * differences[(i, j)];
            let columns = tangent.as_mut_slice().chunks_exact_mut(9);
            for (column, right) in columns.zip(both.iter()) {
                for (entry, left) in column.iter_mut().zip(both.iter()) {
                    *entry += weight * right * left;
                }
            }
        }
        let s = self.axes * Matrix3::from_diagonal(values) * self.axes.transpose();
        for (j, l) in (0..3).flat_map(|j| (0..3).map(move |l| (j, l))) {
            for i in 0..3 {
                tangent[(3 * j + i, 3 * l + i)] += s[(l, j)];
            }
        }
        tangent
    }
}

/// Where the third axis is one of the eigenvectors, as in every axisymmetric body. The smaller eigenvalue of the
/// plane comes from the determinant, which keeps its digits.
fn in_a_plane(c: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let [first, second, both] = [c[(0, 0)], c[(1, 1)], c[(1, 0)]];
    let half = 0.5 * (first - second);
    let large = 0.5 * (first + second) + half.hypot(both);
    let small = (first * second - both * both) / large;
    let (sin, cos) = (0.5 * both.atan2(half)).sin_cos();
    let axes = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    (Vector3::new(large, small, c[(2, 2)]), axes)
}

fn in_space(c: Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    // The iteration is for numbers.
    let finite = c.iter().all(|entry| entry.is_finite());
    let found = finite.then(|| SymmetricEigen::try_new(c, f64::EPSILON, MAX_ITERATIONS));
    let nowhere = || (Vector3::repeat(f64::NAN), Matrix3::repeat(f64::NAN));
    found
        .flatten()
        .map_or_else(nowhere, |found| (found.eigenvalues, found.eigenvectors))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the iteration for any matrix; a plane's eigenvalues are those, and its vectors make C again to rounding.
    #[test]
    fn a_plane_is_as_space() {
        let f: Matrix3<f64> = Matrix3::new(1.3, 0.4, 0.0, -0.2, 0.8, 0.0, 0.0, 0.0, 1.1);
        for scale in [1.0_f64, 1e-6, 1e6] {
            let f = f * scale;
            let c = f.tr_mul(&f);
            let (values, axes) = in_a_plane(&c);
            let (mut own, mut other) = (values, in_space(c).0);
            own.as_mut_slice().sort_by(f64::total_cmp);
            other.as_mut_slice().sort_by(f64::total_cmp);
            assert!((own - other).norm() < 1e-14 * c.norm());
            let again = axes * Matrix3::from_diagonal(&values) * axes.transpose();
            assert!((again - c).norm() < 1e-14 * c.norm());
        }
        let (values, axes) = in_a_plane(&Matrix3::identity());
        assert_eq!((values, axes), (Vector3::repeat(1.0), Matrix3::identity()));
    }
}
