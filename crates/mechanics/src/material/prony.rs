//! Relaxation as a Prony series, and the relaxed force of an elastic history.
//!
//! G(t) = G₀ [1 − Σ gᵢ (1 − exp(−t/τᵢ))], gᵢ relative to the instantaneous modulus. With one relaxation
//! function for the whole body the force is F(t) = Fₑ(t) − Σ gᵢ hᵢ(t), where τᵢ ḣᵢ = Fₑ − hᵢ is what
//! branch i has relaxed towards. Between two times Fₑ is taken as linear, and then the step
//!   h ← e h + (1 − e − φ) Fₑ⁰ + φ Fₑ¹,  e = exp(−Δt/τ),  φ = 1 − (1 − e) τ/Δt
//! is exact [Taylor, Pister and Goudreau 1970].
//!
//! *How we know*: `analytic::step_relaxes_as_the_series`, `analytic::ramp_is_the_closed_integral`.
//!
//! *Limits*: quasi-linear: exact when the elastic force is that of the whole displacement history.

use nalgebra::Matrix3;

use crate::{Error, Vec3};

/// Most terms that a series may have, so that a history needs no allocation.
pub const MAX_TERMS: usize = 8;

/// A relaxation function of at most [`MAX_TERMS`] terms.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PronySeries {
    terms: Vec<(f64, f64)>,
}

impl PronySeries {
    /// From pairs of gᵢ [-] and τᵢ [s]; no pair means an elastic tissue.
    ///
    /// # Errors
    /// Unless every 0 ≤ gᵢ, every 0 < τᵢ, Σ gᵢ < 1 and there are at most [`MAX_TERMS`].
    pub fn new(terms: &[(f64, f64)]) -> Result<Self, Error> {
        let sum: f64 = terms.iter().map(|(g, _)| g).sum();
        let each = |&(g, tau): &(f64, f64)| g >= 0.0 && tau > 0.0 && tau.is_finite();
        if sum < 1.0 && terms.iter().all(each) && terms.len() <= MAX_TERMS {
            Ok(Self {
                terms: terms.to_vec(),
            })
        } else {
            Err(Error::NoRelaxation {
                sum,
                terms: terms.len(),
            })
        }
    }

    /// Its pairs of gᵢ [-] and τᵢ [s].
    pub fn terms(&self) -> &[(f64, f64)] {
        &self.terms
    }

    /// The share of each branch in `step` [s].
    pub(crate) fn shares(&self, step: f64) -> impl Iterator<Item = Share> + '_ {
        self.terms.iter().map(move |&(g, tau)| {
            let ratio = step / tau;
            let decay = (-ratio).exp();
            // 1 − (1 − e)/ratio cancels for short steps; its series does not.
            let new = if ratio < 1e-4 {
                ratio * (0.5 - ratio / 6.0)
            } else {
                1.0 + (-ratio).exp_m1() / ratio
            };
            Share {
                g,
                decay,
                old: 1.0 - decay - new,
                new,
            }
        })
    }

    /// G(t)/G₀ [-] at `time` [s] after a step.
    pub fn relaxation(&self, time: f64) -> f64 {
        let relaxed = |&(g, tau): &(f64, f64)| g * -(-time / tau).exp_m1();
        1.0 - self.terms.iter().map(relaxed).sum::<f64>()
    }
}

/// The history variable h [N] of one branch of a series at each time [s] of an elastic force [N] that is
/// linear between them and begins with a jump; and how h changes with the logarithm of the branch's
/// `time_constant` [s]. The relaxed force is Fₑ − Σ gᵢ hᵢ, so a fit of gᵢ and τᵢ needs no more than these.
pub fn branch(time_constant: f64, times: &[f64], elastic: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let series = PronySeries {
        terms: vec![(0.0, time_constant)],
    };
    let (mut values, mut slopes) = (
        Vec::with_capacity(times.len()),
        Vec::with_capacity(times.len()),
    );
    let (mut h, mut slope) = (0.0, 0.0);
    let mut before: Option<(f64, f64)> = None;
    let mut known: Option<(f64, Share, [f64; 2])> = None;
    for (&time, &force) in times.iter().zip(elastic) {
        let (start, from) = before.unwrap_or((time, force));
        let step = time - start;
        // Most recordings are evenly spaced but for the last digits of their file.
        let as_before = known.filter(|(length, ..)| (step - length).abs() <= 1e-7 * length);
        known = as_before.or_else(|| {
            let share = series.shares(step).next()?;
            let ratio = step / time_constant;
            let by_time = [ratio * share.decay, (-ratio).exp_m1() + share.new];
            Some((step, share, by_time))
        });
        if let Some((_, share, [decay, new])) = known {
            slope = share.decay * slope + decay * (h - from) + new * (force - from);
            h = share.decay * h + share.old * from + share.new * force;
        }
        values.push(h);
        slopes.push(slope);
        before = Some((time, force));
    }
    (values, slopes)
}

