//! The steady force over depth, over subjects: the source's table 5-1 and its figures 5-1 and 5-14.
//!
//! Holds are grouped by organ, condition, whole hours after death and depth. *Mean*, *least* and
//! *largest* are over all holds of a row. Where the animal of each hold is known, the spread is
//! given twice: *within* one animal, the deviation about each animal's own mean, and *between* animals,
//! the deviation of those means.
//!
//! *How we know*: `static_response::…`, with `published/table_5_1_static_force.csv`.
//!
//! *Limits*: depths within 5 % of one another count as one.

use palpate_files::recording::{Condition, RecordingHeader};

use super::Hold;

/// Depths that differ by less than this part are one [-].
const ALIKE: f64 = 0.05;

/// A steady force, and whose it is.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticPoint {
    /// The organ.
    pub organ: Option<String>,
    /// The state of the tissue.
    pub condition: Option<Condition>,
    /// Time since death [s].
    pub post_mortem_s: Option<f64>,
    /// The animal, person or body.
    pub subject: Option<String>,
    /// The depth [m].
    pub depth_m: f64,
    /// The force [N].
    pub steady_n: f64,
}

impl StaticPoint {
    /// The steady end of a `hold` of the recording with this `header`.
    pub fn of(header: &RecordingHeader, hold: &Hold) -> Self {
        Self {
            organ: header.organ.clone(),
            condition: header.condition,
            post_mortem_s: header.post_mortem_s,
            subject: header.subject.clone(),
            depth_m: hold.depth_m,
            steady_n: hold.steady_n,
        }
    }

    fn key(&self) -> (Option<&str>, Option<Condition>, Option<u64>) {
        let hours = self
            .post_mortem_s
            .map(|seconds| (seconds / 3600.0).floor() as u64);
        (self.organ.as_deref(), self.condition, hours)
    }
}

/// The static response of an organ in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticGroup {
    /// The organ.
    pub organ: Option<String>,
    /// The state of the tissue.
    pub condition: Option<Condition>,
    /// Whole hours since death [h].
    pub post_mortem_h: Option<u64>,
    /// By ascending depth.
    pub rows: Vec<StaticRow>,
}

/// The forces at one depth.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct StaticRow {
    /// Mean depth [m].
    pub depth_m: f64,
    /// Mean force over all holds [N].
    pub mean_n: f64,
    /// Least force [N].
    pub min_n: f64,
    /// Largest force [N].
    pub max_n: f64,
    /// How many holds there are.
    pub n: usize,
    /// How many subjects they are from; a recording without a subject counts as one of its own.
    pub subjects: usize,
    /// Standard deviation within one subject [N]; none when no subject was touched twice.
    #[serde(rename = "within_subject_n", skip_serializing_if = "Option::is_none")]
    pub within_n: Option<f64>,
    /// Standard deviation of the subjects' means [N]; none with one subject.
    #[serde(rename = "between_subjects_n", skip_serializing_if = "Option::is_none")]
    pub between_n: Option<f64>,
}

/// The static responses of all organs and states, in the order of their names.
pub fn static_response(points: &[StaticPoint]) -> Vec<StaticGroup> {
    let mut sorted: Vec<&StaticPoint> = points.iter().collect();
    sorted.sort_by(|a, b| {
        let by_depth = a.depth_m.total_cmp(&b.depth_m);
        a.key().cmp(&b.key()).then(by_depth)
    });
    let groups = sorted.chunk_by(|a, b| a.key() == b.key());
    groups
        .map(|group| StaticGroup {
            organ: group[0].organ.clone(),
            condition: group[0].condition,
            post_mortem_h: group[0].key().2,
            rows: rows(group),
        })
        .collect()
}

fn rows(group: &[&StaticPoint]) -> Vec<StaticRow> {
    let mut rows = Vec::new();
    let mut rest = group;
    while let Some(shallowest) = rest.first() {
        let deepest = shallowest.depth_m + ALIKE * shallowest.depth_m.abs();
        let (row, deeper) = rest.split_at(rest.partition_point(|point| point.depth_m <= deepest));
        rows.push(StaticRow::of(row));
        rest = deeper;
    }
    rows
}

impl StaticRow {
    fn of(row: &[&StaticPoint]) -> Self {
        let mut forces: Vec<(Option<&str>, f64)> = row
            .iter()
            .map(|point| (point.subject.as_deref(), point.steady_n))
            .collect();
        forces.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let subjects: Vec<Vec<f64>> = forces
            .chunk_by(|a, b| a.0.is_some() && a.0 == b.0)
            .map(|own| own.iter().map(|(_, force)| *force).collect())
            .collect();
        let means: Vec<f64> = subjects.iter().map(|own| mean(own)).collect();
        let within: f64 = subjects.iter().map(|own| squares(own)).sum();
        let repeats = row.len() - subjects.len();
        let all = row.iter().map(|point| point.steady_n);
        Self {
            depth_m: mean(&row.iter().map(|point| point.depth_m).collect::<Vec<_>>()),
            mean_n: mean(&all.clone().collect::<Vec<_>>()),
            min_n: all.clone().fold(f64::INFINITY, f64::min),
            max_n: all.fold(f64::NEG_INFINITY, f64::max),
            n: row.len(),
            subjects: subjects.len(),
            within_n: (repeats > 0).then(|| (within / repeats as f64).sqrt()),
            between_n: (means.len() > 1)
                .then(|| (squares(&means) / (means.len() - 1) as f64).sqrt()),
        }
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Sum of squares about the mean.
fn squares(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|value| (value - mean).powi(2)).sum()
}
