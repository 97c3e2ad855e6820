//! Swings of the depth: where it turns, how its phase goes, and a sine fitted to it.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::regression::regress;

/// Fewest turns that make a swing: one and a half periods.
const FEWEST_TURNS: usize = 4;
/// Swings smaller or larger than this part of the usual one do not belong to it [-].
const ALIKE: [f64; 2] = [0.6, 1.5];
/// A change of frequency by less than this part over the swing is none [-].
const STEADY: f64 = 0.05;
/// Root mean square of what a sine may leave of its swing [-]. A triangle leaves 0.12.
const SINE_MISFIT: f64 = 0.08;
/// Largest root mean square error of the phase of a chirp at its turns [rad].
const CHIRP_MISFIT: f64 = 0.35;
/// How far a sample may lie from a swing, in amplitudes, to belong to it [-].
const NEAR: f64 = 0.15;

/// A part in which the depth swings.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Swing {
    pub(super) samples: Range<usize>,
    /// Frequencies at its beginning and end [Hz]; one and the same for a sine.
    pub(super) frequencies: [f64; 2],
}

/// The longest part in which `depth` [m] at `time` [s] swings by more than `threshold` [m].
pub(super) fn find(time: &[f64], depth: &[f64], threshold: f64) -> Option<Swing> {
    let turns = turns(depth, threshold);
    let run = longest_run(depth, &turns)?;
    let moments: Vec<f64> = run.iter().map(|&turn| moment(time, depth, turn)).collect();
    let phase = Phase::through(&moments)?;
    let model = Model::new(depth, run, phase);
    let samples = model.extent(time, depth, run);
    let ends = [time[samples.start], time[samples.end - 1]];
    let frequencies = ends.map(|time| model.phase.frequency(time));
    if (frequencies[1] / frequencies[0]).ln().abs() > STEADY {
        return Some(Swing {
            samples,
            frequencies,
        });
    }
    let middle = model.phase.frequency(0.5 * (ends[0] + ends[1]));
    let sine = Sine::fit(&time[samples.clone()], &depth[samples.clone()], middle)?;
    (sine.misfit < SINE_MISFIT * sine.amplitude()).then_some(Swing {
        samples,
        frequencies: [sine.frequency; 2],
    })
}

/// Samples at which the depth turns by more than `threshold`, neither the first nor the last.
fn turns(depth: &[f64], threshold: f64) -> Vec<usize> {
    let mut turns = Vec::new();
    let (mut low, mut high) = (0, 0);
    let mut sense = 0.0;
    for (sample, d) in depth.iter().enumerate() {
        if *d > depth[high] {
            high = sample;
        }
        if *d < depth[low] {
            low = sample;
        }
        if sense >= 0.0 && depth[high] - d > threshold {
            turns.push(high);
            (sense, low, high) = (-1.0, sample, sample);
        } else if sense <= 0.0 && d - depth[low] > threshold {
            turns.push(low);
            (sense, low, high) = (1.0, sample, sample);
        }
    }
    turns.retain(|&turn| turn > 0);
    turns
}

/// The longest run of turns between which the depth goes about equally far.
fn longest_run<'t>(depth: &[f64], turns: &'t [usize]) -> Option<&'t [usize]> {
    let mut swings: Vec<f64> = turns
        .windows(2)
        .map(|pair| (depth[pair[1]] - depth[pair[0]]).abs())
        .collect();
    let all = swings.clone();
    swings.sort_by(f64::total_cmp);
    let usual = *swings.get(swings.len() / 2)?;
    let is_alike = |swing: f64| (ALIKE[0] * usual..=ALIKE[1] * usual).contains(&swing);
    let mut best = 0..0;
    let mut start = 0;
    for end in 0..=all.len() {
        if end == all.len() || !is_alike(all[end]) {
            if end - start > best.len() {
                best = start..end;
            }
            start = end + 1;
        }
    }
    let run = turns.get(best.start..=best.end)?;
    (run.len() >= FEWEST_TURNS && !best.is_empty()).then_some(run)
}

/// When the depth turns, from the parabola through the samples around.
fn moment(time: &[f64], depth: &[f64], turn: usize) -> f64 {
    let (Some(before), Some(after)) = (turn.checked_sub(1), depth.get(turn + 1)) else {
        return time[turn];
    };
    let (left, right) = (depth[before] - depth[turn], after - depth[turn]);
    if left + right == 0.0 {
        return time[turn];
    }
    let share = 0.5 * (left - right) / (left + right);
    time[turn] + share.clamp(-0.5, 0.5) * 0.5 * (time[turn + 1] - time[before])
}

/// How the phase of a swing grows from its first turn.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Phase {
    /// Coefficients of t and t², t from the first turn.
    Quadratic { start: f64, slope: f64, bend: f64 },
    /// first · (exp(rate t) − 1) / rate.
    Exponential { start: f64, first: f64, rate: f64 },
}

impl Phase {
    /// The one that goes nearest to one half turn between each two of the `moments` [s].
    fn through(moments: &[f64]) -> Option<Self> {
        let start = moments[0];
        let phases: Vec<f64> = (0..moments.len()).map(|turn| turn as f64 * PI).collect();
        let quadratic = regress(&phases, |turn| {
            let t = moments[turn] - start;
            [1.0, t, t * t]
        })?;
        let [_, slope, bend] = quadratic.coefficients.as_slice() else {
            return None;
        };
        let quadratic_misfit = quadratic.sum_squared_error;
        let by_quadratic = Self::Quadratic {
            start,
            slope: *slope,
            bend: *bend,
        };
        let best = match exponential(moments, &phases) {
            Some((phase, misfit)) if misfit < quadratic_misfit => (phase, misfit),
            _ => (by_quadratic, quadratic_misfit),
        };
        let goes_on = moments.iter().all(|&time| best.0.frequency(time) > 0.0);
        let is_near = (best.1 / moments.len() as f64).sqrt() < CHIRP_MISFIT;
        (goes_on && is_near).then_some(best.0)
    }

