//! The quartic spline, the radial weight of every particle (3-10), and its derivatives.

/// w(s) = 1 − 6 s² + 8 s³ − 3 s⁴ for 0 ≤ s < 1, zero beyond [-].
pub fn quartic(s: f64) -> f64 {
    if s >= 1.0 {
        return 0.0;
    }
    let rest = 1.0 - s;
    rest * rest * rest * (1.0 + 3.0 * s)
}

/// w'(s)/s [-], which is finite at the centre.
pub(super) fn slope_by_distance(s: f64) -> f64 {
    let rest = 1.0 - s;
    -12.0 * rest * rest
}

/// (w''(s) − w'(s)/s)/s [-].
pub(super) fn curvature_by_distance(s: f64) -> f64 {
    24.0 * (1.0 - s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_weight() {
        for s in [0.1, 0.35, 0.8] {
            let step = 1e-5;
            let (up, down, here) = (quartic(s + step), quartic(s - step), quartic(s));
            let slope = (up - down) / (2.0 * step);
            let second = (up - 2.0 * here + down) / (step * step);
            // Central differences: step² times a derivative of order ten; rounding over step².
            assert!((slope_by_distance(s) * s - slope).abs() < 1e-8);
            let expected = curvature_by_distance(s) * s + slope_by_distance(s);
            assert!((expected - second).abs() < 1e-4);
        }
        assert_eq!((quartic(0.0), quartic(1.0), quartic(2.0)), (1.0, 0.0, 0.0));
    }
}