/// The update of a branch in a step: h ← decay h + old Fₑ⁰ + new Fₑ¹, each [-].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Share {
    pub(crate) g: f64,
    pub(crate) decay: f64,
    pub(crate) old: f64,
    pub(crate) new: f64,
}

/// History variables of a series for the elastic force of one contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ForceHistory {
    branches: [Vec3; MAX_TERMS],
    elastic: Vec3,
}

impl ForceHistory {
    /// The relaxed force [N] after the elastic force has gone linearly to `elastic` [N] in `step` [s];
    /// a `step` of zero is a jump.
    pub fn advance(&mut self, series: &PronySeries, elastic: Vec3, step: f64) -> Vec3 {
        let mut force = elastic;
        for (branch, share) in self.branches.iter_mut().zip(series.shares(step)) {
            *branch = share.decay * *branch + share.old * self.elastic + share.new * elastic;
            force -= share.g * *branch;
        }
        self.elastic = elastic;
        force
    }

    /// The share γ [-] and the history [N] of the relaxed force γ Fₑ − history that [`Self::advance`] will find for any elastic
    /// force Fₑ at the end of a `step` [s].
    pub fn predict(&self, series: &PronySeries, step: f64) -> (f64, Vec3) {
        let (mut follows, mut history) = (1.0, Vec3::zeros());
        for (branch, share) in self.branches.iter().zip(series.shares(step)) {
            follows -= share.g * share.new;
            history += share.g * (share.decay * branch + share.old * self.elastic);
        }
        (follows, history)
    }

    /// The last elastic force [N].
    pub fn elastic(&self) -> Vec3 {
        self.elastic
    }

    /// Rotates the history by `rotation` [-].
    pub fn turn(&mut self, rotation: &Matrix3<f64>) {
        for force in self.branches.iter_mut().chain([&mut self.elastic]) {
            *force = rotation * *force;
        }
    }

    /// Keeps only the part of the history along the unit vector `direction` [-].
    pub fn project_onto(&mut self, direction: &Vec3) {
        for force in self.branches.iter_mut().chain([&mut self.elastic]) {
            *force = direction * direction.dot(force);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_does_not_relax() {
        assert!(PronySeries::new(&[(0.6, 1.0), (0.4, 2.0)]).is_err());
        assert!(PronySeries::new(&[(-0.1, 1.0)]).is_err());
        assert!(PronySeries::new(&[(0.1, 0.0)]).is_err());
        assert!(PronySeries::new(&[(0.01, 1.0); 9]).is_err());
    }

    /// A branch is that of a force history, and its slope that of two neighbours: by their difference of
    /// 2e-5 in ln τ, which leaves an error of its square.
    #[test]
    fn a_branch_is_that_of_a_history() {
        let times: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
        let elastic: Vec<f64> = times.iter().map(|t| (3.0 * t).min(1.5)).collect();
        for tau in [0.004, 0.3, 90.0] {
            let (values, slopes) = branch(tau, &times, &elastic);
            let series = PronySeries::new(&[(0.5, tau)]).unwrap();
            let mut history = ForceHistory::default();
            let near = |factor: f64| branch(tau * factor, &times, &elastic).0;
            let (more, less) = (near(1.0 + 1e-5), near(1.0 - 1e-5));
            for i in 0..times.len() {
                let step = if i == 0 { 0.0 } else { times[i] - times[i - 1] };
                let force = history
                    .advance(&series, Vec3::new(elastic[i], 0.0, 0.0), step)
                    .x;
                assert!(
                    (elastic[i] - 0.5 * values[i] - force).abs() < 1e-9,
                    "{tau} {i}"
                );
                let slope = (more[i] - less[i]) / 2e-5;
                assert!(
                    (slope - slopes[i]).abs() < 1e-6,
                    "{tau} {i}: {slope} {}",
                    slopes[i]
                );
            }
        }
    }
}
