//! The machine-readable form of [`Analyzed`].

use std::path::PathBuf;

use palpate_characterize::Analysis;
use palpate_characterize::analyze::{
    FrequencyRow, Hold, OrganResponse, Relaxation, Sinusoid, Spread, StaticGroup, StaticRow, Sweep,
};
use serde::{Serialize, Serializer};

use super::analyzed::Analyzed;
use crate::{LateralLoad, ReadRecording, Unusable, VERSION};

#[derive(Serialize)]
struct Answer<'a> {
    palpate: &'static str,
    files: Vec<FileAnswer<'a>>,
    organs: Vec<OrganAnswer<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    unusable: &'a [Unusable],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// Results of one recording.
#[derive(Serialize)]
struct FileAnswer<'a> {
    #[serde(serialize_with = "crate::lossy")]
    file: &'a PathBuf,
    organ: Option<&'a str>,
    subject: Option<&'a str>,
    /// First contact, in the recording's own time [s].
    contact_time_s: f64,
    #[serde(rename = "static")]
    static_response: Vec<HoldAnswer>,
    /// Of the longest hold.
    relaxation: Option<&'a Relaxation>,
    /// The longest sine.
    sinusoid: Option<&'a Sinusoid>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sideways: Option<LateralLoad>,
    /// All sines, where there are several.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    sinusoids: &'a [Sinusoid],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    chirps: &'a [Sweep],
}

/// A hold in the form of a row over several holds.
#[derive(Serialize)]
struct HoldAnswer {
    depth_m: f64,
    mean_n: f64,
    min_n: f64,
    max_n: f64,
    n: usize,
}

/// Results pooled over the recordings of an organ.
#[derive(Serialize)]
struct OrganAnswer<'a> {
    organ: Option<&'a str>,
    condition: Option<&'static str>,
    post_mortem_h: Option<u64>,
    #[serde(rename = "static")]
    static_response: &'a [StaticRow],
    relaxation: Option<OrganRelaxation>,
    sinusoid: &'a [FrequencyRow],
}

#[derive(Serialize)]
struct OrganRelaxation {
    ratio: Spread,
    settle_s: Spread,
}

impl Serialize for Analyzed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let organs = self.organs().into_iter();
        let answer = Answer {
            palpate: VERSION,
            files: self.recordings.iter().map(FileAnswer::of).collect(),
            organs: organs.map(OrganAnswer::of).collect(),
            unusable: &self.unusable,
            warnings: self.warnings(),
        };
        answer.serialize(serializer)
    }
}

impl<'a> FileAnswer<'a> {
    fn of((read, found): &'a (ReadRecording, Analysis)) -> Self {
        let header = &read.clean.header;
        let several = found.sinusoids.len() > 1;
        Self {
            file: &read.path,
            organ: header.organ.as_deref(),
            subject: header.subject.as_deref(),
            contact_time_s: read.clean.handling.contact.time_s,
            static_response: found.holds.iter().map(HoldAnswer::of).collect(),
            relaxation: found.relaxation.as_ref(),
            sinusoid: found.longest_sine(),
            sideways: read.lateral_load,
            sinusoids: if several { &found.sinusoids } else { &[] },
            chirps: &found.sweeps,
        }
    }
}

impl HoldAnswer {
    fn of(hold: &Hold) -> Self {
        Self {
            depth_m: hold.depth_m,
            mean_n: hold.steady_n,
            min_n: hold.steady_n,
            max_n: hold.steady_n,
            n: 1,
        }
    }
}

impl<'a> OrganAnswer<'a> {
    fn of((group, response): (Option<&'a StaticGroup>, &'a OrganResponse)) -> Self {
        let relaxation = response.ratio.zip(response.settle_s);
        Self {
            organ: response.organ.as_deref(),
            condition: group
                .and_then(|group| group.condition)
                .map(|state| state.word()),
            post_mortem_h: group.and_then(|group| group.post_mortem_h),
            static_response: group.map_or(&[], |group| &group.rows),
            relaxation: relaxation.map(|(ratio, settle_s)| OrganRelaxation { ratio, settle_s }),
            sinusoid: &response.sinusoids,
        }
    }
}
