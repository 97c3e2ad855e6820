//! Starts from which a fit of a law converges: its own force is fitted again from other parameters.

use palpate_characterize::fit::{Parameter, Settings, least_squares};
use palpate_characterize::inverse::{Body, CandidateLaw, Curves, SHAPES};
use palpate_characterize::lumped::column_force;
use palpate_files::tissue::EffectiveColumn;
use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::indentation::History;

use super::unbounded::unbounded_iteration;
use crate::Error;
use crate::virtual_rig::{RADIUS, ramp_and_hold};
use palpate_jobs::plot::Style;

/// Steps after which an iteration is given up.
const STEPS: usize = 100;
/// Relative change of the parameters at which an iteration ends [-].
const TOLERANCE: f64 = 1e-6;
/// How near to the truth counts as arrived [-].
pub(super) const NEAR: f64 = 0.01;
/// One of so many samples of a recording is enough for forces without noise.
const EVERY: usize = 10;

/// The algorithm of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Algorithm {
    /// This project's, with bounds and changing damping.
    Own,
    /// The source's (6.16), with this damping over the mean of the diagonal of JᵀJ [-].
    Source(f64),
}

/// All, with their words; the source says no number for its damping.
pub(super) const ALGORITHMS: [(Algorithm, &str); 3] = [
    (Algorithm::Own, "own"),
    (Algorithm::Source(1e-6), "source"),
    (Algorithm::Source(0.01), "source_damped"),
];

impl Algorithm {
    pub(super) fn style(self) -> Style {
        match self {
            Self::Own => Style::LineWithDots,
            Self::Source(damping) if damping < 1e-3 => Style::DashedLineWithSquares,
            Self::Source(_) => Style::DottedLine,
        }
    }
}

/// A force that is known for any parameters.
pub(super) enum Model {
    /// An organ under the probe.
    Indented {
        curves: Curves,
        course: History,
        series: PronySeries,
    },
    /// Blatz's law on a column at these depths [m].
    Column {
        column: EffectiveColumn,
        depths: Vec<f64>,
    },
}

impl Model {
    /// A ramp to `depth` [m] and a hold, of a tissue that follows `law`.
    pub(super) fn indented(law: CandidateLaw, depth: f64, series: PronySeries) -> Self {
        let whole = ramp_and_hold(depth);
        let some = |values: Vec<f64>| values.into_iter().step_by(EVERY).collect();
        Self::Indented {
            curves: Curves::new(Body::under_punch(RADIUS), law, depth),
            course: History {
                times: some(whole.times),
                depths: some(whole.depths),
            },
            series,
        }
    }

    /// Forces [N] with these parameters; none where there is no such tissue.
    pub(super) fn forces(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        match self {
            Self::Indented {
                curves,
                course,
                series,
            } => {
                let modulus: f64 = parameters.iter().sum();
                let shape: Vec<f64> = parameters[1..].iter().map(|own| own / modulus).collect();
                // A law with a negative parameter has no run.
                if !(modulus > 0.0 && shape.iter().all(|part| (0.0..=1.0).contains(part))) {
                    return None;
                }
                let unit = curves.clone().of(f64::INFINITY, &shape).ok()?;
                let curve = unit.force.scaled(1.0, modulus);
                Some(curve.relaxed(series, &course.times, &course.depths))
            }
            Self::Column { column, depths } => {
                let own = EffectiveColumn {
                    gamma_pa: parameters[0].into(),
                    alpha: parameters[1].into(),
                    ..*column
                };
                depths.iter().map(|d| column_force(&own, *d).ok()).collect()
            }
        }
    }

    /// The way of the parameters from `start` to those of the forces with `truth`; whether it ended there.
    pub(super) fn way(
        &self,
        algorithm: Algorithm,
        truth: &[f64],
        start: &[f64],
    ) -> Result<(Vec<Vec<f64>>, bool), Error> {
        let Some(measured) = self.forces(truth) else {
            return Err(Error::failed(
                "the printed law has no force; please report this",
            ));
        };
        let way = match algorithm {
            Algorithm::Source(damping) => {
                let residuals =
                    |p: &[f64], residuals: &mut [f64]| self.residuals(p, &measured, residuals);
                unbounded_iteration(start, measured.len(), damping, TOLERANCE, STEPS, residuals)
            }
            Algorithm::Own => self.own_way(start, &measured)?,
        };
        let ended = way.last().is_some_and(|last| near(last, truth));
        Ok((way, ended))
    }
}

impl Model {
    /// The parameters that this project's fit finds in the forces `measured` [N], from `start`.
    pub(super) fn found(&self, start: &[f64], measured: &[f64]) -> Result<Vec<f64>, Error> {
        let last = self.own_way(start, measured)?.pop();
        last.ok_or_else(|| Error::failed("a fit without a step; please report this"))
    }

    fn residuals(&self, parameters: &[f64], measured: &[f64], residuals: &mut [f64]) -> Option<()> {
        let forces = self.forces(parameters)?;
        for (place, residual) in residuals.iter_mut().enumerate() {
            *residual = forces[place] - measured[place];
        }
        Some(())
    }

    /// Of a law with a second modulus the fit seeks the sum of both and the part of the second, as
    /// `inverse::law_fit` does.
    fn own_way(&self, start: &[f64], measured: &[f64]) -> Result<Vec<Vec<f64>>, Error> {
        let shaped = matches!(self, Self::Indented { .. }) && start.len() == 2;
        let [first, largest] = match shaped {
            true => [start.iter().sum(), SHAPES[SHAPES.len() - 1]],
            false => [start[0], f64::INFINITY],
        };
        let mut parameters = vec![Parameter::new("first", first).within(0.0, f64::INFINITY)];
        if let Some(second) = start.get(1) {
            let second = if shaped {
                (second / first).min(largest)
            } else {
                *second
            };
            parameters.push(Parameter::new("second", second).within(0.0, largest));
        }
        let printed = |values: &[f64]| match (shaped, values) {
            (true, &[modulus, shape]) => vec![modulus * (1.0 - shape), modulus * shape],
            _ => values.to_vec(),
        };
        let settings = Settings {
            tolerance: TOLERANCE,
            iterations: STEPS,
            ..Settings::default()
        };
        let fit = least_squares(
            &parameters,
            measured.len(),
            &settings,
            |values, residuals| self.residuals(&printed(values), measured, residuals),
        )?;
        Ok(fit
            .iterations
            .iter()
            .map(|each| printed(&each.values))
            .collect())
    }
}

/// Whether every parameter is within one part in a hundred of the truth.
pub(super) fn near(values: &[f64], truth: &[f64]) -> bool {
    let each = values.iter().zip(truth);
    each.into_iter()
        .all(|(value, truth)| (value / truth - 1.0).abs() <= NEAR)
}

/// Steps after which the parameters stay near the truth.
pub(super) fn steps(way: &[Vec<f64>], truth: &[f64]) -> usize {
    let far = way.iter().rposition(|values| !near(values, truth));
    far.map_or(0, |last| last + 1)
}
