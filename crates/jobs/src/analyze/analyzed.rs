use palpate_characterize::Analysis;
use palpate_characterize::analyze::{
    OrganResponse, StaticGroup, StaticPoint, organ_responses, static_response,
};

use crate::{ReadRecording, Unusable};

/// Results of an analysis, for each recording and pooled; serialized as `--json` prints it.
#[derive(Debug)]
pub struct Analyzed {
    /// Each recording with its results.
    pub recordings: Vec<(ReadRecording, Analysis)>,
    /// Recordings that cannot be used, with the reason.
    pub unusable: Vec<Unusable>,
    /// Every hold.
    pub points: Vec<StaticPoint>,
    /// Steady forces by organ and state.
    pub groups: Vec<StaticGroup>,
    /// Relaxation and sines by organ.
    pub responses: Vec<OrganResponse>,
    /// Warnings, each with its file.
    pub warnings: Vec<String>,
}

impl Analyzed {
    pub(crate) fn of(recordings: Vec<(ReadRecording, Analysis)>, unusable: Vec<Unusable>) -> Self {
        let points: Vec<StaticPoint> = recordings
            .iter()
            .flat_map(|(read, analysis)| {
                let header = &read.clean.header;
                let holds = analysis.holds.iter();
                holds.map(|hold| StaticPoint::of(header, hold))
            })
            .collect();
        let own: Vec<_> = recordings
            .iter()
            .map(|(read, analysis)| (&read.clean.header, analysis))
            .collect();
        let responses = organ_responses(&own);
        let warnings = recordings.iter().flat_map(|(read, analysis)| {
            let each = warnings_of(read, analysis);
            each.map(|warning| format!("{}: {warning}", read.path.display()))
        });
        Self {
            warnings: warnings.collect(),
            groups: static_response(&points),
            responses,
            points,
            unusable,
            recordings,
        }
    }

    /// Each organ with its steady forces in each state; an organ without a hold has none.
    pub fn organs(&self) -> Vec<(Option<&StaticGroup>, &OrganResponse)> {
        let mut organs = Vec::new();
        for response in &self.responses {
            let groups = self.groups.iter();
            let own = groups.filter(|group| group.organ == response.organ);
            let before = organs.len();
            organs.extend(own.map(|group| (Some(group), response)));
            if organs.len() == before {
                organs.push((None, response));
            }
        }
        organs
    }

    /// Warnings, including the recordings that cannot be used.
    pub fn warnings(&self) -> Vec<String> {
        let unusable = self.unusable.iter().map(Unusable::sentence);
        self.warnings.iter().cloned().chain(unusable).collect()
    }
}

/// Warnings about a recording and its results.
pub fn warnings_of<'a>(
    read: &'a ReadRecording,
    analysis: &'a Analysis,
) -> impl Iterator<Item = &'a String> {
    read.clean.warnings.iter().chain(&analysis.warnings)
}
