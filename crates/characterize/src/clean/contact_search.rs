use super::noise;

/// Candidates in the first round.
const CANDIDATES: usize = 300;
/// 95 % of a χ² of one degree of freedom lie below this [-], and of a normal within its root.
pub(super) const CHI_SQUARED: f64 = 3.84;
/// What tissue may differ from a power of the depth by, in parts of the range of force [-].
const MODEL: f64 = 0.02;
/// Least noise, in parts of the range of force [-].
const MIN_NOISE: f64 = 1e-6;
/// The fewest blocks of samples whose means estimate the correlation of noise.
const MIN_BLOCKS: usize = 8;
/// Way that is none, in parts of the range of depth [-].
const STILL: f64 = 1e-4;
/// The fewest samples before contact that determine a drift.
pub(super) const ENOUGH_FOR_DRIFT: usize = 100;

/// What the force is before contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Baseline {
    /// A constant, from which the sensor's noise alone makes it differ.
    Constant,
    /// A constant, from which it differs by as much as is seen.
    WanderingConstant,
    /// A line over time, from which it differs by as much as is seen.
    Line,
}

/// Samples in which the contact is sought: all columns have one number for each.
#[derive(Debug, Clone)]
pub(crate) struct Approach {
    /// [s]
    pub(crate) time: Vec<f64>,
    /// [m]
    pub(crate) depth: Vec<f64>,
    /// [N]
    pub(crate) force: Vec<f64>,
}

/// The search for the sample after which the force rises.
pub(super) struct Search<'s> {
    samples: &'s Approach,
    /// Sums before each sample, about the first time and force.
    sums: Vec<Sums>,
    /// Variance of the noise.
    noise: f64,
    /// Variance by which tissue may differ from a power of the depth.
    model: f64,
    baseline: Baseline,
    /// How the force may rise with the depth.
    rises: &'s [fn(f64) -> f64],
}

/// Sums of force f and time t, and of their products.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    f: f64,
    ff: f64,
    t: f64,
    tt: f64,
    tf: f64,
}

/// The force before contact: `value` at `middle`, and what is left.
struct Before {
    value: f64,
    slope: f64,
    middle: f64,
    left: f64,
}

/// What the search finds.
#[derive(Debug, Clone)]
pub(super) struct Best {
    pub(super) place: usize,
    /// Standard error of its depth.
    pub(super) error: f64,
    /// −2 log likelihood, but for a constant that depends on the samples alone.
    pub(super) misfit: f64,
    /// The depth of the best contact of each rise.
    pub(super) of_rises: Vec<f64>,
}

impl<'s> Search<'s> {
    pub(super) fn new(
        samples: &'s Approach,
        rises: &'s [fn(f64) -> f64],
        baseline: Baseline,
    ) -> Self {
        let (time, force) = (&samples.time, &samples.force);
        let mut sum = Sums::default();
        let mut sums = vec![sum];
        for (t, f) in time.iter().zip(force) {
            let (t, f) = (t - time[0], f - force[0]);
            sum = Sums {
                f: sum.f + f,
                ff: sum.ff + f * f,
                t: sum.t + t,
                tt: sum.tt + t * t,
                tf: sum.tf + t * f,
            };
            sums.push(sum);
        }
        let range = range(force);
        Self {
            samples,
            sums,
            noise: noise::deviation(force).max(MIN_NOISE * range).powi(2),
            model: (MODEL * range).powi(2),
            baseline,
            rises,
        }
    }

    /// The most likely contact of the first rise whose likelihood does not differ significantly from the largest:
    /// correlated noise looks like a slow rise sooner than like a quick one. `correlation` is the least that is assumed
    /// ([`correlation`]). None where too few samples can lie before contact.
    pub(super) fn best(&self, correlation_at_least: f64) -> Option<Best> {
        if self.fewest_before() >= self.samples.depth.len() {
            return None;
        }
        let depth = &self.samples.depth;
        let found: Vec<Vec<(usize, f64)>> =
            self.rises.iter().map(|rise| self.misfits(*rise)).collect();
        let best = least(&found.concat());
        let correlated = correlation(&self.left(best.0)).max(correlation_at_least);
        let enough = best.1 + CHI_SQUARED * correlated;
        let bests: Vec<(usize, f64)> = found.iter().map(|of_rise| least(of_rise)).collect();
        let first = bests.iter().find(|(_, misfit)| *misfit <= enough);
        let place = first.map_or(best.0, |first| first.0);
        let known = found.iter().flatten();
        let known = known.filter(|(_, misfit)| *misfit <= enough);
        let depths: Vec<f64> = known.map(|(place, _)| depth[*place]).collect();
        let place = self.until_it_moves(place);
        let step = depth[(place + 1).min(depth.len() - 1)] - depth[place];
        let error = 0.5 * range(&depths) / CHI_SQUARED.sqrt();
        Some(Best {
            place,
            // The tissue is met anywhere between this sample and the next.
            error: error.hypot(step / 3f64.sqrt()),
            misfit: best.1,
            of_rises: bests.iter().map(|(place, _)| depth[*place]).collect(),
        })
    }

