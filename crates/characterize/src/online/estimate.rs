use std::f64::consts::SQRT_2;
use std::fmt;

use palpate_files::Estimate;
use palpate_files::quantity::plain_quantity;
use serde::Serialize;

use super::OnlineEstimator;
use super::record::Samples;
use crate::inverse::{Curves, Indentation, LawDescription, law_fit};
use crate::viscoelastic::{PressedRelaxation, Relaxation, RelaxationRecord};

/// Terms of the relaxation.
const TERMS: usize = 2;
/// Blocks that are fitted, at least.
pub(super) const FEWEST: usize = 64;
/// A record so much longer than that of the last search from everywhere is searched from everywhere again [-].
const LONGER: f64 = 1.25;

/// The tissue as far as it is known.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OnlineEstimate {
    /// Time since first contact [s].
    pub time_s: f64,
    /// c10_pa, g_1, tau_1_s, g_2, tau_2_s; the first term is the faster one.
    pub parameters: [OnlineParameter; 5],
    /// Samples that were skipped: not finite, or not later than the one before.
    pub skipped: usize,
}

/// One number of the tissue.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OnlineParameter {
    /// Its name, with its unit.
    pub name: &'static str,
    /// The most likely value [its unit]; none while nothing can be fitted.
    pub value: Option<f64>,
    /// The interval that contains the true value with a probability of 95 % [its unit]; none while it is not known.
    pub interval_95: Option<[f64; 2]>,
}

/// Names of the parameters.
const NAMES: [&str; 5] = ["c10_pa", "g_1", "tau_1_s", "g_2", "tau_2_s"];

impl OnlineParameter {
    /// Whether it is known: it has an interval.
    pub fn is_known(&self) -> bool {
        self.interval_95.is_some()
    }

    /// Half the width of its interval over its value [-]; none while it is not known.
    pub fn relative_half_interval(&self) -> Option<f64> {
        let [low, high] = self.interval_95?;
        Some(0.5 * (high - low) / self.value?.abs())
    }
}

impl OnlineEstimate {
    /// Whether the relative half interval of each parameter is at most `target` [-].
    pub fn is_enough(&self, target: f64) -> bool {
        let is_below = |own: &OnlineParameter| {
            own.relative_half_interval()
                .is_some_and(|half| half <= target)
        };
        self.parameters.iter().all(is_below)
    }

    /// The parameters that are not known yet, by their names.
    pub fn unknown(&self) -> impl Iterator<Item = &'static str> + '_ {
        let unknown = self.parameters.iter().filter(|own| !own.is_known());
        unknown.map(|own| own.name)
    }

    pub(super) fn of(found: Option<&Fitted>, time_s: f64, from: &OnlineEstimator) -> Self {
        let unknown = |name| OnlineParameter {
            name,
            value: None,
            interval_95: None,
        };
        Self {
            time_s,
            parameters: found.map_or_else(|| NAMES.map(unknown), Fitted::parameters),
            skipped: from.skipped(),
        }
    }
}

/// Each parameter with half its 95 % interval, and those that are not known yet.
impl fmt::Display for OnlineEstimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "after {:.1} s:", self.time_s)?;
        let known = self.parameters.iter().filter_map(|own| {
            let half = own.relative_half_interval()? * own.value?.abs();
            let name = own.name.trim_end_matches("_pa").trim_end_matches("_s");
            Some(format!(
                " {name} {}",
                plain_quantity(own.name, own.value?, Some(half))
            ))
        });
        let unknown: Vec<&str> = self.unknown().collect();
        let unknown = unknown.join(", ").replace("_pa", "").replace("_s", "");
        let mut all: Vec<String> = known.collect();
        if !unknown.is_empty() {
            all.push(format!(" {unknown} not yet known"));
        }
        f.write_str(&all.join(","))
    }
}

/// What was fitted last.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    pressed: PressedRelaxation,
    law: LawDescription,
    /// Standard error of the modulus because one term is fitted where there may be two [Pa].
    by_second_term: f64,
    /// Relative error of the modulus, at most, because the tissue moves by itself [-].
    by_motion: f64,
    /// Length of the record that was searched from everywhere last [s].
    searched: f64,
}

