use std::ops::Range;

use nalgebra::Matrix3;
use palpate_files::Estimate;
use palpate_files::recording::StimulusKind;
use palpate_files::tissue::Elasticity;
use palpate_mechanics::finite_elements::uniaxial::nominal_stress;
use palpate_mechanics::{Exponential, Law, MooneyRivlin, NeoHookean, Ogden};

use super::column::ALPHAS;
use crate::fit::{
    Fit, Parameter, Settings, Uncertainty, correlated_uncertainty, least_squares, warnings,
};
use crate::fit::{misfit, missed};
use crate::inverse::SoughtLaw;
use crate::{CleanRecording, Error};

/// How a piece is deformed, evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PieceTest {
    /// Along one axis, its sides free.
    #[default]
    Uniaxial,
    /// Along one axis, one of its sides free and the other held as wide as it is: pure shear.
    PlanarTension,
}

/// A law that was found from a piece that is pressed or pulled.
#[derive(Debug, Clone, PartialEq)]
pub struct UniaxialFit {
    /// Which.
    pub law: SoughtLaw,
    /// How the piece was deformed.
    pub test: PieceTest,
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
        // A sheet is pulled, whichever sign its table gives that.
        let farthest = largest.map_or(0.0, |last| depths[last]);
        let is_turned = PieceTest::of(recording) == PieceTest::PlanarTension && farthest > 0.0;
        let sign = if is_turned { 1.0 } else { -1.0 };
        Ok(Self {
            stretches: depths[samples.clone()]
                .iter()
                .map(|d| 1.0 + sign * d / height)
                .collect(),
            stresses: forces.iter().map(|f| sign * f / area).collect(),
            samples,
        })
    }
}

impl PieceTest {
    /// That of a recording of a piece.
    pub fn of(recording: &CleanRecording) -> Self {
        match recording.header.stimulus {
            Some(StimulusKind::PlanarTension) => Self::PlanarTension,
            _ => Self::Uniaxial,
        }
    }

    /// Nominal stress [Pa] of an incompressible law at the `stretch` [-].
    fn stress(self, law: &dyn Law, stretch: f64) -> Result<f64, palpate_mechanics::Error> {
        if self == Self::Uniaxial {
            return nominal_stress(law, stretch);
        }
        let refused = palpate_mechanics::Error::StretchOutOfRange { stretch };
        if !(stretch > 0.0 && stretch.is_finite()) {
            return Err(refused);
        }
        // The pressure makes P₃₃ = 0: P₁₁ = (∂W/∂F)₁₁ − (∂W/∂F)₃₃/λ².
        let f = Matrix3::from_diagonal(&[stretch, 1.0, stretch.recip()].into());
        let stress = law.distortion_stress(&f);
        let found = stress[(0, 0)] - stress[(2, 2)] / (stretch * stretch);
        found.is_finite().then_some(found).ok_or(refused)
    }

    /// I₁ − 3 of the left Cauchy-Green tensor at the `stretch` [-].
    fn invariant(self, stretch: f64) -> f64 {
        let squared = stretch * stretch;
        match self {
            Self::Uniaxial => squared + 2.0 / stretch - 3.0,
            Self::PlanarTension => squared + 1.0 / squared - 2.0,
        }
    }
}

/// Where the exponent α is first looked for [-].
const STARTS: [f64; 5] = [0.003, 0.03, 0.3, 3.0, 30.0];
/// The same for the exponents of Ogden's law, and how large they may become.
const OGDEN_STARTS: [f64; 6] = [1.5, 4.0, 10.0, -1.5, -4.0, -10.0];
const OGDEN_ALPHA: f64 = 50.0;

impl UniaxialFit {
    /// Nominal stress [Pa] of the law at a `stretch` [-], deformed over undeformed length.
    ///
    /// # Errors
    /// Where the law has no stress: at no stretch above zero, or where an exponential overflows.
    pub fn nominal_stress(&self, stretch: f64) -> Result<f64, Error> {
        let values: Vec<f64> = self.fit.parameters.iter().map(|p| p.value).collect();
        Ok(piece_stress(self.law, self.test, &values, stretch)?)
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
    let measured = Measured {
        test: PieceTest::Uniaxial,
        stretches,
        stresses: nominal_stresses,
    };
    fitted(law, measured, &[samples])
}

/// The same from all `recordings` of pieces whose area and height are known, all in the test of the first, each from first
/// contact to its largest strain.
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
    let measured = Measured {
        test: recordings.first().map(PieceTest::of).unwrap_or_default(),
        stretches: &stretches,
        stresses: &stresses,
    };
    fitted(law, measured, &lengths)
}

