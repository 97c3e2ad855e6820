//! A recording made ready: first contact, offset, stimulus, disturbances.

use palpate_files::recording::RecordingHeader;

/// A recording made ready for statistics and fits. All columns have one number for each sample.
#[derive(Debug, Clone, PartialEq)]
pub struct CleanRecording {
    /// What is known of the specimen, the indenter and the stimulus.
    pub header: RecordingHeader,
    /// Times [s], from the first contact, ascending.
    pub time: Vec<f64>,
    /// Depths [m], from the first contact, into the tissue.
    pub depth: Vec<f64>,
    /// Forces on the tissue [N], less what the sensor showed before contact; not filtered. This is fitted.
    pub force: Vec<f64>,
    /// The same forces [N] after the filter. This is drawn.
    pub filtered_force: Vec<f64>,
    /// What the indenter did, in the order of time.
    pub segments: Vec<Segment>,
    /// What was done to it and what deserves doubt, in plain sentences.
    pub doubts: Vec<String>,
}

/// A part of the stimulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// What the indenter does in it.
    pub kind: SegmentKind,
    /// First sample.
    pub first: usize,
    /// One past the last sample.
    pub end: usize,
}

/// What the indenter does in a part of the stimulus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SegmentKind {
    /// It goes deeper.
    Ramp,
    /// It stays.
    Hold,
    /// It goes back.
    Retreat,
    /// It swings with one frequency [Hz].
    Sine(f64),
    /// It swings with a frequency [Hz] that goes from the first to the second.
    Chirp(f64, f64),
}
