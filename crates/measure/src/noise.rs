use std::f64::consts::TAU;

/// Numbers of a normal law, the same for the same seed.
#[derive(Debug, Clone)]
pub(crate) struct Noise(fastrand::Rng);

impl Noise {
    pub(crate) fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// Of mean zero and standard deviation one [-]: the method of Box and Muller.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.0.f64()).ln()).sqrt();
        radius * (TAU * self.0.f64()).cos()
    }

    /// Between zero and one [-].
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0.f64()
    }
}
