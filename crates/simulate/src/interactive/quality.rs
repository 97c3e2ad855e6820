use palpate_geometry::Vec3;
use palpate_servo::{LoopReport, MemoryLock, Percentiles, Priority};

/// The quality of a touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// The model.
    pub model: ModelReport,
    /// The servo loop of each tool, in the scene's order; none without a device.
    pub loops: Vec<Option<LoopReport>>,
}

/// Measurements of the model.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct ModelReport {
    /// The priority that the operating system gave the model's thread.
    pub priority: Priority,
    /// Steps per second [Hz].
    #[serde(rename = "rate_hz")]
    pub rate: f64,
    /// Number of steps.
    pub steps: u64,
    /// Missed steps, because the one before took longer than its period.
    pub missed: u64,
    /// Time from reading the hands to the forces of a step [s].
    #[serde(rename = "touch_s")]
    pub touch_times: Percentiles,
    /// Duration of whole steps, with display and recording [s].
    #[serde(rename = "step_s")]
    pub step_times: Percentiles,
    /// Extrapolation error of the forces between steps.
    #[serde(flatten)]
    pub extrapolation: ExtrapolationError,
}

impl Quality {
    /// Where the operating system does not provide the required real-time settings, the consequence and how to allow
    /// it: a sentence each for servo loops, model and memory.
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

/// The extrapolation error: the force that the servo loop extrapolated from older answers minus the one that the model
/// then found for the same hand position: at every step in contact, where the last answer is oldest, or at every tick
/// ([`super::measure_extrapolation_error`]).
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct ExtrapolationError {
    /// Number of compared forces.
    #[serde(skip)]
    pub compared: u64,
    /// Root mean square [N].
    #[serde(rename = "extrapolation_rms_n")]
    pub rms: f64,
    /// Maximum [N].
    #[serde(rename = "extrapolation_max_n")]
    pub max: f64,
    /// The largest force of the model [N], for comparison.
    #[serde(rename = "extrapolation_peak_n")]
    pub peak: f64,
}

impl ExtrapolationError {
    /// Counts an extrapolated force and the model's force [N].
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
