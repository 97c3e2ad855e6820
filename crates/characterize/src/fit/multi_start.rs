use nalgebra::DVector;

use super::{Fit, Parameter, Random};
use crate::Error;

/// A minimum, and how many starts led to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// The best fit that ended there.
    pub fit: Fit,
    /// How many of the starts ended there.
    pub starts: usize,
}

/// Fits whose models are closer than this, relative to the models, are of one minimum.
const SAME: f64 = 1e-3;

/// Fits from where `parameters` start and from `starts` other places, and the minima to which they lead, the
/// best first.
///
/// The places are a Latin hypercube between the bounds [McKay, Beckman and Conover 1979]: each parameter
/// comes once into each of `starts` parts of its range, which are of equal ratio when the lower bound is above
/// zero. Without two bounds, a tenth to ten times its scale takes their place. Fits that cannot start are
/// passed over.
///
/// # Errors
/// When no fit could start.
pub fn multi_start(
    parameters: &[Parameter],
    starts: usize,
    seed: u64,
    mut fit: impl FnMut(&[Parameter]) -> Result<Fit, Error>,
) -> Result<Vec<Minimum>, Error> {
    let places = hypercube(parameters, starts, &mut Random::new(seed));
    let starts = std::iter::once(parameters).chain(places.iter().map(Vec::as_slice));
    distinct_minima(starts.map(&mut fit))
}

/// The minima in which fits of the same data ended, the best first.
///
/// # Errors
/// That of the first fit, when none could start.
pub(crate) fn distinct_minima(
    fits: impl Iterator<Item = Result<Fit, Error>>,
) -> Result<Vec<Minimum>, Error> {
    let mut minima: Vec<Minimum> = Vec::new();
    let mut refused = None;
    for found in fits {
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                refused.get_or_insert(error);
                continue;
            }
        };
        match minima.iter_mut().find(|minimum| same(&minimum.fit, &found)) {
            Some(minimum) => {
                minimum.starts += 1;
                if found.sum_of_squares() < minimum.fit.sum_of_squares() {
                    minimum.fit = found;
                }
            }
            None => minima.push(Minimum {
                fit: found,
                starts: 1,
            }),
        }
    }
    let sum = |minimum: &Minimum| minimum.fit.sum_of_squares();
    minima.sort_by(|a, b| sum(a).total_cmp(&sum(b)));
    match refused {
        Some(refused) if minima.is_empty() => Err(refused),
        _ => Ok(minima),
    }
}

/// Whether two fits ended in one minimum: the way from one to the other hardly changes the model, to first order.
/// Sums of squares say nothing of it: those of two minima may agree by chance, or both be zero.
fn same(a: &Fit, b: &Fit) -> bool {
    // Columns of fixed parameters mean nothing.
    let free = |fit: &Fit, by: &dyn Fn(usize) -> f64| {
        let places = (0..fit.parameters.len()).filter(|&place| !fit.parameters[place].fixed);
        let each = places.map(|place| fit.jacobian.column(place) * by(place));
        each.fold(DVector::zeros(fit.residuals.len()), |sum, x| sum + x)
            .norm()
    };
    let value = |fit: &Fit, place: usize| fit.parameters[place].value;
    let way = |place: usize| value(b, place) - value(a, place);
    let [changed, whole] = [
        free(a, &way).max(free(b, &way)),
        free(a, &|place| value(a, place)).max(free(b, &|place| value(b, place))),
    ];
    changed <= SAME * whole
}

/// Sums of squares of two minima of which the second is about as good as the first [-].
const AS_GOOD: f64 = 1.5;

/// The sentence on another minimum of the fit of a `law` whose sum of squares is so many `times` that of the best, with its
/// parameters by their names; none where it is much worse.
pub(crate) fn another_minimum<'a>(
    law: &str,
    times: f64,
    parameters: impl Iterator<Item = (&'a str, f64)>,
) -> Option<String> {
    (times < AS_GOOD).then(|| {
        let each = parameters.map(|(name, value)| format!("{name} = {value:.4}"));
        format!(
            "{law}: another minimum is about as good, with a sum of squares {times:.2} times as large, at {}; \
             these recordings do not decide which of them is the tissue's",
            each.collect::<Vec<_>>().join(", ")
        )
    })
}

fn hypercube(parameters: &[Parameter], starts: usize, random: &mut Random) -> Vec<Vec<Parameter>> {
    let mut places = vec![parameters.to_vec(); starts];
    for (i, parameter) in parameters.iter().enumerate().filter(|(_, p)| !p.fixed) {
        let mut order: Vec<usize> = (0..starts).collect();
        for k in (1..starts).rev() {
            order.swap(k, random.below(k + 1));
        }
        for (place, part) in places.iter_mut().zip(order) {
            let share = (part as f64 + random.uniform()) / starts as f64;
            place[i].value = between(parameter, share);
        }
    }
    places
}

/// The value a part `share` of the way from the lower to the upper end of a parameter's range.
fn between(parameter: &Parameter, share: f64) -> f64 {
    let Parameter {
        lower,
        upper,
        scale,
        ..
    } = *parameter;
    let [low, high] = match (lower.is_finite(), upper.is_finite()) {
        (true, true) => [lower, upper],
        (true, false) => [
            lower.max(0.1 * scale),
            lower.max(0.1 * scale) + 10.0 * scale,
        ],
        (false, true) => [upper - 10.0 * scale, upper],
        (false, false) if parameter.value < 0.0 => [-10.0 * scale, -0.1 * scale],
        (false, false) => [0.1 * scale, 10.0 * scale],
    };
    let value = if low > 0.0 {
        low * (high / low).powf(share)
    } else {
        low + share * (high - low)
    };
    value.clamp(lower, upper)
}
