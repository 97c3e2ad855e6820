use std::ops::Range;

use nalgebra::Matrix3;
use palpate_files::recording::{RecordingHeader, StimulusKind};
use palpate_mechanics::finite_elements::homogeneous::{Homogeneous, deformed};
use palpate_mechanics::finite_elements::uniaxial::nominal_stress;
use palpate_mechanics::{
    Exponential, FibreFrame, Law, MooneyRivlin, NeoHookean, Ogden, Vec3, law_named,
};

use crate::inverse::CandidateLaw;
use crate::{CleanRecording, Error};

/// How a piece is deformed, evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PieceTest {
    /// Along one axis, its sides free.
    #[default]
    Uniaxial,
    /// Along one axis, one of its sides free and the other of fixed width: pure shear.
    PlanarTension,
    /// One face moves along itself, parallel to the opposite one.
    SimpleShear,
}

/// How a piece is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PieceLoading {
    /// How it is deformed.
    pub test: PieceTest,
    /// Angle from the direction of loading to the reference axis of its fibres [degrees], where it is stated.
    pub fibre_axis_angle_deg: Option<f64>,
}

/// Measured stretches and stresses of a piece.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    pub(super) loading: PieceLoading,
    /// Or amounts of shear [-].
    pub(super) stretches: Vec<f64>,
    /// [Pa]
    pub(super) stresses: Vec<f64>,
}

impl Measured {
    pub(super) fn of(recording: &CleanRecording) -> Result<Self, Error> {
        let FittedPiece {
            stretches,
            stresses,
            ..
        } = FittedPiece::of(recording)?;
        Ok(Self {
            loading: PieceLoading::of(&recording.header),
            stretches,
            stresses,
        })
    }

    /// Stretches or amounts of shear, each with its stress.
    pub(super) fn samples(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let each = self.stretches.iter().zip(&self.stresses);
        each.map(|(stretch, stress)| (*stretch, *stress))
    }
}

/// The fitted part of a recording of a piece: from first contact to its largest strain.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedPiece {
    /// The samples.
    pub samples: Range<usize>,
    /// Their stretches [-], deformed over undeformed length; in simple shear, their amounts of shear.
    pub stretches: Vec<f64>,
    /// Their nominal stresses [Pa], above zero in tension.
    pub stresses: Vec<f64>,
}

impl FittedPiece {
    /// # Errors
    /// When the recording does not say area or height.
    pub fn of(recording: &CleanRecording) -> Result<Self, Error> {
        let known = |value: Option<f64>, key| value.ok_or(Error::Unknown { key });
        let area = known(recording.header.area_m2, "area_m2")?;
        let height = known(recording.header.height_m, "height_m")?;
        let first = recording.time.partition_point(|t| *t < 0.0);
        let depths = &recording.depth;
        let largest =
            (first..depths.len()).max_by(|&a, &b| depths[a].abs().total_cmp(&depths[b].abs()));
        let samples = first..largest.map_or(first, |last| last + 1);
        let forces = &recording.force[samples.clone()];
        // What is clamped is pulled, or sheared forward, whichever sign its table gives that.
        let farthest = largest.map_or(0.0, |last| depths[last]);
        let stimulus = recording.header.stimulus;
        let is_clamped = stimulus.is_some_and(StimulusKind::is_clamped);
        let sign = if is_clamped && farthest > 0.0 {
            1.0
        } else {
            -1.0
        };
        let rest = match stimulus {
            Some(StimulusKind::SimpleShear) => 0.0,
            _ => 1.0,
        };
        Ok(Self {
            stretches: depths[samples.clone()]
                .iter()
                .map(|d| rest + sign * d / height)
                .collect(),
            stresses: forces.iter().map(|f| sign * f / area).collect(),
            samples,
        })
    }
}

impl PieceLoading {
    /// The loading in the header of a recording of a piece.
    pub fn of(header: &RecordingHeader) -> Self {
        Self {
            test: match header.stimulus {
                Some(StimulusKind::PlanarTension) => PieceTest::PlanarTension,
                Some(StimulusKind::SimpleShear) => PieceTest::SimpleShear,
                _ => PieceTest::Uniaxial,
            },
            fibre_axis_angle_deg: header.fibre_axis_angle_deg,
        }
    }

    /// Directions of the fibres where the piece is pulled along x, or sheared along x in planes normal to y.
    ///
    /// # Errors
    /// When they are not stated.
    pub(super) fn frame(&self) -> Result<FibreFrame, Error> {
        let key = "fibre_axis_angle_deg";
        let angle = self.fibre_axis_angle_deg.ok_or(Error::Unknown { key })?;
        let (sin, cos) = angle.to_radians().sin_cos();
        let frame = FibreFrame::new(&Vec3::new(cos, sin, 0.0), &Vec3::new(-sin, cos, 0.0));
        Ok(frame.unwrap_or(FibreFrame::ALONG_AXES))
    }
}

