//! Stiffening of incompressible neo-Hookean tissue, made by [`super::Stiffening::of`]; the test
//! `stiffening::the_stored_curves_are_those_of_finite_elements` makes it again.

use crate::contact::{Friction, Tip};

/// s/a and F/F₀ · s/a, from the first depth to the last at which there is an equilibrium.
pub(super) fn points(tip: Tip, bond: Friction) -> &'static [(f64, f64)] {
    match (tip, bond) {
        (Tip::Flat { .. }, Friction::Bonded) => &FLAT_STICK,
        (Tip::Flat { .. }, Friction::Frictionless) => &FLAT_SLIP,
        (Tip::Sphere { .. }, Friction::Bonded) => &SPHERE_STICK,
        (Tip::Sphere { .. }, Friction::Frictionless) => &SPHERE_SLIP,
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
    (0.20106, 0.19170),
    (0.40292, 0.37278),
    (0.60525, 0.54647),
    (0.80789, 0.71075),
    (1.01077, 0.86757),
    (1.26463, 1.05392),
    (1.51869, 1.22874),
    (2.02721, 1.54807),
    (2.53593, 1.82763),
    (3.04476, 2.07801),
    (3.55347, 2.29742),
    (4.06199, 2.49136),
    (4.56997, 2.65124),
    (5.07864, 2.82644),
    (5.58758, 3.00102),
    (6.09680, 3.17557),
];

const SPHERE_SLIP: [(f64, f64); 9] = [
    (0.01000, 0.01000),
    (0.20104, 0.19138),
    (0.40283, 0.36909),
    (0.60502, 0.53489),
    (0.80748, 0.68915),
    (1.01008, 0.83062),
    (1.26338, 0.98581),
    (1.51663, 1.11833),
    (2.02227, 1.29686),
];
