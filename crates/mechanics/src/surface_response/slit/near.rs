//! Stress of a force on a half-space: Boussinesq's and Cerruti's solutions [Johnson 1985], times E.
//!
//! In axes x, y along the surface and z outward, tension positive. `soft` [m²] is added to the square of
//! distances: a force is spread.

use nalgebra::{Matrix2x3, Matrix3};

use crate::Vec3;

/// Traction on the plane x = 0 at `r` [m] from a force at the origin [1/m²]: column k of a unit force along k.
/// The z of `r` is not positive.
pub(super) fn traction(nu: f64, r: &Vec3, soft: f64) -> Matrix3<f64> {
    let (x, y, z) = (r.x, r.y, -r.z);
    let d = (r.norm_squared() + soft).sqrt();
    let shape = 1.0 - 2.0 * nu;
    let (d3, d5, e) = (d.powi(3), d.powi(5), d + z);
    let (e2, e3) = (e * e, e * e * e);
    // Of a force into the body.
    let flat = (2.0 * d + z) / (d3 * e2);
    let px = -3.0 * x * x * z / d5 + shape * (z / d3 - 1.0 / (d * e) + x * x * flat);
    let py = -3.0 * x * y * z / d5 + shape * x * y * flat;
    let pz = -3.0 * x * z * z / d5;
    // Of one along x.
    let bent = 1.0 / (d3 * e2) + 2.0 / (d * d * e3);
    let xx = -3.0 * x.powi(3) / d5 + shape * (x / d3 - 3.0 * x / (d * e2) + x.powi(3) * bent);
    let xy = -3.0 * x * x * y / d5 + shape * (-y / (d * e2) + x * x * y * bent);
    let xz = -3.0 * x * x * z / d5;
    // Of one along y.
    let yx = -3.0 * y * x * x / d5 + shape * (y / d3 - y / (d * e2) + y * x * x * bent);
    let yy = -3.0 * y * y * x / d5 + shape * (-x / (d * e2) + y * y * x * bent);
    let yz = -3.0 * x * y * z / d5;
    Matrix3::new(xx, yx, -px, xy, yy, -py, -xz, -yz, pz) / std::f64::consts::TAU
}

/// Displacement along the surface at `r` [m] from a force at the origin, times E [1/m]: column k of a unit force
/// along k.
pub(super) fn displacement(nu: f64, [x, y]: [f64; 2], soft: f64) -> Matrix2x3<f64> {
    let d = (x * x + y * y + soft).sqrt();
    let (x, y) = (x / d, y / d);
    let odd = 0.5 * (1.0 - 2.0 * nu);
    let even = 1.0 - nu;
    let shape = Matrix2x3::new(
        even + nu * x * x,
        nu * x * y,
        odd * x,
        nu * x * y,
        even + nu * y * y,
        odd * y,
    );
    shape * ((1.0 + nu) / (std::f64::consts::PI * d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: balance. By symmetry a plane next to a force bears half of it. Tolerance: the plane ends at 1/100
    /// of what it bears, and steps of a twentieth.
    #[test]
    fn a_plane_bears_half_of_a_force() {
        for nu in [0.2, 0.45] {
            let mut sum = Matrix3::zeros();
            let (turns, steps) = (64, 200);
            for step in 0..steps {
                // From 1/100 of the distance to 100 of it.
                let r = 0.01 * 1e4_f64.powf((f64::from(step) + 0.5) / f64::from(steps));
                let width = r * 1e4_f64.ln() / f64::from(steps);
                for turn in 0..turns {
                    let angle = -std::f64::consts::PI * (f64::from(turn) + 0.5) / f64::from(turns);
                    let area = r * width * std::f64::consts::PI / f64::from(turns);
                    let (z, y) = angle.sin_cos();
                    sum += traction(nu, &Vec3::new(1.0, r * y, r * z), 0.0) * area;
                }
            }
            for axis in 0..3 {
                assert!((sum[(axis, axis)] + 0.5).abs() < 0.02, "{nu} {sum}");
            }
        }
    }

    /// Judge: Hooke's law on the free surface, from differences of the displacement. Tolerance: of the differences.
    #[test]
    fn traction_on_the_surface_is_that_of_the_displacement() {
        let (nu, step) = (0.3, 1e-5);
        let (x, y) = (0.8, -0.5);
        let slope = |axis: usize| {
            let mut ends = [[x, y], [x, y]];
            ends[0][axis] -= step;
            ends[1][axis] += step;
            let [low, high] = ends.map(|at| displacement(nu, at, 0.0));
            (high - low) / (2.0 * step)
        };
        let [of_x, of_y] = [slope(0), slope(1)];
        let found = traction(nu, &Vec3::new(x, y, 0.0), 0.0);
        for k in 0..3 {
            let across = (of_x[(0, k)] + nu * of_y[(1, k)]) / (1.0 - nu * nu);
            let along = (of_x[(1, k)] + of_y[(0, k)]) * 0.5 / (1.0 + nu);
            assert!((found[(0, k)] - across).abs() < 1e-8);
            assert!((found[(1, k)] - along).abs() < 1e-8);
            assert!(found[(2, k)].abs() < 1e-12);
        }
    }
}