impl From<PieceTest> for PieceLoading {
    fn from(test: PieceTest) -> Self {
        Self {
            test,
            fibre_axis_angle_deg: None,
        }
    }
}

impl From<PieceTest> for Homogeneous {
    fn from(test: PieceTest) -> Self {
        match test {
            PieceTest::Uniaxial => Self::Uniaxial,
            PieceTest::PlanarTension => Self::PlanarTension,
            PieceTest::SimpleShear => Self::SimpleShear,
        }
    }
}

impl PieceTest {
    /// Nominal stress [Pa] of an isotropic incompressible law at the `stretch` or amount of shear [-].
    fn stress(self, law: &dyn Law, stretch: f64) -> Result<f64, palpate_mechanics::Error> {
        if self == Self::Uniaxial {
            return nominal_stress(law, stretch);
        }
        let refused = palpate_mechanics::Error::StretchOutOfRange { stretch };
        let is_sound = stretch.is_finite() && (stretch > 0.0 || self == Self::SimpleShear);
        if !is_sound {
            return Err(refused);
        }
        let found = match self {
            Self::SimpleShear => {
                let f = Matrix3::identity() + stretch * Vec3::x() * Vec3::y().transpose();
                // The pressure has no part in it.
                law.distortion_stress(&f)[(0, 1)]
            }
            _ => {
                // The pressure makes P₃₃ = 0: P₁₁ = (∂W/∂F)₁₁ − (∂W/∂F)₃₃/λ².
                let f = Matrix3::from_diagonal(&[stretch, 1.0, stretch.recip()].into());
                let stress = law.distortion_stress(&f);
                stress[(0, 0)] - stress[(2, 2)] / (stretch * stretch)
            }
        };
        found.is_finite().then_some(found).ok_or(refused)
    }

    /// I₁ − 3 of the left Cauchy-Green tensor at the `stretch` or amount of shear [-].
    fn invariant(self, stretch: f64) -> f64 {
        let squared = stretch * stretch;
        match self {
            Self::Uniaxial => squared + 2.0 / stretch - 3.0,
            Self::PlanarTension => squared + 1.0 / squared - 2.0,
            Self::SimpleShear => squared,
        }
    }
}

/// Nominal stress [Pa] of a law with the parameters `p` at a stretch or an amount of shear [-]. It is linear in all but
/// exponents, so that those of an isotropic law need not be those of a tissue.
///
/// # Errors
/// Where the law has no stress, and of a law with fibres when their direction is not stated.
pub fn piece_stress(
    law: CandidateLaw,
    loading: impl Into<PieceLoading>,
    p: &[f64],
    stretch: f64,
) -> Result<f64, Error> {
    let loading = loading.into();
    let test = loading.test;
    let of = |law: &dyn Law| test.stress(law, stretch);
    match law {
        CandidateLaw::NeoHookean => Ok(p[0] * of(&NeoHookean::incompressible(1.0)?)?),
        CandidateLaw::MooneyRivlin => {
            let first = of(&MooneyRivlin::incompressible(1.0, 0.0)?)?;
            let second = of(&MooneyRivlin::incompressible(0.0, 1.0)?)?;
            Ok(p[0] * first + p[1] * second)
        }
        CandidateLaw::Exponential => Ok(p[0] * of(&Exponential::incompressible(1.0, p[1])?)?),
        CandidateLaw::Ogden(_) => {
            let terms = p.as_chunks().0.iter();
            let each =
                terms.map(|&[mu, alpha]| Ok(mu * of(&Ogden::incompressible(&[[1.0, alpha]])?)?));
            each.sum()
        }
        CandidateLaw::ReducedPolynomial(_) => {
            // The stress of neo-Hookean tissue times Σ k C_k0 (I₁ − 3)^(k−1).
            let first = of(&NeoHookean::incompressible(1.0)?)?;
            let invariant = test.invariant(stretch);
            let each = (1..).zip(p);
            let slope = each.map(|(k, c)| f64::from(k) * c * invariant.powi(k - 1));
            Ok(first * slope.sum::<f64>())
        }
        CandidateLaw::HolzapfelGasserOgden => {
            let law = law_named(law.name(), p)?;
            let law = law.in_frame(&loading.frame()?).unwrap_or(law);
            Ok(deformed(law.as_ref(), test.into(), stretch, None)?.nominal_stress)
        }
    }
}
