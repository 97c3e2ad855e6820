//! The reduced polynomial W = Σ_i C_i0 (Ī1 − 3)^i with one to three terms, Ī1 the first invariant of C̄ = F̄^T F̄, at
//! constant volume or with ½ κ (J − 1)². With one term it is neo-Hookean, with three it is Yeoh's law [Yeoh 1993].
//!
//! P̄ = 2 W' F̄ and Ā = 2 W' 1 + 4 W'' F̄ ⊗ F̄, which `Isochoric` makes a stress and its derivative; at rest μ = 2 C10,
//! E = 6 C10 if incompressible.
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: 0 < C10; with a negative last constant its force falls beyond some stretch.

use nalgebra::{Matrix3, SVector};

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::volume::Volume;
use crate::Error;

const NAMES: [&str; 3] = ["c10_pa", "c20_pa", "c30_pa"];

/// The reduced polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct ReducedPolynomial {
    constants: Vec<f64>,
    volume: Volume,
}

impl ReducedPolynomial {
    /// From C10 and perhaps C20 and C30 [Pa]; the volume cannot change.
    ///
    /// # Errors
    /// Unless there are one to three, 0 < C10, all finite.
    pub fn incompressible(constants: &[f64]) -> Result<Self, Error> {
        Self::new(constants, Volume::INCOMPRESSIBLE)
    }

    /// From C10 and perhaps C20 and C30 [Pa], and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// As [`incompressible`](Self::incompressible), and unless 0 < κ.
    pub fn compressible(constants: &[f64], bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(constants, Volume::compressible(bulk_modulus)?)
    }

    fn new(constants: &[f64], volume: Volume) -> Result<Self, Error> {
        let count = (1..=NAMES.len()).contains(&constants.len());
        if !(count && constants[0] > 0.0 && constants.iter().all(|constant| constant.is_finite())) {
            return Err(Error::ReducedPolynomialOutOfRange {
                constants: constants.to_vec(),
            });
        }
        Ok(Self {
            constants: constants.to_vec(),
            volume,
        })
    }

    /// W, W' and W'' [Pa] where Ī1 − 3 is `x`.
    fn derivatives(&self, x: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        // Horner's scheme, with its derivatives.
        for constant in self.constants.iter().rev() {
            sums[2] = sums[2] * x + 2.0 * sums[1];
            sums[1] = sums[1] * x + sums[0];
            sums[0] = sums[0] * x + constant;
        }
        // The polynomial begins with its first power: W = x q(x).
        let [q, first, second] = sums;
        [x * q, q + x * first, 2.0 * first + x * second]
    }
}

impl Law for ReducedPolynomial {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        self.derivatives(Isochoric::of(f).f.norm_squared() - 3.0)[0]
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        let [_, first, _] = self.derivatives(isochoric.f.norm_squared() - 3.0);
        isochoric.stress(&(2.0 * first * isochoric.f))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        let [_, first, second] = self.derivatives(isochoric.f.norm_squared() - 3.0);
        let along = SVector::<f64, 9>::from_column_slice(isochoric.f.as_slice());
        let inner =
            Tangent::from_diagonal_element(2.0 * first) + 4.0 * second * along * along.transpose();
        isochoric.tangent(&(2.0 * first * isochoric.f), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        NAMES
            .into_iter()
            .zip(self.constants.iter().copied())
            .collect()
    }

    fn by_parameter(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let x = isochoric.f.norm_squared() - 3.0;
        let power = (index + 1) as f64 * x.powi(index as i32);
        (isochoric.stress(&(2.0 * power * isochoric.f)), 0.0)
    }
}
