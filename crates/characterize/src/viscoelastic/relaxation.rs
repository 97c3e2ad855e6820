use nalgebra::DMatrix;
use palpate_files::Estimate;
use palpate_files::quantity::plain_quantity;
use palpate_mechanics::PronySeries;

use super::model::{Model, RelaxationRecord, terms};
use super::product_form::ProductForm;
use crate::Error;
use crate::fit::{
    Expected, Fit, HARDLY_KNOWN, Parameter, Settings, Uncertainty, correlated_uncertainty,
    least_squares_with_jacobian, simplest, student_quantile, with_systematic,
};
use crate::inverse::Correlations;

/// What may be chosen about a relaxation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RelaxationSettings {
    /// How many terms it has; the information criterion chooses from one to four when none is said.
    pub terms: Option<usize>,
}

/// How a tissue relaxes.
#[derive(Debug, Clone, PartialEq)]
pub struct Relaxation {
    /// The relaxation function.
    pub series: PronySeries,
    /// Its gᵢ [-] and τᵢ [s] with their errors.
    pub terms: Vec<[Estimate; 2]>,
    /// The same as a product (6.10).
    pub product: ProductForm,
    /// The exponent μ by which the elastic force grows faster with depth than was assumed [-].
    pub exponent: Estimate,
    /// The instantaneous elastic force at the largest depth of each course, relative to the largest force of all
    /// [-].
    pub sizes: Vec<f64>,
    /// Σ ε² of the forces relative to the largest [-].
    pub sum_of_squares: f64,
    /// What each number of terms comes to: their number, Σ ε² and the information criterion [-].
    pub tried: Vec<(usize, f64, f64)>,
    /// The fit; its parameters are μ, the ratios and logarithms of times, the sizes.
    pub fit: Fit,
    /// Covariance of the parameters of the fit, in their order.
    pub covariance: DMatrix<f64>,
    /// The t [-] of intervals of each gᵢ and τᵢ that hold the truth with a probability of 95 %.
    pub quantiles: Vec<[f64; 2]>,
    /// That of μ [-].
    pub exponent_quantile: f64,
    /// Forces of the fit relative to the largest [-], course by course.
    pub forces: Vec<Vec<f64>>,
}

/// Part of what relaxes by which a body with internal variables relaxes otherwise than the product of an
/// elastic force and G(t) says [-]: found at a depth of four radii and ν = 0.49
/// (`specimen::a_law_is_found_from_a_viscoelastic_run`).
pub(crate) const QUASI_LINEAR: f64 = 0.02;
/// Most terms that are tried.
const MAX_TERMS: usize = 4;
/// A root mean square of ε below which there is nothing left to fit [-]: elastic force is known no better.
const NEGLIGIBLE: f64 = 3e-4;
/// Part of Σ ε² that one more term must gain for yet another to be tried [-].
const NOTHING_GAINED: f64 = 1e-3;
/// Samples that must lie where the depth changes for the exponent to be sought.
const RAMP: usize = 8;
/// The exponents that are sought.
const EXPONENTS: [f64; 2] = [-0.9, 3.0];
/// A term of more than this ratio would leave nothing after relaxation.
const LARGEST_RATIO: f64 = 1e3;
/// Times are sought up to this many lengths of the recording.
const LONGEST: f64 = 10.0;
/// Relative change of the parameters below which a fit has arrived [-].
const TOLERANCE: f64 = 1e-7;

impl Relaxation {
    /// What each gᵢ [-] and τᵢ [s] may be off because force is taken for an elastic one times G(t): a part of its error.
    pub fn quasi_linear_errors(&self) -> Vec<[f64; 2]> {
        let off = quasi_linear(self.terms.iter().map(|[g, _]| g.value).sum());
        let of_term = |term: &[Estimate; 2]| term.map(|known| off * known.value);
        self.terms.iter().map(of_term).collect()
    }

