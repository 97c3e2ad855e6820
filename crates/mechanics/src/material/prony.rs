//! Relaxation as a Prony series, and the force that it leaves of an elastic history.
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

    /// What becomes of each branch in `step` [s].
    pub(crate) fn shares(&self, step: f64) -> impl Iterator<Item = Share> + '_ {
        self.terms.iter().map(move |&(g, tau)| {
            let ratio = step / tau;
            let kept = (-ratio).exp();
            // 1 − (1 − e)/ratio cancels for short steps; its series does not.
            let new = if ratio < 1e-4 {
                ratio * (0.5 - ratio / 6.0)
            } else {
                1.0 + (-ratio).exp_m1() / ratio
            };
            Share {
                g,
                kept,
                old: 1.0 - kept - new,
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

/// How a branch goes over a step: h ← kept h + old Fₑ⁰ + new Fₑ¹, each [-].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Share {
    pub(crate) g: f64,
    pub(crate) kept: f64,
    pub(crate) old: f64,
    pub(crate) new: f64,
}

/// What the branches of a series remember of the elastic force of one contact.
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
            *branch = share.kept * *branch + share.old * self.elastic + share.new * elastic;
            force -= share.g * *branch;
        }
        self.elastic = elastic;
        force
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
}
