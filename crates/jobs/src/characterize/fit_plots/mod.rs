//! Plot data of a specimen: curves of few points, and the iterations of its fits. It is stored with the answer, so
//! that a report can be made later.

mod of_laws;
mod of_recordings;

pub(crate) use of_recordings::all_samples;

use palpate_characterize::inverse::CandidateLaw;
use palpate_characterize::lumped::PieceTest;
use palpate_files::quantity::quantity;
use palpate_files::recording::RecordingHeader;
use serde::{Deserialize, Serialize};

use super::finished::Studied;

/// Probability of the bands [-].
pub const LEVEL: f64 = 0.95;

/// Plot data of one specimen.
#[derive(Debug, Serialize, Deserialize)]
pub struct FitPlots {
    /// Facts on specimen and indenter from the headers: names and values.
    pub facts: Vec<(String, String)>,
    /// Of the specimen.
    pub recordings: Vec<DrawnRecording>,
    /// The fitted laws.
    pub laws: Vec<DrawnLaw>,
    /// The fitted relaxation.
    pub relaxation: Option<DrawnSeries>,
}

/// One recording.
#[derive(Debug, Serialize, Deserialize)]
pub struct DrawnRecording {
    /// Its file, as named by the user.
    pub file: String,
    /// SHA-256 of the file.
    pub digest: String,
    /// How many.
    pub samples: usize,
    /// [Hz]
    pub rate_hz: f64,
    /// Cut-off of the filter [Hz].
    pub cutoff_hz: Option<f64>,
    /// First contact, as the recording counts time [s] and depth [m], and the depth's standard error [m].
    pub contact: (f64, f64, Option<f64>),
    /// Segments of the stimulus, each from and to [s].
    pub segments: Vec<(String, [f64; 2])>,
    /// Times [s] from first contact.
    pub time: Vec<f64>,
    /// Depths [m].
    pub depth: Vec<f64>,
    /// Forces [N].
    pub force: Vec<f64>,
    /// The same after the filter [N].
    pub filtered_force: Vec<f64>,
    /// The fit.
    pub fitted: Option<DrawnFit>,
}

/// The fit of a recording, next to the measured values.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DrawnFit {
    /// Times [s] from first contact.
    pub time: Vec<f64>,
    /// Depths [m]; of a piece, stretches or amounts of shear [-].
    pub course: Vec<f64>,
    /// Forces [N]; of a piece, nominal stresses [Pa].
    pub measured: Vec<f64>,
    /// Whether it is of a piece.
    pub is_piece: bool,
    /// How the piece was deformed; none of an indentation.
    #[serde(default)]
    pub test: Option<PieceTest>,
    /// The angle of its loading to the axis of its fibres [degrees]; none where it is not stated.
    #[serde(default)]
    pub fibre_axis_angle_deg: Option<f64>,
    /// The fitted laws.
    pub laws: Vec<DrawnCurve>,
    /// The fitted relaxation.
    pub relaxation: Option<DrawnRelaxation>,
}

/// The curve of a law.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DrawnCurve {
    /// By its key in the answer.
    pub law: String,
    /// In the unit of the measured values.
    pub values: Vec<f64>,
    /// Half width of the band of [`LEVEL`].
    pub reach: Vec<f64>,
}

/// Forces over the instantaneous elastic force at the largest depth [-].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DrawnRelaxation {
    /// Measured.
    pub measured: Vec<f64>,
    /// Fitted.
    pub fitted: Vec<f64>,
    /// Times [s] from first contact, and values if ramps are treated as steps.
    pub of_step: Vec<(f64, f64)>,
}

/// G(t)/G(0) [-] at times [s] after a step, evenly on a logarithm.
#[derive(Debug, Serialize, Deserialize)]
pub struct DrawnSeries {
    /// Times [s] and values.
    pub points: Vec<(f64, f64)>,
}

