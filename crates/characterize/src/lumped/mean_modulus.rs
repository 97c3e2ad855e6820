use palpate_files::recording::{IndenterShape, RecordingHeader, Specimen, StimulusKind};

use crate::analyze::{Hold, holds};
use crate::{CleanRecording, Error};

/// The end of an indenter, for a half-space of linear tissue without friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contact {
    /// A flat punch of this radius [m] (6.1).
    Flat(f64),
    /// A sphere of this radius [m], indented much less than that [Hertz 1881].
    Sphere(f64),
    /// A cone with this angle [rad] between its axis and its side [Sneddon 1965].
    Cone(f64),
}

impl Contact {
    /// The indenter of a recording.
    ///
    /// # Errors
    /// When the header does not say its radius, or its angle; an indenter of no stated shape is flat.
    pub fn of(header: &RecordingHeader) -> Result<Self, Error> {
        let known = |value: Option<f64>, key| value.ok_or(Error::Unknown { key });
        let radius = || known(header.indenter_radius_m, "indenter_radius_m");
        match header.indenter_shape.unwrap_or(IndenterShape::Flat) {
            IndenterShape::Flat => radius().map(Self::Flat),
            IndenterShape::Sphere => radius().map(Self::Sphere),
            IndenterShape::Cone => {
                let angle = known(header.indenter_half_angle_deg, "indenter_half_angle_deg")?;
                Ok(Self::Cone(angle.to_radians()))
            }
        }
    }

    /// The force [N] at `depth` [m] of a tissue with E/(1 − ν²) = 1 Pa.
    pub(super) fn unit_force(self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        match self {
            Self::Flat(radius) => 2.0 * radius * depth, // (6.1)
            Self::Sphere(radius) => 4.0 / 3.0 * radius.sqrt() * depth.powf(1.5),
            Self::Cone(angle) => 2.0 / std::f64::consts::PI * angle.tan() * depth * depth,
        }
    }

    /// The radius [m] of what touches at `depth` [m], in the same closed forms.
    pub(super) fn face_radius(self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        match self {
            Self::Flat(radius) => radius,
            Self::Sphere(radius) => (radius * depth).sqrt().min(radius),
            Self::Cone(angle) => 2.0 / std::f64::consts::PI * angle.tan() * depth,
        }
    }
}

/// Young's modulus [Pa] of incompressible tissue, ν = ½, from one `force` [N] at `depth` [m]: a secant.
///
/// # Errors
/// Without contact, or when the specimen is `hollow`, for which the half-space says nothing.
pub fn mean_modulus(contact: Contact, hollow: bool, depth: f64, force: f64) -> Result<f64, Error> {
    if hollow {
        return Err(Error::HollowOrgan);
    }
    let unit = contact.unit_force(depth);
    if unit > 0.0 && unit.is_finite() && force.is_finite() {
        return Ok(0.75 * force / unit);
    }
    Err(Error::NoContact {
        cause: "the depth is not above zero",
    })
}

/// The mean elastic modulus of a specimen (6.1), as table 6-1 has it.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MeanModulus {
    /// The mean over the holds at the largest depth [Pa].
    pub value: f64,
    /// Their standard deviation [Pa]: a spread, no error of the mean; none of one hold alone.
    pub standard_deviation: Option<f64>,
    /// Their mean depth [m].
    pub depth_m: f64,
    /// How many they are.
    pub holds: usize,
}

/// Depths that differ by less than this part are one [-].
const ALIKE: f64 = 0.05;

/// The mean elastic modulus of incompressible tissue from all `recordings` of a specimen: that of the steady
/// force, the mean of the last tenth of a hold, over all holds at the largest depth.
///
/// # Errors
/// When the specimen is hollow, there is no hold, or a header does not say what indenter it was.
pub fn mean_elastic_modulus(recordings: &[CleanRecording]) -> Result<MeanModulus, Error> {
    let mut all: Vec<(Contact, Hold)> = Vec::new();
    for recording in recordings {
        let header = &recording.header;
        if header.specimen == Some(Specimen::Tube) {
            return Err(Error::HollowOrgan);
        }
        if header.stimulus.is_some_and(StimulusKind::is_of_piece) {
            continue;
        }
        let contact = Contact::of(header)?;
        let found = holds(recording, &mut Vec::new());
        all.extend(found.into_iter().map(|hold| (contact, hold)));
    }
    let deepest = all.iter().map(|(_, hold)| hold.depth_m).fold(0.0, f64::max);
    all.retain(|(_, hold)| hold.depth_m > 0.0 && hold.depth_m >= (1.0 - ALIKE) * deepest);
    let moduli: Result<Vec<f64>, Error> = all
        .iter()
        .map(|(contact, hold)| mean_modulus(*contact, false, hold.depth_m, hold.steady_n))
        .collect();
    let moduli = moduli?;
    if moduli.is_empty() {
        return Err(Error::NoHold);
    }
    let count = moduli.len() as f64;
    let mean = moduli.iter().sum::<f64>() / count;
    let squares: f64 = moduli.iter().map(|modulus| (modulus - mean).powi(2)).sum();
    Ok(MeanModulus {
        value: mean,
        standard_deviation: (count > 1.0).then(|| (squares / (count - 1.0)).sqrt()),
        depth_m: all.iter().map(|(_, hold)| hold.depth_m).sum::<f64>() / count,
        holds: moduli.len(),
    })
}
