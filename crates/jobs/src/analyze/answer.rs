use std::path::PathBuf;

use palpate_characterize::Analysis;
use palpate_characterize::analyze::{
    Hold, OrganResponse, Relaxation, Sinusoid, Spread, StaticGroup, StaticRow, Sweep,
};
use serde::Serialize;

use super::analyzed::Analyzed;
use crate::VERSION;
use crate::{ReadRecording, Sideways, Unusable};

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub struct Answer {
    palpate: &'static str,
    /// One for each recording.
    pub files: Vec<FileAnswer>,
    /// One for each organ and state.
    pub organs: Vec<OrganAnswer>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unusable: Vec<Unusable>,
    /// What deserves doubt.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// What one recording shows.
#[derive(Debug, Serialize)]
pub struct FileAnswer {
    /// As it was named.
    #[serde(serialize_with = "crate::lossy")]
    pub file: PathBuf,
    organ: Option<String>,
    subject: Option<String>,
    /// First contact, in the recording's own time [s].
    contact_time_s: f64,
    /// A row for each hold.
    #[serde(rename = "static")]
    pub static_response: Vec<StaticAnswer>,
    /// Of the longest hold.
    pub relaxation: Option<RelaxationAnswer>,
    /// The longest sine.
    pub sinusoid: Option<SinusoidAnswer>,
    /// What the other axes of its sensor show at the largest force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sideways: Option<Sideways>,
    /// All sines, where there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    sinusoids: Vec<SinusoidAnswer>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    chirps: Vec<Vec<ChirpPoint>>,
}

/// What all recordings of an organ show.
#[derive(Debug, Serialize)]
pub struct OrganAnswer {
    /// Its name; none where no file says it.
    pub organ: Option<String>,
    condition: Option<&'static str>,
    post_mortem_h: Option<u64>,
    /// A row for each depth.
    #[serde(rename = "static")]
    pub static_response: Vec<StaticAnswer>,
    relaxation: Option<OrganRelaxation>,
    /// By ascending frequency.
    sinusoid: Vec<OrganSinusoid>,
}

/// Steady forces at one depth.
#[derive(Debug, Serialize)]
pub struct StaticAnswer {
    /// [m]
    pub depth_m: f64,
    /// [N]
    pub mean_n: f64,
    /// [N]
    pub min_n: f64,
    /// [N]
    pub max_n: f64,
    /// Holds.
    pub n: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    subjects: Option<usize>,
    /// Standard deviation within one subject, and between subjects.
    #[serde(skip_serializing_if = "Option::is_none")]
    within_subject_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    between_subjects_n: Option<f64>,
}

/// How the force of a hold falls.
#[derive(Debug, Serialize)]
pub struct RelaxationAnswer {
    /// [N]
    pub peak_n: f64,
    /// Mean of the last tenth of the hold [N].
    pub steady_n: f64,
    /// Steady over peak [-].
    pub ratio: f64,
    /// After which the force stays within a tenth of steady [s].
    pub settle_s: f64,
    hold_s: f64,
}

/// The answer to a sine.
#[derive(Debug, Clone, Serialize)]
pub struct SinusoidAnswer {
    /// [Hz]
    pub frequency_hz: f64,
    /// [N/m]
    pub stiffness_n_per_m: f64,
    stiffness_standard_error: f64,
    /// Positive when force leads depth [rad].
    pub phase_rad: f64,
    phase_standard_error: f64,
    /// Per cycle, positive when lost [J].
    pub hysteresis_j: f64,
    amplitude_m: f64,
    pre_indentation_m: f64,
    /// Higher harmonics of the force over the first.
    distortion: f64,
    periods: usize,
}

/// The answer to a chirp at one frequency.
#[derive(Debug, Serialize)]
struct ChirpPoint {
    frequency_hz: f64,
    stiffness_n_per_m: f64,
    phase_rad: f64,
    coherence: f64,
    is_coherent: bool,
}

/// A number over recordings.
#[derive(Debug, Serialize)]
struct SpreadAnswer {
    mean: f64,
    min: f64,
    max: f64,
    n: usize,
}

/// Relaxation over the recordings of an organ.
#[derive(Debug, Serialize)]
struct OrganRelaxation {
    ratio: SpreadAnswer,
    settle_s: SpreadAnswer,
}

/// The answers of an organ to sines of one frequency.
#[derive(Debug, Serialize)]
struct OrganSinusoid {
    frequency_hz: f64,
    stiffness_n_per_m: SpreadAnswer,
    phase_rad: SpreadAnswer,
    hysteresis_j: SpreadAnswer,
}

impl Answer {
    /// Of what was analyzed.
    pub fn new(analyzed: &Analyzed) -> Self {
        let unusable = analyzed.unusable.iter().map(Unusable::sentence);
        let each = analyzed.recordings.iter();
        Self {
            palpate: VERSION,
            files: each
                .map(|(read, found)| FileAnswer::new(read, found))
                .collect(),
            organs: organs(&analyzed.groups, &analyzed.responses),
            unusable: analyzed.unusable.clone(),
            warnings: analyzed.doubts.iter().cloned().chain(unusable).collect(),
        }
    }
}

/// One for each organ and state; an organ without a hold has one too.
fn organs(groups: &[StaticGroup], responses: &[OrganResponse]) -> Vec<OrganAnswer> {
    let mut organs: Vec<OrganAnswer> = Vec::new();
    for response in responses {
        let own: Vec<_> = groups
            .iter()
            .filter(|group| group.organ == response.organ)
            .collect();
        if own.is_empty() {
            organs.push(OrganAnswer::new(None, response));
        }
        organs.extend(
            own.into_iter()
                .map(|group| OrganAnswer::new(Some(group), response)),
        );
    }
    organs
}

impl FileAnswer {
    fn new(read: &ReadRecording, found: &Analysis) -> Self {
        let header = &read.clean.header;
        let all: Vec<_> = found.sinusoids.iter().map(SinusoidAnswer::of).collect();
        let longest = found
            .sinusoids
            .iter()
            .max_by_key(|sine| sine.end - sine.first);
        Self {
            file: read.path.clone(),
            organ: header.organ.clone(),
            subject: header.subject.clone(),
            contact_time_s: read.clean.handling.contact.time_s,
            static_response: found.holds.iter().map(StaticAnswer::of_hold).collect(),
            relaxation: found.relaxation.as_ref().map(RelaxationAnswer::of),
            sinusoid: longest.map(SinusoidAnswer::of),
            sideways: read.sideways,
            sinusoids: if all.len() > 1 { all } else { Vec::new() },
            chirps: found.sweeps.iter().map(chirp).collect(),
        }
    }
}

impl OrganAnswer {
    fn new(group: Option<&StaticGroup>, response: &OrganResponse) -> Self {
        let rows = group.map_or(&[][..], |group| &group.rows);
        let relaxation = response.ratio.zip(response.settle_s);
        let of_row = |row: &palpate_characterize::analyze::FrequencyRow| OrganSinusoid {
            frequency_hz: row.frequency_hz,
            stiffness_n_per_m: SpreadAnswer::of(&row.stiffness_n_per_m),
            phase_rad: SpreadAnswer::of(&row.phase_rad),
            hysteresis_j: SpreadAnswer::of(&row.hysteresis_j),
        };
        Self {
            organ: response.organ.clone(),
            condition: group
                .and_then(|group| group.condition)
                .map(|state| state.word()),
            post_mortem_h: group.and_then(|group| group.post_mortem_h),
            static_response: rows.iter().map(StaticAnswer::of_row).collect(),
            relaxation: relaxation.map(|(ratio, settle_s)| OrganRelaxation {
                ratio: SpreadAnswer::of(&ratio),
                settle_s: SpreadAnswer::of(&settle_s),
            }),
            sinusoid: response.sinusoids.iter().map(of_row).collect(),
        }
    }
}

impl StaticAnswer {
    fn of_hold(hold: &Hold) -> Self {
        Self {
            depth_m: hold.depth_m,
            mean_n: hold.steady_n,
            min_n: hold.steady_n,
            max_n: hold.steady_n,
            n: 1,
            subjects: None,
            within_subject_n: None,
            between_subjects_n: None,
        }
    }

    fn of_row(row: &StaticRow) -> Self {
        Self {
            depth_m: row.depth_m,
            mean_n: row.mean_n,
            min_n: row.min_n,
            max_n: row.max_n,
            n: row.n,
            subjects: Some(row.subjects),
            within_subject_n: row.within_n,
            between_subjects_n: row.between_n,
        }
    }
}

impl RelaxationAnswer {
    fn of(found: &Relaxation) -> Self {
        Self {
            peak_n: found.peak_n,
            steady_n: found.steady_n,
            ratio: found.ratio,
            settle_s: found.settle_s,
            hold_s: found.hold_s,
        }
    }
}

impl SinusoidAnswer {
    fn of(found: &Sinusoid) -> Self {
        Self {
            frequency_hz: found.frequency_hz,
            stiffness_n_per_m: found.stiffness_n_per_m,
            stiffness_standard_error: found.stiffness_error_n_per_m,
            phase_rad: found.phase_rad,
            phase_standard_error: found.phase_error_rad,
            hysteresis_j: found.hysteresis_j,
            amplitude_m: found.amplitude_m,
            pre_indentation_m: found.depth_m,
            distortion: found.distortion,
            periods: found.periods,
        }
    }
}

impl SpreadAnswer {
    fn of(spread: &Spread) -> Self {
        Self {
            mean: spread.mean,
            min: spread.min,
            max: spread.max,
            n: spread.n,
        }
    }
}

fn chirp(sweep: &Sweep) -> Vec<ChirpPoint> {
    let each = sweep.points.iter().map(|point| ChirpPoint {
        frequency_hz: point.frequency_hz,
        stiffness_n_per_m: point.stiffness_n_per_m,
        phase_rad: point.phase_rad,
        coherence: point.coherence,
        is_coherent: point.is_coherent,
    });
    each.collect()
}
