//! The third derivative of a path, by least squares in a moving window: noise and the sampling rate have little
//! influence, and a changing rate does no harm.

use nalgebra::{SMatrix, SVector};
use palpate_geometry::Vec3;

/// Half of the window [s]: a hand's own motion is below some 5 Hz.
const HALF: f64 = 0.15;

/// Step of the windows [s].
const APART: f64 = 0.02;

/// Terms of the polynomial in the window: up to the fourth power.
const TERMS: usize = 5;

/// Least number of samples in a window.
const LEAST: usize = 8;

/// √(½ T⁵/L² ∫ j² dt) [-] over stretches of times [s] and places [m], which took `time` [s] over `path` [m].
pub(super) fn normalised(stretches: &[Vec<(f64, Vec3)>], time: f64, path: f64) -> Option<f64> {
    let long = |stretch: &&Vec<(f64, Vec3)>| match stretch.as_slice() {
        [(first, _), .., (last, _)] => last - first >= 2.0 * HALF,
        _ => false,
    };
    let squares: Vec<f64> = stretches.iter().filter(long).map(|s| square(s)).collect();
    if squares.is_empty() || time < 0.5 || path <= 0.0 {
        return None;
    }
    let integral: f64 = squares.iter().sum();
    Some((0.5 * time.powi(5) / (path * path) * integral).sqrt())
}

/// ∫ j² dt over a stretch [m²/s⁵], by the trapezoidal rule.
fn square(stretch: &[(f64, Vec3)]) -> f64 {
    let (first, last) = (stretch[0].0, stretch[stretch.len() - 1].0);
    let windows = ((last - first) / APART).ceil().max(1.0);
    let step = (last - first) / windows;
    let mut sum = 0.0;
    let mut from = 0;
    for number in 0..=windows as usize {
        let at = first + step * number as f64;
        // At an end the window stays inside, and the polynomial is evaluated at its border.
        let middle = at.clamp(first + HALF, (last - HALF).max(first + HALF));
        while stretch[from].0 < middle - HALF - 1e-9 {
            from += 1;
        }
        let inside = |sample: &&(f64, Vec3)| sample.0 <= middle + HALF + 1e-9;
        let jerk = third(stretch[from..].iter().take_while(inside), at);
        let weight = if number == 0 || number == windows as usize {
            0.5
        } else {
            1.0
        };
        sum += weight * step * jerk.norm_squared();
    }
    sum
}

/// The third derivative [m/s³] at `at` [s] of the polynomial that fits the samples.
fn third<'s>(samples: impl Iterator<Item = &'s (f64, Vec3)>, at: f64) -> Vec3 {
    let mut normal = SMatrix::<f64, TERMS, TERMS>::zeros();
    let mut right = SMatrix::<f64, TERMS, 3>::zeros();
    let mut count = 0;
    for (time, place) in samples {
        let t = (time - at) / HALF;
        let powers = SVector::<f64, TERMS>::from_fn(|power, _| t.powi(power as i32));
        normal += powers * powers.transpose();
        right += powers * place.transpose();
        count += 1;
    }
    if count < LEAST {
        return Vec3::zeros();
    }
    let solved = normal.cholesky().map(|factors| factors.solve(&right));
    solved.map_or(Vec3::zeros(), |terms| {
        terms.row(3).transpose() * (6.0 / HALF.powi(3))
    })
}
