//! Resistance to a change of volume: ½ κ θ², with θ = det F − 1 at finite strain and tr F − 3 at small.
//!
//! *How we know*: `laws::dilation_has_its_gradient_and_curvature`, and the battery over every law.

use nalgebra::{Matrix3, Vector3};

use super::law::Tangent;
use crate::Error;

/// How strain is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Strain {
    /// Linear in the displacement; a rotation strains.
    Small,
    /// Exact; a rotation does not strain.
    Finite,
}

/// How a law resists a change of volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Volume {
    /// Bulk modulus κ [Pa]; infinite when the volume cannot change.
    pub bulk_modulus: f64,
    /// Which dilation θ is meant.
    pub strain: Strain,
}

impl Volume {
    /// At finite strain, without change.
    pub(crate) const INCOMPRESSIBLE: Self = Self {
        bulk_modulus: f64::INFINITY,
        strain: Strain::Finite,
    };

    /// At finite strain, with a bulk modulus [Pa] that is a positive number.
    pub(crate) fn compressible(bulk_modulus: f64) -> Result<Self, Error> {
        if !(bulk_modulus > 0.0 && bulk_modulus.is_finite()) {
            return Err(Error::BulkModulusOutOfRange { bulk_modulus });
        }
        Ok(Self {
            bulk_modulus,
            strain: Strain::Finite,
        })
    }

    /// Dilation θ(F) [-].
    pub fn dilation(&self, f: &Matrix3<f64>) -> f64 {
        match self.strain {
            Strain::Small => f.trace() - 3.0,
            Strain::Finite => f.determinant() - 1.0,
        }
    }

    /// ∂θ/∂F [-]: the cofactors of F, or the identity.
    pub fn dilation_gradient(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        match self.strain {
            Strain::Small => Matrix3::identity(),
            Strain::Finite => cofactors(f),
        }
    }

    /// ∂²θ/∂F∂F [-], numbered as a [`Tangent`].
    pub fn dilation_curvature(&self, f: &Matrix3<f64>) -> Tangent {
        let mut curvature = Tangent::zeros();
        self.add_dilation_curvature(1.0, f, &mut curvature);
        curvature
    }

    /// Adds `factor` times [`Self::dilation_curvature`] to `tangent`.
    pub(crate) fn add_dilation_curvature(
        &self,
        factor: f64,
        f: &Matrix3<f64>,
        tangent: &mut Tangent,
    ) {
        if self.strain == Strain::Finite {
            // det F = F_0 · (F_1 × F_2): column c against the next is ± the cross matrix of the third.
            for first in 0..3 {
                let (second, third) = ((first + 1) % 3, (first + 2) % 3);
                let column = factor * f.column(third);
                for i in 0..3 {
                    let (next, last) = ((i + 1) % 3, (i + 2) % 3);
                    for (k, entry) in [(next, column[last]), (last, -column[next])] {
                        tangent[(3 * first + i, 3 * second + k)] += entry;
                        tangent[(3 * second + k, 3 * first + i)] += entry;
                    }
                }
            }
        }
    }

    pub(crate) fn energy(&self, f: &Matrix3<f64>) -> f64 {
        0.5 * self.bulk_modulus * self.dilation(f).powi(2)
    }

    pub(crate) fn stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        self.bulk_modulus * self.dilation(f) * self.dilation_gradient(f)
    }

    pub(crate) fn tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let gradient = self.dilation_gradient(f);
        let flat = nalgebra::SVector::<f64, 9>::from_column_slice(gradient.as_slice());
        self.bulk_modulus
            * (flat * flat.transpose() + self.dilation(f) * self.dilation_curvature(f))
    }
}

pub(crate) fn cofactors(f: &Matrix3<f64>) -> Matrix3<f64> {
    let [a, b, c]: [Vector3<f64>; 3] = [0, 1, 2].map(|i| f.column(i).into_owned());
    Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)])
}
