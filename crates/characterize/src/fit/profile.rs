use super::{Fit, Parameter, Uncertainty};
use crate::Error;

/// How the sum of squares rises when one parameter is moved and the others are found anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Values of the parameter [its unit], ascending, with the least sums of squares.
    pub points: Vec<[f64; 2]>,
    /// The values [its unit] between which the sum stays below what the level allows; a side is `None` when it
    /// never rises so far.
    pub interval: [Option<f64>; 2],
}

/// Steps to each side, at most; they grow, so the last are hundreds of standard errors away.
const STEPS: usize = 14;
/// The first step, in standard errors, and what each is of the one before.
const FIRST: f64 = 0.5;
const GROWTH: f64 = 1.5;

/// The profile of one parameter, as far as the interval of the probability `level` reaches. `fit_again` fits
/// with that parameter fixed.
///
/// For a linear model the interval is [`Uncertainty::interval`]; the rise of Σ r² that bounds it follows from
/// this, so that correlated residuals widen both alike.
///
/// # Errors
/// Those of the fits, and when `found` did not choose the parameter.
pub fn profile(
    found: &Fit,
    parameter: usize,
    uncertainty: &Uncertainty,
    level: f64,
    mut fit_again: impl FnMut(&[Parameter]) -> Result<Fit, Error>,
) -> Result<Profile, Error> {
    let errors = uncertainty
        .standard_error(parameter)
        .zip(uncertainty.unit_error(parameter))
        .zip(uncertainty.quantile(parameter, level));
    let Some(((error, unit), quantile)) = errors else {
        return Err(Error::BadParameter {
            parameter: Box::new(found.parameters[parameter].clone()),
        });
    };
    let least = found.sum_of_squares();
    let limit = least + (quantile * error / unit).powi(2);
    let center = found.parameters[parameter].value;
    let mut points = vec![[center, least]];
    let mut interval = [None; 2];
    for (side, direction) in [-1.0, 1.0].into_iter().enumerate() {
        let mut parameters = found.parameters.clone();
        let (mut before, mut distance) = ([center, least], FIRST * error);
        for _ in 0..STEPS {
            let moved = &mut parameters[parameter];
            moved.value = (center + direction * distance).clamp(moved.lower, moved.upper);
            let (value, at_bound) = (moved.value, moved.at_bound());
            moved.fixed = true;
            let again = fit_again(&parameters)?;
            let point = [value, again.sum_of_squares()];
            points.push(point);
            parameters = again.parameters;
            if point[1] >= limit {
                interval[side] = Some(crossing([before, point], center, [least, limit]));
                break;
            }
            if at_bound {
                break;
            }
            before = point;
            distance *= GROWTH;
        }
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok(Profile { points, interval })
}

/// Where the sum reaches the limit, when its root is linear between two points, as it is for a linear model.
fn crossing(points: [[f64; 2]; 2], center: f64, [least, limit]: [f64; 2]) -> f64 {
    let [near, far] = points.map(|[value, sum]| [value - center, (sum - least).max(0.0).sqrt()]);
    let share = ((limit - least).sqrt() - near[1]) / (far[1] - near[1]);
    center + near[0] + share * (far[0] - near[0])
}
