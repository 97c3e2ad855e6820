use std::fmt;
use std::path::PathBuf;

use palpate_characterize::online::OnlineEstimate;
use serde::Serialize;

use super::measuring::{Measured, Measuring};
use crate::VERSION;

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub struct Answer {
    palpate: &'static str,
    recordings: Vec<Recording>,
    /// Whether Ctrl-C came before the end.
    pub stopped: bool,
    /// Warnings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Recording {
    #[serde(serialize_with = "crate::lossy")]
    file: PathBuf,
    stimulus: String,
    samples: usize,
    peak_force_n: f64,
    /// Whether it ends before its stimulus.
    stopped: bool,
    /// Whether it does because its parameters were known as well as the protocol asks.
    enough: bool,
    /// The last estimate of the tissue.
    #[serde(skip_serializing_if = "Option::is_none")]
    estimate: Option<OnlineEstimate>,
}

impl Answer {
    /// Of recordings.
    pub fn new(measured: Vec<Measured>, measuring: &Measuring) -> Self {
        let each = measured.into_iter().map(|own| Recording {
            file: own.recorded.file,
            stimulus: own.stimulus,
            samples: own.recorded.samples,
            peak_force_n: own.recorded.peak,
            stopped: own.recorded.cut_short.is_some(),
            enough: own.is_enough,
            estimate: own.estimate,
        });
        let recordings: Vec<Recording> = each.collect();
        Self {
            palpate: VERSION,
            stopped: recordings.len() < measuring.names().len()
                || recordings.iter().any(|own| own.stopped && !own.enough),
            recordings,
            warnings: measuring.warnings.clone(),
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for recording in &self.recordings {
            let end = match (recording.enough, recording.stopped) {
                (true, _) => ", known well enough",
                (false, true) => ", stopped",
                (false, false) => "",
            };
            writeln!(
                f,
                "{:<24} {:>7} samples, at most {:.4} N{end}: {}",
                recording.stimulus,
                recording.samples,
                recording.peak_force_n,
                recording.file.display()
            )?;
            if let Some(estimate) = &recording.estimate {
                writeln!(f, "    {estimate}")?;
            }
        }
        Ok(())
    }
}
