//! Small smooth functions from which the organs are shaped.

use crate::Vec3;

/// Metres in a millimetre: the shapes are written in millimetres and scaled in their last line.
pub(super) const MILLIMETRE: f64 = 1e-3;

/// A bell [-]: 1 at 0, falling to 1/e at ±1 [-].
pub(super) fn bell(x: f64) -> f64 {
    (-x * x).exp()
}

/// A smooth step [-] from 0 (x far below 0) to 1 (x far above 0); half of it within ±0.55 [-].
pub(super) fn step(x: f64) -> f64 {
    0.5 * (1.0 + x.tanh())
}

/// A smooth ramp [-]: 0 for x far below 0, x far above it.
pub(super) fn ramp(x: f64) -> f64 {
    x.max(0.0) + (-x.abs()).exp().ln_1p()
}

/// `vector` turned by `angle` [rad] in the plane of two axes, from `first` towards `second`.
pub(super) fn turned(vector: Vec3, first: usize, second: usize, angle: f64) -> Vec3 {
    let (sine, cosine) = angle.sin_cos();
    let mut turned = vector;
    turned[first] = cosine * vector[first] - sine * vector[second];
    turned[second] = sine * vector[first] + cosine * vector[second];
    turned
}

/// Bézier curve through `controls`, at `t` from 0 to 1 [-], in the unit of the controls.
pub(super) fn bezier<T, const N: usize>(controls: &[T; N], t: f64) -> T
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    // De Casteljau: blend neighbours until one is left.
    let mut points = *controls;
    for left in (1..N).rev() {
        for i in 0..left {
            points[i] = points[i] * (1.0 - t) + points[i + 1] * t;
        }
    }
    points[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bezier_curve_starts_and_ends_at_its_controls() {
        let controls = [1.0, 5.0, -2.0, 4.0];
        assert_eq!(bezier(&controls, 0.0), 1.0);
        assert_eq!(bezier(&controls, 1.0), 4.0);
        assert_eq!(bezier(&[0.0, 1.0, 2.0], 0.25), 0.5);
    }

    #[test]
    fn steps_and_ramps_are_flat_where_they_should_be() {
        assert!(step(-20.0).abs() < 1e-12 && (step(20.0) - 1.0).abs() < 1e-12);
        assert!(ramp(-40.0).abs() < 1e-12 && (ramp(40.0) - 40.0).abs() < 1e-12);
    }

    #[test]
    fn turning_keeps_lengths() {
        let vector = Vec3::new(1.0, 2.0, 3.0);
        assert!((turned(vector, 0, 2, 0.7).norm() - vector.norm()).abs() < 1e-15);
    }
}
