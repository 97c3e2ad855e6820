//! Design of experiments: ramps and holds that determine the parameters of a guessed tissue best.
//!
//! The errors that a characterization would state follow from the derivatives of force with the parameters at a guess,
//! before anything is pressed [Atkinson et al. 2007]: covariance (JᵀJ)⁻¹ of the noise, and to first order what the
//! zeros of the recordings, the elements and the product of force and G(t) do, as in a fit. Of all protocols within
//! the limits one is sought whose worst parameter is known best at the worst of several guesses (minimax), or whose
//! covariance has the least determinant (D-optimal). Depths are evenly spaced, ramps and holds of one protocol alike.
//!
//! *How we know*: `design::…`: errors of fits that are made, and a protocol against the default one.
//!
//! The effect of a step of the depth on a press is noise to a fit, with as many degrees of freedom as there are presses:
//! the interval of few presses is wide, and expected to be.
//!
//! *Limits*: to first order around the guesses; flat punches on specimens that are large relative to them, as the rig presses.

mod expected;
mod search;

use palpate_mechanics::PronySeries;

use crate::inverse::{CandidateLaw, ZeroErrors};

pub use expected::{ExpectedCurve, ExpectedParameter};
pub use search::{Criterion, OptimizedProtocol, design};

/// A tissue as it may be.
#[derive(Debug, Clone, PartialEq)]
pub struct Guess {
    /// The law.
    pub law: CandidateLaw,
    /// Its modulus [Pa].
    pub modulus: f64,
    /// Its shapes [-].
    pub shape: Vec<f64>,
    /// How it relaxes.
    pub series: PronySeries,
}

impl Guess {
    /// Tissue whose modulus is `stiffer` [-] and whose times are `slower` [-] times those of this one.
    ///
    /// # Errors
    /// When a time is none.
    pub fn changed(&self, stiffer: f64, slower: f64) -> Result<Self, palpate_mechanics::Error> {
        let terms = self.series.terms().iter();
        let terms: Vec<_> = terms.map(|(g, tau)| (*g, slower * tau)).collect();
        Ok(Self {
            modulus: stiffer * self.modulus,
            series: PronySeries::new(&terms)?,
            ..self.clone()
        })
    }
}

/// Errors of recordings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instrument {
    /// Standard deviation of independent noise of a sample that is equivalent to the true noise [N].
    pub noise: f64,
    /// Samples in a second [Hz].
    pub rate: f64,
    /// Of the zeros of each recording; that of the depth contains the resolution of the depth.
    pub zeros: ZeroErrors,
}

/// Presses with one indenter, each a ramp and a hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Presses {
    /// Radius of the indenter [m].
    pub radius: f64,
    /// One press for each [m].
    pub depths: Vec<f64>,
    /// How long each goes down [s].
    pub ramp: f64,
    /// How long each stays [s].
    pub hold: f64,
}

impl Presses {
    /// How long all take, without the rest between them [s].
    pub fn duration(&self) -> f64 {
        self.depths.len() as f64 * (self.ramp + self.hold)
    }

    /// The deepest [m].
    pub fn deepest(&self) -> f64 {
        self.depths.iter().copied().fold(0.0, f64::max)
    }
}

/// Limits of the protocols.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// [m]
    pub depth: f64,
    /// [N]
    pub force: f64,
    /// Mean speed of a ramp [m/s].
    pub speed: f64,
    /// Of all presses together, without the rest between them [s].
    pub time: f64,
    /// Of one press [s], such as a held breath.
    pub press: f64,
    /// Most presses.
    pub presses: usize,
    /// Indenters that there are: their radii [m].
    pub radii: Vec<f64>,
}
