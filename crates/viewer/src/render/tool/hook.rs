use std::f64::consts::{FRAC_PI_2, TAU};

use palpate_geometry::Vec3;

use super::revolved::{sharp, turned};
use super::solid::Solid;

/// From the heel to where the shaft begins [m].
pub(super) const LENGTH: f64 = 0.016;

/// Radius of the wire [m], of its bend [m], and the length of its foot beyond the bend [m].
const WIRE: f64 = 0.0006;
const BEND: f64 = 0.0014;
const FOOT: f64 = 0.0022;

/// Where the bare wire leaves its collar [m].
const BARE: f64 = 0.0105;

/// The electrode: down the shaft's axis, bent towards +x, its heel at the origin.
pub(super) fn wire() -> Vec<[f32; 6]> {
    const AROUND: usize = 18;
    let ring = |center: Vec3, out: Vec3, radius: f64| -> Vec<Vec3> {
        let angles = (0..AROUND).map(|k| TAU * k as f64 / AROUND as f64);
        // Counter-clockwise about the way down and then along +x.
        angles
            .map(|angle| center + radius * (angle.sin() * out - angle.cos() * Vec3::y()))
            .collect()
    };
    let bend = Vec3::new(BEND, 0.0, WIRE + BEND);
    let mut rings = vec![ring(Vec3::new(0.0, 0.0, BARE + 0.002), -Vec3::x(), WIRE)];
    for k in 0..=10 {
        let (sin, cos) = (FRAC_PI_2 * f64::from(k) / 10.0).sin_cos();
        let out = Vec3::new(-cos, 0.0, -sin);
        rings.push(ring(bend + BEND * out, out, WIRE));
    }
    let end = bend + Vec3::new(FOOT, 0.0, -BEND);
    for k in 0..=5 {
        let (sin, cos) = (FRAC_PI_2 * f64::from(k) / 5.0).sin_cos();
        let center = end + WIRE * sin * Vec3::x();
        rings.push(ring(center, -Vec3::z(), (WIRE * cos).max(1e-6)));
    }
    Solid::skin(&rings).corners()
}

/// Insulation of the wire where it leaves the shaft.
pub(super) fn collar(shaft: f64) -> Vec<[f32; 6]> {
    turned(&sharp(&[
        (0.0, BARE),
        (0.45 * shaft, BARE),
        (0.55 * shaft, BARE + 5e-4),
        (0.60 * shaft, LENGTH - 3e-3),
        (0.92 * shaft, LENGTH - 1e-3),
        (0.92 * shaft, LENGTH + 1e-4),
        (0.0, LENGTH + 1e-4),
    ]))
}
