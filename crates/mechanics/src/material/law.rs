use nalgebra::{Matrix3, SMatrix};

/// ∂P/∂F [Pa]: entry (3 j + i, 3 l + k) is ∂P_ij/∂F_kl, both matrices read column by column.
pub type Tangent = SMatrix<f64, 9, 9>;

/// A law between the deformation gradient F = ∂x/∂X and stress. It never sees a mesh.
///
/// Moduli are instantaneous; relaxation is [`crate::PronySeries`]'s.
pub trait Law {
    /// Strain energy per undeformed volume Ψ(F) [Pa].
    fn energy(&self, f: &Matrix3<f64>) -> f64;

    /// First Piola-Kirchhoff stress P = ∂Ψ/∂F [Pa].
    fn stress(&self, f: &Matrix3<f64>) -> Matrix3<f64>;

    /// ∂P/∂F [Pa].
    fn tangent(&self, f: &Matrix3<f64>) -> Tangent;
}
