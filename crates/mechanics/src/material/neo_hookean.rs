//! The neo-Hookean law: W = C10 (Ī1 − 3), with Ī1 the trace of C̄ = F̄^T F̄, at constant volume or with
//! ½ κ (J − 1)². (6.8)
//!
//! P̄ = 2 C10 F̄, which `Isochoric` makes a stress; at rest μ = 2 C10, E = 6 C10 if incompressible.
//! With D1 = 2/κ it is Abaqus' and CalculiX' `*HYPERELASTIC, NEO HOOKE`.
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: stiffens little: beyond a stretch of about 1.5 tissue is stiffer.

use nalgebra::Matrix3;

use super::isochoric::Isochoric;
use super::law::{Distortion, Law, Tangent};
use super::volume::Volume;
use crate::Error;

/// The neo-Hookean law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    c10: f64,
    volume: Volume,
}

impl NeoHookean {
    /// From C10 [Pa], half the shear modulus at rest; the volume cannot change.
    ///
    /// # Errors
    /// Unless 0 < C10.
    pub fn incompressible(c10: f64) -> Result<Self, Error> {
        Self::new(c10, Volume::INCOMPRESSIBLE)
    }

    /// From C10 [Pa] and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// Unless 0 < C10 and 0 < κ, both finite.
    pub fn compressible(c10: f64, bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(c10, Volume::compressible(bulk_modulus)?)
    }

    fn new(c10: f64, volume: Volume) -> Result<Self, Error> {
        if !(c10 > 0.0 && c10.is_finite()) {
            return Err(Error::NeoHookeanOutOfRange { c10 });
        }
        Ok(Self { c10, volume })
    }
}

impl Law for NeoHookean {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        self.c10 * (Isochoric::of(f).f.norm_squared() - 3.0) // (6.8)
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        isochoric.stress(&(2.0 * self.c10 * isochoric.f))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        isochoric.tangent_of_modulus(2.0 * self.c10)
    }

    fn distortion(&self, f: &Matrix3<f64>) -> Distortion {
        let isochoric = Isochoric::of(f);
        Distortion {
            energy: self.c10 * (isochoric.f.norm_squared() - 3.0), // (6.8)
            stress: isochoric.stress(&(2.0 * self.c10 * isochoric.f)),
            tangent: isochoric.tangent_of_modulus(2.0 * self.c10),
        }
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![("c10_pa", self.c10)]
    }

    fn sensitivities(&self, _index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        (self.distortion_stress(f) / self.c10, 0.0)
    }
}
