use crate::Limits;
use crate::dynamics::Compensation;

/// How a loop runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// Time from tick to tick [s].
    pub period: f64,
    /// What forces have to pass; none means those that belong to the device.
    pub limits: Option<Limits>,
    /// What is added for the device itself; none for one that does it on its own, or cannot.
    pub compensation: Option<Compensation>,
    /// Samples that the log has room for.
    pub log: usize,
}

impl Default for ServoSettings {
    /// 1 kHz, and four seconds of samples until somebody reads them.
    fn default() -> Self {
        Self {
            period: 1e-3,
            limits: None,
            compensation: None,
            log: 4096,
        }
    }
}
