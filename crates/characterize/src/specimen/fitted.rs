use std::ops::Range;

use super::{Characterization, Pressed, is_piece};
use crate::CleanRecording;
use crate::fit::{Fit, correlated_uncertainty, with_systematic};
use crate::inverse::{CandidateLaw, LawFit};
use crate::lumped::FittedPiece;

/// A recording versus its fits, sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedRecording {
    /// Its place among the recordings of the specimen.
    pub place: usize,
    /// The samples that were fitted.
    pub samples: Range<usize>,
    /// The relaxation, if one was found.
    pub relaxation: Option<FittedRelaxation>,
    /// The laws that were found.
    pub laws: Vec<FittedLaw>,
}

/// Forces over the instantaneous elastic force at the largest depth [-].
#[derive(Debug, Clone, PartialEq)]
pub struct FittedRelaxation {
    /// As measured.
    pub measured: Vec<f64>,
    /// Of the relaxation with the recorded course of the depth.
    pub fitted: Vec<f64>,
    /// Of the relaxation that takes ramps for steps, for the last samples; empty when none was found.
    pub of_step: Vec<f64>,
}

/// What a law gives: forces [N], or nominal stresses [Pa] of a piece along one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedLaw {
    /// Which.
    pub law: CandidateLaw,
    /// What it gives [N or Pa].
    pub values: Vec<f64>,
    /// How far from them, up and down, the curve of the true parameters lies at most, with the probability
    /// that was asked for [N or Pa]: by noise, and by what the model may be off.
    pub reach: Vec<f64>,
}

impl Characterization {
    /// The `recordings` of this characterization versus its fits; the reach of a law holds with the
    /// probability `level` [-]. Recordings of which nothing is fitted are left out.
    pub fn fitted(&self, recordings: &[CleanRecording], level: f64) -> Vec<FittedRecording> {
        let samples = |recording: &CleanRecording| match self.uniaxial.is_empty() {
            true => Pressed::samples(recording),
            false if is_piece(recording) => FittedPiece::of(recording).ok().map(|own| own.samples),
            false => None,
        };
        let each = recordings.iter().enumerate();
        let mut all: Vec<FittedRecording> = each
            .filter_map(|(place, recording)| {
                Some(FittedRecording {
                    place,
                    samples: samples(recording)?,
                    relaxation: None,
                    laws: Vec::new(),
                })
            })
            .collect();
        for found in self.laws.iter().filter_map(|(_, law)| law.as_ref().ok()) {
            let LawFit { law, fit, .. } = &found.found;
            let forces = found.found.forces.concat();
            add(&mut all, *law, &found.found.systematic, &forces, fit, level);
        }
        for found in self
            .uniaxial
            .iter()
            .filter_map(|(_, law)| law.as_ref().ok())
        {
            let measured = all
                .iter()
                .filter_map(|own| FittedPiece::of(&recordings[own.place]).ok());
            let measured = measured.flat_map(|own| own.stresses);
            let residuals = &found.fit.residuals;
            let values: Vec<f64> = measured.zip(residuals).map(|(own, r)| own + r).collect();
            add(&mut all, found.law, &[], &values, &found.fit, level);
        }
        self.relax(recordings, &mut all);
        all
    }

    fn relax(&self, recordings: &[CleanRecording], all: &mut [FittedRecording]) {
        let Ok(relaxation) = &self.relaxation else {
            return;
        };
        let with_force = all.iter_mut().filter_map(|own| {
            let pressed = Pressed::of(&recordings[own.place])?;
            pressed.has_force().then_some((own, pressed))
        });
        let with_force: Vec<_> = with_force.collect();
        let largest = with_force.iter().map(|(_, pressed)| pressed.largest);
        let largest = largest.fold(0.0, f64::max);
        let found = relaxation.forces.iter().zip(&relaxation.sizes);
        for (course, ((own, pressed), (forces, &size))) in
            with_force.into_iter().zip(found).enumerate()
        {
            let steps = self.relaxation_of_steps.as_ref().ok();
            let of_step = steps.and_then(|steps| steps.forces.get(course));
            let over = |values: &[f64], whole: f64| values.iter().map(|v| v / whole).collect();
            own.relaxation = (size > 0.0).then(|| FittedRelaxation {
                measured: over(&pressed.force, size * largest),
                fitted: over(forces, size),
                of_step: of_step.map_or_else(Vec::new, |forces| over(forces, size)),
            });
        }
    }
}

/// Hands each recording its part of the `values` of a law, with what is `systematic` in its errors.
fn add(
    all: &mut [FittedRecording],
    law: CandidateLaw,
    systematic: &[Vec<f64>],
    values: &[f64],
    fit: &Fit,
    level: f64,
) {
    let lengths: Vec<usize> = all.iter().map(|own| own.samples.len()).collect();
    let free = fit.unbounded();
    let known = with_systematic(correlated_uncertainty(&free, &lengths), &free, systematic);
    let reach = known.prediction_half_widths(&free, level);
    let mut first = 0;
    for (own, length) in all.iter_mut().zip(lengths) {
        let range = first..first + length;
        own.laws.push(FittedLaw {
            law,
            values: values[range.clone()].to_vec(),
            reach: reach[range].to_vec(),
        });
        first += length;
    }
}
