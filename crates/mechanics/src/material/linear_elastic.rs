//! Isotropic linear elasticity at small strain.
//!
//! ε = sym(F) − 1, Ψ = ½ λ (tr ε)² + μ ε:ε, P = λ (tr ε) 1 + 2 μ ε.
//!
//! *How we know*: `laws::stress_is_the_derivative_of_energy`, `laws::tangent_is_the_derivative_of_stress`.
//!
//! *Limits*: small strain; a rotation strains it.

use nalgebra::Matrix3;

use super::law::{Law, Tangent};
use super::volume::{Strain, Volume};
use crate::Error;

/// Poisson's ratio that stands for incompressible in a law that cannot be [-]; the stiffness of a
/// half-space is then right to one part in a hundred thousand.
pub(crate) const NEARLY_INCOMPRESSIBLE: f64 = 0.499_99;

/// Isotropic linear elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearElastic {
    youngs_modulus: f64,
    poissons_ratio: f64,
}

impl LinearElastic {
    /// From Young's modulus [Pa] and Poisson's ratio [-].
    ///
    /// # Errors
    /// Unless 0 < E and −1 < ν < ½.
    pub fn new(youngs_modulus: f64, poissons_ratio: f64) -> Result<Self, Error> {
        if !(youngs_modulus > 0.0 && youngs_modulus.is_finite()) {
            return Err(Error::YoungsModulusOutOfRange { youngs_modulus });
        }
        if !(poissons_ratio > -1.0 && poissons_ratio < 0.5) {
            return Err(Error::PoissonsRatioOutOfRange { poissons_ratio });
        }
        Ok(Self {
            youngs_modulus,
            poissons_ratio,
        })
    }

    /// The linear law that `law` is for a small strain added to the rest state: its consistent
    /// linearization there. An incompressible one becomes nearly so.
    ///
    /// # Errors
    /// When the tangent is not that of a stable isotropic solid.
    pub fn at_rest(law: &dyn Law) -> Result<Self, Error> {
        // ∂P_01/∂F_01 = μ.
        let shear = law.distortion_tangent(&Matrix3::identity())[(3, 3)];
        // With s = μ/κ, ν = (3 − 2 s) / (2 (3 + s)), which an infinite κ does not disturb.
        let softness = shear / law.volume().bulk_modulus;
        let poissons_ratio = (3.0 - 2.0 * softness) / (2.0 * (3.0 + softness));
        let poissons_ratio = poissons_ratio.min(NEARLY_INCOMPRESSIBLE);
        Self::new(2.0 * shear * (1.0 + poissons_ratio), poissons_ratio)
    }

    /// Young's modulus E [Pa].
    pub fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    /// Poisson's ratio ν [-].
    pub fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }

    /// Shear modulus G = μ = E / (2 (1 + ν)) [Pa].
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
    }

    /// Bulk modulus K = E / (3 (1 − 2 ν)) [Pa].
    pub fn bulk_modulus(&self) -> f64 {
        self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
    }

    /// Lamé's first parameter λ = E ν / ((1 + ν)(1 − 2 ν)) [Pa].
    pub fn lame_modulus(&self) -> f64 {
        let nu = self.poissons_ratio;
        self.youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }
}

fn deviator(f: &Matrix3<f64>) -> Matrix3<f64> {
    let strain = 0.5 * (f + f.transpose()) - Matrix3::identity();
    strain - strain.trace() / 3.0 * Matrix3::identity()
}

impl Law for LinearElastic {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        self.shear_modulus() * deviator(f).norm_squared()
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        2.0 * self.shear_modulus() * deviator(f)
    }

    fn distortion_tangent(&self, _f: &Matrix3<f64>) -> Tangent {
        let shear = self.shear_modulus();
        Tangent::from_fn(|row, column| {
            let (i, j, k, l) = (row % 3, row / 3, column % 3, column / 3);
            let same = |a: usize, b: usize| f64::from(u8::from(a == b));
            shear
                * (same(i, k) * same(j, l) + same(i, l) * same(j, k)
                    - 2.0 / 3.0 * same(i, j) * same(k, l))
        })
    }

    fn volume(&self) -> Volume {
        Volume {
            bulk_modulus: self.lame_modulus() + 2.0 / 3.0 * self.shear_modulus(),
            strain: Strain::Small,
        }
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("youngs_modulus_pa", self.youngs_modulus),
            ("poissons_ratio", self.poissons_ratio),
        ]
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        // 2 μ = E / (1 + ν), 1/κ = 3 (1 − 2 ν) / E.
        let (modulus, nu) = (self.youngs_modulus, self.poissons_ratio);
        let stress = self.distortion_stress(f);
        match index {
            0 => (stress / modulus, -3.0 * (1.0 - 2.0 * nu) / modulus.powi(2)),
            _ => (-stress / (1.0 + nu), -6.0 / modulus),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_is_no_solid() {
        assert!(LinearElastic::new(0.0, 0.3).is_err());
        assert!(LinearElastic::new(f64::NAN, 0.3).is_err());
        assert!(LinearElastic::new(1e4, 0.5).is_err());
        assert!(LinearElastic::new(1e4, 0.6).is_err());
        assert!(LinearElastic::new(1e4, -1.0).is_err());
    }

    #[test]
    fn its_own_linearization_is_itself() {
        let law = LinearElastic::new(1e4, 0.45).unwrap();
        let again = LinearElastic::at_rest(&law).unwrap();
        // Rounding: 1/(1 − 2ν) amplifies the last digits tenfold.
        assert!((again.youngs_modulus() / 1e4 - 1.0).abs() < 1e-13);
        assert!((again.poissons_ratio() - 0.45).abs() < 1e-14);
    }
}
