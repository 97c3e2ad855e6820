//! The displacement under a flat punch of unit radius without friction on a half-space, which every
//! finite sphere carries in addition to its polynomials.
//!
//! With V = (2/π) Im ln(R + ζ), ζ = z + i, R² = ρ² + ζ², the potential of the punch [Sneddon], and χ its
//! integral along the depth z, 2 (1 − ν) u = −(1 − 2ν) ∇ₕχ − z ∇V + 2 (1 − ν) V e_z, ∇ₕ being along the surface.

use std::f64::consts::FRAC_2_PI;

use nalgebra::{Complex, Matrix3};

use crate::Vec3;

/// Displacement [-] and its gradient ∂uᵢ/∂xⱼ [1/tip radius] at `x` [tip radii], the third axis outward;
/// (0, 0, −1) under the punch.
pub(super) fn punch(x: &Vec3, poissons_ratio: f64) -> (Vec3, Matrix3<f64>) {
    let nu = poissons_ratio;
    // On the axis the terms in 1/ρ have limits, reached to rounding this near.
    let rho = x.x.hypot(x.y).max(1e-9);
    let (cosine, sine) = match x.x.hypot(x.y) > 1e-9 {
        true => (x.x / rho, x.y / rho),
        false => (1.0, 0.0),
    };
    let z = (-x.z).max(0.0);
    let zeta = Complex::new(z, 1.0);
    let root = (zeta * zeta + rho * rho).sqrt();
    let sum = root + zeta;
    let im = |value: Complex<f64>| FRAC_2_PI * value.im;
    let v = im(sum.ln());
    let v_r = im(Complex::new(rho, 0.0) / (root * sum));
    let v_z = im(root.inv());
    let cubed = root * root * root;
    let v_zz = -im(zeta / cubed);
    let v_rz = -im(Complex::new(rho, 0.0) / cubed);
    let v_rr = -v_zz - v_r / rho;
    let chi_r = -im(Complex::new(rho, 0.0) / sum);
    let chi_rr = -v_z - chi_r / rho;
    let (k, n) = (1.0 - 2.0 * nu, 0.5 / (1.0 - nu));
    let outward = -n * (k * chi_r + z * v_r);
    let down = v - n * z * v_z;
    let outward_r = -n * (k * chi_rr + z * v_rr);
    let outward_z = -n * ((k + 1.0) * v_r + z * v_rz);
    let down_r = v_r - n * z * v_rz;
    let down_z = v_z - n * (v_z + z * v_zz);
    let hoop = outward / rho;
    let mixed = (outward_r - hoop) * cosine * sine;
    let gradient = Matrix3::new(
        outward_r * cosine * cosine + hoop * sine * sine,
        mixed,
        -outward_z * cosine,
        mixed,
        outward_r * sine * sine + hoop * cosine * cosine,
        -outward_z * sine,
        -down_r * cosine,
        -down_r * sine,
        down_z,
    );
    (Vec3::new(outward * cosine, outward * sine, -down), gradient)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judges: the rigid disc, (2/π) asin(1/ρ) outside it, and central differences.
    #[test]
    fn punch_field_is_the_closed_form() {
        for nu in [0.0, 0.3, 0.49] {
            let (under, _) = punch(&Vec3::new(0.3, 0.5, 0.0), nu);
            let (beside, _) = punch(&Vec3::new(1.5, 0.0, 0.0), nu);
            assert!((under.z + 1.0).abs() < 1e-12, "{nu}: {under}");
            assert!((beside.z + FRAC_2_PI * (1.0f64 / 1.5).asin()).abs() < 1e-12);
            let x = Vec3::new(0.7, -0.4, -0.5);
            let (_, gradient) = punch(&x, nu);
            for axis in 0..3 {
                let mut step = Vec3::zeros();
                step[axis] = 1e-6;
                let slope = (punch(&(x + step), nu).0 - punch(&(x - step), nu).0) / 2e-6;
                // Differences of 1e-6.
                assert!((slope - gradient.column(axis)).norm() < 1e-8, "{nu} {axis}");
            }
        }
    }

    /// Judge: the field equations, (1 − 2ν) ∇²u + ∇(∇·u) = 0, and no traction outside the punch.
    #[test]
    fn punch_field_is_in_equilibrium() {
        for nu in [0.0, 0.3, 0.49] {
            let stress = |x: &Vec3| {
                let (_, gradient) = punch(x, nu);
                let lame = 2.0 * nu / (1.0 - 2.0 * nu);
                gradient
                    + gradient.transpose()
                    + Matrix3::from_diagonal_element(lame * gradient.trace())
            };
            let x = Vec3::new(0.7, -0.4, -0.5);
            let mut sum = Vec3::zeros();
            for axis in 0..3 {
                let mut step = Vec3::zeros();
                step[axis] = 1e-5;
                sum += (stress(&(x + step)) - stress(&(x - step))).column(axis) / 2e-5;
            }
            // Differences of 1e-5 of terms up to 2ν/(1 − 2ν) = 49.
            assert!(sum.norm() < 1e-6, "{nu}: {sum}");
            let traction = stress(&Vec3::new(1.2, 0.9, 0.0)).column(2).norm();
            assert!(traction < 1e-12, "{nu}: {traction}");
        }
    }
}
