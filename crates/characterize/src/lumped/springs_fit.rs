use nalgebra::DMatrix;
use palpate_files::Estimate;
use palpate_files::tissue::NonlinearSprings;

use super::springs::{OF_BRANCH, STATIC, respond};
use crate::Error;
use crate::fit::{
    Fit, Parameter, Settings, Uncertainty, correlated_uncertainty, least_squares_with_jacobian,
    simplest, warnings,
};
use crate::fit::{misfit, missed};
use crate::inverse::Indentation;

/// The springs of (6.4) that were found, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringsFit {
    /// The parameters, with their standard errors; of a second spring that is not worth it all are zero.
    pub springs: NonlinearSprings,
    /// How many springs relax: one or two, the one with the larger force first.
    pub branches: usize,
    /// What each number of them comes to: their number, Σ ε² [N²] and the information criterion [-].
    pub tried: Vec<(usize, f64, f64)>,
    /// The fit of the parameters, in the order of their names.
    pub fit: Fit,
    /// How well they are known.
    pub uncertainty: Uncertainty,
    /// The part of the force that the springs do not follow: its root mean square over the largest [-].
    pub misfit: f64,
    /// Warnings, in plain sentences.
    pub warnings: Vec<String>,
}

/// Names of the parameters, in their order.
const NAMES: [&str; 8] = NonlinearSprings::NAMES;
/// Exponents that are sought for the static spring and for those that relax [-]: below one, the stiffness of
/// a spring at rest would have no bound.
const EXPONENTS: [[f64; 2]; 2] = [[0.5, 6.0], [1.0, 6.0]];
/// The exponent that fits start from [-].
const EXPONENT: f64 = 1.5;
/// Times in which a spring gives way at first, where fits start, in lengths of the recording [-].
const TIMES: [f64; 3] = [0.01, 0.05, 0.3];
/// Relative change of the parameters below which a fit has arrived [-]: far less than they are known.
const TOLERANCE: f64 = 1e-8;

