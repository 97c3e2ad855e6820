//! Preparation of a recording: first contact, offset, stimulus, disturbances.
//!
//! ```text
//! Recording ─signs─▶ ─contact, offset─▶ ─segments─▶ ─ripple─▶ ─low-pass─▶ CleanRecording
//! ```
//!
//! The fitted force is the measured one, less the sensor's zero and, of tissue that moves by itself, the swing of its
//! force (`motion`); only plots use the filtered force. [`CleanRecording::warnings`] lists all changes and warnings.

mod contact;
mod contact_search;
mod drift;
mod filter;
mod motion;
pub(crate) mod noise;
mod oriented;
mod plausible;
pub(crate) mod regression;
mod ripple;
mod sampling;
pub(crate) mod segments;
mod stimulus;
pub(crate) mod swing;

use palpate_files::Recording;
use palpate_files::recording::{RecordingHeader, StimulusKind};

pub use contact::Contact;
pub(crate) use contact::rising_contact;
pub(crate) use contact_search::Approach;
pub use filter::LowPass;
pub(crate) use motion::MovingTissue;
use oriented::Oriented;
pub use ripple::Ripple;
pub use sampling::Sampling;

use crate::Error;

/// Fewest samples of a recording.
const FEWEST_SAMPLES: usize = 5;
/// The cut-off over the fastest thing in the stimulus [-].
const CUTOFF: f64 = 10.0;
/// Lowest cut-off by default [Hz].
const LOWEST_CUTOFF: f64 = 2.0;
/// Highest cut-off by default over the rate [-].
const HIGHEST_CUTOFF: f64 = 0.4;

/// What is up to the user in the making of a clean recording.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CleanSettings {
    /// Cut-off of the filter [Hz]; by default ten times the fastest thing in the stimulus (a frequency,
    /// or the inverse of a ramp's duration), but at least 2 Hz and at most 0.4 of the rate.
    pub cutoff_hz: Option<f64>,
    /// When the indenter first touched, in the recording's own time [s]; found by default.
    pub contact_time_s: Option<f64>,
    /// Whether a heart's ripple is taken out of the filtered force.
    pub removes_ripple: bool,
}

/// A recording made ready for statistics and fits. All columns have one number for each sample.
#[derive(Debug, Clone, PartialEq)]
pub struct CleanRecording {
    /// What is known of the specimen, the indenter and the stimulus.
    pub header: RecordingHeader,
    /// Times [s], from the first contact, ascending.
    pub time: Vec<f64>,
    /// Depths [m], from the first contact, into the tissue.
    pub depth: Vec<f64>,
    /// Forces on the tissue [N], less what the sensor showed before contact; not filtered.
    pub force: Vec<f64>,
    /// The same forces [N] after the filter. This is drawn.
    pub filtered_force: Vec<f64>,
    /// What the indenter did, in the order of time; rests out of the tissue are left out.
    pub segments: Vec<Segment>,
    /// What was found and done on the way.
    pub handling: CleaningReport,
    /// What was done to it and warnings, in plain sentences.
    pub warnings: Vec<String>,
}

/// What was found and done on the way to a clean recording.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CleaningReport {
    /// The first contact.
    pub contact: Contact,
    /// How the samples lie in time.
    pub sampling: Sampling,
    /// A heart's ripple, if one was seen.
    pub ripple: Option<Ripple>,
    /// Cut-off of the filter [Hz]; none when the recording was not filtered.
    pub cutoff_hz: Option<f64>,
    /// Factors that turned depth and force, 1 or −1 [-].
    pub signs: [f64; 2],
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

/// Makes a recording ready.
///
/// # Errors
/// When it is too short, its force never changes, no contact is found, or the settings do not fit it.
pub fn clean(recording: &Recording, settings: &CleanSettings) -> Result<CleanRecording, Error> {
    let mut warnings = recording.remarks().to_vec();
    if let Some(why) = recording.header.cut_short() {
        warnings.push(format!(
            "it was cut short ({why}), so a part of its stimulus is missing"
        ));
    }
    if let Some(why) = recording.incomplete() {
        warnings.push(format!("it is {why}"));
    }
    let samples = Oriented::new(recording, &mut warnings);
    check(&samples)?;
    let sampling = Sampling::of(&samples.time);
    sampling.add_warnings(&mut warnings);
    let contact = find_contact(recording, &samples, settings)?;
    let shifted = |values: &[f64], by: f64| values.iter().map(|value| value - by).collect();
    let mut clean = CleanRecording {
        header: recording.header.clone(),
        time: shifted(&samples.time, contact.time_s),
        depth: shifted(&samples.depth, contact.depth_m),
        force: shifted(&samples.force, contact.offset_n),
        filtered_force: Vec::new(),
        segments: Vec::new(),
        handling: CleaningReport {
            contact,
            sampling,
            signs: samples.signs,
            ..CleaningReport::default()
        },
        warnings,
    };
    clean.segments = segments::find(&clean.time, &clean.depth, contact.sample);
    clean.handling.ripple = Ripple::find(&clean.time, &clean.force, &clean.segments);
    clean.smooth(settings)?;
    clean.add_warnings(recording);
    Ok(clean)
}

