//! Sanders' shell in wave numbers [Sanders 1959]: closing tractions of jumps along a generator of a cylinder (radius
//! R, thickness w), and tractions of forces there.
//!
//! With B the strains of a displacement of wave numbers k and q = n/R, C their stiffness, J the strains that jumps
//! e^{ikx} are and P a force,
//!
//! ```text
//! H(k) = Σ_n (Jᵀ C J − Jᵀ C B (Bᵀ C B)⁻¹ Bᵀ C J)/(2 π R),   T(k) = Σ_n Jᵀ C B (Bᵀ C B)⁻¹ P/(2 π R).
//! ```
//!
//! H is never negative. It holds bulging, the ring that is left of a tube that is cut along, and how a hinge opens a
//! slit; where k is large it is that of a plate, |k| w/4 and |k| D (1 − ν)(3 + ν)/4.
//!
//! *How we know*: below: a flat shell's forces, short waves; `curvature::tests`.
//!
//! *Limits*: thin shells; a whole tube without ends.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Matrix4, Matrix4x3, Matrix6, SMatrix, Vector3};

/// Sanders' shell of a radius and a thickness, in wave numbers.
#[derive(Clone, Copy)]
pub(super) struct FourierShell {
    pub(super) nu: f64,
    /// 1/R [1/m]; zero for a plate.
    pub(super) curvature: f64,
    pub(super) thickness: f64,
}

impl FourierShell {
    /// D over E.
    fn bending(&self) -> f64 {
        self.thickness.powi(3) / (12.0 * (1.0 - self.nu * self.nu))
    }

    /// C over E.
    pub(super) fn stiffness(&self) -> Matrix6<f64> {
        let (nu, w) = (self.nu, self.thickness);
        let plane = Matrix3::new(1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu));
        let mut stiffness = Matrix6::zeros();
        let (mut stretch, stretched) =
            (stiffness.fixed_view_mut::<3, 3>(0, 0), w / (1.0 - nu * nu));
        stretch.copy_from(&(plane * stretched));
        let mut bend = stiffness.fixed_view_mut::<3, 3>(3, 3);
        bend.copy_from(&(plane * self.bending()));
        stiffness
    }

    /// B: ε_s, ε_θ, γ, κ_s, κ_θ and 2 κ_sθ of i u, i v and w.
    fn strains(&self, [k, q]: [f64; 2]) -> SMatrix<f64, 6, 3> {
        let bent = self.curvature;
        SMatrix::from_columns(&[
            [k, 0.0, q, 0.0, 0.0, -0.5 * q * bent].into(),
            [0.0, q, k, 0.0, q * bent, 1.5 * k * bent].into(),
            [0.0, bent, 0.0, k * k, q * q, 2.0 * k * q].into(),
        ])
    }

    /// J, of opening, turning, sliding and −i times a deflection.
    fn jumps(&self, [k, q]: [f64; 2]) -> SMatrix<f64, 6, 4> {
        SMatrix::from_columns(&[
            [0.0, 1.0, 0.0, 0.0, 0.0, 0.0].into(),
            [0.0, 0.0, 0.0, 0.0, 1.0, 0.0].into(),
            [0.0, 0.0, 1.0, 0.0, 0.0, -0.5 * self.curvature].into(),
            [0.0, 0.0, 0.0, 0.0, q, 2.0 * k].into(),
        ])
    }

    /// A term of H's sum, and of that of T under forces: outward, −i times across, and the latter's couple on the
    /// outer face. None where nothing withstands.
    pub(super) fn term(
        &self,
        stiffness: &Matrix6<f64>,
        at: [f64; 2],
    ) -> Option<(Matrix4<f64>, Matrix4x3<f64>)> {
        let (strains, jumps) = (self.strains(at), self.jumps(at));
        let forces = stiffness * jumps;
        let whole = strains.transpose() * stiffness * strains;
        let known = strains.transpose() * forces;
        let factor = whole.cholesky()?;
        let left = jumps.transpose() * forces - known.transpose() * factor.solve(&known);
        let couple = Vector3::new(0.0, self.curvature, at[1]) * (0.5 * self.thickness);
        let loads = Matrix3::from_columns(&[Vector3::z(), Vector3::y(), couple]);
        Some((left, known.transpose() * factor.solve(&loads)))
    }
}