    /// Correlations of its gᵢ and τᵢ.
    pub fn correlations(&self) -> Correlations {
        let count = self.terms.len();
        let values: Vec<f64> = self.fit.parameters.iter().map(|p| p.value).collect();
        let mut pairs: Vec<_> = terms(&values, count).into_iter().enumerate().collect();
        pairs.sort_by(|(_, a), (_, b)| a.1.total_cmp(&b.1));
        let left = 1.0 - pairs.iter().map(|(_, (g, _))| g).sum::<f64>();
        // gᵢ = ρᵢ/(1 + Σ ρ); the fit has ln τ.
        let mut by = DMatrix::zeros(2 * count, values.len());
        for (row, &(place, (g, tau))) in pairs.iter().enumerate() {
            for other in 0..count {
                let own = if other == place { 1.0 } else { 0.0 };
                by[(2 * row, 1 + 2 * other)] = left * (own - g);
            }
            by[(2 * row + 1, 2 + 2 * place)] = tau;
        }
        let names = (1..=count).flat_map(|i| [format!("g_{i}"), format!("tau_{i}_s")]);
        let mut covariance = &by * &self.covariance * by.transpose();
        for (place, off) in self.quasi_linear_errors().into_iter().flatten().enumerate() {
            covariance[(place, place)] += even(off);
        }
        Correlations::of(names.collect(), &covariance)
    }

    /// Warnings about it, after recordings of `duration` [s].
    pub fn warnings(&self, duration: f64) -> Vec<String> {
        let mut said = Vec::new();
        for (place, [g, tau]) in (1..).zip(&self.terms) {
            let unsure = |estimate: &Estimate| {
                estimate
                    .standard_error
                    .is_some_and(|error| error > HARDLY_KNOWN * estimate.value)
            };
            if tau.value > duration {
                said.push(format!(
                    "tau_{place} is longer than the recording shows: {} in a recording of {}",
                    plain_quantity("_s", tau.value, None),
                    plain_quantity("_s", duration, None)
                ));
            } else if unsure(g) || unsure(tau) {
                said.push(format!(
                    "term {place} of the relaxation is hardly known: g {}, tau {}",
                    plain_quantity("", g.value, g.standard_error),
                    plain_quantity("_s", tau.value, tau.standard_error)
                ));
            }
        }
        said
    }
}

/// The variance of what lies evenly between −`bound` and `bound`.
pub(crate) fn even(bound: f64) -> f64 {
    bound * bound / 3.0
}

/// See [`Relaxation::quasi_linear_errors`]; relative, where all gᵢ are `total` [-].
pub(crate) fn quasi_linear(total: f64) -> f64 {
    QUASI_LINEAR * (1.0 - total)
}

/// The relaxation that is nearest to all `courses` at once.
///
/// # Errors
/// When there is nothing to fit, or too little of it.
pub fn relaxation(
    records: &[RelaxationRecord],
    settings: RelaxationSettings,
) -> Result<Relaxation, Error> {
    if records.is_empty() {
        return Err(Error::NoContactForce);
    }
    let mut fits: Vec<Fit> = Vec::new();
    for count in settings.terms.map_or(1..=MAX_TERMS, |terms| terms..=terms) {
        let fit = with_terms(records, count, fits.last())?;
        let gained = fits.last().is_none_or(|before| {
            fit.sum_of_squares() < (1.0 - NOTHING_GAINED) * before.sum_of_squares()
        });
        let left = (fit.sum_of_squares() / fit.residuals.len() as f64).sqrt();
        fits.push(fit);
        if !gained || left < NEGLIGIBLE {
            break;
        }
    }
    // What the richest leaves is noise, so all are compared as if that noise had been seen.
    let lengths: Vec<usize> = records.iter().map(|course| course.time.len()).collect();
    let richest = fits.last().ok_or(Error::NoContactForce)?;
    let of_richest = correlated_uncertainty(richest, &lengths);
    let samples = of_richest.effective_samples;
    let (chosen, criteria) = simplest(&fits.iter().collect::<Vec<_>>(), samples);
    let tried = fits.iter().zip(criteria);
    let tried =
        tried.map(|(fit, criterion)| (terms_of(fit, records), fit.sum_of_squares(), criterion));
    let tried: Vec<_> = tried.collect();
    let uncertainty = match chosen + 1 == fits.len() {
        true => of_richest,
        false => correlated_uncertainty(&fits[chosen], &lengths),
    };
    let fit = fits.swap_remove(chosen);
    let systematic = Model {
        records,
        terms: terms_of(&fit, records),
    };
    let systematic = systematic.systematic(&values_of(&fit));
    let uncertainty = with_systematic(uncertainty, &fit, &systematic);
    described(records, fit, uncertainty, tried)
}

pub(super) fn values_of(fit: &Fit) -> Vec<f64> {
    fit.parameters.iter().map(|p| p.value).collect()
}

