//! An isotropic function of C = F^T F by its eigenvalues, and the stress F S(C) with its derivative.
//!
//! With the eigenvectors n of C, its eigenvalues c, and S = Σ s(c_i) n_i ⊗ n_i, an increment of S is in
//! the basis n that of C, entry by entry, times the divided differences h_ij of s between c_i and c_j
//! [Higham 2008, section 3.2]. So with a_i = F n_i, of the columns of P and F in that basis,
//!   ∂P_i/∂F_j = h_ij a_j ⊗ a_i + δ_ij (s_i 1 + Σ_m h_im a_m ⊗ a_m).
//!
//! *How we know*: `laws::tangent_is_the_derivative_of_stress`, at equal stretches too.
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
        // The iteration is for numbers.
        let finite = c.iter().all(|entry| entry.is_finite());
        let found = finite.then(|| SymmetricEigen::try_new(c, f64::EPSILON, MAX_ITERATIONS));
        let nowhere = || (Vector3::repeat(f64::NAN), Matrix3::repeat(f64::NAN));
        let (squares, axes) = found
            .flatten()
            .map_or_else(nowhere, |found| (found.eigenvalues, found.eigenvectors));
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
        let dyad = |i: usize, j: usize| self.moved.column(i) * self.moved.column(j).transpose();
        let block = |i: usize, j: usize| {
            let mut block = differences[(i, j)] * dyad(j, i);
            if i == j {
                block += Matrix3::from_diagonal_element(values[i]);
                for m in 0..3 {
                    block += differences[(i, m)] * dyad(m, m);
                }
            }
            block
        };
        // Out of the basis, one side after the other.
        let blocks = [0, 1, 2].map(|i| [0, 1, 2].map(|j| block(i, j)));
        let half = blocks.map(|row| [0, 1, 2].map(|l| self.sum(&row, l)));
        let mut tangent = Tangent::zeros();
        for (j, l) in (0..3).flat_map(|j| (0..3).map(move |l| (j, l))) {
            let column = [half[0][l], half[1][l], half[2][l]];
            tangent
                .fixed_view_mut::<3, 3>(3 * j, 3 * l)
                .copy_from(&self.sum(&column, j));
        }
        tangent
    }

    /// Σ_i n_i[component] blocks_i.
    fn sum(&self, blocks: &[Matrix3<f64>; 3], component: usize) -> Matrix3<f64> {
        let weights = self.axes.row(component);
        blocks[0] * weights[0] + blocks[1] * weights[1] + blocks[2] * weights[2]
    }
}
