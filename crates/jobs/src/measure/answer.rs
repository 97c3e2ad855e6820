use std::fmt;
use std::path::PathBuf;

use palpate_measure::Recorded;
use serde::Serialize;

use super::measuring::Measuring;
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
}

impl Answer {
    /// Of recordings, each with what its stimulus is called.
    pub fn new(recorded: Vec<(String, Recorded)>, measuring: &Measuring) -> Self {
        let each = recorded.into_iter().map(|(stimulus, recorded)| Recording {
            file: recorded.file,
            stimulus,
            samples: recorded.samples,
            peak_force_n: recorded.peak,
            stopped: recorded.cut_short.is_some(),
        });
        let recordings: Vec<Recording> = each.collect();
        Self {
            palpate: VERSION,
            stopped: recordings.len() < measuring.names().len()
                || recordings.iter().any(|recording| recording.stopped),
            recordings,
            warnings: measuring.warnings.clone(),
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for recording in &self.recordings {
            let end = if recording.stopped { ", stopped" } else { "" };
            writeln!(
                f,
                "{:<24} {:>7} samples, at most {:.4} N{end}: {}",
                recording.stimulus,
                recording.samples,
                recording.peak_force_n,
                recording.file.display()
            )?;
        }
        Ok(())
    }
}
