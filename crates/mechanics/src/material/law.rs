use std::fmt::Debug;
use std::sync::Arc;

use nalgebra::{Matrix3, SMatrix};

use super::fibres::FibreFrame;
use super::volume::Volume;

/// ∂P/∂F [Pa]: entry (3 j + i, 3 l + k) is ∂P_ij/∂F_kl, both matrices read column by column.
pub type Tangent = SMatrix<f64, 9, 9>;

/// Energy of distortion with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Distortion {
    /// W(F) [Pa].
    pub energy: f64,
    /// ∂W/∂F [Pa].
    pub stress: Matrix3<f64>,
    /// ∂²W/∂F∂F [Pa].
    pub tangent: Tangent,
}

/// A law between the deformation gradient F = ∂x/∂X and stress. It does not depend on a mesh.
///
/// Its energy has two parts, Ψ(F) = W(F) + ½ κ θ(F)²: one of distortion, which does not depend on a
/// change of volume, and one of [`Volume`]. Mixed elements treat them separately, so that κ may be
/// infinite; [`Law::energy`], [`Law::stress`] and [`Law::tangent`] combine them and are defined for
/// a finite κ only. Moduli are instantaneous; relaxation is [`crate::PronySeries`]'s.
pub trait Law: Debug + Send + Sync {
    /// Energy of distortion per undeformed volume W(F) [Pa].
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64;

    /// Its first Piola-Kirchhoff stress ∂W/∂F [Pa].
    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64>;

    /// ∂²W/∂F∂F [Pa].
    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent;

    /// All three at once, which a law may compute faster than one after another.
    fn distortion(&self, f: &Matrix3<f64>) -> Distortion {
        Distortion {
            energy: self.distortion_energy(f),
            stress: self.distortion_stress(f),
            tangent: self.distortion_tangent(f),
        }
    }

    /// How it resists a change of volume.
    fn volume(&self) -> Volume;

    /// The parameters by the names that files give them, with their values [Pa] or [-].
    fn parameters(&self) -> Vec<(&'static str, f64)>;

    /// What a unit of the parameter `index` of [`Law::parameters`] adds: to the stress of distortion,
    /// and to the compressibility 1/κ [1/Pa].
    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64);

    /// The same law with its fibres in `frame`; none where it has no fibres, so that it is the same in every frame.
    fn in_frame(&self, _frame: &FibreFrame) -> Option<Arc<dyn Law>> {
        None
    }

    /// Whether it has fibres, and so depends on their direction.
    fn has_fibres(&self) -> bool {
        self.in_frame(&FibreFrame::ALONG_AXES).is_some()
    }

    /// Strain energy per undeformed volume Ψ(F) [Pa].
    fn energy(&self, f: &Matrix3<f64>) -> f64 {
        self.distortion_energy(f) + self.volume().energy(f)
    }

    /// First Piola-Kirchhoff stress P = ∂Ψ/∂F [Pa].
    fn stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        self.distortion_stress(f) + self.volume().stress(f)
    }

    /// ∂P/∂F [Pa].
    fn tangent(&self, f: &Matrix3<f64>) -> Tangent {
        self.distortion_tangent(f) + self.volume().tangent(f)
    }
}
