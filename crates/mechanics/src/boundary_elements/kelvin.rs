use nalgebra::Matrix3;

use crate::{LinearElastic, Vec3};

/// Kelvin's solution: a unit force in an infinite solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kelvin {
    shear_modulus: f64,
    poissons_ratio: f64,
}

impl Kelvin {
    /// In the solid of `law`.
    pub fn new(law: &LinearElastic) -> Self {
        Self {
            shear_modulus: law.shear_modulus(),
            poissons_ratio: law.poissons_ratio(),
        }
    }

    /// u*ᵢₖ [m/N]: displacement along k at `r` [m] from a unit force along i.
    pub fn displacement(&self, r: &Vec3) -> Matrix3<f64> {
        let distance = r.norm();
        let unit = r / distance;
        let shape =
            Matrix3::identity() * (3.0 - 4.0 * self.poissons_ratio) + unit * unit.transpose();
        shape * (self.displacement_factor() / distance) // (4.3), corrected
    }

    /// p*ᵢₖ [1/m²]: traction along k, on a plane of outward unit `normal` at `r` [m], from a unit force along
    /// i.
    pub fn traction(&self, r: &Vec3, normal: &Vec3) -> Matrix3<f64> {
        let distance = r.norm();
        let unit = r / distance;
        let away = 1.0 - 2.0 * self.poissons_ratio;
        let radial = Matrix3::identity() * away + unit * unit.transpose() * 3.0;
        let turning = unit * normal.transpose() - normal * unit.transpose();
        let shape = radial * unit.dot(normal) - turning * away;
        shape * (self.traction_factor() / distance.powi(2)) // (4.3), corrected
    }

    /// 1/(16 π G (1 − ν)) [m²/N].
    pub(super) fn displacement_factor(&self) -> f64 {
        let denominator = 16.0 * std::f64::consts::PI * self.shear_modulus;
        1.0 / (denominator * (1.0 - self.poissons_ratio))
    }

    /// −1/(8 π (1 − ν)) [-].
    pub(super) fn traction_factor(&self) -> f64 {
        -1.0 / (8.0 * std::f64::consts::PI * (1.0 - self.poissons_ratio))
    }

    pub(super) fn poissons_ratio(&self) -> f64 {
        self.poissons_ratio
    }
}
