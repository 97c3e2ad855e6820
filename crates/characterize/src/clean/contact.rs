//! The first contact, and the zero of the sensor before it.
//!
//! A recording of this project counts depth from first contact, so the contact is where the depth leaves zero. In others
//! it is found: while the force first rises by 5 % of its range, or by twenty deviations of its noise if that is more, it
//! is a constant f₀ until the depth d_c of a sample, and f₀ + a (d − d_c)^p from there on, with a ≥ 0 and p = 1, 3/2 or 2
//! for a flat face, a sphere and a cone. Where the shape is not stated, p is the smallest of the three whose likelihood
//! does not differ significantly from the largest. Before contact only noise makes the force differ from this, after it
//! the tissue too, by 2 % of the range. The most likely sample is the contact. Samples whose −2 log likelihood is larger
//! by less than 3.84 (the 95 % point of χ² with one degree of freedom), times the factor by which correlation of the noise
//! widens it, give its standard error, together with the way to the next sample. Where the zero drifts before contact, a line
//! takes the place of the constant (`drift`). On a layer, where the force under a sphere or a cone is no power of the depth,
//! half the range between the contacts of the three p is part of the error.
//!
//! *How we know*: `contact::…`, on synthetic recordings with known truth at 10 Hz to 1 kHz, linear and
//! Hertzian.
//!
//! *Limits*: correlated noise widens the interval; which sample is the most likely is found as if it were white. A tissue
//! that is very soft at first is met late by as much as the noise hides.

use std::ops::Range;

use palpate_files::recording::{IndenterShape, RecordingHeader, Specimen};

use super::contact_search::{Approach, Baseline, ENOUGH_FOR_DRIFT, Search, range};
use super::regression::{Regression, regress};
use super::{CleanRecording, Oriented, drift, noise};
use crate::Error;

/// Part of the rise of the force that is looked at [-].
const EARLY: f64 = 0.05;
/// The same in deviations of the noise, if that is more [-].
const ABOVE_NOISE: f64 = 20.0;
/// Samples on the rise that are looked at besides.
const ON_THE_RISE: usize = 5;
/// Samples looked at; of more, every second, third and so on.
const MAX_SAMPLES: usize = 20_000;
/// Standard errors from which a drift is reported [-]: one in 16,000 by chance.
const CERTAIN: f64 = 4.0;
/// What a drift may leave, in deviations of the noise [-].
const NOISE_ALONE: f64 = 1.5;
/// How far above the tissue nothing touches, in parts of the largest depth [-].
const CLEAR: f64 = 0.05;

/// Where the indenter first touched, as the recording counts time, depth and force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contact {
    /// The last sample before the tissue is pressed.
    pub sample: usize,
    /// Its time [s].
    pub time_s: f64,
    /// Its depth [m].
    pub depth_m: f64,
    /// Standard error of the depth [m]; none when the recording itself counts from first contact.
    pub depth_error_m: Option<f64>,
    /// What the sensor showed at it without load [N]: this was taken off.
    pub offset_n: f64,
    /// Standard error of the offset [N]; none when too few samples lie before contact.
    pub offset_error_n: Option<f64>,
    /// How fast the sensor's zero went before contact [N/s]; none when it stood still.
    pub drift_n_per_s: Option<f64>,
}

/// That of a piece that is clamped from the first sample: it has no contact to find.
pub(super) fn at_first(samples: &Oriented) -> Contact {
    Contact {
        time_s: samples.time[0],
        depth_m: samples.depth[0],
        ..Contact::default()
    }
}