/// What was measured of a piece.
#[derive(Debug, Clone, Copy)]
struct Measured<'a> {
    test: PieceTest,
    stretches: &'a [f64],
    /// [Pa]
    stresses: &'a [f64],
}

fn fitted(law: SoughtLaw, measured: Measured<'_>, lengths: &[usize]) -> Result<UniaxialFit, Error> {
    let mut said = Vec::new();
    let mut fit = nearest(law, measured, f64::NEG_INFINITY)?;
    if law == SoughtLaw::MooneyRivlin {
        let [c10, c01] = [0, 1].map(|place: usize| fit.parameters[place].value);
        if c10 + c01 <= 0.0 {
            fit = nearest(law, measured, 0.0)?;
            said.push(format!(
                "the nearest c10_pa and c01_pa, {c10:.4e} and {c01:.4e}, have no stiffness at rest; both were held above zero"
            ));
        }
    }
    if let SoughtLaw::Ogden(_) = law {
        let moduli = fit.parameters.iter().step_by(2).map(|own| own.value);
        let shear: f64 = moduli.sum();
        if shear <= 0.0 {
            fit = nearest(law, measured, 0.0)?;
            said.push(format!(
                "the nearest mu have the sum {shear:.4e}, which is no stiffness at rest; all were held above zero"
            ));
        }
    }
    if measured.test == PieceTest::PlanarTension && matches!(law, SoughtLaw::Ogden(_)) {
        said.push(
            "planar tension does not tell the sign of alpha, which is taken as above zero; a uniaxial test does"
                .to_owned(),
        );
    }
    let is_modulus = |own: &&Parameter| own.name.ends_with("_pa");
    let negative = fit.parameters.iter().filter(is_modulus);
    for own in negative.filter(|own| own.value < 0.0) {
        said.push(format!(
            "{} is negative: far from the stretches recorded the law may have no stiffness",
            own.name
        ));
    }
    let uncertainty = correlated_uncertainty(&fit, lengths);
    let largest = measured
        .stresses
        .iter()
        .fold(0.0, |most: f64, s| most.max(s.abs()));
    let misfit = misfit(&fit, largest);
    said.extend(warnings(&fit, &uncertainty, None));
    said.extend(missed(law.name().word(), "stress", misfit));
    let estimates: Vec<Estimate> = (0..fit.parameters.len())
        .map(|place| Estimate {
            value: fit.parameters[place].value,
            standard_error: uncertainty.standard_error(place),
        })
        .collect();
    let names = law.names().into_iter();
    Ok(UniaxialFit {
        law,
        test: measured.test,
        elasticity: law.elasticity(&estimates),
        parameters: names.zip(estimates).collect(),
        uncertainty,
        misfit,
        warnings: said,
        fit,
    })
}

/// The fit with the least Σ ε² and no modulus below `least` [Pa], of all that the starts lead to.
fn nearest(law: SoughtLaw, measured: Measured<'_>, least: f64) -> Result<Fit, Error> {
    let Measured {
        test,
        stretches,
        stresses,
    } = measured;
    let samples = stretches.len().min(stresses.len());
    let mut best: Option<Fit> = None;
    for parameters in starts(law, measured, least)? {
        let fit = least_squares(
            &parameters,
            samples,
            &Settings::default(),
            |p, residuals| {
                for (residual, (&stretch, known)) in
                    residuals.iter_mut().zip(stretches.iter().zip(stresses))
                {
                    *residual = piece_stress(law, test, p, stretch).ok()? - known;
                }
                Some(())
            },
        )?;
        let is_better = |best: &Fit| fit.sum_of_squares() < best.sum_of_squares();
        if best.as_ref().is_none_or(is_better) {
            best = Some(fit);
        }
    }
    best.ok_or(Error::NothingFelt)
}