    fn fewest_before(&self) -> usize {
        match self.baseline {
            Baseline::Line => ENOUGH_FOR_DRIFT,
            Baseline::Constant | Baseline::WanderingConstant => 0,
        }
    }

    /// Contacts at every so many samples and at every one near the likeliest of these, with their misfits.
    fn misfits(&self, rise: fn(f64) -> f64) -> Vec<(usize, f64)> {
        let (first, count) = (self.fewest_before(), self.samples.depth.len());
        let stride = count.div_ceil(CANDIDATES);
        let of = |place| (place, self.misfit(place, rise));
        let mut found: Vec<_> = (first..count).step_by(stride).map(of).collect();
        let near = least(&found).0;
        let around = near.saturating_sub(stride).max(first)..(near + stride).min(count);
        found.extend(around.map(of));
        found
    }

    /// Nothing is pressed while the indenter rests.
    fn until_it_moves(&self, place: usize) -> usize {
        let depth = &self.samples.depth;
        let still = STILL * range(depth);
        let later = depth[place..].iter();
        let rest = later.take_while(|d| (**d - depth[place]).abs() <= still);
        (place + rest.count()).max(place + 1).min(depth.len()) - 1
    }

    fn before(&self, place: usize) -> Before {
        let count = (place + 1) as f64;
        let sums = self.sums[place + 1];
        let mean = sums.f / count;
        let constant = (sums.ff - sums.f * mean).max(0.0);
        let middle = sums.t / count;
        let [square, product] = [sums.tt - sums.t * middle, sums.tf - sums.t * mean];
        let slope = match self.baseline {
            Baseline::Line if square > 0.0 => product / square,
            _ => 0.0,
        };
        Before {
            value: self.samples.force[0] + mean,
            slope,
            middle: self.samples.time[0] + middle,
            left: (constant - slope * product).max(0.0),
        }
    }

    /// What a contact at `place` leaves of the force before it.
    fn left(&self, place: usize) -> Vec<f64> {
        let before = self.before(place);
        let both = self.samples.time.iter().zip(&self.samples.force);
        both.take(place + 1)
            .map(|(t, f)| f - before.at(*t))
            .collect()
    }

    /// −2 log likelihood of the contact at `place`, but for a constant.
    fn misfit(&self, place: usize, rise: fn(f64) -> f64) -> f64 {
        let before = self.before(place);
        let Approach { time, depth, force } = self.samples;
        let from = depth[place];
        let [mut total, mut square, mut product] = [0.0; 3];
        for after in place + 1..depth.len() {
            let (rise, f) = (
                rise((depth[after] - from).max(0.0)),
                force[after] - before.at(time[after]),
            );
            total += f * f;
            square += rise * rise;
            product += rise * f;
        }
        let gain = if square > 0.0 && product > 0.0 {
            product * (product / square)
        } else {
            0.0
        };
        let left = (total - gain).max(0.0);
        let [free, pressed] = [place + 1, depth.len() - place - 1].map(|count| count as f64);
        let [noise, after] = match self.baseline {
            Baseline::Constant => [self.noise, self.noise + self.model],
            Baseline::WanderingConstant | Baseline::Line => {
                let noise = (before.left / free).max(self.noise);
                [noise, (left / pressed.max(1.0)).max(noise)]
            }
        };
        free * noise.ln() + before.left / noise + pressed * after.ln() + left / after
    }
}

impl Before {
    fn at(&self, time: f64) -> f64 {
        self.value + self.slope * (time - self.middle)
    }
}

/// Number of these samples that are worth one independent sample [-]: the variance of means of blocks over
/// that of independent samples, for the length of a block at which it is largest.
pub(super) fn correlation(values: &[f64]) -> f64 {
    let variance = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|v| (v - mean).powi(2));
        squares.sum::<f64>() / (values.len() as f64 - 1.0)
    };
    let single = variance(values);
    let lengths = std::iter::successors(Some(2), |length| Some(2 * length));
    let lengths = lengths.take_while(|length| values.len() / length >= MIN_BLOCKS);
    let ratio = lengths.map(|length| {
        let means = values
            .chunks_exact(length)
            .map(|block| block.iter().sum::<f64>() / length as f64);
        length as f64 * variance(&means.collect::<Vec<_>>()) / single
    });
    let largest = ratio.fold(1.0, f64::max);
    if largest.is_finite() { largest } else { 1.0 }
}

/// The one with the least misfit.
fn least(found: &[(usize, f64)]) -> (usize, f64) {
    let least = found.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    least.copied().unwrap_or((0, 0.0))
}

pub(super) fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - values.iter().copied().fold(f64::INFINITY, f64::min)
}
