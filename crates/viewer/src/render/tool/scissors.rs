use palpate_geometry::Vec3;

use super::JawSize;
use super::hinge::GAP;
use super::solid::Solid;

/// Sideways offset of the middle of a blade from its ends [-], in units of its length.
const BENT: f64 = 0.085;

/// Stations along a blade.
const STATIONS: usize = 40;

/// One blade of scissors, shut: its flat side slides along that of the other. `side` selects the blade.
pub(super) fn corners(jaws: &JawSize, side: f64) -> Vec<[f32; 6]> {
    // Both are bent to the same side, so that the second is no mirror image of the first.
    let bend = BENT * jaws.length * side;
    let solid = blade(jaws, bend).with(lug(jaws, bend));
    match side > 0.0 {
        true => solid.corners(),
        false => solid.turned_over().corners(),
    }
}

/// From the tip to the hinge: an edge just beyond the middle, a back that is thick and round.
fn blade(jaws: &JawSize, bend: f64) -> Solid {
    let thick = 0.27 * jaws.width;
    let rings: Vec<Vec<Vec3>> = (0..=STATIONS)
        .map(|k| {
            // Denser at the tip, which is round.
            let part = (k as f64 / STATIONS as f64).powi(2);
            let z = jaws.length * part;
            let round = (1.0 - (1.0 - (part / 0.07).min(1.0)).powi(2)).sqrt();
            let back = jaws.width * (0.16 + 0.27 * part) * round;
            let edge = -jaws.width * 0.05 * round;
            let full = thick * (0.45 + 0.55 * part) * round.sqrt();
            let aside = bow(bend, part);
            let at = |x: f64, y: f64| Vec3::new(x, aside + y, z);
            vec![
                at(edge, 2e-5),
                at(back, 2e-5),
                at(0.96 * back, 0.55 * full),
                at(0.80 * back, 0.92 * full),
                at(0.62 * back, full),
                at(0.30 * back, 0.9 * full),
            ]
        })
        .collect();
    Solid::skin(&rings)
}

/// How far to the side [m] a blade lies at a `part` of its length.
fn bow(bend: f64, part: f64) -> f64 {
    4.0 * bend * part * (1.0 - part)
}

/// The end in which the blade turns.
fn lug(jaws: &JawSize, bend: f64) -> Solid {
    let hinge = jaws.length * Vec3::z();
    let radius = 0.45 * jaws.width;
    let disc = Solid::disc(hinge, radius, 2e-5, GAP - 5e-5);
    let shank = |z: f64, (low, high): (f64, f64), thick: f64| {
        let aside = bow(bend, (z / jaws.length).min(1.0));
        vec![
            Vec3::new(low, aside + 2e-5, z),
            Vec3::new(high, aside + 2e-5, z),
            Vec3::new(high, aside + thick, z),
            Vec3::new(low, aside + thick, z),
        ]
    };
    let up = jaws.length;
    disc.with(Solid::skin(&[
        shank(
            0.78 * up,
            (-0.02 * radius, 0.74 * radius),
            0.25 * jaws.width,
        ),
        shank(up, (-0.9 * radius, 0.95 * radius), GAP - 5e-5),
        shank(up + 0.6 * radius, (-0.7 * radius, 0.7 * radius), GAP - 5e-5),
    ]))
}
