//! The law of Holzapfel, Gasser and Ogden with dispersion [Gasser, Ogden and Holzapfel 2006]: a neo-Hookean matrix and two
//! families of fibres,
//!   W = C10 (Ī1 − 3) + k1/(2 k2) Σ (exp(k2 ⟨E⟩²) − 1),  E = κ (Ī1 − 3) + (1 − 3 κ)(Ī4 − 1),
//! with Ī4 = |F̄ a|² of each family's mean direction a at rest, at constant volume or with ½ K (J − 1)². The directions lie at
//! ±γ to the reference axis of a [`FibreFrame`], in its plane. The dispersion κ is 0 where all fibres of a family have its
//! direction, and 1/3 where they have none: the law is isotropic then.
//!
//! Fibres resist no compression: ⟨E⟩ is E where that is positive, else 0. So do Abaqus and FEBio [Abaqus 2017, Anisotropic
//! hyperelastic behavior; FEBio, Holzapfel-Gasser-Ogden]; with 0 < κ a family may then resist though its mean direction
//! is compressed. With γ = 0° or 90° the two families are one, of twice k1.
//!
//! With H = κ 1 + (1 − 3 κ) a ⊗ a, E = H:(C̄ − 1), w′ = k1 ⟨E⟩ exp(k2 ⟨E⟩²) and w″ = dw′/dE,
//!   P̄ = 2 C10 F̄ + Σ 2 w′ F̄ H,  Ā:dF = 2 C10 dF + Σ 2 w′ dF H + 4 w″ (F̄ H):dF F̄ H,
//! which `Isochoric` makes stress and tangent. C10 is half the shear modulus of the matrix. Nothing divides by k2.
//!
//! *How we know*: `laws` (the battery), `fibres` (closed forms, other laws in the limits, a thick tube).
//!
//! *Limits*: the tangent jumps where E is zero, at rest too, where a stretch along the fibres meets them and a compression does
//! not; there it is that of fibres that resist. An exponential that overflows makes stress infinite or NaN:
//! with k2 = 500, beyond E = 1.2.

use std::sync::Arc;

use nalgebra::{Matrix3, SVector};
use palpate_files::tissue::LawName;

use super::fibres::{FibreError, FibreFrame};
use super::isochoric::Isochoric;
use super::law::{Distortion, Law, Tangent};
use super::volume::Volume;
use crate::{Error, Vec3};

/// Two families of fibres, symmetric about a reference axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibres {
    /// Stiffness k1 of each family [Pa].
    pub k1: f64,
    /// How fast they stiffen, k2 [-].
    pub k2: f64,
    /// Their dispersion κ [-], from 0 to 1/3.
    pub dispersion: f64,
    /// Angle γ of each family to the reference axis [degrees], from 0 to 90.
    pub angle_deg: f64,
}

/// The law of Holzapfel, Gasser and Ogden.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HolzapfelGasserOgden {
    c10: f64,
    fibres: Fibres,
    frame: FibreFrame,
    /// H of each family [-].
    structure: [Matrix3<f64>; 2],
    volume: Volume,
}

impl HolzapfelGasserOgden {
    /// From C10 [Pa], half the shear modulus of the matrix, and its fibres, in [`FibreFrame::ALONG_AXES`]; the volume cannot
    /// change.
    ///
    /// # Errors
    /// Unless 0 < C10, 0 ≤ k1, 0 ≤ k2, 0 ≤ κ ≤ 1/3 and 0° ≤ γ ≤ 90°, all finite.
    pub fn incompressible(c10: f64, fibres: Fibres) -> Result<Self, Error> {
        Self::new(c10, fibres, Volume::INCOMPRESSIBLE)
    }

    /// As [`Self::incompressible`], with the bulk modulus K [Pa].
    ///
    /// # Errors
    /// As [`Self::incompressible`], and unless 0 < K.
    pub fn compressible(c10: f64, fibres: Fibres, bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(c10, fibres, Volume::compressible(bulk_modulus)?)
    }

    fn new(c10: f64, fibres: Fibres, volume: Volume) -> Result<Self, Error> {
        let Fibres {
            k1,
            k2,
            dispersion,
            angle_deg,
        } = fibres;
        let finite = [c10, k1, k2].iter().all(|value| value.is_finite());
        let in_range = c10 > 0.0
            && k1 >= 0.0
            && k2 >= 0.0
            && (0.0..=1.0 / 3.0).contains(&dispersion)
            && (0.0..=90.0).contains(&angle_deg);
        if !(finite && in_range) {
            let error = FibreError::OutOfRange {
                c10,
                k1,
                k2,
                dispersion,
                angle_deg,
            };
            return Err(error.into());
        }
        Ok(Self::with_frame(
            c10,
            fibres,
            FibreFrame::ALONG_AXES,
            volume,
        ))
    }

    fn with_frame(c10: f64, fibres: Fibres, frame: FibreFrame, volume: Volume) -> Self {
        let structure = directions(&fibres, &frame).map(|a| {
            fibres.dispersion * Matrix3::identity()
                + (1.0 - 3.0 * fibres.dispersion) * a * a.transpose()
        });
        Self {
            c10,
            fibres,
            frame,
            structure,
            volume,
        }
    }

    /// The same with its fibres in `frame`.
    #[must_use]
    pub fn turned_to(&self, frame: FibreFrame) -> Self {
        Self::with_frame(self.c10, self.fibres, frame, self.volume)
    }

