//! Evaluates a fitted law at other depths, times or stretches.

use std::collections::BTreeMap;

use nalgebra::DMatrix;
use palpate_characterize::inverse::{CandidateLaw, ElasticForce, standard_errors};
use palpate_characterize::lumped::{PieceLoading, PieceTest, piece_stress};
use palpate_mechanics::{IndentationCurve, PronySeries};
use serde::Deserialize;

use super::Choice;
use super::answer::{CovarianceAnswer, ElasticAnswer};
use crate::Error;

/// A fitted law, as in its answer.
#[derive(Debug, Deserialize)]
pub struct FoundLaw {
    /// Its name in files.
    pub law: String,
    /// By their keys.
    pub values: BTreeMap<String, f64>,
    /// Pairs of gᵢ [-] and τᵢ [s].
    pub series: Vec<(f64, f64)>,
    /// Of its parameters and the relaxation's.
    pub covariance: CovarianceAnswer,
    /// Its elastic force; null of a piece.
    pub elastic: Option<ElasticAnswer>,
    /// How the piece was deformed, of a piece.
    #[serde(default)]
    pub test: Option<PieceTest>,
    /// The angle of its loading to the axis of its fibres [degrees], of a law with fibres.
    #[serde(default)]
    pub fibre_axis_angle_deg: Option<f64>,
}

/// Relative step of a finite-difference derivative of a stress [-]: half the digits.
const STEP: f64 = 1e-6;

impl FoundLaw {
    /// Forces [N] at `course`, depths [m], over `time` [s] or at once without it; of a piece nominal stresses [Pa] at
    /// stretches or amounts of shear [-]. Each with its standard error.
    ///
    /// # Errors
    /// When times and depths are not as many, times do not ascend, or a stretch is none.
    pub fn evaluate(&self, time: Option<&[f64]>, course: &[f64]) -> Result<Vec<[f64; 2]>, Error> {
        if let Some(time) = time {
            self.check(time, course)?;
        }
        if let Some(wrong) = course.iter().find(|x| !x.is_finite()) {
            return Err(Error::input(format!(
                "a depth or stretch is {wrong}; give finite numbers"
            )));
        }
        let Some(elastic) = &self.elastic else {
            return self.stresses(course);
        };
        let through = |forces: &[f64]| IndentationCurve::through(&elastic.depth_m, forces);
        let by = elastic.sensitivities.iter();
        let force = ElasticForce {
            force: through(&elastic.force_n),
            sensitivities: by.map(|(name, own)| (name.clone(), through(own))).collect(),
        };
        let series = PronySeries::new(&self.series)?;
        let known = self.covariance.correlations();
        Ok(force.evaluate(time, course, &series, &known))
    }

    fn check(&self, time: &[f64], course: &[f64]) -> Result<(), Error> {
        if self.elastic.is_none() {
            return Err(Error::input(
                "times are given for a piece, whose stress is of its stretch alone; leave them out",
            ));
        }
        if time.len() != course.len() {
            return Err(Error::input(format!(
                "there are {} times and {} depths; give as many of both",
                time.len(),
                course.len()
            )));
        }
        if let Some(place) = (1..time.len()).find(|&i| time[i] <= time[i - 1]) {
            return Err(Error::input(format!(
                "time {} s follows {} s; give times that ascend",
                time[place],
                time[place - 1]
            )));
        }
        Ok(())
    }

    fn stresses(&self, stretches: &[f64]) -> Result<Vec<[f64; 2]>, Error> {
        let law = Choice::law_named(&self.law, None)?;
        let law =
            CandidateLaw::with_parameters(law.name(), self.values.len()).ok_or_else(|| {
                Error::input(format!(
                    "the law `{}` has {} parameters; give those that were found",
                    self.law,
                    self.values.len()
                ))
            })?;
        let loading = PieceLoading {
            test: self.test.unwrap_or_default(),
            fibre_axis_angle_deg: self.fibre_axis_angle_deg,
        };
        let names = law.names();
        let known = |name: &&str| self.values.get(*name).copied().unwrap_or(0.0);
        let values: Vec<f64> = names.iter().map(known).collect();
        let at = |values: &[f64]| -> Result<Vec<f64>, Error> {
            let each = stretches.iter();
            let each = each.map(|stretch| piece_stress(law, loading, values, *stretch));
            Ok(each.collect::<Result<_, _>>()?)
        };
        let known = self.covariance.correlations();
        let mut derivatives = DMatrix::zeros(stretches.len(), known.names.len());
        for (column, name) in known.names.iter().enumerate() {
            let Some(place) = names.iter().position(|own| own == name) else {
                continue;
            };
            let step = STEP * values[place].abs().max(STEP);
            let [mut above, mut below] = [values.clone(), values.clone()];
            above[place] += step;
            below[place] -= step;
            for (row, (above, below)) in at(&above)?.iter().zip(at(&below)?).enumerate() {
                derivatives[(row, column)] = (above - below) / (2.0 * step);
            }
        }
        let errors = standard_errors(&derivatives, &known.covariance);
        Ok(at(&values)?
            .into_iter()
            .zip(errors)
            .map(<[f64; 2]>::from)
            .collect())
    }
}