fn check(samples: &Oriented) -> Result<(), Error> {
    let count = samples.time.len();
    if count < FEWEST_SAMPLES {
        return Err(Error::TooShort {
            samples: count,
            least: FEWEST_SAMPLES,
            task: "finding the contact",
        });
    }
    let force = samples.force[0];
    if samples.force.iter().all(|other| *other == force) {
        return Err(Error::ConstantForce { force });
    }
    Ok(())
}

fn find_contact(
    recording: &Recording,
    samples: &Oriented,
    settings: &CleanSettings,
) -> Result<Contact, Error> {
    let stimulus = recording.header.stimulus;
    let is_clamped = stimulus.is_some_and(StimulusKind::is_clamped);
    match settings.contact_time_s {
        Some(time) => contact::at(samples, time),
        None if !recording.begins_at_contact() && is_clamped => Ok(contact::at_first(samples)),
        None if !recording.begins_at_contact() => contact::by_force(samples, &recording.header),
        None => contact::by_depth(samples, stimulus.is_some_and(StimulusKind::is_of_piece)),
    }
}

impl CleanRecording {
    fn smooth(&mut self, settings: &CleanSettings) -> Result<(), Error> {
        let mut force = self.force.clone();
        if let Some(ripple) = &self.handling.ripple
            && settings.removes_ripple
        {
            ripple.remove(&self.time, &mut force);
        }
        let cutoff = settings.cutoff_hz.unwrap_or_else(|| self.usual_cutoff());
        self.filtered_force = self.handling.sampling.smooth(&self.time, &force, cutoff)?;
        self.handling.cutoff_hz = Some(cutoff);
        Ok(())
    }

    fn usual_cutoff(&self) -> f64 {
        let rate = self.handling.sampling.rate_hz;
        let fastest = self
            .segments
            .iter()
            .map(|own| match own.kind {
                SegmentKind::Ramp | SegmentKind::Retreat => 1.0 / self.duration(own),
                SegmentKind::Hold => 0.0,
                SegmentKind::Sine(frequency) => frequency,
                SegmentKind::Chirp(first, last) => first.max(last),
            })
            .fold(0.0, f64::max);
        (CUTOFF * fastest)
            .max(LOWEST_CUTOFF)
            .min(HIGHEST_CUTOFF * rate)
    }

    pub(crate) fn is_piece(&self) -> bool {
        let stimulus = self.header.stimulus;
        stimulus.is_some_and(StimulusKind::is_of_piece)
    }

    /// How long a segment takes [s], from its first sample to the first of the next.
    pub fn duration(&self, segment: &Segment) -> f64 {
        let last = self.time.len() - 1;
        self.time[segment.end.min(last)] - self.time[segment.first]
    }

    /// The force [N] that is fitted: as if the tissue did not move by itself.
    pub fn force_at_rest(&self) -> Vec<f64> {
        let moving = self.moving();
        moving.map_or_else(|| self.force.clone(), |moving| moving.force_at_rest())
    }

    /// The amplitude of the motion of the tissue by itself [m], as a heart moves it; none where its force does not swing.
    pub fn motion(&self) -> Option<f64> {
        self.moving()?.amplitude()
    }

    fn moving(&self) -> Option<MovingTissue<'_>> {
        Some(MovingTissue {
            time: &self.time,
            depth: &self.depth,
            force: &self.force,
            segments: &self.segments,
            ripple: self.handling.ripple.as_ref()?,
            shape: self.header.indenter_shape,
        })
    }

    fn add_warnings(&mut self, recording: &Recording) {
        let mut warnings = std::mem::take(&mut self.warnings);
        contact::add_warnings(&self.handling.contact, self, &mut warnings);
        stimulus::add_warnings(self, &mut warnings);
        plausible::add_warnings(self, recording, &mut warnings);
        if let Some(ripple) = &self.handling.ripple {
            let motion = self.motion().map_or_else(String::new, |motion| {
                format!(
                    "; the tissue moves by about {motion:.1e} m, and the depth of the first contact may be off by as much"
                )
            });
            warnings.push(format!(
                "the force of the hold swings by {:.2e} N at {:.2} Hz, as over a heart; this is taken out of the force that is \
                 fitted{motion}",
                ripple.amplitude_n, ripple.frequency_hz
            ));
        }
        self.warnings = warnings;
    }
}
