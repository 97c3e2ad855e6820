//! The isochoric version Ψ(F) = W(F̄) of an energy W(F), with F̄ = J^(−1/3) F and J = det F: it does not
//! depend on a change of volume [Flory 1961].
//!
//! With P̄ = ∂W/∂F and Ā = ∂²W/∂F∂F at F̄, the cofactors H of F̄ (its inverse, transposed) and q = P̄:F̄:
//!   P = J^(−1/3) (P̄ − ⅓ q H)
//!   ∂P/∂F = J^(−2/3) (Ā − ⅓ (R ⊗ H + H ⊗ R) + ⅑ (q + F̄:Ā:F̄) H ⊗ H + ⅓ q K),
//! where R = P̄ + Ā:F̄ and K:dF = H dF^T H.
//!
//! *How we know*: `laws::stress_is_the_derivative_of_energy`, `laws::tangent_is_the_derivative_of_stress`,
//! `laws::distortion_does_not_feel_a_pure_dilation`.
//!
//! *Limits*: where J is no positive number there is no such F̄ and everything is NaN, for a solver to
//! notice.

use nalgebra::{Matrix3, SVector};

use super::law::Tangent;
use super::volume::cofactors;

/// A deformation gradient without its change of volume, and the way back.
pub(crate) struct Isochoric {
    /// F̄ [-]; NaN where J is no positive number.
    pub(crate) f: Matrix3<f64>,
    cofactors: Matrix3<f64>,
    scale: f64,
}

impl Isochoric {
    pub(crate) fn of(f: &Matrix3<f64>) -> Self {
        let ratio = f.determinant();
        let scale = if ratio > 0.0 && ratio.is_finite() {
            1.0 / ratio.cbrt()
        } else {
            f64::NAN
        };
        let f = scale * f;
        Self {
            f,
            cofactors: cofactors(&f),
            scale,
        }
    }

    /// ∂Ψ/∂F [Pa] from P̄ [Pa].
    pub(crate) fn stress(&self, inner: &Matrix3<f64>) -> Matrix3<f64> {
        self.scale * (inner - inner.dot(&self.f) / 3.0 * self.cofactors)
    }

    /// ∂²Ψ/∂F∂F [Pa] from P̄ and Ā [Pa].
    pub(crate) fn tangent(&self, inner: &Matrix3<f64>, inner_tangent: &Tangent) -> Tangent {
        let mut along = SVector::<f64, 9>::zeros();
        for (column, weight) in inner_tangent.column_iter().zip(self.f.iter()) {
            along += column * *weight;
        }
        let mut tangent = *inner_tangent;
        self.complete(inner, &along, &mut tangent);
        tangent
    }

    /// The same where Ā is a `modulus` [Pa] times the identity, and so P̄ that times F̄.
    pub(crate) fn tangent_of_modulus(&self, modulus: f64) -> Tangent {
        let inner = modulus * self.f;
        let mut tangent = Tangent::from_diagonal_element(modulus);
        self.complete(&inner, &flat(&inner), &mut tangent);
        tangent
    }

    /// Makes ∂²Ψ/∂F∂F of Ā, with `along` = Ā:F̄.
    fn complete(&self, inner: &Matrix3<f64>, along: &SVector<f64, 9>, tangent: &mut Tangent) {
        let (f, h) = (flat(&self.f), flat(&self.cofactors));
        let q = inner.dot(&self.f);
        // Both rank-one terms and H ⊗ H at once: m ⊗ H + H ⊗ m.
        let m = (q + f.dot(along)) / 18.0 * h - (flat(inner) + along) / 3.0;
        let squared = self.scale.powi(2);
        let third = q / 3.0;
        for (column, entries) in tangent.as_mut_slice().chunks_exact_mut(9).enumerate() {
            let (k, l) = (column % 3, column / 3);
            for j in 0..3 {
                for i in 0..3 {
                    let row = 3 * j + i;
                    // K at (ij)(kl) is H_il H_kj.
                    let turned = h[3 * l + i] * h[3 * j + k];
                    let entry = &mut entries[row];
                    *entry += m[row] * h[column] + h[row] * m[column] + third * turned;
                    *entry *= squared;
                }
            }
        }
    }
}

fn flat(m: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_column_slice(m.as_slice())
}