/// The contact where the depth, which counts from it, leaves zero.
pub(super) fn by_depth(samples: &Oriented, is_piece: bool) -> Result<Contact, Error> {
    let (time, depth) = (&samples.time, &samples.depth);
    let deepest = depth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if deepest <= 0.0 && is_piece {
        // A pulled piece is clamped from the first sample.
        return Ok(Contact {
            time_s: time[0],
            ..Contact::default()
        });
    }
    if deepest <= 0.0 {
        return Err(Error::NoContact {
            cause: "the depth never gets above zero",
        });
    }
    let deep = depth.iter().position(|&d| d >= 0.1 * deepest);
    let deep = deep.expect("the deepest is one of them");
    let Some(sample) = depth[..deep].iter().rposition(|&d| d <= 0.0) else {
        return Ok(Contact {
            time_s: time[0],
            ..Contact::default()
        });
    };
    let share = -depth[sample] / (depth[sample + 1] - depth[sample]);
    let time_s = time[sample] + share * (time[sample + 1] - time[sample]);
    // The first contact is never exact: samples well above the tissue give the zero, if they are enough.
    let clear = depth[..=sample]
        .iter()
        .rposition(|&d| d <= -CLEAR * deepest);
    let clear = clear.filter(|&last| last >= noise::ENOUGH);
    let zero = Zero::before(samples, clear.unwrap_or(sample));
    Ok(Contact {
        sample,
        time_s,
        depth_m: 0.0,
        depth_error_m: None,
        offset_n: zero.map_or(0.0, |zero| zero.at(time_s)),
        offset_error_n: zero.map(|zero| zero.error),
        drift_n_per_s: zero.and_then(|zero| zero.slope),
    })
}

/// How the force of a flat face, a sphere and a cone rises with the depth first.
pub(super) const RISES: [fn(f64) -> f64; 3] = [|u| u, |u| u * u.sqrt(), |u| u * u];

/// How the force of an indenter of this shape rises with the depth first; of an unknown one any of the three.
fn rises(shape: Option<IndenterShape>) -> &'static [fn(f64) -> f64] {
    match shape {
        Some(IndenterShape::Flat) => &RISES[..1],
        Some(IndenterShape::Sphere) => &RISES[1..2],
        Some(IndenterShape::Cone) => &RISES[2..],
        None => &RISES,
    }
}

/// The sample after which the force of `approach` begins to rise with the depth from a constant, under an indenter of this
/// shape, and the standard error of its depth [m].
pub(crate) fn rising_contact(approach: &Approach, shape: Option<IndenterShape>) -> (usize, f64) {
    let best = Search::new(approach, rises(shape), Baseline::Constant).best(1.0);
    best.map_or((0, 0.0), |best| (best.place, best.error))
}

/// Whether the force rises with another power of the depth than on a half-space: on a layer the growing contact of a
/// round indenter feels more and more of the base.
fn is_any_power(header: &RecordingHeader) -> bool {
    let is_round = matches!(
        header.indenter_shape,
        Some(IndenterShape::Sphere | IndenterShape::Cone)
    );
    is_round && header.specimen == Some(Specimen::Layer)
}

/// The contact where the force begins to rise.
pub(super) fn by_force(samples: &Oriented, header: &RecordingHeader) -> Result<Contact, Error> {
    let shape = header.indenter_shape;
    if !noise::exceeds_noise(&samples.force) || rise(&noise::without_spikes(&samples.force)) <= 0.0
    {
        return Err(Error::NoContact {
            cause: "the force never rises above its noise",
        });
    }
    if let Some(contact) = drift::contact(samples, rises(shape)) {
        return Ok(contact);
    }
    let (approach, every) = thinned(samples, 0..early_end(&samples.force, EARLY));
    let (place, error) = rising_contact(&approach, shape);
    let of_rise = if is_any_power(header) {
        let any = Search::new(&approach, &RISES, Baseline::Constant).best(1.0);
        any.map_or(0.0, |any| 0.5 * range(&any.of_rises))
    } else {
        0.0
    };
    Ok(at_sample(
        samples,
        place * every,
        Some(error.hypot(of_rise)),
    ))
}

/// The samples of a range, of many every second, third and so on, and which.
pub(super) fn thinned(samples: &Oriented, range: Range<usize>) -> (Approach, usize) {
    let every = range.len().div_ceil(MAX_SAMPLES).max(1);
    let of = |values: &[f64]| -> Vec<f64> {
        let own = values[range.clone()].iter();
        own.step_by(every).copied().collect()
    };
    let approach = Approach {
        time: of(&samples.time),
        depth: of(&samples.depth),
        force: of(&samples.force),
    };
    (approach, every)
}

fn at_sample(samples: &Oriented, sample: usize, depth_error_m: Option<f64>) -> Contact {
    let zero = Zero::before(samples, sample);
    let time_s = samples.time[sample];
    // One sample gives the zero too, but not its error.
    let only = || samples.force[..=sample].iter().sum::<f64>() / (sample + 1) as f64;
    Contact {
        sample,
        time_s,
        depth_m: samples.depth[sample],
        depth_error_m,
        offset_n: zero.map_or_else(only, |zero| zero.at(time_s)),
        offset_error_n: zero.map(|zero| zero.error),
        drift_n_per_s: zero.and_then(|zero| zero.slope),
    }
}

