//! What a force on a face of a plate does, by plane stress and Kirchhoff's theory of bending, times E.
//!
//! In axes x, y along the plate and z outward; faces at z = ± w/2. The deflection of a unit force along z is
//! W = r² ln r/(8 π D); a force on a face along it is one in the middle and a couple. `soft` [m²] is added to
//! the square of distances.

use std::f64::consts::PI;

use nalgebra::Matrix3;

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

    /// Displacement at `r` [m] on one face from a unit force on another (1 outer, −1 inner) at the origin along
    /// each axis, times E [1/m]; only its changes mean something.
    pub(super) fn displacement(
        &self,
        r: [f64; 2],
        [seen, loaded]: [f64; 2],
        soft: f64,
    ) -> Matrix3<f64> {
        let (nu, w) = (self.nu, self.thickness);
        let [x, y] = r;
        let s = x * x + y * y + soft;
        let k = (1.0 + nu) / (4.0 * PI * w);
        let log = -0.5 * (3.0 - nu) * s.ln();
        let turn = (1.0 + nu) / s;
        let (second, _) = Self::derivatives(r, soft);
        let stiff = 1.0 / self.bending();
        let couples = -seen * loaded * 0.25 * w * w * stiff;
        let slope = (s.ln() + 1.0) / (8.0 * PI) * stiff;
        let (tilt, lift) = (-seen * 0.5 * w * slope, loaded * 0.5 * w * slope);
        Matrix3::new(
            k * (log + turn * x * x) + couples * second[0],
            k * turn * x * y + couples * second[1],
            tilt * x,
            k * turn * x * y + couples * second[1],
            k * (log + turn * y * y) + couples * second[2],
            tilt * y,
            lift * x,
            lift * y,
            0.5 * s * s.ln() / (8.0 * PI) * stiff,
        )
    }
}
