//! The first contact where the sensor's zero drifts while the indenter approaches.
//!
//! Over the force up to a quarter of its rise, the contact with a line over time before it is compared with that with a
//! constant, each with as much noise as is seen before and after it. The line is a drift where its slope is certain and is
//! less than 5 % of the mean rate of loading up to half of the force, and its likelihood is significantly larger: tissue that
//! is soft at first rises faster than that (silicone in `real::…` 18 to 30 %), drifts of real curves slower (at most 0.5 %).
//! A drift is straight only for a while: the contact is then found again from as far before it as the indenter presses after
//! it, in the first 5 % of what the force rises above the line.
//!
//! *How we know*: `contact::contact_is_found_over_a_drift`, straight and curved drifts of a generator of its own, with white
//! and with correlated noise; `real::…`.
//!
//! *Limits*: the drift is taken off as it is at contact; later drift only gives a warning. Where a drift hides the beginning of the
//! rise, the contact depends on how the force is assumed to rise: half the range between the three rises is in its error.

use super::Oriented;
use super::contact::{Contact, RISES, early_end, thinned};
use super::contact_search::{Baseline, CHI_SQUARED, ENOUGH_FOR_DRIFT, Search, correlation, range};
use super::regression::{Regression, regress};

/// Parts of the rise of the force that are looked at, first and then [-].
const WIDE: f64 = 0.25;
const EARLY: f64 = 0.05;
/// The largest rate of a drift, over the mean rate of loading up to half of the force [-].
const SLOW: f64 = 0.05;
/// Standard errors from which a drift is certain [-].
const CERTAIN: f64 = 4.0;
/// Rounds in which the contact is found again.
const ROUNDS: usize = 3;

/// A line through the force before contact.
struct Line {
    fit: Regression,
    middle: f64,
    /// Number of samples that are worth one of white noise [-].
    correlated: f64,
}

impl Line {
    fn through(samples: &Oriented, from: usize, place: usize) -> Option<Self> {
        let (time, force) = (&samples.time[from..=place], &samples.force[from..=place]);
        let middle = 0.5 * (samples.time[from] + samples.time[place]);
        let fit = regress(force, |sample| [1.0, time[sample] - middle])?;
        let mut line = Self {
            fit,
            middle,
            correlated: 1.0,
        };
        let both = time.iter().zip(force);
        let left: Vec<f64> = both.map(|(t, f)| f - line.at(*t)).collect();
        line.correlated = correlation(&left);
        Some(line)
    }

    fn slope(&self) -> f64 {
        self.fit.coefficients[1]
    }

    fn at(&self, time: f64) -> f64 {
        self.fit.coefficients[0] + self.slope() * (time - self.middle)
    }

    fn error_at(&self, time: f64) -> f64 {
        let [value, slope] = [0, 1].map(|place| self.fit.standard_errors[place]);
        value.hypot(slope * (time - self.middle)) * self.correlated.sqrt()
    }

    /// Whether it is certain, and slow next to the rise of the force after `place`.
    fn is_drift(&self, samples: &Oriented, place: usize) -> bool {
        let zero = self.at(samples.time[place]);
        let largest = samples
            .force
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let half = 0.5 * (largest - zero);
        let mut after = samples.time[place..].iter().zip(&samples.force[place..]);
        let reaches = after.find(|(_, force)| **force - zero >= half);
        let Some((time, _)) = reaches.filter(|_| half > 0.0) else {
            return false;
        };
        let error = self.fit.standard_errors[1] * self.correlated.sqrt();
        let slow = self.slope().abs() * (time - samples.time[place]) < SLOW * half;
        slow && self.slope().abs() > CERTAIN * error
    }
}

/// The contact over a drift; none where there is no drift.
pub(super) fn contact(samples: &Oriented, rises: &[fn(f64) -> f64]) -> Option<Contact> {
    let end = early_end(&samples.force, WIDE);
    let (approach, every) = thinned(samples, 0..end);
    let line = Search::new(&approach, rises, Baseline::Line).best(1.0)?;
    let constant = Search::new(&approach, rises, Baseline::WanderingConstant).best(1.0)?;
    let mut place = line.place * every;
    let first = Line::through(samples, 0, place)?;
    let gain = constant.misfit - line.misfit;
    if !first.is_drift(samples, place) || gain <= CHI_SQUARED * first.correlated {
        return None;
    }
    let deepest = samples
        .depth
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let mut error = line.error;
    let mut from = 0;
    for _ in 0..ROUNDS {
        let above = 2.0 * samples.depth[place] - deepest;
        let far = samples.depth[..=place].iter().rposition(|d| *d < above);
        from = far.map_or(0, |far| far + 1);
        from = from.min(place.saturating_sub(2 * ENOUGH_FOR_DRIFT));
        let line = Line::through(samples, from, place)?;
        let both = samples.time[from..].iter().zip(&samples.force[from..]);
        let above_line: Vec<f64> = both.map(|(t, f)| f - line.at(*t)).collect();
        let end = (from + early_end(&above_line, EARLY)).max(place + 2);
        let (approach, every) = thinned(samples, from..end.min(samples.force.len()));
        let of = |rises| Search::new(&approach, rises, Baseline::Line).best(first.correlated);
        let (found, any) = (of(rises)?, of(&RISES)?);
        error = found.error.hypot(0.5 * range(&any.of_rises));
        let next = from + found.place * every;
        if next == place {
            break;
        }
        place = next;
    }
    let line = Line::through(samples, from, place)?;
    let time_s = samples.time[place];
    Some(Contact {
        sample: place,
        time_s,
        depth_m: samples.depth[place],
        depth_error_m: Some(error),
        offset_n: line.at(time_s),
        offset_error_n: Some(line.error_at(time_s)),
        drift_n_per_s: Some(line.slope()),
    })
}
