use nalgebra::DMatrix;
use palpate_mechanics::PronySeries;

use super::curves::Curves;
use super::description::{LawDescription, in_own_parameters};
use super::forces::{self, Indentation};
use super::law::CandidateLaw;
use super::law_fit::SETTINGS;
use crate::Error;
use crate::fit::{
    Draws, Fit, Spread, block_bootstrap, correlated_uncertainty, least_squares_with_jacobian,
    noise_study, profile,
};
use crate::viscoelastic::terms;

/// Uncertainty by repeated fits, in addition to the covariance.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeated {
    /// For each parameter the values [its unit] between which Σ ε² stays below what a probability of 95 %
    /// allows, with the relaxation fixed; a side is `None` where it never rises so far.
    pub profiles: Vec<Option<[Option<f64>; 2]>>,
    /// The spread of each parameter [its unit] when the residuals are drawn anew in blocks, relaxation and
    /// all; none where no recording is longer than a block, for then there is nothing to draw.
    pub bootstrap: Option<Vec<f64>>,
    /// Samples of a block.
    pub block: usize,
    /// Noise, and how far it spreads the parameters (6.4.6).
    pub noise: Vec<NoiseEffect>,
}

/// Spread of the parameters by noise.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseEffect {
    /// Standard deviation of independent noise, over the largest force [-].
    pub noise: f64,
    /// Spread of each parameter [its unit].
    pub spread: Vec<f64>,
}

/// Noise that is tried, over the largest force [-].
const NOISE: [f64; 3] = [0.01, 0.05, 0.1];
/// Fewest draws from which a spread is computed: the standard deviation of ten values is known to a quarter.
pub const MIN_DRAWS: usize = 10;
/// Correlation times in a block of residuals.
const BLOCK: f64 = 5.0;
/// The probability of the profile's interval.
const LEVEL: f64 = 0.95;

/// Fits of `law` made again: with each parameter moved, with residuals in another order, with more noise.
///
/// # Errors
/// When each of them would take runs of finite elements, as under pressure, and those of the fits.
pub fn repeated(
    law: &LawDescription,
    curves: &Curves,
    indentations: &[Indentation<'_>],
    draws: Draws,
) -> Result<Repeated, Error> {
    if curves.depend_on_modulus() {
        return Err(Error::CostlyToRepeat {
            law: law.found.law.name(),
        });
    }
    let own = in_own_parameters(&law.found);
    let count = law.parameters.len();
    let lengths: Vec<usize> = indentations.iter().map(|each| each.time.len()).collect();
    let samples: usize = lengths.iter().sum();
    let mut model = OwnModel {
        law: law.found.law,
        curves,
        indentations,
    };
    let profiles = profiles(&own, count, &lengths, &mut model)?;
    let block = (BLOCK * samples as f64 / law.uncertainty.effective_samples).ceil() as usize;
    let mut bootstrap = None;
    if lengths.iter().any(|&length| length > block) {
        let evaluate = |p: &[f64], r: &mut [f64], j: &mut DMatrix<f64>| model.evaluate(p, r, j);
        let drawn = block_bootstrap(&own, &lengths, block, draws, &SETTINGS, evaluate);
        if drawn.values.is_empty() {
            return Err(Error::NoStart {
                parameters: own.parameters,
            });
        }
        bootstrap = Some(spreads(&drawn, count));
    }
    let largest = indentations
        .iter()
        .flat_map(|each| each.force)
        .copied()
        .fold(0.0, f64::max);
    // Three times as much is done as for the bootstrap, and less is asked of it.
    let fewer = Draws {
        count: draws.count.div_ceil(4).max(MIN_DRAWS),
        ..draws
    };
    let mut noise_effect = |noise: f64| {
        let evaluate = |p: &[f64], r: &mut [f64], j: &mut DMatrix<f64>| model.evaluate(p, r, j);
        let spread = noise_study(&own, noise * largest, fewer, &SETTINGS, evaluate);
        (!spread.values.is_empty()).then(|| NoiseEffect {
            noise,
            spread: spreads(&spread, count),
        })
    };
    Ok(Repeated {
        profiles,
        bootstrap,
        block,
        noise: NOISE.into_iter().filter_map(&mut noise_effect).collect(),
    })
}

/// Half of what holds the middle 68.3 %: of a normal law its standard deviation, and not led astray by the few
/// fits that noise leads to another minimum.
fn spreads(spread: &Spread, count: usize) -> Vec<f64> {
    let half = |place| {
        let [low, high] = spread.interval(place, 0.683);
        0.5 * (high - low)
    };
    (0..count).map(half).collect()
}

fn profiles(
    own: &Fit,
    count: usize,
    lengths: &[usize],
    model: &mut OwnModel<'_>,
) -> Result<Vec<Option<[Option<f64>; 2]>>, Error> {
    let mut restricted = own.clone();
    for parameter in restricted.parameters.iter_mut().skip(count) {
        parameter.fixed = true;
    }
    let uncertainty = correlated_uncertainty(&restricted, lengths);
    let mut one = |place: usize| {
        if !restricted.chosen().contains(&place) {
            return Ok(None);
        }
        let found = profile(&restricted, place, &uncertainty, LEVEL, |parameters| {
            let samples = restricted.residuals.len();
            let evaluate = |p: &[f64], r: &mut [f64], j: &mut DMatrix<f64>| model.evaluate(p, r, j);
            least_squares_with_jacobian(parameters, samples, &SETTINGS, evaluate)
        })?;
        Ok(Some(found.interval))
    };
    (0..count).map(&mut one).collect()
}

/// Forces by a law's own parameters and a relaxation.
struct OwnModel<'a> {
    law: CandidateLaw,
    curves: &'a Curves,
    indentations: &'a [Indentation<'a>],
}

impl OwnModel<'_> {
    /// The parameters are those of the law and the relaxation's.
    fn evaluate(
        &mut self,
        values: &[f64],
        residuals: &mut [f64],
        jacobian: &mut DMatrix<f64>,
    ) -> Option<()> {
        let count = self.law.count();
        let own = self.law.to_shape_parameters(&values[..count])?;
        let curve = self.curves.predicted(own.modulus, &own.shape)?;
        let pairs = terms(&values[count - 1..], (values.len() - count) / 2);
        let series = PronySeries::new(&pairs).ok()?;
        let mut start = 0;
        for each in self.indentations {
            let (forces, mut columns) =
                forces::forces(each.time, each.depth, &curve, own.modulus, &series);
            for row in 0..forces.len() {
                residuals[start + row] = forces[row] - each.force[row];
                let of_shape: Vec<f64> = (0..count).map(|place| columns[place][row]).collect();
                for (place, column) in columns[..count].iter_mut().enumerate() {
                    let by = own.by.column(place);
                    column[row] = of_shape.iter().zip(&by).map(|(of, by)| of * by).sum();
                }
            }
            forces::write(&columns, start, jacobian);
            start += forces.len();
        }
        residuals.iter().all(|r| r.is_finite()).then_some(())
    }
}
