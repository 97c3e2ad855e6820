//! The ligament of a wall that is cut to a part of its thickness, as a row of springs [Rice and Levy 1972],
//! from the stress intensity of an edge crack in a strip [Tada, Paris and Irwin 1973].

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix2, Matrix5};

/// Steps of the integral over the depth.
const STEPS: usize = 24;

/// Stiffness of the ligament over E for a length of one [-], between the modes of a facet in a wall.
pub(super) fn ligament(nu: f64, part: f64) -> Matrix5<f64> {
    let (mut both, mut across) = (Matrix2::zeros(), 0.0);
    for step in 0..STEPS {
        let x = part * (step as f64 + 0.5) / STEPS as f64;
        let weight = part / STEPS as f64 * PI * x;
        let angle = FRAC_PI_2 * x;
        let rest = 1.0 - angle.sin();
        let common = (angle.tan() / angle).sqrt() / angle.cos();
        let pulled = common * (0.752 + 2.02 * x + 0.37 * rest.powi(3));
        let bent = 3.0 * common * (0.923 + 0.199 * rest.powi(4));
        both += Matrix2::new(pulled * pulled, pulled * bent, pulled * bent, bent * bent) * weight;
        let slid = (1.122 - 0.561 * x + 0.085 * x * x + 0.18 * x.powi(3)) / (1.0 - x).sqrt();
        across += slid * slid * weight;
    }
    let plane = 2.0 * (1.0 - nu * nu);
    let torn = 8.0 * (1.0 + nu) / PI * -(FRAC_PI_2 * part).cos().ln();
    let mut stiffness = Matrix5::zeros();
    // Of two compliances that are nearly in proportion, as those of a shallow cut are. The sum of squares
    // is not below zero and the slack above it, so that the matrix has an inverse for 0 < part < 1.
    debug_assert!(
        part > 0.0 && part < 1.0,
        "a ligament is what is left of a wall: {part}"
    );
    let both = both * plane;
    let slack = 1e-4 * both.trace();
    let raised = both + Matrix2::identity() * slack;
    let inverse = Matrix2::new(
        raised[(1, 1)],
        -raised[(0, 1)],
        -raised[(1, 0)],
        raised[(0, 0)],
    ) / raised.determinant();
    // Evenly and at the hinge.
    for (i, row) in [0, 2].into_iter().enumerate() {
        for (j, column) in [0, 2].into_iter().enumerate() {
            stiffness[(row, column)] = inverse[(i, j)];
        }
    }
    stiffness[(1, 1)] = 1.0 / torn;
    for i in 3..5 {
        for j in 3..5 {
            stiffness[(i, j)] = 1.0 / (plane * across);
        }
    }
    stiffness
}
