use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use super::measuring::{Measuring, Recorded};
use crate::output::VERSION;

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    recordings: Vec<Recording>,
    /// Whether Ctrl-C came before the end.
    pub(super) stopped: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Recording {
    file: PathBuf,
    stimulus: String,
    samples: usize,
    peak_force_n: f64,
    /// Whether it ends before its stimulus.
    stopped: bool,
}

impl Answer {
    pub(super) fn new(recorded: Vec<Recorded>, measuring: &Measuring) -> Self {
        let stopped = recorded.len() < measuring.names().len()
            || recorded.iter().any(|recording| recording.stopped);
        let each = recorded.into_iter().map(|recorded| Recording {
            file: recorded.file,
            stimulus: recorded.stimulus,
            samples: recorded.samples,
            peak_force_n: recorded.peak,
            stopped: recorded.stopped,
        });
        Self {
            palpate: VERSION,
            recordings: each.collect(),
            stopped,
            warnings: measuring.doubts.clone(),
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
