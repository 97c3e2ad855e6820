use crate::Limits;
use crate::dynamics::Compensation;

/// The settings of a loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// Period of the ticks [s].
    pub period: f64,
    /// The limits of its forces; none selects those of the device.
    pub limits: Option<Limits>,
    /// The compensation of the device's dynamics; none for a device that compensates by itself, or cannot.
    pub compensation: Option<Compensation>,
    /// Capacity of the log, in samples.
    pub log: usize,
}

impl Default for ServoSettings {
    /// 1 kHz, and a log of four seconds.
    fn default() -> Self {
        Self {
            period: 1e-3,
            limits: None,
            compensation: None,
            log: 4096,
        }
    }
}
