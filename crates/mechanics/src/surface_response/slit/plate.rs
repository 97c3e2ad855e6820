//! Stress of a force on a face of a plate, by plane stress and Kirchhoff's theory of bending, times E.
//!
//! In axes x, y along the plate and z outward; faces at z = ± w/2. The deflection of a unit force along z is
//! W = r² ln r/(8 π D); a force on a face along it is one in the middle and a couple. `soft` [m²] is added to
//! the square of distances.

use std::f64::consts::PI;

use nalgebra::Matrix2x3;

use crate::Vec3;

/// A plate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plate {
    pub(super) nu: f64,
    /// Thickness w [m].
    pub(super) thickness: f64,
}

impl Plate {
    /// D over E [m³].
    pub(super) fn bending(&self) -> f64 {
        self.thickness.powi(3) / (12.0 * (1.0 - self.nu * self.nu))
    }

    /// Second and third derivatives of W [-, 1/m] times D: xx, xy, yy; xxx, xxy, xyy, yyy.
    fn derivatives([x, y]: [f64; 2], soft: f64) -> ([f64; 3], [f64; 4]) {
        let s = x * x + y * y + soft;
        let (log, k) = (s.ln() + 1.0, 1.0 / (8.0 * PI));
        let second = [
            k * (log + 2.0 * x * x / s),
            k * 2.0 * x * y / s,
            k * (log + 2.0 * y * y / s),
        ];
        let third = [
            k * (6.0 * x / s - 4.0 * x.powi(3) / (s * s)),
            k * (2.0 * y / s - 4.0 * x * x * y / (s * s)),
            k * (2.0 * x / s - 4.0 * x * y * y / (s * s)),
            k * (6.0 * y / s - 4.0 * y.powi(3) / (s * s)),
        ];
        (second, third)
    }

    /// Rows N, N_s [1/m], M 2/w [1/m] and the edge force V [1/m] on the plane x = 0 at `r` [m] from a unit force
    /// on the `face` (1 outer, −1 inner) at the origin along each axis.
    pub(super) fn resultants(&self, r: [f64; 2], face: f64, soft: f64) -> [Vec3; 4] {
        let (nu, w) = (self.nu, self.thickness);
        let [x, y] = r;
        let s = x * x + y * y + soft;
        let (second, third) = Self::derivatives(r, soft);
        // Plane stress.
        let k = -1.0 / (4.0 * PI * s);
        let (near, far) = (1.0 - nu, 2.0 * (1.0 + nu) / s);
        let xx = k * (near * x + far * x.powi(3));
        let xy = k * (near * y + far * x * x * y);
        let yx = k * (-near * y + far * x * x * y);
        let yy = k * (near * x + far * x * y * y);
        // M = −(w_xx + ν w_yy), of a force along z and of couples.
        let moment = -(second[0] + nu * second[2]);
        let couple = 0.5 * w * face;
        let of_x = -couple * (third[0] + nu * third[2]);
        let of_y = -couple * (third[1] + nu * third[3]);
        // V = −(Δw)_x − (1 − ν) w_xyy.
        let edge = -(third[0] + third[2]) - (1.0 - nu) * third[2];
        [
            Vec3::new(xx, yx, 0.0),
            Vec3::new(xy, yy, 0.0),
            Vec3::new(of_x, of_y, moment) * (2.0 / w),
            Vec3::new(0.0, 0.0, edge),
        ]
    }

    /// Displacement along the plate at `r` [m] on one face from a unit force on another (1 outer, −1 inner) at the
    /// origin along each axis, times E [1/m]; only its changes mean something.
    pub(super) fn displacement(
        &self,
        r: [f64; 2],
        [seen, loaded]: [f64; 2],
        soft: f64,
    ) -> Matrix2x3<f64> {
        let (nu, w) = (self.nu, self.thickness);
        let [x, y] = r;
        let s = x * x + y * y + soft;
        let log = s.ln();
        let stretch = (1.0 + nu) / (4.0 * PI * w);
        let bend = 1.0 / (8.0 * PI * self.bending());
        let couples = -seen * loaded * 0.25 * w * w * bend;
        // Of x² and y² over s, and of one.
        let turn = (stretch * (1.0 + nu) + 2.0 * couples) / s;
        let even = couples * (log + 1.0) - 0.5 * stretch * (3.0 - nu) * log;
        let tilt = -seen * 0.5 * w * bend * (log + 1.0);
        Matrix2x3::new(
            even + turn * x * x,
            turn * x * y,
            tilt * x,
            turn * x * y,
            even + turn * y * y,
            tilt * y,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLATE: Plate = Plate {
        nu: 0.3,
        thickness: 0.7,
    };

    /// Judge: Hooke's law on both faces, from differences of the displacement. Tolerance: of the differences.
    #[test]
    fn resultants_are_those_of_the_displacement() {
        let (nu, w, step) = (PLATE.nu, PLATE.thickness, 1e-5);
        let at = [0.8, -0.5];
        for loaded in [1.0, -1.0] {
            let found = PLATE.resultants(at, loaded, 0.0);
            let stress = |seen: f64| {
                let slope = |axis: usize| {
                    let mut ends = [at, at];
                    ends[0][axis] -= step;
                    ends[1][axis] += step;
                    let [low, high] = ends.map(|at| PLATE.displacement(at, [seen, loaded], 0.0));
                    (high - low) / (2.0 * step)
                };
                let [of_x, of_y] = [slope(0), slope(1)];
                [0, 1, 2].map(|k| {
                    let across = (of_x[(0, k)] + nu * of_y[(1, k)]) / (1.0 - nu * nu);
                    let along = (of_x[(1, k)] + of_y[(0, k)]) * 0.5 / (1.0 + nu);
                    [across, along]
                })
            };
            let (outer, inner) = (stress(1.0), stress(-1.0));
            for k in 0..3 {
                let even = [0, 1].map(|kind| 0.5 * w * (outer[k][kind] + inner[k][kind]));
                let hinge = w / 6.0 * (outer[k][0] - inner[k][0]);
                assert!((found[0][k] - even[0]).abs() < 1e-7);
                assert!((found[1][k] - even[1]).abs() < 1e-7);
                assert!((found[2][k] - hinge).abs() < 1e-7, "{k}");
            }
        }
    }

    /// Judge: balance. By symmetry a line next to a force bears half of it. Tolerance: the line's
    /// end.
    #[test]
    fn a_line_bears_half_of_a_force() {
        let (mut sum, steps) = ([0.0; 3], 4000);
        for step in 0..steps {
            let part = (f64::from(step) + 0.5) / f64::from(steps) - 0.5;
            let y = (3.1 * part).tan();
            let width = 3.1 / f64::from(steps) * (1.0 + y * y);
            let found = PLATE.resultants([1.0, y], 1.0, 0.0);
            sum[0] += found[0].x * width;
            sum[1] += found[1].y * width;
            sum[2] += found[3].z * width;
        }
        for sum in sum {
            assert!((sum + 0.5).abs() < 0.02, "{sum}");
        }
    }
}
