use super::noise;

/// Candidates in the first round.
const CANDIDATES: usize = 300;
/// 95 % of a χ² of one degree of freedom lie below this [-], and of a normal within its root.
const CHI_SQUARED: f64 = 3.84;
/// What tissue may differ from a power of the depth by, in parts of the range of force [-].
const MODEL: f64 = 0.02;
/// Least noise, in parts of the range of force [-].
const LEAST_NOISE: f64 = 1e-6;
/// Blocks of samples from whose means the correlation of noise is told, at least.
const LEAST_BLOCKS: usize = 8;
/// Way that is none, in parts of the range of depth [-].
const STILL: f64 = 1e-4;

/// The search for the sample after which the force rises.
pub(super) struct Search<'s> {
    depth: &'s [f64],
    force: &'s [f64],
    /// Sums of force and of its square before each sample, about the first force.
    sums: Vec<[f64; 2]>,
    /// Variance of the force before contact, and after it, where the model errs besides.
    variances: [f64; 2],
    /// How the force may rise with the depth.
    rises: &'s [fn(f64) -> f64],
}

/// What the search finds.
pub(super) struct Best {
    pub(super) place: usize,
    /// Standard error of its depth.
    pub(super) error: f64,
}

impl<'s> Search<'s> {
    pub(super) fn new(depth: &'s [f64], force: &'s [f64], rises: &'s [fn(f64) -> f64]) -> Self {
        let mut sum = [0.0; 2];
        let mut sums = vec![sum];
        for f in force {
            let f = f - force[0];
            sum = [sum[0] + f, sum[1] + f * f];
            sums.push(sum);
        }
        let range = range(force);
        let noise = noise::deviation(force).max(LEAST_NOISE * range);
        Self {
            depth,
            force,
            sums,
            variances: [noise.powi(2), noise.powi(2) + (MODEL * range).powi(2)],
            rises,
        }
    }

    /// The most likely contact of the first rise whose likelihood does not differ significantly from the largest:
    /// correlated noise looks like a slow rise sooner than like a quick one.
    pub(super) fn best(&self) -> Best {
        let found: Vec<Vec<(usize, f64)>> =
            self.rises.iter().map(|rise| self.misfits(*rise)).collect();
        let best = least(&found.concat());
        let enough = best.1 + CHI_SQUARED * self.correlated(best.0);
        let mut bests = found.iter().map(|of_rise| least(of_rise));
        let first = bests.find(|(_, misfit)| *misfit <= enough);
        let (place, _) = first.unwrap_or(best);
        let known = found.iter().flatten();
        let known = known.filter(|(_, misfit)| *misfit <= enough);
        let depths: Vec<f64> = known.map(|(place, _)| self.depth[*place]).collect();
        let place = self.until_it_moves(place);
        let step = self.depth[(place + 1).min(self.depth.len() - 1)] - self.depth[place];
        let error = 0.5 * range(&depths) / CHI_SQUARED.sqrt();
        Best {
            place,
            // The tissue is met anywhere between this sample and the next.
            error: error.hypot(step / 3f64.sqrt()),
        }
    }

    /// Contacts at every so many samples and at every one near the likeliest of these, with their misfits.
    fn misfits(&self, rise: fn(f64) -> f64) -> Vec<(usize, f64)> {
        let count = self.depth.len();
        let stride = count.div_ceil(CANDIDATES);
        let of = |place| (place, self.misfit(place, rise));
        let mut found: Vec<_> = (0..count).step_by(stride).map(of).collect();
        let near = least(&found).0;
        found.extend((near.saturating_sub(stride)..(near + stride).min(count)).map(of));
        found
    }

    /// Nothing is pressed while the indenter rests.
    fn until_it_moves(&self, place: usize) -> usize {
        let still = STILL * range(self.depth);
        let later = self.depth[place..].iter();
        let rest = later.take_while(|d| (**d - self.depth[place]).abs() <= still);
        (place + rest.count()).max(place + 1).min(self.depth.len()) - 1
    }

    /// How many samples before a contact at `place` tell as much as one that knows nothing of the others [-]: the variance
    /// of means of blocks over that of independent samples, for the length of a block at which it is largest.
    fn correlated(&self, place: usize) -> f64 {
        let before = &self.force[..=place];
        let variance = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let squares = values.iter().map(|v| (v - mean).powi(2));
            squares.sum::<f64>() / (values.len() as f64 - 1.0)
        };
        let single = variance(before);
        let lengths = std::iter::successors(Some(2), |length| Some(2 * length));
        let lengths = lengths.take_while(|length| before.len() / length >= LEAST_BLOCKS);
        let ratio = lengths.map(|length| {
            let means = before
                .chunks_exact(length)
                .map(|block| block.iter().sum::<f64>() / length as f64);
            length as f64 * variance(&means.collect::<Vec<_>>()) / single
        });
        let largest = ratio.fold(1.0, f64::max);
        if largest.is_finite() { largest } else { 1.0 }
    }

    /// −2 log likelihood of the contact at `place`, but for a constant.
    fn misfit(&self, place: usize, rise: fn(f64) -> f64) -> f64 {
        let count = (place + 1) as f64;
        let [sum, squares] = self.sums[place + 1];
        let zero = self.force[0] + sum / count;
        let from = self.depth[place];
        let [mut total, mut square, mut product] = [0.0; 3];
        for (d, f) in self.depth.iter().zip(self.force).skip(place + 1) {
            let (rise, f) = (rise((d - from).max(0.0)), f - zero);
            total += f * f;
            square += rise * rise;
            product += rise * f;
        }
        let gain = if square > 0.0 && product > 0.0 {
            product * (product / square)
        } else {
            0.0
        };
        let pressed = (self.depth.len() - place - 1) as f64;
        let [before, after] = self.variances;
        (squares - sum * sum / count).max(0.0) / before
            + (total - gain).max(0.0) / after
            + pressed * (after / before).ln()
    }
}

/// The one with the least misfit.
fn least(found: &[(usize, f64)]) -> (usize, f64) {
    let least = found.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    least.copied().unwrap_or((0, 0.0))
}

fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - values.iter().copied().fold(f64::INFINITY, f64::min)
}
