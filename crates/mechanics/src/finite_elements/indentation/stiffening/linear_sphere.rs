//! Force of a linear tissue under a sphere over Hertz's force, made by [`super::press`] on blocks of
//! 200 radii; the test `stiffening::the_stored_spheres_are_those_of_finite_elements` makes it again.
//!
//! Hertz's surface is a paraboloid, and his tissue moves straight down. A sphere is steeper and so touches less; that
//! points of the surface are carried inward (below ν = ½) makes it stiffer, already at small depth.

use crate::IndentationCurve;
use crate::contact::Friction;

/// Depths s/ρ [-] of the columns.
pub(super) const DEPTHS: [f64; 12] = [
    0.002, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0,
];

struct Row {
    poissons_ratio: f64,
    slip: [f64; DEPTHS.len()],
    stick: [f64; DEPTHS.len()],
}

/// x r(x) over x = s/ρ at a Poisson's ratio, r linear between the rows.
pub(super) fn curve(poissons_ratio: f64, bond: Friction) -> IndentationCurve {
    let last = ROWS.len() - 1;
    let above = ROWS
        .iter()
        .position(|row| row.poissons_ratio >= poissons_ratio);
    let above = above.unwrap_or(last).max(1);
    let (low, high) = (&ROWS[above - 1], &ROWS[above]);
    let along = (poissons_ratio - low.poissons_ratio) / (high.poissons_ratio - low.poissons_ratio);
    let of = |row: &'static Row| match bond {
        Friction::Frictionless => &row.slip,
        Friction::Bonded => &row.stick,
    };
    let (low, high) = (of(low), of(high));
    let forces: [f64; DEPTHS.len()] =
        std::array::from_fn(|i| DEPTHS[i] * (low[i] + along * (high[i] - low[i])));
    IndentationCurve::through(&DEPTHS, &forces)
}

#[rustfmt::skip]
const ROWS: [Row; 8] = [
    Row {
        poissons_ratio: 0.0,
        slip: [1.0138, 1.0590, 1.0764, 1.0930, 1.0990, 1.0990, 1.0944, 1.0858, 1.0745, 1.0595, 1.0405, 1.0169],
        stick: [1.0942, 1.0850, 1.0897, 1.0959, 1.0967, 1.0973, 1.0957, 1.0949, 1.0917, 1.0892, 1.0870, 1.0818],
    },
    Row {
        poissons_ratio: 0.1,
        slip: [1.0122, 1.0505, 1.0638, 1.0744, 1.0753, 1.0703, 1.0610, 1.0486, 1.0324, 1.0122, 0.9876, 0.9600],
        stick: [1.0798, 1.0665, 1.0706, 1.0736, 1.0733, 1.0722, 1.0694, 1.0683, 1.0640, 1.0605, 1.0566, 1.0505],
    },
    Row {
        poissons_ratio: 0.2,
        slip: [1.0102, 1.0399, 1.0484, 1.0516, 1.0461, 1.0355, 1.0215, 1.0034, 0.9814, 0.9556, 0.9267, 0.8919],
        stick: [1.0656, 1.0487, 1.0495, 1.0499, 1.0482, 1.0453, 1.0419, 1.0394, 1.0339, 1.0288, 1.0228, 1.0152],
    },
    Row {
        poissons_ratio: 0.3,
        slip: [1.0076, 1.0265, 1.0289, 1.0228, 1.0100, 0.9932, 0.9724, 0.9476, 0.9200, 0.8890, 0.8527, 0.8110],
        stick: [1.0358, 1.0283, 1.0277, 1.0252, 1.0219, 1.0174, 1.0122, 1.0079, 1.0007, 0.9929, 0.9863, 0.9795],
    },
    Row {
        poissons_ratio: 0.4,
        slip: [1.0042, 1.0089, 1.0035, 0.9863, 0.9648, 0.9394, 0.9105, 0.8797, 0.8456, 0.8073, 0.7645, 0.7148],
        stick: [1.0108, 1.0085, 1.0066, 1.0018, 0.9957, 0.9881, 0.9802, 0.9729, 0.9645, 0.9545, 0.9472, 0.9416],
    },
    Row {
        poissons_ratio: 0.45,
        slip: [1.0020, 0.9978, 0.9876, 0.9642, 0.9370, 0.9067, 0.8742, 0.8398, 0.8016, 0.7605, 0.7140, 0.6616],
        stick: [1.0036, 1.0004, 0.9972, 0.9909, 0.9829, 0.9729, 0.9633, 0.9527, 0.9437, 0.9334, 0.9300, 0.9218],
    },
    Row {
        poissons_ratio: 0.48,
        slip: [1.0006, 0.9903, 0.9771, 0.9492, 0.9184, 0.8848, 0.8504, 0.8134, 0.7734, 0.7301, 0.6818, 0.6278],
        stick: [1.0006, 0.9967, 0.9924, 0.9849, 0.9740, 0.9636, 0.9541, 0.9420, 0.9314, 0.9257, 0.9183, 0.9090],
    },
    Row {
        poissons_ratio: 0.4999,
        slip: [0.9995, 0.9848, 0.9695, 0.9384, 0.9050, 0.8693, 0.8335, 0.7948, 0.7537, 0.7089, 0.6598, 0.6047],
        stick: [0.9999, 0.9949, 0.9896, 0.9813, 0.9691, 0.9556, 0.9485, 0.9361, 0.9227, 0.9203, 0.9100, 0.8992],
    },
];