/// H of jumps e^{ikx} less that of a plate, over E: of N on opening; of N on a turn and of M on it; of shear on
/// sliding; of V on a deflection, and of shear on it.
pub(super) fn difference(nu: f64, [radius, thickness]: [f64; 2], k: f64) -> [f64; 6] {
    let (w, r) = (thickness, radius);
    let waves = FourierShell {
        nu,
        curvature: 1.0 / r,
        thickness,
    };
    let (bending, stiffness) = (waves.bending(), waves.stiffness());
    let last = 12 + (6.0 * k * r + 3.0 * (r / w).sqrt()).ceil() as usize;
    let mut sums = [0.0; 6];
    for n in 0..=last {
        let Some((left, _)) = waves.term(&stiffness, [k, n as f64 / r]) else {
            continue;
        };
        let weight = if n == 0 { 1.0 } else { 2.0 } / (2.0 * PI * r);
        let entries = [(0, 0), (0, 1), (1, 1), (2, 2), (3, 3), (2, 3)];
        for (sum, entry) in sums.iter_mut().zip(entries) {
            *sum += left[entry] * weight;
        }
    }
    // Beyond the last it is as flat as a plate.
    let end = (last as f64 + 0.5) / r;
    let (k2, cubed) = (k * k, 1.0 / (3.0 * end.powi(3)));
    let odd = 1.0 - nu;
    sums[0] += w / PI * k2 * k2 * cubed;
    sums[2] += bending / PI * odd * k2 * (2.0 / end - (3.0 - nu) * k2 * cubed);
    sums[3] += w / PI * k2 * (1.0 / end - 2.0 * k2 * cubed);
    sums[4] += bending / PI * k2 * k2 * odd * ((1.0 + nu) / end - 2.0 * nu * k2 * cubed);
    let bent = bending * odd * (3.0 + nu) / 4.0;
    [
        sums[0] - 0.25 * w * k,
        sums[1],
        sums[2] - bent * k,
        sums[3] - 0.25 * w * k,
        sums[4] - bent * k * k2,
        sums[5],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::plate::Plate;
    use super::*;

    /// Judge: the closed forms of a plate. Tolerance: of waves that end.
    #[test]
    fn a_flat_shell_bears_a_force_as_a_plate() {
        let (nu, width, last) = (0.3, 0.05, 240);
        let flat = FourierShell {
            nu,
            curvature: 0.0,
            thickness: 1.0,
        };
        let stiffness = flat.stiffness();
        for at in [[1.0, 1.0], [2.0, 0.5]] {
            let mut sum = [0.0; 3];
            for step in 0..last * last {
                let [k, q] = [step / last, step % last].map(|n| (n as f64 + 0.5) * width);
                let (_, forces) = flat.term(&stiffness, [k, q]).unwrap();
                let fade = (-((k * k + q * q) / 36.0).powi(2)).exp() * (width / PI).powi(2);
                let wave = fade * (k * at[1]).cos() * (q * at[0]).sin();
                for (sum, entry) in sum.iter_mut().zip([(0, 1), (1, 2), (3, 0)]) {
                    *sum -= wave * forces[entry];
                }
            }
            let plate = Plate { nu, thickness: 1.0 };
            let [n, _, m, v] = plate.resultants(at, 1.0, 0.0);
            for (sum, expected) in sum.into_iter().zip([n.x, 0.5 * m.x, v.z]) {
                assert!((sum / expected - 1.0).abs() < 0.03, "{sum} {expected}");
            }
        }
    }

    /// Judge: a plate, the limit of waves that are short relative to √(R w).
    #[test]
    fn short_waves_see_a_plate() {
        let found = difference(0.3, [1000.0, 1.0], 0.6);
        for (found, plate) in found.into_iter().zip([0.15, 0.15, 0.03, 0.15, 0.01, 0.03]) {
            assert!(found.abs() < 0.01 * plate, "{found} {plate}");
        }
    }
}
