use crate::noise::Noise;

/// A force sensor between device and indenter.
#[derive(Debug, Clone)]
pub struct ForceSensor {
    /// Its step [N].
    pub step: f64,
    /// The largest force that it shows [N].
    pub range: f64,
    /// Standard deviation of its noise [N].
    pub noise: f64,
    random: Noise,
}

impl ForceSensor {
    /// The source's: an ATI Nano17 with steps of 1/1280 N (section 5.2.1), 17 N along its axis; noise of half a
    /// step.
    pub fn nano17(seed: u64) -> Self {
        Self {
            step: 1.0 / 1280.0,
            range: 17.0,
            noise: 0.5 / 1280.0,
            random: Noise::new(seed),
        }
    }

    /// What it shows of a `force` [N].
    pub fn read(&mut self, force: f64) -> f64 {
        let felt = (force + self.noise * self.random.normal()).clamp(-self.range, self.range);
        // Not −0.
        (felt / self.step).round() * self.step + 0.0
    }
}
