//! What a force on a half-space does: Boussinesq's and Cerruti's solutions [Johnson 1985], times E.
//!
//! In axes x, y along the surface and z outward, tension positive. `soft` [m²] is added to the square of
//! distances: a force is spread.

use nalgebra::Matrix3;

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

/// Displacement of the surface at `r` [m] from a force at the origin, times E [1/m]: column k of a unit force
/// along k.
pub(super) fn displacement(nu: f64, r: &Vec3, soft: f64) -> Matrix3<f64> {
    let d = (r.x * r.x + r.y * r.y + soft).sqrt();
    let (x, y) = (r.x / d, r.y / d);
    let odd = 0.5 * (1.0 - 2.0 * nu);
    let even = 1.0 - nu;
    let shape = Matrix3::new(
        even + nu * x * x,
        nu * x * y,
        odd * x,
        nu * x * y,
        even + nu * y * y,
        odd * y,
        -odd * x,
        -odd * y,
        even,
    );
    shape * ((1.0 + nu) / (std::f64::consts::PI * d))
}
