use crate::Limits;

/// How a loop runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// Time from tick to tick [s].
    pub period: f64,
    /// What forces have to pass; none means those that belong to the device.
    pub limits: Option<Limits>,
    /// Samples that the log has room for.
    pub log: usize,
}

impl Default for ServoSettings {
    /// 1 kHz, and four seconds of samples until somebody reads them.
    fn default() -> Self {
        Self {
            period: 1e-3,
            limits: None,
            log: 4096,
        }
    }
}
