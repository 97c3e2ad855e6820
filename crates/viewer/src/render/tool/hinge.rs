use palpate_geometry::Vec3;

use super::JawSize;
use super::revolved::{sharp, turned};
use super::solid::Solid;

/// From the axis of the hinge to where the shaft begins [m].
pub(super) const LENGTH: f64 = 0.009;

/// Where the fork's prongs begin on the shaft's end [m].
const FORK: f64 = 0.004;

/// Half of the gap between the prongs [m]; each jaw fills one side of it.
pub(super) const GAP: f64 = 0.0015;

/// The fork in which jaws turn, with its pin.
pub(super) fn corners(jaws: &JawSize, shaft: f64) -> Vec<[f32; 6]> {
    let at = jaws.length * Vec3::z();
    let pin = Solid::disc(at, 0.0008, -shaft - 1e-4, shaft + 1e-4);
    let mut corners = pin.corners();
    for side in [1.0, -1.0] {
        corners.extend(prong(at, shaft, side).corners());
    }
    let (low, high) = (jaws.length + FORK, jaws.length + LENGTH);
    corners.extend(turned(&sharp(&[
        (0.0, low),
        (0.86 * shaft, low),
        (0.98 * shaft, low + 6e-4),
        (0.98 * shaft, high - 5e-4),
        (0.86 * shaft, high - 4e-4),
        (0.86 * shaft, high),
        (0.0, high),
    ])));
    corners
}

/// A prong on one side of the jaws: round below, flat inside, as round as the shaft outside.
fn prong(at: Vec3, shaft: f64, side: f64) -> Solid {
    const HALF: usize = 9;
    let wide = 0.72 * shaft;
    // Down to the hinge straight, then around it.
    let outline: Vec<(f64, f64)> = std::iter::once((wide, FORK + 4e-4))
        .chain((0..=2 * HALF).map(|k| {
            let turn = std::f64::consts::PI * k as f64 / (2 * HALF) as f64;
            (wide * turn.cos(), -0.8 * wide * turn.sin())
        }))
        .chain(std::iter::once((-wide, FORK + 4e-4)))
        .collect();
    let ring = |depth: fn(f64, f64) -> f64| -> Vec<Vec3> {
        let place = |&(x, z): &(f64, f64)| at + Vec3::new(x, side * depth(x, shaft), z);
        match side > 0.0 {
            true => outline.iter().map(place).collect(),
            false => outline.iter().rev().map(place).collect(),
        }
    };
    Solid::skin(&[
        ring(|_, _| GAP),
        ring(|x, shaft| (shaft * shaft - x * x).sqrt() - 1e-4),
    ])
}
