use palpate_characterize::Analysis;
use palpate_characterize::analyze::{
    OrganResponse, StaticGroup, StaticPoint, organ_responses, static_response,
};

use crate::command::recordings::{ReadRecording, Unusable};

/// What recordings show, one by one and together.
#[derive(Debug)]
pub(super) struct Analyzed<'a> {
    pub(super) recordings: Vec<(&'a ReadRecording, Analysis)>,
    pub(super) unusable: Vec<Unusable>,
    /// Every hold.
    pub(super) points: Vec<StaticPoint>,
    pub(super) groups: Vec<StaticGroup>,
    pub(super) responses: Vec<OrganResponse>,
    /// What deserves doubt, each with its file.
    pub(super) doubts: Vec<String>,
}

impl<'a> Analyzed<'a> {
    pub(super) fn of(
        recordings: Vec<(&'a ReadRecording, Analysis)>,
        unusable: Vec<Unusable>,
    ) -> Self {
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
        let doubts = recordings.iter().flat_map(|(read, analysis)| {
            let each = doubts_of(read, analysis);
            each.map(|doubt| format!("{}: {doubt}", read.path.display()))
        });
        Self {
            doubts: doubts.collect(),
            groups: static_response(&points),
            responses,
            points,
            unusable,
            recordings,
        }
    }
}

/// What deserves doubt about a recording, and about what it shows.
pub(super) fn doubts_of<'a>(
    read: &'a ReadRecording,
    analysis: &'a Analysis,
) -> impl Iterator<Item = &'a String> {
    read.clean.doubts.iter().chain(&analysis.doubts)
}