/// Above the first samples, and up to the largest.
fn rise(force: &[f64]) -> f64 {
    force.iter().copied().fold(f64::NEG_INFINITY, f64::max) - base(force)
}

fn base(force: &[f64]) -> f64 {
    noise::median(&force[..force.len().min(3)])
}

/// One past the samples until the force has first gone through a `part` of its rise.
pub(super) fn early_end(force: &[f64], part: f64) -> usize {
    let smooth = noise::without_spikes(force);
    let (base, rise) = (base(&smooth), rise(&smooth));
    let level = (part * rise).max(ABOVE_NOISE * noise::deviation(force));
    let first_above = |level: f64| smooth.iter().position(|f| f - base >= level);
    let half = first_above(0.5 * rise).unwrap_or(0);
    let top = first_above(rise).unwrap_or(half);
    let below = smooth[..half].iter().rposition(|f| f - base < level);
    let above = below.map_or(0, |below| below + 1);
    (above + ON_THE_RISE).min(top + 1).max(2).min(force.len())
}

/// What the sensor shows without load.
#[derive(Debug, Clone, Copy)]
struct Zero {
    value: f64,
    error: f64,
    slope: Option<f64>,
    middle: f64,
}

impl Zero {
    /// From the samples up to `last`, if they are enough.
    fn before(samples: &Oriented, last: usize) -> Option<Self> {
        let (time, force) = (&samples.time[..=last], &samples.force[..=last]);
        let middle = 0.5 * (time[0] + time[last]);
        let constant = regress(force, |_| [1.0]).filter(|_| force.len() >= noise::ENOUGH)?;
        let line = regress(force, |sample| [1.0, time[sample] - middle])
            .filter(|line| force.len() >= ENOUGH_FOR_DRIFT && is_drift(line, force));
        let (fit, slope) = match line {
            Some(line) => {
                let slope = line.coefficients[1];
                (line, Some(slope))
            }
            None => (constant, None),
        };
        Some(Self {
            value: fit.coefficients[0],
            error: fit.standard_errors[0],
            slope,
            middle,
        })
    }

    fn at(&self, time: f64) -> f64 {
        self.value + self.slope.unwrap_or(0.0) * (time - self.middle)
    }
}

/// Whether a line is certain and leaves nothing but noise.
fn is_drift(line: &Regression, force: &[f64]) -> bool {
    let left = (line.sum_squared_error / force.len() as f64).sqrt();
    line.coefficients[1].abs() > CERTAIN * line.standard_errors[1]
        && left < NOISE_ALONE * noise::deviation(force)
}

/// The contact at a `time` [s] that the user states.
pub(super) fn at(samples: &Oriented, time: f64) -> Result<Contact, Error> {
    let [first, last] = [0, samples.time.len() - 1].map(|sample| samples.time[sample]);
    if !(first..=last).contains(&time) {
        return Err(Error::ContactOutside { time, first, last });
    }
    let sample = samples.time.partition_point(|own| *own <= time) - 1;
    Ok(at_sample(samples, sample, None))
}

/// Says how the contact was found.
pub(super) fn add_warnings(contact: &Contact, clean: &CleanRecording, warnings: &mut Vec<String>) {
    if let Some(error) = contact.depth_error_m {
        warnings.push(format!(
            "the first contact was found at {:.4} s, at {:.3e} +- {error:.1e} m",
            contact.time_s, contact.depth_m
        ));
    }
    if clean.is_piece() {
        // There is no contact: the piece is clamped.
    } else if contact.sample == 0 {
        warnings.push(
            "the recording begins in contact: nothing shows the sensor's zero, and the indenter may have touched before"
                .to_owned(),
        );
    } else if contact.offset_error_n.is_none() {
        warnings.push(format!(
            "only {} samples lie before contact, too few to tell the sensor's zero well",
            contact.sample + 1
        ));
    }
    if let Some(drift) = contact.drift_n_per_s {
        let left = clean.time.last().copied().unwrap_or(0.0);
        warnings.push(format!(
            "the sensor's zero moved by {drift:.2e} N/s before contact; if the drift continues, it is off by {:.2e} N at the end",
            drift * left
        ));
    }
}