/// The relaxation that is expected to be found from `courses`, whose elastic forces are of these `sizes` [-], of tissue
/// that relaxes by `series`: `weights` are the roots of how many samples of unit noise, relative to the largest force,
/// each row stands for.
///
/// # Errors
/// When the series is none.
pub(crate) fn expected_relaxation(
    records: &[RelaxationRecord],
    series: &PronySeries,
    sizes: &[f64],
    weights: &[f64],
) -> Result<Relaxation, Error> {
    let count = series.terms().len();
    let left = 1.0 - series.terms().iter().map(|(g, _)| g).sum::<f64>();
    let of_terms = series.terms().iter().flat_map(|(g, tau)| {
        let time = Parameter::new("log_tau", tau.ln()).scaled(1.0);
        [Parameter::new("ratio", g / left), time]
    });
    let of_sizes = sizes.iter().map(|size| Parameter::new("size", *size));
    let exponent = Parameter::new("exponent", 0.0);
    let parameters = [exponent].into_iter().chain(of_terms).chain(of_sizes);
    let mut fit = Fit::at(parameters.collect(), weights.len());
    let model = Model {
        records,
        terms: count,
    };
    let values = values_of(&fit);
    model
        .evaluate(&values, &mut fit.residuals, &mut fit.jacobian)
        .ok_or(Error::NoContactForce)?;
    let systematic = model.systematic(&values);
    let expected = Expected::of(fit, &systematic, weights);
    let known = expected.known(&expected.fit, systematic.len(), records.len());
    described(records, expected.fit, known, Vec::new())
}

pub(super) fn terms_of(fit: &Fit, records: &[RelaxationRecord]) -> usize {
    (fit.parameters.len() - 1 - records.len()) / 2
}

/// The same as if the hold had begun with a step: only what follows the largest force is seen.
///
/// # Errors
/// As [`relaxation`].
pub fn relaxation_of_steps(
    records: &[RelaxationRecord],
    settings: RelaxationSettings,
) -> Result<Relaxation, Error> {
    let steps: Vec<RelaxationRecord> = records
        .iter()
        .map(RelaxationRecord::after_the_peak)
        .collect();
    relaxation(&steps, settings)
}

fn with_terms(
    records: &[RelaxationRecord],
    count: usize,
    before: Option<&Fit>,
) -> Result<Fit, Error> {
    let thinned: Vec<RelaxationRecord> = records.iter().map(RelaxationRecord::thinned).collect();
    let mut best: Option<Fit> = None;
    for parameters in starts(records, count, before) {
        let fit = fitted(&thinned, count, &parameters)?;
        if best
            .as_ref()
            .is_none_or(|best| fit.sum_of_squares() < best.sum_of_squares())
        {
            best = Some(fit);
        }
    }
    let best = best.ok_or(Error::NoContactForce)?;
    fitted(records, count, &best.parameters)
}

pub(super) fn fitted(
    records: &[RelaxationRecord],
    terms: usize,
    parameters: &[Parameter],
) -> Result<Fit, Error> {
    let model = Model { records, terms };
    let settings = Settings {
        tolerance: TOLERANCE,
        ..Settings::default()
    };
    least_squares_with_jacobian(
        parameters,
        model.samples(),
        &settings,
        |values, residuals, jacobian| model.evaluate(values, residuals, jacobian),
    )
}

/// Where the fit starts: times spread evenly over what the recordings show, and the terms of one fewer
/// with one more before or after.
pub(super) fn starts(
    records: &[RelaxationRecord],
    count: usize,
    before: Option<&Fit>,
) -> Vec<Vec<Parameter>> {
    let [shortest, longest] = visible_times(records);
    let at = |part: f64| shortest * (longest / shortest).powf(part);
    let drop = records.iter().map(RelaxationRecord::drop).sum::<f64>() / records.len() as f64;
    let spread = |from: f64, to: f64| {
        let times = (0..count).map(|i| at(from + (to - from) * (i as f64 + 0.5) / count as f64));
        times
            .map(|tau| (drop / count as f64, tau))
            .collect::<Vec<_>>()
    };
    let mut series = vec![spread(0.0, 1.0), spread(0.4, 1.0)];
    if let Some(before) = before {
        let value = |place: usize| before.parameters[place].value;
        let known = (1..count).map(|term| (value(2 * term - 1), value(2 * term).exp()));
        for more in [0.1, 0.9].map(|part| shortest * (longest / shortest).powf(part)) {
            series.push(known.clone().chain([(0.1 * drop, more)]).collect());
        }
    }
    let exponent = Parameter::new("exponent", 0.0)
        .within(EXPONENTS[0], EXPONENTS[1])
        .scaled(1.0);
    let exponent = if records.iter().any(|course| course.ramp() >= RAMP) {
        exponent
    } else {
        exponent.fixed()
    };
    let of_series = |terms: Vec<(f64, f64)>| {
        let each = terms
            .into_iter()
            .enumerate()
            .flat_map(|(place, (ratio, tau))| {
                let ratio = ratio.clamp(1e-3, LARGEST_RATIO);
                let (least, most) = ((0.1 * shortest).ln(), (LONGEST * longest).ln());
                [
                    Parameter::new(format!("ratio_{}", place + 1), ratio)
                        .within(0.0, LARGEST_RATIO),
                    Parameter::new(
                        format!("log_tau_{}", place + 1),
                        tau.ln().clamp(least, most),
                    )
                    .within(least, most)
                    .scaled(1.0),
                ]
            });
        let sizes = records.iter().zip(1..).map(|(course, number)| {
            Parameter::new(format!("size_{number}"), course.peak()).within(0.0, 1e3)
        });
        [exponent.clone()]
            .into_iter()
            .chain(each)
            .chain(sizes)
            .collect()
    };
    series.into_iter().map(of_series).collect()
}

