use std::ops::Range;

use palpate_files::Estimate;
use palpate_files::tissue::Elasticity;
use palpate_mechanics::finite_elements::uniaxial::nominal_stress;
use palpate_mechanics::{Exponential, Law, MooneyRivlin, NeoHookean};

use super::column::ALPHAS;
use crate::fit::{
    Fit, Parameter, Settings, Uncertainty, correlated_uncertainty, least_squares, warnings,
};
use crate::fit::{misfit, missed};
use crate::inverse::SoughtLaw;
use crate::{CleanRecording, Error};

/// A law that was found from a piece that is pressed or pulled along one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct UniaxialFit {
    /// Which.
    pub law: SoughtLaw,
    /// The law as files hold it.
    pub elasticity: Elasticity,
    /// Its parameters in the order of its keys, each with its name and its standard error.
    pub parameters: Vec<(&'static str, Estimate)>,
    /// The fit, in the same parameters; its residuals are nominal stresses [Pa].
    pub fit: Fit,
    /// How well they are known.
    pub uncertainty: Uncertainty,
    /// The part of the stress that the law does not follow: its root mean square over the largest [-].
    pub misfit: f64,
    /// Warnings, in plain sentences.
    pub warnings: Vec<String>,
}

/// What of a recording of a piece is fitted: from first contact to its largest strain.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulled {
    /// The samples.
    pub samples: Range<usize>,
    /// Their stretches [-], deformed over undeformed length.
    pub stretches: Vec<f64>,
    /// Their nominal stresses [Pa], above zero in tension.
    pub stresses: Vec<f64>,
}

impl Pulled {
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
        Ok(Self {
            stretches: depths[samples.clone()]
                .iter()
                .map(|d| 1.0 - d / height)
                .collect(),
            stresses: forces.iter().map(|f| -f / area).collect(),
            samples,
        })
    }
}

/// Where the exponent α is first looked for [-].
const STARTS: [f64; 5] = [0.003, 0.03, 0.3, 3.0, 30.0];

impl UniaxialFit {
    /// Nominal stress [Pa] of the law at a `stretch` [-], deformed over undeformed length.
    ///
    /// # Errors
    /// Where the law has no stress: at no stretch above zero, or where an exponential overflows.
    pub fn nominal_stress(&self, stretch: f64) -> Result<f64, Error> {
        let values: Vec<f64> = self.fit.parameters.iter().map(|p| p.value).collect();
        Ok(uniaxial_stress(self.law, &values, stretch)?)
    }
}

/// The `law` that comes nearest to `nominal_stresses` [Pa] at `stretches` [-], deformed over undeformed length.
///
/// # Errors
/// When there are fewer samples than parameters, or no stress that grows with the stretch.
pub fn fit_uniaxial(
    law: SoughtLaw,
    stretches: &[f64],
    nominal_stresses: &[f64],
) -> Result<UniaxialFit, Error> {
    let samples = stretches.len().min(nominal_stresses.len());
    fitted(law, stretches, nominal_stresses, &[samples])
}