    /// Strain E of each family [-], below zero where it is slack.
    pub fn fibre_strains(&self, f: &Matrix3<f64>) -> [f64; 2] {
        self.strains(&Isochoric::of(f).f)
    }

    fn strains(&self, f: &Matrix3<f64>) -> [f64; 2] {
        // Exactly zero at rest.
        let green = f.tr_mul(f) - Matrix3::identity();
        self.structure.map(|h| h.dot(&green))
    }

    /// H and E of the families that resist, or are about to.
    fn stretched(&self, f: &Matrix3<f64>) -> impl Iterator<Item = (&Matrix3<f64>, f64)> {
        let each = self.structure.iter().zip(self.strains(f));
        each.filter(|(_, strain)| *strain >= 0.0)
    }

    /// w′/k1 [-].
    fn slope(&self, strain: f64) -> f64 {
        strain * (self.fibres.k2 * strain * strain).exp()
    }

    /// w″/k1 [-].
    fn curvature(&self, strain: f64) -> f64 {
        let exponent = self.fibres.k2 * strain * strain;
        (1.0 + 2.0 * exponent) * exponent.exp()
    }

    fn inner_energy(&self, f: &Matrix3<f64>) -> f64 {
        let matrix = self.c10 * (f.norm_squared() - 3.0);
        let fibres = self.stretched(f).map(|(_, strain)| {
            let exponent = self.fibres.k2 * strain * strain;
            // (e^x − 1)/x, which is 1 at 0.
            let ratio = if exponent == 0.0 {
                1.0
            } else {
                exponent.exp_m1() / exponent
            };
            0.5 * self.fibres.k1 * strain * strain * ratio
        });
        matrix + fibres.sum::<f64>()
    }

    fn inner_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let fibres = self
            .stretched(f)
            .map(|(h, strain)| 2.0 * self.fibres.k1 * self.slope(strain) * (f * h));
        2.0 * self.c10 * f + fibres.sum::<Matrix3<f64>>()
    }

    fn inner_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let mut tangent = Tangent::from_diagonal_element(2.0 * self.c10);
        for (h, strain) in self.stretched(f) {
            let fh = f * h;
            let flat = SVector::<f64, 9>::from_column_slice(fh.as_slice());
            tangent += 4.0 * self.fibres.k1 * self.curvature(strain) * flat * flat.transpose();
            let slope = 2.0 * self.fibres.k1 * self.slope(strain);
            for (j, l) in (0..3).flat_map(|j| (0..3).map(move |l| (j, l))) {
                for i in 0..3 {
                    tangent[(3 * j + i, 3 * l + i)] += slope * h[(l, j)];
                }
            }
        }
        tangent
    }
}

/// a of both families, of length one [-].
fn directions(fibres: &Fibres, frame: &FibreFrame) -> [Vec3; 2] {
    let (sin, cos) = fibres.angle_deg.to_radians().sin_cos();
    [sin, -sin].map(|sin| cos * frame.axis() + sin * frame.across())
}

impl Law for HolzapfelGasserOgden {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        self.inner_energy(&Isochoric::of(f).f)
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        isochoric.stress(&self.inner_stress(&isochoric.f))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        self.distortion(f).tangent
    }

    fn distortion(&self, f: &Matrix3<f64>) -> Distortion {
        let isochoric = Isochoric::of(f);
        let inner = self.inner_stress(&isochoric.f);
        Distortion {
            energy: self.inner_energy(&isochoric.f),
            stress: isochoric.stress(&inner),
            tangent: isochoric.tangent(&inner, &self.inner_tangent(&isochoric.f)),
        }
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        let Fibres {
            k1,
            k2,
            dispersion,
            angle_deg,
        } = self.fibres;
        let keys = LawName::HolzapfelGasserOgden.row().keys();
        keys.zip([self.c10, k1, k2, dispersion, angle_deg])
            .collect()
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let f = &isochoric.f;
        if index == 0 {
            return (isochoric.stress(&(2.0 * f)), 0.0);
        }
        let green = f.tr_mul(f) - Matrix3::identity();
        let directions = directions(&self.fibres, &self.frame);
        // da/dγ is a at an angle larger by a right one.
        let turned = Fibres {
            angle_deg: self.fibres.angle_deg + 90.0,
            ..self.fibres
        };
        let slopes = self::directions(&turned, &self.frame);
        let k1 = self.fibres.k1;
        let mut inner = Matrix3::zeros();
        for (family, strain) in self.strains(f).into_iter().enumerate() {
            // Nor of what is no number.
            if strain.is_nan() || strain <= 0.0 {
                continue;
            }
            let (h, a) = (self.structure[family], directions[family]);
            let by_structure = |change: Matrix3<f64>| {
                let by_strain = self.curvature(strain) * change.dot(&green);
                2.0 * k1 * (by_strain * (f * h) + self.slope(strain) * (f * change))
            };
            inner += match index {
                1 => 2.0 * self.slope(strain) * (f * h),
                2 => 2.0 * k1 * strain * strain * self.slope(strain) * (f * h),
                3 => by_structure(Matrix3::identity() - 3.0 * a * a.transpose()),
                _ => {
                    let both = a * slopes[family].transpose();
                    let along = 1_f64.to_radians() * (1.0 - 3.0 * self.fibres.dispersion);
                    by_structure(along * (both + both.transpose()))
                }
            };
        }
        (isochoric.stress(&inner), 0.0)
    }

    fn in_frame(&self, frame: &FibreFrame) -> Option<Arc<dyn Law>> {
        Some(Arc::new(self.turned_to(*frame)))
    }
}
