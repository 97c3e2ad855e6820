use palpate_geometry::Vec3;
use palpate_servo::{LoopReport, MemoryLock, Percentiles, Priority};

/// How good the touch was.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// The model.
    pub model: ModelReport,
    /// The servo loop of each tool, in the scene's order; none where there is no device.
    pub loops: Vec<Option<LoopReport>>,
}

/// What the model measured of itself.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct ModelReport {
    /// What the operating system gave the model's thread.
    pub priority: Priority,
    /// Steps per second [Hz].
    #[serde(rename = "rate_hz")]
    pub rate: f64,
    /// Steps that were done.
    pub steps: u64,
    /// Steps that were left out, because the one before took longer than its period.
    pub missed: u64,
    /// How long steps took to find their forces, from reading the hands on [s].
    #[serde(rename = "touch_s")]
    pub touch_times: Percentiles,
    /// How long whole steps took, with what is seen and recorded of them [s].
    #[serde(rename = "step_s")]
    pub step_times: Percentiles,
    /// How far the forces between steps were off.
    #[serde(flatten)]
    pub extrapolation: ExtrapolationError,
}

impl Quality {
    /// Where the operating system does not give what a touch needs, what that means and how to allow it: a sentence for
    /// each of servo loops, model and memory.
    pub fn warnings(&self, memory: MemoryLock) -> Vec<String> {
        let mut loops = self.loops.iter().flatten();
        let servo = loops.find_map(|report| report.priority.warning("servo"));
        let model = self.model.priority.warning("model");
        [servo, model, memory.warning()]
            .into_iter()
            .flatten()
            .collect()
    }
}

/// How far the force that the servo loop made of older answers was from the one that the model then found
/// for the same place of the hand: at every step in contact, where the last answer is oldest, or at every
/// tick ([`super::judge_samples`]).
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct ExtrapolationError {
    /// Forces that were compared.
    #[serde(skip)]
    pub compared: u64,
    /// Root of the mean square [N].
    #[serde(rename = "extrapolation_rms_n")]
    pub rms: f64,
    /// The largest [N].
    #[serde(rename = "extrapolation_max_n")]
    pub max: f64,
    /// The largest force of the model [N], to compare with.
    #[serde(rename = "extrapolation_peak_n")]
    pub peak: f64,
}

impl ExtrapolationError {
    /// Counts a force that was made in between and the one that was found [N].
    pub(super) fn add(&mut self, made: &Vec3, found: &Vec3) {
        let size = found.norm();
        if made.norm() == 0.0 && size == 0.0 {
            return;
        }
        let error = (made - found).norm();
        let before = self.rms * self.rms * self.compared as f64;
        self.compared += 1;
        self.rms = ((before + error * error) / self.compared as f64).sqrt();
        self.max = self.max.max(error);
        self.peak = self.peak.max(size);
    }
}
