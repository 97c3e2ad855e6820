//! Stiffening of incompressible neo-Hookean tissue, made by [`super::Stiffening::of`]; the test
//! `stiffening::the_stored_curves_are_those_of_finite_elements` makes it again.

use crate::contact::{Bond, Tip};

/// s/a and F/F₀ · s/a, from the first depth to the last at which there is an equilibrium.
pub(super) fn points(tip: Tip, bond: Bond) -> &'static [(f64, f64)] {
    match (tip, bond) {
        (Tip::Flat { .. }, Bond::Stick) => &FLAT_STICK,
        (Tip::Flat { .. }, Bond::Slip) => &FLAT_SLIP,
        (Tip::Sphere { .. }, Bond::Stick) => &SPHERE_STICK,
        (Tip::Sphere { .. }, Bond::Slip) => &SPHERE_SLIP,
    }
}

const FLAT_STICK: [(f64, f64); 17] = [
    (0.01000, 0.01000),
    (0.20370, 0.20004),
    (0.40730, 0.39424),
    (0.61090, 0.58873),
    (0.81441, 0.77819),
    (1.01786, 0.96449),
    (1.27222, 1.19974),
    (1.52656, 1.43448),
    (2.03536, 1.90960),
    (2.54433, 2.39396),
    (3.05367, 2.89821),
    (3.56339, 3.42315),
    (4.07366, 3.97767),
    (4.58448, 4.56206),
    (5.09565, 5.16501),
    (5.60759, 5.80992),
    (6.11945, 6.45040),
];

const FLAT_SLIP: [(f64, f64); 4] = [
    (0.01000, 0.01000),
    (0.20357, 0.19723),
    (0.40692, 0.38205),
    (0.61030, 0.56891),
];

const SPHERE_STICK: [(f64, f64); 17] = [
    (0.01000, 0.01000),
    (0.20105, 0.18941),
    (0.40292, 0.37302),
    (0.60527, 0.54824),
    (0.80791, 0.71257),
    (1.01077, 0.86772),
    (1.26464, 1.05417),
    (1.51870, 1.22899),
    (2.02722, 1.54836),
    (2.53594, 1.82792),
    (3.04477, 2.07836),
    (3.55347, 2.29778),
    (4.06200, 2.49177),
    (4.57000, 2.65224),
    (5.07869, 2.82832),
    (5.58770, 3.00540),
    (6.09708, 3.18475),
];

const SPHERE_SLIP: [(f64, f64); 7] = [
    (0.01000, 0.01000),
    (0.20102, 0.18824),
    (0.40282, 0.36838),
    (0.60505, 0.53728),
    (0.80747, 0.68816),
    (1.01007, 0.82972),
    (1.26336, 0.98405),
];
