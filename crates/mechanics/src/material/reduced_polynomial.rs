//! The reduced polynomial W = C10 (Ī1 − 3) + C20 (Ī1 − 3)² + C30 (Ī1 − 3)³, with Ī1 the trace of C̄ = F̄^T F̄, at
//! constant volume or with ½ κ (J − 1)²; with three terms it is Yeoh's law [Yeoh 1993].
//!
//! P̄ = 2 W′ F̄ and Ā = 2 W′ 1 + 4 W″ F̄ ⊗ F̄, which `Isochoric` makes a stress; at rest μ = 2 C10, E = 6 C10 if
//! incompressible.
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: C20 and C30 may be negative; the force falls then beyond some stretch. It cannot be fitted to tension and
//! equibiaxial tension that differ as they do in a law with Ī2.

use nalgebra::{Matrix3, SVector};
use palpate_files::tissue::LawName;

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::volume::Volume;
use crate::Error;

/// Most coefficients of the law.
const MAX_ORDER: usize = 3;

/// The reduced polynomial of order 1 to 3; of order 3 Yeoh's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReducedPolynomial {
    /// C10, C20 and C30 [Pa]; those beyond the order are zero.
    coefficients: [f64; MAX_ORDER],
    order: usize,
    volume: Volume,
}

impl ReducedPolynomial {
    /// From C10, C20 and C30 [Pa], or the first one or two of them; the volume cannot change.
    ///
    /// # Errors
    /// Unless there are one to three finite numbers and 0 < C10.
    pub fn incompressible(coefficients: &[f64]) -> Result<Self, Error> {
        Self::new(coefficients, Volume::INCOMPRESSIBLE)
    }

    /// From C10, C20 and C30 [Pa], or the first one or two of them, and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// Unless there are one to three finite numbers, 0 < C10 and 0 < κ.
    pub fn compressible(coefficients: &[f64], bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(coefficients, Volume::compressible(bulk_modulus)?)
    }

    fn new(coefficients: &[f64], volume: Volume) -> Result<Self, Error> {
        let order = coefficients.len();
        let c10 = coefficients.first().copied().unwrap_or(0.0);
        let finite = coefficients.iter().all(|value| value.is_finite());
        if !(finite && order <= MAX_ORDER && c10 > 0.0) {
            return Err(Error::ReducedPolynomialOutOfRange { order, c10 });
        }
        let mut own = [0.0; MAX_ORDER];
        own[..order].copy_from_slice(coefficients);
        Ok(Self {
            coefficients: own,
            order,
            volume,
        })
    }

    /// W, W′ and W″ [Pa] by Ī1 − 3, of this deformation without change of volume.
    fn by_invariant(&self, f: &Matrix3<f64>) -> [f64; 3] {
        let i = f.norm_squared() - 3.0;
        let [c10, c20, c30] = self.coefficients;
        [
            i * (c10 + i * (c20 + i * c30)),
            c10 + i * (2.0 * c20 + 3.0 * i * c30),
            2.0 * c20 + 6.0 * i * c30,
        ]
    }
}

impl Law for ReducedPolynomial {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        self.by_invariant(&Isochoric::of(f).f)[0]
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        let [_, slope, _] = self.by_invariant(&isochoric.f);
        isochoric.stress(&(2.0 * slope * isochoric.f))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        let [_, slope, curvature] = self.by_invariant(&isochoric.f);
        let flat = SVector::<f64, 9>::from_column_slice(isochoric.f.as_slice());
        let inner =
            Tangent::from_diagonal_element(2.0 * slope) + 4.0 * curvature * flat * flat.transpose();
        isochoric.tangent(&(2.0 * slope * isochoric.f), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        let keys = LawName::ReducedPolynomial.row().keys();
        keys.zip(self.coefficients).take(self.order).collect()
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let mut unit = [0.0; MAX_ORDER];
        unit[index.min(MAX_ORDER - 1)] = 1.0;
        let unit = Self {
            coefficients: unit,
            ..*self
        };
        let [_, slope, _] = unit.by_invariant(&isochoric.f);
        (isochoric.stress(&(2.0 * slope * isochoric.f)), 0.0)
    }
}
