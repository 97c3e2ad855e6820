//! The law of Mooney and Rivlin: W = C10 (Ī1 − 3) + C01 (Ī2 − 3), the invariants those of C̄ = F̄^T F̄,
//! at constant volume or with ½ κ (J − 1)². (6.7)
//!
//! Ī2 = ½ (Ī1² − C̄:C̄), so P̄ = 2 C10 F̄ + 2 C01 (Ī1 F̄ − F̄ C̄), which `Isochoric` makes a stress; at
//! rest μ = 2 (C10 + C01), E = 6 (C10 + C01) if incompressible [Mooney 1940; Rivlin 1948].
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: one of the two constants may be negative, as fits to one kind of test give it. The law is
//! stable at rest then, but not at every stretch: in simple tension or compression its force is zero
//! again at the stretch −C01/C10.

use nalgebra::Matrix3;

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::volume::Volume;
use crate::Error;

/// The law of Mooney and Rivlin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MooneyRivlin {
    c10: f64,
    c01: f64,
    volume: Volume,
}

impl MooneyRivlin {
    /// From C10 and C01 [Pa], whose sum is half the shear modulus at rest; the volume cannot change.
    ///
    /// # Errors
    /// Unless 0 < C10 + C01, both finite.
    pub fn incompressible(c10: f64, c01: f64) -> Result<Self, Error> {
        Self::new(c10, c01, Volume::INCOMPRESSIBLE)
    }

    /// From C10, C01 and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// Unless 0 < C10 + C01 and 0 < κ, all finite.
    pub fn compressible(c10: f64, c01: f64, bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(c10, c01, Volume::compressible(bulk_modulus)?)
    }

    fn new(c10: f64, c01: f64, volume: Volume) -> Result<Self, Error> {
        let sum = c10 + c01;
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(Error::MooneyRivlinOutOfRange { c10, c01 });
        }
        Ok(Self { c10, c01, volume })
    }
}

/// ∂Ī1/∂F and ∂Ī2/∂F at F̄ as if it were any F [-].
fn gradients(f: &Matrix3<f64>) -> [Matrix3<f64>; 2] {
    [2.0 * f, 2.0 * (f.norm_squared() * f - f * f.tr_mul(f))]
}

impl Law for MooneyRivlin {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        let f = Isochoric::of(f).f;
        let first = f.norm_squared();
        let second = 0.5 * (first.powi(2) - f.tr_mul(&f).norm_squared());
        self.c10 * (first - 3.0) + self.c01 * (second - 3.0) // (6.7)
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        let [first, second] = gradients(&isochoric.f);
        isochoric.stress(&(self.c10 * first + self.c01 * second))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        let f = &isochoric.f;
        let (left, right) = (f * f.transpose(), f.tr_mul(f));
        let [first, second] = gradients(f);
        let mut inner = Tangent::zeros();
        for (j, l) in (0..3).flat_map(|j| (0..3).map(move |l| (j, l))) {
            // ∂(Ī1 F − F C)_ij/∂F_kl = 2 F_ij F_kl − F_il F_kj + (Ī1 δ_jl − C_jl) δ_ik − δ_jl B_ik.
            let (one, other) = (f.column(j), f.column(l));
            let mut block = 2.0 * one * other.transpose() - other * one.transpose();
            let mut diagonal = -right[(j, l)];
            if j == l {
                diagonal += right.trace();
                block -= left;
            }
            block += Matrix3::from_diagonal_element(diagonal);
            block *= 2.0 * self.c01;
            if j == l {
                block += Matrix3::from_diagonal_element(2.0 * self.c10);
            }
            inner.fixed_view_mut::<3, 3>(3 * j, 3 * l).copy_from(&block);
        }
        isochoric.tangent(&(self.c10 * first + self.c01 * second), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![("c10_pa", self.c10), ("c01_pa", self.c01)]
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let gradients = gradients(&isochoric.f);
        (isochoric.stress(&gradients[index.min(1)]), 0.0)
    }
}