/// Where fits start: stress is linear in the moduli, which are found for each of a few exponents, and the best of each
/// sign of the exponents is taken.
fn starts(
    law: SoughtLaw,
    measured: Measured<'_>,
    least: f64,
) -> Result<Vec<Vec<Parameter>>, Error> {
    let test = measured.test;
    let mut best: Vec<([bool; 3], f64, Vec<f64>)> = Vec::new();
    // In planar tension an exponent does as much as its opposite.
    let least_alpha = match test {
        PieceTest::Uniaxial => -OGDEN_ALPHA,
        PieceTest::PlanarTension => 0.0,
    };
    let is_sought = |shape: &Vec<f64>| {
        let mut exponents = shape.iter().step_by(2);
        !matches!(law, SoughtLaw::Ogden(_)) || exponents.all(|alpha| *alpha >= least_alpha)
    };
    for shape in shapes(law).into_iter().filter(is_sought) {
        let unit: Vec<f64> = law
            .parameters(1.0, &shape)
            .iter()
            .map(|p| p.value)
            .collect();
        let (mut products, mut squares) = (0.0, 0.0);
        for (&stretch, known) in measured.stretches.iter().zip(measured.stresses) {
            let own = piece_stress(law, test, &unit, stretch).unwrap_or(f64::INFINITY);
            products += own * known;
            squares += own * own;
        }
        let (modulus, gained) = (products / squares, products * products / squares);
        if !(modulus > 0.0 && modulus.is_finite()) {
            continue;
        }
        let values = law
            .parameters(modulus, &shape)
            .iter()
            .map(|p| p.value)
            .collect();
        // Of Ogden's law the exponents are every second number.
        let signs = [0, 2, 4].map(|place| shape.get(place).is_some_and(|alpha| *alpha < 0.0));
        match best.iter_mut().find(|own| own.0 == signs) {
            Some(own) if own.1 >= gained => {}
            Some(own) => *own = (signs, gained, values),
            None => best.push((signs, gained, values)),
        }
    }
    if best.is_empty() {
        return Err(Error::NothingFelt);
    }
    let bounded = |(name, value): (&'static str, f64)| {
        let parameter = Parameter::new(name, value);
        match name {
            "alpha" => parameter.within(ALPHAS[0], ALPHAS[2]),
            name if name.starts_with("alpha_") => parameter.within(least_alpha, OGDEN_ALPHA),
            // The law has no stiffness at rest without it.
            "c10_pa" if matches!(law, SoughtLaw::ReducedPolynomial(_)) => {
                parameter.within(least.max(0.0), f64::INFINITY)
            }
            _ => parameter.within(least, f64::INFINITY),
        }
    };
    let all = best.into_iter().map(|(_, _, values)| {
        let named = law.names().into_iter().zip(values);
        named.map(bounded).collect()
    });
    Ok(all.collect())
}

/// Shapes from which fits may start.
fn shapes(law: SoughtLaw) -> Vec<Vec<f64>> {
    match law {
        SoughtLaw::NeoHookean => vec![Vec::new()],
        SoughtLaw::MooneyRivlin => vec![vec![0.5]],
        SoughtLaw::Exponential => STARTS.map(|alpha| vec![alpha]).to_vec(),
        SoughtLaw::ReducedPolynomial(_) => vec![vec![0.0; law.count() - 1]],
        SoughtLaw::Ogden(terms) => {
            // Exponents in the order of the starts, so that terms do not change places.
            let mut all: Vec<Vec<f64>> = OGDEN_STARTS.map(|alpha| vec![alpha]).to_vec();
            for _ in 1..terms.count() {
                let more = all.iter().flat_map(|own| {
                    let after = OGDEN_STARTS
                        .iter()
                        .skip_while(|alpha| own.last() != Some(alpha));
                    after
                        .skip(1)
                        .map(|alpha| [&own[..], &[0.3, *alpha]].concat())
                });
                all = more.collect();
            }
            all
        }
    }
}

/// Nominal stress [Pa] of a law with the parameters `p` in a `test`, also where they are none of a tissue: it is linear in
/// all but exponents.
///
/// # Errors
/// At a stretch where the law has no stress.
pub fn piece_stress(
    law: SoughtLaw,
    test: PieceTest,
    p: &[f64],
    stretch: f64,
) -> Result<f64, palpate_mechanics::Error> {
    let of = |law: &dyn Law| test.stress(law, stretch);
    match law {
        SoughtLaw::NeoHookean => Ok(p[0] * of(&NeoHookean::incompressible(1.0)?)?),
        SoughtLaw::MooneyRivlin => {
            let first = of(&MooneyRivlin::incompressible(1.0, 0.0)?)?;
            let second = of(&MooneyRivlin::incompressible(0.0, 1.0)?)?;
            Ok(p[0] * first + p[1] * second)
        }
        SoughtLaw::Exponential => Ok(p[0] * of(&Exponential::incompressible(1.0, p[1])?)?),
        SoughtLaw::Ogden(_) => {
            let terms = p.as_chunks().0.iter();
            let each =
                terms.map(|&[mu, alpha]| Ok(mu * of(&Ogden::incompressible(&[[1.0, alpha]])?)?));
            each.sum()
        }
        SoughtLaw::ReducedPolynomial(_) => {
            // The stress of neo-Hookean tissue times Σ k C_k0 (I₁ − 3)^(k−1).
            let first = of(&NeoHookean::incompressible(1.0)?)?;
            let invariant = test.invariant(stretch);
            let each = (1..).zip(p);
            let slope = each.map(|(k, c)| f64::from(k) * c * invariant.powi(k - 1));
            Ok(first * slope.sum::<f64>())
        }
    }
}
