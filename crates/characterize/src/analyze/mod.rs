//! Analysis without a model: relaxation, static response, swings.
//!
//! ```text
//! CleanRecording ─▶ Analysis: holds, relaxation, sinusoids, sweeps
//! all holds      ─▶ static response: per organ, condition, time after death and depth
//! all analyses   ─▶ organ responses: relaxation and swings per organ
//! ```

mod organ_response;
mod relaxation;
mod sinusoid;
mod static_response;
mod sweep;

pub use organ_response::{FrequencyRow, OrganResponse, Spread, organ_responses};
pub(crate) use relaxation::holds;
pub use relaxation::{Hold, Relaxation};
pub use sinusoid::Sinusoid;
pub use static_response::{StaticGroup, StaticPoint, StaticRow, static_response};
pub use sweep::{COHERENT, Sweep, SweepPoint};

use crate::CleanRecording;
use crate::clean::SegmentKind;

/// What one recording shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// Every hold, in the order of time.
    pub holds: Vec<Hold>,
    /// Relaxation in the longest hold; none without a hold.
    pub relaxation: Option<Relaxation>,
    /// The answer to each sine, in the order of time.
    pub sinusoids: Vec<Sinusoid>,
    /// The answer to each chirp, in the order of time.
    pub sweeps: Vec<Sweep>,
    /// Warnings about the results; those about the recordings stand apart.
    pub warnings: Vec<String>,
}

impl Analysis {
    /// The answer to the longest sine.
    pub fn longest_sine(&self) -> Option<&Sinusoid> {
        let sines = self.sinusoids.iter();
        sines.max_by_key(|sine| sine.end - sine.first)
    }
}

/// Analyzes a recording.
pub fn analyze(recording: &CleanRecording) -> Analysis {
    let mut warnings = Vec::new();
    let holds = holds(recording, &mut warnings);
    let mut sinusoids = Vec::new();
    let mut sweeps = Vec::new();
    for segment in &recording.segments {
        match segment.kind {
            SegmentKind::Sine(frequency) => {
                sinusoids.extend(Sinusoid::of(recording, segment, frequency, &mut warnings));
            }
            SegmentKind::Chirp(first, last) => {
                sweeps.extend(Sweep::of(recording, segment, [first, last], &mut warnings));
            }
            SegmentKind::Ramp | SegmentKind::Hold | SegmentKind::Retreat => {}
        }
    }
    Analysis {
        relaxation: relaxation::longest(recording, &mut warnings),
        holds,
        sinusoids,
        sweeps,
        warnings,
    }
}