/// The same from all `recordings` of pieces whose area and height are known, each from first contact to its
/// largest strain.
///
/// # Errors
/// As [`fit_uniaxial`], and when a recording does not say area or height.
pub fn fit_uniaxial_recordings(
    law: SoughtLaw,
    recordings: &[CleanRecording],
) -> Result<UniaxialFit, Error> {
    let (mut stretches, mut stresses, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
    for recording in recordings {
        let own = Pulled::of(recording)?;
        lengths.push(own.samples.len());
        stretches.extend(own.stretches);
        stresses.extend(own.stresses);
    }
    fitted(law, &stretches, &stresses, &lengths)
}

fn fitted(
    law: SoughtLaw,
    stretches: &[f64],
    stresses: &[f64],
    lengths: &[usize],
) -> Result<UniaxialFit, Error> {
    let mut said = Vec::new();
    let mut fit = nearest(law, stretches, stresses, f64::NEG_INFINITY)?;
    if law == SoughtLaw::MooneyRivlin {
        let [c10, c01] = [0, 1].map(|place: usize| fit.parameters[place].value);
        if c10 + c01 <= 0.0 {
            fit = nearest(law, stretches, stresses, 0.0)?;
            said.push(format!(
                "the nearest c10_pa and c01_pa, {c10:.4e} and {c01:.4e}, have no stiffness at rest; both were held above zero"
            ));
        } else if c10.min(c01) < 0.0 {
            let negative = if c10 < c01 { "c10_pa" } else { "c01_pa" };
            said.push(format!(
                "{negative} is negative: far from the stretches recorded the law has no stiffness"
            ));
        }
    }
    let uncertainty = correlated_uncertainty(&fit, lengths);
    let largest = stresses.iter().fold(0.0, |most: f64, s| most.max(s.abs()));
    let misfit = misfit(&fit, largest);
    said.extend(warnings(&fit, &uncertainty, None));
    said.extend(missed(law.name().word(), "stress", misfit));
    let estimates: Vec<Estimate> = (0..fit.parameters.len())
        .map(|place| Estimate {
            value: fit.parameters[place].value,
            standard_error: uncertainty.standard_error(place),
        })
        .collect();
    let names = law.parameters(1.0, 0.0).into_iter().map(|p| p.name);
    Ok(UniaxialFit {
        law,
        elasticity: law.elasticity(&estimates),
        parameters: names.zip(estimates).collect(),
        uncertainty,
        misfit,
        warnings: said,
        fit,
    })
}

/// The fit with the least Σ ε² and no modulus below `least` [Pa].
fn nearest(law: SoughtLaw, stretches: &[f64], stresses: &[f64], least: f64) -> Result<Fit, Error> {
    let samples = stretches.len().min(stresses.len());
    let parameters = start(law, stretches, stresses, least)?;
    least_squares(
        &parameters,
        samples,
        &Settings::default(),
        |p, residuals| {
            for (residual, (&stretch, known)) in
                residuals.iter_mut().zip(stretches.iter().zip(stresses))
            {
                *residual = uniaxial_stress(law, p, stretch).ok()? - known;
            }
            Some(())
        },
    )
}

/// Where a fit starts. Stress is linear in the modulus, which is found for each of a few shapes.
fn start(
    law: SoughtLaw,
    stretches: &[f64],
    stresses: &[f64],
    least: f64,
) -> Result<Vec<Parameter>, Error> {
    let shapes = match law {
        SoughtLaw::Exponential => &STARTS[..],
        SoughtLaw::NeoHookean | SoughtLaw::MooneyRivlin => &[0.5],
    };
    let mut best: Option<(f64, Vec<f64>)> = None;
    for &shape in shapes {
        let unit: Vec<f64> = law.parameters(1.0, shape).iter().map(|p| p.value).collect();
        let (mut products, mut squares) = (0.0, 0.0);
        for (&stretch, known) in stretches.iter().zip(stresses) {
            let own = uniaxial_stress(law, &unit, stretch).unwrap_or(f64::INFINITY);
            products += own * known;
            squares += own * own;
        }
        let (modulus, gained) = (products / squares, products * products / squares);
        if modulus > 0.0 && best.as_ref().is_none_or(|(most, _)| gained > *most) {
            let values = law.parameters(modulus, shape);
            best = Some((gained, values.iter().map(|p| p.value).collect()));
        }
    }
    let (_, values) = best.ok_or(Error::NothingFelt)?;
    let named = values.iter().zip(law.parameters(1.0, 0.0));
    Ok(named
        .map(|(&value, own)| match own.name {
            "alpha" => Parameter::new(own.name, value).within(ALPHAS[0], ALPHAS[2]),
            _ => Parameter::new(own.name, value).within(least, f64::INFINITY),
        })
        .collect())
}

/// Nominal stress [Pa] of a law with these parameters, also where they are none of a tissue: it is linear in
/// all but α.
///
/// # Errors
/// At a stretch where the law has no stress.
pub fn uniaxial_stress(
    law: SoughtLaw,
    p: &[f64],
    stretch: f64,
) -> Result<f64, palpate_mechanics::Error> {
    let of = |law: &dyn Law| nominal_stress(law, stretch);
    match law {
        SoughtLaw::NeoHookean => Ok(p[0] * of(&NeoHookean::incompressible(1.0)?)?),
        SoughtLaw::MooneyRivlin => {
            let first = of(&MooneyRivlin::incompressible(1.0, 0.0)?)?;
            let second = of(&MooneyRivlin::incompressible(0.0, 1.0)?)?;
            Ok(p[0] * first + p[1] * second)
        }
        SoughtLaw::Exponential => Ok(p[0] * of(&Exponential::incompressible(1.0, p[1])?)?),
    }
}
