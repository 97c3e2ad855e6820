//! Online estimation during a press: modulus and two relaxation terms with their 95 % intervals, after any sample.
//!
//! ```text
//! sample ──contact──▶ record of bounded length ──▶ relaxation of two terms ──▶ neo-Hookean law ──▶ OnlineEstimate
//! ```
//!
//! [`OnlineEstimator::add`] takes one sample: it adds to a mean and allocates nothing. The record holds at most
//! [`MAX_BLOCKS`] blocks, each the mean of equally many samples; when it is full, neighbouring blocks are merged.
//! [`OnlineEstimator::estimate`] fits that record as [`characterize`](crate::characterize) fits a recording: the same
//! force F(t) = M [f(d) − Σ gᵢ hᵢ], the same covariance of correlated residuals, the same bounds of the model. It starts
//! from the estimate before, and costs as much after an hour as after seconds. The force over depth is tabulated or solved
//! once, when the estimator is made; no finite elements run afterwards.
//!
//! A parameter without an interval is not known yet: half of it would be larger than the value. Terms are known both or
//! not at all; until the information criterion prefers two of them, one takes their place in the fit and is not stated.
//!
//! *How we know*: `online::…`: coverage on recordings of independent finite elements and of the virtual rig, and agreement
//! with the fit of the whole recording.
//!
//! *Limits*: one press; neo-Hookean tissue; forces on the tissue are positive and depths grow into it.

mod contact;
mod estimate;
mod record;

use palpate_files::recording::RecordingHeader;

use crate::Error;
use crate::inverse::{Body, CandidateLaw, Curves, has_curve};
use contact::ContactDetector;
use estimate::Fitted;
pub use estimate::{OnlineEstimate, OnlineParameter};
pub use record::OnlineSample;
use record::Record;

/// Blocks of the record, at most.
pub const MAX_BLOCKS: usize = 1024;
/// The relative half interval at which a parameter is known well enough by default [-].
pub const DEFAULT_TARGET: f64 = 0.1;
/// Depth to which the force is known by default, in radii of the indenter [-]: that of the table.
const DEEPEST: f64 = 8.0;

/// How the depth of the first contact is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OnlineContact {
    /// Depths count from first contact, which is known with this standard error [m].
    Stated {
        /// Standard error of the depth of the first contact [m].
        error_m: f64,
    },
    /// Depths count from anywhere; the contact is where the force begins to rise.
    Detected,
}

/// What is pressed, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct OnlineSettings {
    /// Specimen and indenter: the keys of a recording's header.
    pub header: RecordingHeader,
    /// How the first contact is known.
    pub contact: OnlineContact,
    /// The deepest press [m]; none for eight radii of the indenter.
    pub deepest_m: Option<f64>,
}

impl OnlineSettings {
    /// The deepest press [m].
    fn deepest(&self) -> Result<f64, Error> {
        let radius = self.header.indenter_radius_m;
        let deepest = self.deepest_m.or(radius.map(|radius| DEEPEST * radius));
        let unknown = Error::Unknown {
            key: "indenter_radius_m",
        };
        let deepest = deepest.ok_or(unknown)?;
        match deepest > 0.0 && deepest.is_finite() {
            true => Ok(deepest),
            false => Err(Error::NoContactForce),
        }
    }

    /// Whether the force over depth is tabulated, so that an estimator is made at once: on a large piece under a flat punch
    /// down to eight radii. Elsewhere finite elements take seconds to minutes.
    pub fn is_tabulated(&self) -> bool {
        let is_there = || {
            let deepest = self.deepest()?;
            let body = Body::of(&self.header, deepest)?;
            Ok::<_, Error>(has_curve(&body, CandidateLaw::NeoHookean, deepest))
        };
        is_there().unwrap_or(false)
    }
}

/// An estimate that is updated while tissue is pressed.
#[derive(Debug, Clone)]
pub struct OnlineEstimator {
    settings: OnlineSettings,
    curves: Curves,
    watch: ContactDetector,
    pressed: Record,
    /// Time of the last sample [s].
    last: f64,
    skipped: usize,
    is_released: bool,
    before: Option<Fitted>,
}

impl OnlineEstimator {
    /// Makes room for everything, and solves the force over depth if it is not tabulated: on a large piece under a flat
    /// punch it is.
    ///
    /// # Errors
    /// When the indenter or the specimen is not known or not possible, or no equilibrium is found down to the deepest depth.
    pub fn new(settings: OnlineSettings) -> Result<Self, Error> {
        let deepest = settings.deepest()?;
        let body = Body::of(&settings.header, deepest)?;
        let mut curves = Curves::new(body, CandidateLaw::NeoHookean, deepest);
        curves.of(f64::INFINITY, &[])?;
        Ok(Self {
            watch: ContactDetector::new(settings.contact, settings.header.indenter_shape),
            curves,
            settings,
            pressed: Record::new(MAX_BLOCKS),
            last: f64::NEG_INFINITY,
            skipped: 0,
            is_released: false,
            before: None,
        })
    }

    /// Forgets the press, for the next one.
    pub fn restart(&mut self) {
        self.watch =
            ContactDetector::new(self.settings.contact, self.settings.header.indenter_shape);
        self.pressed.clear();
        self.last = f64::NEG_INFINITY;
        self.skipped = 0;
        self.is_released = false;
        self.before = None;
    }

    /// Takes a sample, at an even rate. One that is not finite, or not later than the one before, is skipped and counted. What
    /// comes after the indenter has left the tissue is no part of the press.
    pub fn add(&mut self, sample: OnlineSample) {
        let is_good = sample.is_finite() && sample.time_s > self.last;
        if !is_good {
            self.skipped += 1;
            return;
        }
        self.last = sample.time_s;
        if self.is_released {
            return;
        }
        if !self.watch.is_touching() {
            let pressed = &mut self.pressed;
            self.watch.add(sample, &mut |own| pressed.add(own));
            return;
        }
        if self.watch.is_withdrawn(&sample) {
            self.is_released = true;
            return;
        }
        self.watch.refine(sample);
        self.pressed.add(sample);
    }

    /// Whether the tissue was touched.
    pub fn is_touching(&self) -> bool {
        self.watch.is_touching()
    }

    /// The estimate from all samples so far.
    pub fn estimate(&mut self) -> OnlineEstimate {
        let found = self.fitted();
        let since = self.watch.contact().map_or(0.0, |contact| {
            (self.pressed.end().unwrap_or(contact.time_s) - contact.time_s).max(0.0)
        });
        let estimate = OnlineEstimate::of(found.as_ref(), since, self);
        if found.is_some() {
            self.before = found;
        }
        estimate
    }

    fn fitted(&mut self) -> Option<Fitted> {
        let contact = self.watch.contact()?;
        let shape = self.settings.header.indenter_shape;
        let samples = self.pressed.since(&contact).at_rest(shape);
        Fitted::of(&samples, &mut self.curves, self.before.as_ref())
    }

    /// Samples that were skipped.
    pub fn skipped(&self) -> usize {
        self.skipped
    }
}
