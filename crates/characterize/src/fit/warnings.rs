//! Warnings of a fit about poorly known parameters, in plain sentences.
//!
//! Errors relative to the parameters' sizes have a covariance whose eigenvectors are combinations of parameters,
//! each with its own error. Where that error is large, the parameters that take part cannot be
//! distinguished (or, if it is one alone, it is not known); of their simple combinations the best
//! known is named with its value. `verdict.rs` decides which parameters are hardly known.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use palpate_files::quantity::{plain_quantity, without_unit};

use super::{Fit, HARDLY_KNOWN, Stop, Uncertainty, Verdict, verdicts};

/// The part of an eigenvector from which on a parameter takes part in it [-].
const TAKES_PART: f64 = 0.3;
/// Rounding of a model's values [-].
const ROUNDING: f64 = 1e-12;

/// Warnings of a fit; empty when there are none. `duration` [s] is that of the
/// recording, to which time constants (parameters in seconds) are compared.
pub fn warnings(fit: &Fit, uncertainty: &Uncertainty, duration: Option<f64>) -> Vec<String> {
    let mut sentences = Vec::new();
    let early = match fit.stop {
        Stop::Converged => None,
        // Of an exact fit nothing is left to be better by.
        Stop::NoBetter if is_exact(fit) => None,
        Stop::NoBetter => Some("no further step was better"),
        Stop::NoDerivatives => Some("the model has no answer near the last one"),
        Stop::Iterations => Some("its steps were used up"),
    };
    sentences.extend(early.map(|why| format!("the fit stopped before it arrived, as {why}")));
    for parameter in fit.parameters.iter().filter(|p| !p.fixed) {
        let (name, value) = (&parameter.name, parameter.value);
        if parameter.at_bound() {
            sentences.push(format!(
                "{name} ended on its bound {value}, which is no estimate"
            ));
        } else if let Some(duration) = duration.filter(|d| ending(name) == "_s" && value > *d) {
            let [value, duration] = [value, duration].map(|time| plain_quantity("_s", time, None));
            let shown = format!("{value} in a recording of {duration}");
            sentences.push(format!(
                "{name} is longer than the recording shows: {shown}"
            ));
        }
    }
    sentences.extend(hardly_known(fit, uncertainty));
    sentences
}

/// Whether the residuals are mere rounding relative to the values of the model.
fn is_exact(fit: &Fit) -> bool {
    let values = fit.parameters.iter().map(|p| p.value);
    let given = &fit.jacobian * DVector::from_iterator(fit.parameters.len(), values);
    fit.sum_of_squares().sqrt() < ROUNDING * given.norm()
}

fn hardly_known(fit: &Fit, uncertainty: &Uncertainty) -> Vec<String> {
    let count = uncertainty.chosen.len();
    if count == 0 {
        return Vec::new();
    }
    let size = |k: usize| {
        let parameter = &fit.parameters[uncertainty.chosen[k]];
        if parameter.value == 0.0 {
            parameter.scale
        } else {
            parameter.value.abs()
        }
    };
    let relative = DMatrix::from_fn(count, count, |i, j| {
        uncertainty.covariance[(i, j)] / (size(i) * size(j))
    });
    let errors: Vec<_> = (0..count).map(|i| Some(relative[(i, i)].sqrt())).collect();
    let verdicts = verdicts(&errors, &uncertainty.correlation());
    let mut reported = vec![false; count];
    let mut sentences = Vec::new();
    let eigen = SymmetricEigen::new(relative.clone());
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    for k in order {
        let vector = eigen.eigenvectors.column(k);
        let part: Vec<usize> = (0..count)
            .filter(|&i| vector[i].abs() > TAKES_PART && !reported[i])
            .filter(|&i| verdicts[i] != Verdict::Known)
            .collect();
        let worst = part
            .iter()
            .map(|&i| relative[(i, i)].sqrt())
            .fold(0.0, f64::max);
        if eigen.eigenvalues[k].max(0.0).sqrt() <= HARDLY_KNOWN || worst <= HARDLY_KNOWN {
            continue;
        }
        let members: Vec<Member> = part
            .iter()
            .map(|&i| Member::new(fit, uncertainty, i))
            .collect();
        let covariance = uncertainty
            .covariance
            .select_rows(&part)
            .select_columns(&part);
        sentences.push(match best_combination(&members, &covariance, worst) {
            Some(combination) => format!(
                "{} cannot be told apart from this recording; {combination}",
                joined(&members)
            ),
            None => alone(&members, &covariance),
        });
        part.iter().for_each(|&i| reported[i] = true);
    }
    // Hardly known parameters that are named in no such combination.
    for i in (0..count).filter(|&i| !reported[i] && verdicts[i] == Verdict::HardlyKnown) {
        let variance = uncertainty.covariance.view((i, i), (1, 1)).into_owned();
        sentences.push(alone(&[Member::new(fit, uncertainty, i)], &variance));
    }
    sentences
}