/// The iterations of the fit of a law.
#[derive(Debug, Serialize, Deserialize)]
pub struct DrawnLaw {
    /// By its key in the answer.
    pub law: String,
    /// Its parameters, by their keys.
    pub names: Vec<String>,
    /// Their values after each step of the fit, the first being the start.
    pub iterations: Vec<Vec<f64>>,
    /// Σ ε² after each step.
    pub sums_of_squares: Vec<f64>,
}

impl FitPlots {
    /// The fit of each recording, with its file, at the drawn samples.
    pub(crate) fn fitted(&self) -> Vec<(String, DrawnFit)> {
        let each = self.recordings.iter();
        each.filter_map(|own| Some((own.file.clone(), own.fitted.clone()?)))
            .collect()
    }

    pub(crate) fn of(studied: &Studied) -> Self {
        let recordings = of_recordings::drawn(studied);
        let longest = recordings.iter().filter_map(|own| own.time.last().copied());
        let longest = longest.fold(0.0, f64::max);
        let shortest = recordings.iter().map(|own| 0.5 / own.rate_hz);
        let shortest = shortest.fold(f64::INFINITY, f64::min);
        let relaxation = studied.found.relaxation.as_ref().ok();
        Self {
            facts: shared_facts(studied),
            recordings,
            laws: of_laws::drawn(&studied.found),
            relaxation: relaxation
                .filter(|_| 0.0 < shortest && shortest < longest)
                .map(|found| DrawnSeries {
                    points: spread(shortest, longest)
                        .map(|time| (time, found.series.relaxation(time)))
                        .collect(),
                }),
        }
    }
}

/// Times [s] evenly on a logarithm.
fn spread(from: f64, to: f64) -> impl Iterator<Item = f64> {
    const POINTS: u32 = 160;
    (0..=POINTS).map(move |i| from * (to / from).powf(f64::from(i) / f64::from(POINTS)))
}

/// The key of a law in the answer.
fn key(law: CandidateLaw) -> String {
    law.name().word().to_owned()
}

/// Facts on which the headers of all recordings agree.
fn shared_facts(studied: &Studied) -> Vec<(String, String)> {
    let mut each = studied.recordings.iter().map(|own| facts(&own.header));
    let mut shared = each.next().unwrap_or_default();
    each.for_each(|own| shared.retain(|fact| own.contains(fact)));
    shared
}

/// Facts on specimen and indenter in a header.
fn facts(header: &RecordingHeader) -> Vec<(String, String)> {
    let length = |of: Option<f64>| of.map(|m| quantity("_m", m, None));
    let degrees = |angle: Option<f64>| angle.map(|angle| format!("{angle}°"));
    let entries = [
        (
            "condition",
            header.condition.map(|own| own.word().replace('_', " ")),
        ),
        (
            "time after death",
            header.post_mortem_s.map(|s| format!("{:.1} h", s / 3600.0)),
        ),
        (
            "stimulus",
            header.stimulus.map(|own| own.word().replace('_', " ")),
        ),
        (
            "indenter",
            header.indenter_shape.map(|own| own.word().to_owned()),
        ),
        ("radius of the indenter", length(header.indenter_radius_m)),
        ("half angle", degrees(header.indenter_half_angle_deg)),
        (
            "area",
            header.area_m2.map(|area| quantity("_m2", area, None)),
        ),
        ("height", length(header.height_m)),
        (
            "angle of the fibres' axis",
            degrees(header.fibre_axis_angle_deg),
        ),
        ("angle of the fibres", degrees(header.fibre_angle_deg)),
        (
            "dispersion",
            header.dispersion.map(|own| format!("{own:.4}")),
        ),
        ("inner radius", length(header.inner_radius_m)),
        ("outer radius", length(header.outer_radius_m)),
        ("length", length(header.length_m)),
        (
            "pressure",
            header.pressure_pa.map(|pressure| format!("{pressure} Pa")),
        ),
        ("made by", header.source.clone()),
    ];
    let known = entries.into_iter();
    known
        .filter_map(|(name, value)| Some((name.to_owned(), value?)))
        .collect()
}