    fn at(self, time: f64) -> f64 {
        match self {
            Self::Quadratic { start, slope, bend } => {
                let t = time - start;
                t * (slope + t * bend)
            }
            Self::Exponential { start, first, rate } => {
                first * ((rate * (time - start)).exp_m1()) / rate
            }
        }
    }

    fn frequency(self, time: f64) -> f64 {
        let speed = match self {
            Self::Quadratic { start, slope, bend } => slope + 2.0 * bend * (time - start),
            Self::Exponential { start, first, rate } => first * (rate * (time - start)).exp(),
        };
        speed / TAU
    }
}

/// The best exponential phase and its sum of squares, its rate searched over a hundred times either way.
fn exponential(moments: &[f64], phases: &[f64]) -> Option<(Phase, f64)> {
    let start = moments[0];
    let length = moments[moments.len() - 1] - start;
    let fit = |rate: f64| {
        let column = |turn: usize| ((rate * (moments[turn] - start)).exp_m1()) / rate;
        let fit = regress(phases, |turn| [1.0, column(turn)])?;
        let first = fit.coefficients[1];
        Some((
            Phase::Exponential { start, first, rate },
            fit.sum_squared_error,
        ))
    };
    let most = 100f64.ln() / length;
    let rates = (-50..=50)
        .filter(|&step| step != 0)
        .map(|step| f64::from(step) * most / 50.0);
    let least = |a: &(Phase, f64), b: &(Phase, f64)| a.1.total_cmp(&b.1);
    let coarse = rates.filter_map(|rate| Some((rate, fit(rate)?.1)));
    let (near, _) = coarse.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (-20..=20)
        .filter_map(|step| fit(near + f64::from(step) * most / 1000.0))
        .min_by(least)
}

/// A swing of constant amplitude with a phase.
struct Model {
    phase: Phase,
    middle: f64,
    /// Half of the way between turns, positive when the first turn is the deeper.
    amplitude: f64,
}

impl Model {
    fn new(depth: &[f64], run: &[usize], phase: Phase) -> Self {
        let mean = |first: usize| {
            let values = run.iter().skip(first).step_by(2).map(|&turn| depth[turn]);
            values.sum::<f64>() / run.len().saturating_sub(first).div_ceil(2) as f64
        };
        let (one, other) = (mean(0), mean(1));
        Self {
            phase,
            middle: 0.5 * (one + other),
            amplitude: 0.5 * (one - other),
        }
    }

    /// The samples around the turns, up to a quarter of a period beyond, that keep to the swing.
    fn extent(&self, time: &[f64], depth: &[f64], run: &[usize]) -> Range<usize> {
        let (first, last) = (run[0], run[run.len() - 1]);
        let belongs = |&sample: &usize| {
            let there = self.middle + self.amplitude * self.phase.at(time[sample]).cos();
            (depth[sample] - there).abs() < NEAR * self.amplitude.abs()
        };
        let phase = |sample: usize| self.phase.at(time[sample]);
        let quarter = 0.25 * TAU;
        let (earliest, latest) = (phase(first) - quarter, phase(last) + quarter);
        let before = (0..first)
            .rev()
            .take_while(|sample| phase(*sample) >= earliest && belongs(sample));
        let after = (last + 1..depth.len())
            .take_while(|sample| phase(*sample) <= latest && belongs(sample));
        before.last().unwrap_or(first)..after.last().unwrap_or(last) + 1
    }
}

/// mean + cosine · cos(2π f t) + sine · sin(2π f t), fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sine {
    /// Frequency [Hz].
    pub(crate) frequency: f64,
    pub(crate) mean: f64,
    pub(crate) cosine: f64,
    pub(crate) sine: f64,
    /// Root mean square of what is left.
    pub(crate) misfit: f64,
}

impl Sine {
    /// Fits `values` at `time` [s], beginning with a `frequency` [Hz] that is nearly right.
    pub(crate) fn fit(time: &[f64], values: &[f64], frequency: f64) -> Option<Self> {
        let mut fit = Self::with(time, values, frequency)?;
        let middle = 0.5 * (time.first()? + time.last()?);
        for _ in 0..8 {
            let omega = TAU * fit.frequency;
            // A step of Gauss and Newton: the derivative by the frequency is a column of its own.
            let step = regress(values, |sample| {
                let (s, c) = (omega * time[sample]).sin_cos();
                let along = (time[sample] - middle) * (fit.sine * c - fit.cosine * s);
                [1.0, c, s, along]
            })?;
            let next = fit.frequency + step.coefficients[3] / TAU;
            let better = Self::with(time, values, next).filter(|next| next.misfit < fit.misfit);
            match better {
                Some(better) if next > 0.0 => fit = better,
                _ => break,
            }
        }
        Some(fit)
    }

    fn with(time: &[f64], values: &[f64], frequency: f64) -> Option<Self> {
        let omega = TAU * frequency;
        let fit = regress(values, |sample| {
            let (s, c) = (omega * time[sample]).sin_cos();
            [1.0, c, s]
        })?;
        Some(Self {
            frequency,
            mean: fit.coefficients[0],
            cosine: fit.coefficients[1],
            sine: fit.coefficients[2],
            misfit: (fit.sum_squared_error / values.len() as f64).sqrt(),
        })
    }

    pub(crate) fn amplitude(&self) -> f64 {
        self.cosine.hypot(self.sine)
    }
}