/// A parameter of a combination.
struct Member<'a> {
    name: &'a str,
    value: f64,
}

impl<'a> Member<'a> {
    fn new(fit: &'a Fit, uncertainty: &Uncertainty, place: usize) -> Self {
        let parameter = &fit.parameters[uncertainty.chosen[place]];
        Self {
            name: &parameter.name,
            value: parameter.value,
        }
    }
}

/// The best known of the simple combinations, if it is known and much better than the members are.
fn best_combination(members: &[Member], covariance: &DMatrix<f64>, worst: f64) -> Option<String> {
    let units: Vec<&str> = members.iter().map(|member| ending(member.name)).collect();
    // A name without a unit may have any, and no two of those can be added.
    let alike = !units[0].is_empty() && units.iter().all(|unit| *unit == units[0]);
    let gradient_error = |gradient: &[f64]| {
        let gradient = nalgebra::DVector::from_column_slice(gradient);
        gradient.dot(&(covariance * &gradient)).max(0.0).sqrt()
    };
    let mut candidates: Vec<(&str, f64, f64, &str)> = Vec::new();
    if alike && members.len() > 1 {
        let sum: f64 = members.iter().map(|member| member.value).sum();
        let error = gradient_error(&vec![1.0; members.len()]);
        candidates.push(("their sum", sum, error, units[0]));
    }
    if let [a, b] = members {
        let product = gradient_error(&[b.value, a.value]);
        candidates.push(("their product", a.value * b.value, product, ""));
        let ratio = gradient_error(&[b.value.recip(), -a.value / b.value.powi(2)]);
        candidates.push(("their ratio", a.value / b.value, ratio, ""));
        if alike {
            let difference = gradient_error(&[1.0, -1.0]);
            candidates.push(("their difference", a.value - b.value, difference, units[0]));
        }
    }
    // The first is the simplest; another must be twice as well known to be named instead.
    let relative = |candidate: &(&str, f64, f64, &str)| candidate.2 / candidate.1.abs();
    let best = candidates.iter().enumerate().min_by(|(i, a), (j, b)| {
        let weight = |place: usize| if place == 0 { 1.0 } else { 2.0 };
        (weight(*i) * relative(a)).total_cmp(&(weight(*j) * relative(b)))
    });
    let (what, value, error, unit) = best.map(|(_, best)| *best)?;
    let known = error / value.abs() <= HARDLY_KNOWN.min(0.25 * worst);
    known.then(|| format!("{what} is {}", plain_quantity(unit, value, Some(error))))
}

fn alone(members: &[Member], covariance: &DMatrix<f64>) -> String {
    let each = members.iter().enumerate().map(|(i, member)| {
        let error = covariance[(i, i)].sqrt();
        let value = plain_quantity(member.name, member.value, Some(error));
        format!(
            "{} is hardly known from this recording: {value}",
            member.name
        )
    });
    each.collect::<Vec<_>>().join("; ")
}

fn joined(members: &[Member]) -> String {
    let names: Vec<&str> = members.iter().map(|member| member.name).collect();
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

/// The unit in which a name ends: `_pa`.
fn ending(name: &str) -> &str {
    &name[without_unit(name).len()..]
}