/// The shortest and the longest time [s] that can be seen: of two samples, and of the longest course.
fn visible_times(records: &[RelaxationRecord]) -> [f64; 2] {
    let steps = records.iter().flat_map(|course| course.time.windows(2));
    let shortest = steps
        .map(|pair| pair[1] - pair[0])
        .fold(f64::INFINITY, f64::min);
    let longest = records
        .iter()
        .map(RelaxationRecord::length)
        .fold(0.0, f64::max);
    [(2.0 * shortest).min(0.1 * longest), longest]
}

pub(super) fn described(
    records: &[RelaxationRecord],
    fit: Fit,
    uncertainty: Uncertainty,
    tried: Vec<(usize, f64, f64)>,
) -> Result<Relaxation, Error> {
    let count = terms_of(&fit, records);
    let values: Vec<f64> = fit.parameters.iter().map(|p| p.value).collect();
    let [covariance, of_noise] = uncertainty.of_all(fit.parameters.len());
    let pairs = terms(&values, count);
    let left = 1.0 - pairs.iter().map(|(g, _)| g).sum::<f64>();
    // With its derivatives by the parameters of the fit, and what it may be off [its unit] besides.
    let known = |value: f64, by: &[(usize, f64)], off: f64| {
        let [variance, noise] = [&covariance, &of_noise].map(|covariance| {
            let each = by
                .iter()
                .flat_map(|&(i, x)| by.iter().map(move |&(j, y)| x * y * covariance[(i, j)]));
            each.sum::<f64>().max(0.0)
        });
        let variance = variance + even(off);
        let estimate = Estimate {
            value,
            standard_error: Some(variance.sqrt()),
        };
        let freedom = uncertainty.degrees_of_freedom(variance, noise);
        (estimate, student_quantile(freedom, 0.95))
    };
    let off = quasi_linear(pairs.iter().map(|(g, _)| g).sum());
    let mut described: Vec<_> = (0..count)
        .map(|place| {
            let (g, tau) = pairs[place];
            let by = |j: usize| left * (if j == place { 1.0 } else { 0.0 } - g);
            let of_ratios: Vec<_> = (0..count).map(|j| (1 + 2 * j, by(j))).collect();
            [
                known(g, &of_ratios, off * g),
                known(tau, &[(2 + 2 * place, tau)], off * tau),
            ]
        })
        .collect();
    described.sort_by(|a, b| a[1].0.value.total_cmp(&b[1].0.value));
    let each = |term: &[(Estimate, f64); 2]| (term[0].0.value, term[1].0.value);
    let of_terms: Vec<_> = described.iter().map(each).collect();
    let series = PronySeries::new(&of_terms)?;
    let mut start = 0;
    let forces = records.iter().map(|course| {
        let rows = start..start + course.force.len();
        start = rows.end;
        let each = fit.residuals[rows].iter().zip(&course.force);
        each.map(|(residual, force)| residual + force).collect()
    });
    let (exponent, exponent_quantile) = known(values[0], &[(0, 1.0)], 0.0);
    Ok(Relaxation {
        product: ProductForm::of(&series),
        series,
        terms: described.iter().map(|term| term.map(|own| own.0)).collect(),
        quantiles: described.iter().map(|term| term.map(|own| own.1)).collect(),
        exponent,
        exponent_quantile,
        sizes: values[1 + 2 * count..].to_vec(),
        sum_of_squares: fit.sum_of_squares(),
        tried,
        forces: forces.collect(),
        covariance,
        fit,
    })
}
