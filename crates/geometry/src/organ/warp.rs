//! Small smooth functions from which the organs are shaped.

/// A bell [-]: 1 at 0, falling to 1/e at ±1 [-].
pub(super) fn bell(x: f64) -> f64 {
    (-x * x).exp()
}

/// A smooth step [-] from 0 (x far below 0) to 1 (x far above 0) over a width of about 2 [-].
pub(super) fn step(x: f64) -> f64 {
    0.5 * (1.0 + x.tanh())
}