/// The springs of (6.4) that come nearest to all `indentations` at once.
///
/// # Errors
/// When there is no depth or no force, or the samples are fewer than the parameters.
pub fn fit_springs(indentations: &[Indentation<'_>]) -> Result<SpringsFit, Error> {
    let sizes = StartingSizes::of(indentations)?;
    let one = best(indentations, &sizes.starts(None))?;
    let two = best(indentations, &sizes.starts(Some(&one)))?;
    let lengths: Vec<usize> = indentations.iter().map(|each| each.time.len()).collect();
    // What the richer leaves is noise, so both are compared as if that noise had been seen.
    let samples = correlated_uncertainty(&two, &lengths).effective_samples;
    let (chosen, criteria) = simplest(&[&one, &two], samples);
    let tried = vec![
        (1, one.sum_of_squares(), criteria[0]),
        (2, two.sum_of_squares(), criteria[1]),
    ];
    let branches = chosen + 1;
    let mut fit = if branches == 2 { two } else { one };
    stronger_first(&mut fit, sizes.depth);
    let uncertainty = correlated_uncertainty(&fit, &lengths);
    let misfit = misfit(&fit, sizes.peak);
    let mut said = warnings(&fit, &uncertainty, None);
    said.extend(missed("the system of nonlinear springs", "force", misfit));
    Ok(SpringsFit {
        springs: described(&fit, &uncertainty),
        branches,
        tried,
        uncertainty,
        misfit,
        warnings: said,
        fit,
    })
}

/// Sizes that fits start from.
struct StartingSizes {
    /// The largest depth [mm].
    depth: f64,
    /// The largest force [N].
    peak: f64,
    /// The force that is left at the end of the deepest recording [N].
    left: f64,
    /// The length of the longest recording [s].
    duration: f64,
}

impl StartingSizes {
    fn of(indentations: &[Indentation<'_>]) -> Result<Self, Error> {
        let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let deepest = indentations
            .iter()
            .max_by(|a, b| most(a.depth).total_cmp(&most(b.depth)));
        let deepest = deepest.ok_or(Error::NoContactForce)?;
        let duration = |each: &Indentation<'_>| match each.time {
            [first, .., last] => last - first,
            _ => 0.0,
        };
        let sizes = Self {
            depth: 1e3 * most(deepest.depth),
            peak: most(deepest.force),
            left: deepest.force.last().copied().unwrap_or(0.0),
            duration: indentations.iter().map(duration).fold(0.0, f64::max),
        };
        if sizes.depth > 0.0 && sizes.peak > 0.0 && sizes.duration > 0.0 {
            Ok(sizes)
        } else {
            Err(Error::NoContactForce)
        }
    }

    /// Starting values: with one relaxing spring, or with a second in addition to the result `one`.
    fn starts(&self, one: Option<&Fit>) -> Vec<Vec<Parameter>> {
        let start = |time: &f64| match one {
            None => [self.at_rest(), self.branch(0, *time)].concat(),
            Some(one) => [one.parameters.clone(), self.branch(1, *time)].concat(),
        };
        TIMES.iter().map(start).collect()
    }

    fn at_rest(&self) -> Vec<Parameter> {
        let left = self.left.clamp(0.1 * self.peak, self.peak);
        let [lower, upper] = EXPONENTS[0];
        vec![
            factor(NAMES[0], left / self.depth.powf(EXPONENT)),
            Parameter::new(NAMES[1], EXPONENT).within(lower, upper),
        ]
    }

    fn branch(&self, place: usize, time: f64) -> Vec<Parameter> {
        let names = &NAMES[STATIC + place * OF_BRANCH..];
        let lost = (self.peak - self.left).clamp(0.05 * self.peak, self.peak);
        let [lower, upper] = EXPONENTS[1];
        let rate = self.depth.powf(1.0 - EXPONENT) / (time * self.duration);
        vec![
            factor(names[0], rate),
            Parameter::new(names[1], EXPONENT).within(lower, upper),
            factor(names[2], 0.5 * lost / self.depth.powf(EXPONENT)),
        ]
    }
}

fn factor(name: &str, value: f64) -> Parameter {
    Parameter::new(name, value).within(0.0, f64::INFINITY)
}

fn best(indentations: &[Indentation<'_>], starts: &[Vec<Parameter>]) -> Result<Fit, Error> {
    let mut best: Result<Fit, Error> = Err(Error::NoContactForce);
    for parameters in starts {
        let found = fitted(indentations, parameters);
        best = match (best, found) {
            (Ok(best), Ok(found)) if best.sum_of_squares() <= found.sum_of_squares() => Ok(best),
            (Ok(best), Err(_)) => Ok(best),
            (_, found) => found,
        };
    }
    best
}

fn fitted(indentations: &[Indentation<'_>], parameters: &[Parameter]) -> Result<Fit, Error> {
    let samples = indentations.iter().map(|each| each.time.len()).sum();
    let settings = Settings {
        tolerance: TOLERANCE,
        ..Settings::default()
    };
    let evaluate = |values: &[f64], residuals: &mut [f64], jacobian: &mut DMatrix<f64>| {
        let mut start = 0;
        for each in indentations {
            for (row, force) in each.force.iter().enumerate() {
                residuals[start + row] = -force;
            }
            respond(values, each.time, each.depth, &mut |row, first, share| {
                residuals[start + row] += share.force;
                let count = if first == 0 { STATIC } else { OF_BRANCH };
                for (place, change) in share.by.iter().take(count).enumerate() {
                    jacobian[(start + row, first + place)] = *change;
                }
            })?;
            start += each.force.len();
        }
        Some(())
    };
    least_squares_with_jacobian(parameters, samples, &settings, evaluate)
}

/// Of two relaxing springs the one that would be the stronger at `depth` [mm] comes first.
fn stronger_first(fit: &mut Fit, depth: f64) {
    let places = [STATIC, STATIC + OF_BRANCH];
    if fit.parameters.len() < places[1] + OF_BRANCH {
        return;
    }
    let strength = |first: usize| {
        let [exponent, factor] = [1, 2].map(|i| fit.parameters[first + i].value);
        factor * depth.powf(exponent)
    };
    if strength(places[0]) >= strength(places[1]) {
        return;
    }
    for [a, b] in (0..OF_BRANCH).map(|i| places.map(|first| first + i)) {
        fit.parameters.swap(a, b);
        fit.jacobian.swap_columns(a, b);
    }
    for (parameter, name) in fit.parameters.iter_mut().zip(NAMES) {
        name.clone_into(&mut parameter.name);
    }
}

fn described(fit: &Fit, uncertainty: &Uncertainty) -> NonlinearSprings {
    let of = |place: usize| match fit.parameters.get(place) {
        Some(parameter) => Estimate {
            value: parameter.value,
            standard_error: uncertainty.standard_error(place),
        },
        None => Estimate::exactly(0.0),
    };
    NonlinearSprings::of(std::array::from_fn(of))
}
