//! Relaxation and swings of several recordings of one organ, as in the source's figure 5-16.

use palpate_files::recording::RecordingHeader;

use super::{Analysis, Sinusoid};

/// Frequencies that differ by less than this part are one [-].
const ALIKE: f64 = 0.05;

/// Mean and range of a number over recordings, in the number's unit.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The least.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// How many there are.
    pub n: usize,
}

/// What the recordings of an organ show.
#[derive(Debug, Clone, PartialEq)]
pub struct OrganResponse {
    /// The organ.
    pub organ: Option<String>,
    /// Steady over peak force [-]; none without a hold.
    pub ratio: Option<Spread>,
    /// When the force had settled [s], from first contact; none without a hold.
    pub settle_s: Option<Spread>,
    /// The answers to sines, by ascending frequency.
    pub sinusoids: Vec<FrequencyRow>,
}

/// The answers to sines of one frequency.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FrequencyRow {
    /// Mean frequency [Hz].
    pub frequency_hz: f64,
    /// Amplitude of the force over that of the depth [N/m].
    pub stiffness_n_per_m: Spread,
    /// Phase of the force before that of the depth [rad].
    pub phase_rad: Spread,
    /// Energy lost in a period [J].
    pub hysteresis_j: Spread,
}

impl Spread {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let n = values.clone().count();
        (n > 0).then(|| Self {
            mean: values.clone().sum::<f64>() / n as f64,
            min: values.clone().fold(f64::INFINITY, f64::min),
            max: values.fold(f64::NEG_INFINITY, f64::max),
            n,
        })
    }
}

/// The responses of all organs, in the order of their names.
pub fn organ_responses(recordings: &[(&RecordingHeader, &Analysis)]) -> Vec<OrganResponse> {
    let mut sorted = recordings.to_vec();
    sorted.sort_by(|a, b| a.0.organ.cmp(&b.0.organ));
    let organs = sorted.chunk_by(|a, b| a.0.organ == b.0.organ);
    organs
        .map(|own| {
            let relaxations = own.iter().filter_map(|(_, analysis)| analysis.relaxation);
            let sinusoids = own.iter().flat_map(|(_, analysis)| &analysis.sinusoids);
            OrganResponse {
                organ: own[0].0.organ.clone(),
                ratio: Spread::of(relaxations.clone().map(|relaxation| relaxation.ratio)),
                settle_s: Spread::of(relaxations.map(|relaxation| relaxation.settle_s)),
                sinusoids: frequency_rows(sinusoids.copied().collect()),
            }
        })
        .collect()
}

fn frequency_rows(mut sinusoids: Vec<Sinusoid>) -> Vec<FrequencyRow> {
    sinusoids.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    let mut rows = Vec::new();
    let mut rest = sinusoids.as_slice();
    while let Some(slowest) = rest.first() {
        let fastest = (1.0 + ALIKE) * slowest.frequency_hz;
        let (row, faster) = rest.split_at(rest.partition_point(|own| own.frequency_hz <= fastest));
        let spread = |number: fn(&Sinusoid) -> f64| {
            Spread::of(row.iter().map(number)).expect("the slowest is in the row")
        };
        rows.push(FrequencyRow {
            frequency_hz: spread(|own| own.frequency_hz).mean,
            stiffness_n_per_m: spread(|own| own.stiffness_n_per_m),
            phase_rad: spread(|own| own.phase_rad),
            hysteresis_j: spread(|own| own.hysteresis_j),
        });
        rest = faster;
    }
    rows
}
