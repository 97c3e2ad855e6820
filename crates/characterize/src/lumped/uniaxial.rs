use palpate_files::Estimate;
use palpate_files::tissue::Elasticity;

use super::column::ALPHAS;
use super::fibres::{self, KnownFibres};
use super::piece::{Measured, PieceLoading, PieceTest, piece_stress};
use crate::fit::{
    Fit, Parameter, Settings, Uncertainty, correlated_uncertainty, least_squares, warnings,
};
use crate::fit::{misfit, missed};
use crate::inverse::CandidateLaw;
use crate::{CleanRecording, Error};

/// A law that was found from a piece that is pressed or pulled.
#[derive(Debug, Clone, PartialEq)]
pub struct UniaxialFit {
    /// The law that was sought.
    pub law: CandidateLaw,
    /// How each piece was loaded.
    pub loadings: Vec<PieceLoading>,
    /// The law as files hold it.
    pub elasticity: Elasticity,
    /// Its parameters in the order of its keys, each with its name and its standard error.
    pub parameters: Vec<(&'static str, Estimate)>,
    /// The fit, in the same parameters; its residuals are nominal stresses [Pa].
    pub fit: Fit,
    /// How well they are known.
    pub uncertainty: Uncertainty,
    /// Parameters that have no error, because these tests do not determine them, whatever the fit says.
    pub undetermined: Vec<&'static str>,
    /// The part of the stress that the law does not follow: its root mean square over the largest [-].
    pub misfit: f64,
    /// Warnings, in plain sentences.
    pub warnings: Vec<String>,
}

/// Where the exponent α is first looked for [-].
const STARTS: [f64; 5] = [0.003, 0.03, 0.3, 3.0, 30.0];
/// The same for the exponents of Ogden's law, and how large they may become.
const OGDEN_STARTS: [f64; 6] = [1.5, 4.0, 10.0, -1.5, -4.0, -10.0];
const OGDEN_ALPHA: f64 = 50.0;

impl UniaxialFit {
    /// Nominal stress [Pa] of the law at a `stretch` or amount of shear [-] of the first piece.
    ///
    /// # Errors
    /// Where the law has no stress: at no stretch above zero, or where an exponential overflows.
    pub fn nominal_stress(&self, stretch: f64) -> Result<f64, Error> {
        let values: Vec<f64> = self.fit.parameters.iter().map(|p| p.value).collect();
        let loading = self.loadings.first().copied().unwrap_or_default();
        piece_stress(self.law, loading, &values, stretch)
    }
}

/// The `law` that comes nearest to `nominal_stresses` [Pa] at `stretches` [-], deformed over undeformed length.
///
/// # Errors
/// When there are fewer samples than parameters, or no stress that grows with the stretch.
pub fn fit_uniaxial(
    law: CandidateLaw,
    stretches: &[f64],
    nominal_stresses: &[f64],
) -> Result<UniaxialFit, Error> {
    let samples = stretches.len().min(nominal_stresses.len());
    let piece = Measured {
        loading: PieceTest::Uniaxial.into(),
        stretches: stretches[..samples].to_vec(),
        stresses: nominal_stresses[..samples].to_vec(),
    };
    fitted(law, &[piece], KnownFibres::default())
}

/// The same from all `recordings` of pieces whose area and height are known, each in its own test, from first contact to its
/// largest strain.
///
/// # Errors
/// As [`fit_uniaxial`], when a recording does not say area or height, or for a law with fibres not how they lie.
pub fn fit_uniaxial_recordings(
    law: CandidateLaw,
    recordings: &[CleanRecording],
) -> Result<UniaxialFit, Error> {
    let pieces: Result<Vec<_>, Error> = recordings.iter().map(Measured::of).collect();
    let first = recordings.first().map(|own| KnownFibres::of(&own.header));
    fitted(law, &pieces?, first.unwrap_or_default())
}

fn fitted(
    law: CandidateLaw,
    pieces: &[Measured],
    known: KnownFibres,
) -> Result<UniaxialFit, Error> {
    let mut said = Vec::new();
    let mut undetermined = Vec::new();
    let mut fit = match law {
        CandidateLaw::HolzapfelGasserOgden => {
            let found = fibres::fitted(pieces, known)?;
            said.extend(found.warnings);
            undetermined = found.undetermined;
            found.fit
        }
        _ => nearest(law, pieces, f64::NEG_INFINITY)?,
    };
    if law == CandidateLaw::MooneyRivlin {
        let [c10, c01] = [0, 1].map(|place: usize| fit.parameters[place].value);
        if c10 + c01 <= 0.0 {
            fit = nearest(law, pieces, 0.0)?;
            said.push(format!(
                "the nearest c10_pa and c01_pa, {c10:.4e} and {c01:.4e}, have no stiffness at rest; both were held above zero"
            ));
        }
    }
    if let CandidateLaw::Ogden(_) = law {
        let moduli = fit.parameters.iter().step_by(2).map(|own| own.value);
        let shear: f64 = moduli.sum();
        if shear <= 0.0 {
            fit = nearest(law, pieces, 0.0)?;
            said.push(format!(
                "the nearest mu have the sum {shear:.4e}, which is no stiffness at rest; all were held above zero"
            ));
        }
    }
    if is_plane(pieces) && matches!(law, CandidateLaw::Ogden(_)) {
        said.push(
            "planar tension and simple shear do not tell the sign of alpha, which is taken as above zero; a uniaxial test does"
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
    let lengths: Vec<usize> = pieces.iter().map(|own| own.stresses.len()).collect();
    let uncertainty = match law {
        CandidateLaw::HolzapfelGasserOgden => {
            let all = correlated_uncertainty(&fibres::with_all_free(&fit), &lengths);
            all.among(|place| !fit.parameters[place].at_bound())
        }
        _ => correlated_uncertainty(&fit, &lengths),
    };
    let stresses = pieces.iter().flat_map(|own| &own.stresses);
    let largest = stresses.fold(0.0, |most: f64, s| most.max(s.abs()));
    let misfit = misfit(&fit, largest);
    said.extend(warnings(&fit, &uncertainty, None));
    said.extend(missed(law.name().word(), "stress", misfit));
    let names = law.names().into_iter();
    let each = names.clone().zip(&fit.parameters).enumerate();
    let estimates: Vec<Estimate> = each
        .map(|(place, (name, parameter))| Estimate {
            value: parameter.value,
            standard_error: uncertainty
                .standard_error(place)
                .filter(|_| !undetermined.contains(&name)),
        })
        .collect();
    Ok(UniaxialFit {
        law,
        loadings: pieces.iter().map(|own| own.loading).collect(),
        elasticity: law.elasticity(&estimates),
        parameters: names.zip(estimates).collect(),
        uncertainty,
        undetermined,
        misfit,
        warnings: said,
        fit,
    })
}

/// Whether all pieces are in plane strain, where an exponent does as much as its opposite.
fn is_plane(pieces: &[Measured]) -> bool {
    let mut each = pieces.iter();
    each.all(|own| own.loading.test != PieceTest::Uniaxial)
}

/// The fit of an isotropic law with the least Σ ε² and no modulus below `least` [Pa], of all that the starts lead to.
fn nearest(law: CandidateLaw, pieces: &[Measured], least: f64) -> Result<Fit, Error> {
    let samples = pieces.iter().map(|own| own.stresses.len()).sum();
    let mut best: Option<Fit> = None;
    for parameters in starts(law, pieces, least)? {
        let fit = least_squares(
            &parameters,
            samples,
            &Settings::default(),
            |p, residuals| {
                for (residual, (loading, stretch, known)) in
                    residuals.iter_mut().zip(each_sample(pieces))
                {
                    *residual = piece_stress(law, loading, p, stretch).ok()? - known;
                }
                Some(())
            },
        )?;
        let is_better = |best: &Fit| fit.sum_of_squares() < best.sum_of_squares();
        if best.as_ref().is_none_or(is_better) {
            best = Some(fit);
        }
    }
    best.ok_or(Error::NoContactForce)
}

fn each_sample(pieces: &[Measured]) -> impl Iterator<Item = (PieceLoading, f64, f64)> + '_ {
    let each = pieces.iter();
    each.flat_map(|own| own.samples().map(|(x, stress)| (own.loading, x, stress)))
}

/// Where fits start: stress is linear in the moduli, which are found for each of a few exponents, and the best of each
/// sign of the exponents is taken.
fn starts(
    law: CandidateLaw,
    pieces: &[Measured],
    least: f64,
) -> Result<Vec<Vec<Parameter>>, Error> {
    let mut best: Vec<([bool; 3], f64, Vec<f64>)> = Vec::new();
    let least_alpha = if is_plane(pieces) { 0.0 } else { -OGDEN_ALPHA };
    let is_sought = |shape: &Vec<f64>| {
        let mut exponents = shape.iter().step_by(2);
        !matches!(law, CandidateLaw::Ogden(_)) || exponents.all(|alpha| *alpha >= least_alpha)
    };
    for shape in shapes(law).into_iter().filter(is_sought) {
        let unit: Vec<f64> = law
            .parameters(1.0, &shape)
            .iter()
            .map(|p| p.value)
            .collect();
        let (mut products, mut squares) = (0.0, 0.0);
        for (loading, stretch, known) in each_sample(pieces) {
            let own = piece_stress(law, loading, &unit, stretch).unwrap_or(f64::INFINITY);
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
        return Err(Error::NoContactForce);
    }
    let bounded = |(name, value): (&'static str, f64)| {
        let parameter = Parameter::new(name, value);
        match name {
            "alpha" => parameter.within(ALPHAS[0], ALPHAS[2]),
            name if name.starts_with("alpha_") => parameter.within(least_alpha, OGDEN_ALPHA),
            // The law has no stiffness at rest without it.
            "c10_pa" if matches!(law, CandidateLaw::ReducedPolynomial(_)) => {
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
fn shapes(law: CandidateLaw) -> Vec<Vec<f64>> {
    match law {
        CandidateLaw::NeoHookean => vec![Vec::new()],
        CandidateLaw::MooneyRivlin => vec![vec![0.5]],
        CandidateLaw::Exponential => STARTS.map(|alpha| vec![alpha]).to_vec(),
        CandidateLaw::ReducedPolynomial(_) => vec![vec![0.0; law.count() - 1]],
        CandidateLaw::HolzapfelGasserOgden => vec![law.start()],
        CandidateLaw::Ogden(terms) => {
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