impl Fitted {
    /// Fits `samples`; none while they show too little.
    pub(super) fn of(
        samples: &Samples,
        curves: &mut Curves,
        before: Option<&Self>,
    ) -> Option<Self> {
        let length = samples.time.last()? - samples.time.first()?;
        if samples.time.len() < FEWEST {
            return None;
        }
        let afresh = before.is_none_or(|own| length >= LONGER * own.searched);
        let curve = curves.of(f64::INFINITY, &[]).ok()?.force;
        let shape = |depth: f64| curve.force(depth);
        let largest = samples.force.iter().copied().fold(0.0, f64::max);
        let (time, depth, force) = (&samples.time, &samples.depth, &samples.force);
        let record = RelaxationRecord::new(time, depth, force, largest, shape)?;
        let record = record.with_zeros(depth, samples.zeros, largest, shape);
        let start = before.map(|own| &own.pressed);
        let pressed = PressedRelaxation::of(&record, start, afresh).ok()?;
        let indentation = Indentation {
            time,
            depth,
            force,
            zeros: samples.zeros,
        };
        let law = law_fit(curves, &[indentation], &pressed.relaxation.series).ok()?;
        let law = LawDescription::of(law, &[indentation]);
        let mut by_second_term = 0.0;
        if let Some(series) = &pressed.two_terms {
            let other = law_fit(curves, &[indentation], series).ok()?;
            let other = LawDescription::of(other, &[indentation]);
            let moduli = [&law, &other].map(|law| law.parameters.first().map(|own| own.1));
            let [Some(own), Some(other)] = moduli else {
                return None;
            };
            by_second_term = missing_term(&own, &other)?;
        }
        Some(Self {
            by_motion: motion(&pressed.relaxation, &record),
            pressed,
            law,
            by_second_term,
            searched: match (afresh, before) {
                (false, Some(own)) => own.searched,
                _ => length,
            },
        })
    }

    fn parameters(&self) -> [OnlineParameter; 5] {
        let modulus = self.law.parameters.first().map(|(_, own)| {
            let quantile = self.law.uncertainty.quantile(0, 0.95);
            let error = own
                .standard_error
                .map(|error| error.hypot(self.by_second_term));
            let half = quantile.zip(error);
            let half = half.map(|(t, error)| (t * error).hypot(self.by_motion * own.value));
            (own.value, half)
        });
        let relaxation = &self.pressed.relaxation;
        let terms = relaxation.terms.iter().zip(&relaxation.quantiles);
        let of_terms = terms.flat_map(|(term, quantiles)| {
            [0, 1].map(|place| {
                let own = term[place];
                let half = own.standard_error.map(|error| quantiles[place] * error);
                (own.value, half)
            })
        });
        // One term alone is a mixture of both.
        let of_terms = of_terms.filter(|_| relaxation.terms.len() == TERMS);
        let mut all = modulus.into_iter().chain(of_terms);
        let mut found = NAMES.map(|name| {
            let (value, half) = all.next().unwrap_or((f64::NAN, None));
            let value = Some(value).filter(|value| value.is_finite());
            let is_telling =
                |half: &f64| value.is_some_and(|value| (0.0..value.abs()).contains(half));
            let half = half.filter(is_telling);
            let interval = |(value, half): (f64, f64)| match name.ends_with("_s") {
                // The fit is in the logarithm of a time.
                true => [-1.0, 1.0].map(|side| value * (side * half / value).exp()),
                false => [value - half, value + half],
            };
            OnlineParameter {
                name,
                value,
                interval_95: value.zip(half).map(interval),
            }
        });
        // The terms are distinguished; otherwise none of their numbers would mean what its name says.
        if !found.iter().skip(1).all(OnlineParameter::is_known) {
            for own in &mut found[1..] {
                own.interval_95 = None;
            }
        }
        found
    }
}

/// Relative error of the modulus, at most, because the tissue moves by itself [-], before the swing of its force is seen and taken
/// out. The indenter touches it at any phase of that motion, so that the zero of the depth is off by up to the amplitude. The
/// residual of the relaxation is the motion times the slope of the force; the amplitude of a sine is √2 times its root mean
/// square. The residual also contains the noise of the sensor, which makes this larger than it needs to be.
fn motion(relaxation: &Relaxation, record: &RelaxationRecord) -> f64 {
    let count = record.force.len() as f64;
    let residual = (relaxation.sum_of_squares / count).sqrt();
    let mean = record.force.iter().sum::<f64>() / count;
    SQRT_2 * residual / mean
}

/// Standard error of a modulus that was found with one term because there may be two [Pa], from both moduli: how far they are
/// apart, and how well that is known, whose variance is the difference of theirs [Hausman 1978]. A second term that ends on
/// its bound leaves the moduli alike, which does not show that it is absent. None where an error is not known.
fn missing_term(one: &Estimate, two: &Estimate) -> Option<f64> {
    let more = two.standard_error?.powi(2) - one.standard_error?.powi(2);
    Some((one.value - two.value).hypot(more.max(0.0).sqrt()))
}
