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
}

/// What the search finds.
pub(super) struct Best {
    pub(super) place: usize,
    /// Standard error of its depth.
    pub(super) error: f64,
}

impl<'s> Search<'s> {
    pub(super) fn new(depth: &'s [f64], force: &'s [f64]) -> Self {
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
        }
    }

    pub(super) fn best(&self) -> Best {
        let count = self.depth.len();
        let stride = count.div_ceil(CANDIDATES);
        let misfits = |places: &mut dyn Iterator<Item = usize>| -> Vec<(usize, f64)> {
            places.map(|place| (place, self.misfit(place))).collect()
        };
        let least = |found: &[(usize, f64)]| {
            let least = found.iter().min_by(|a, b| a.1.total_cmp(&b.1));
            least.copied().unwrap_or((0, 0.0))
        };
        let mut found = misfits(&mut (0..count).step_by(stride));
        let near = least(&found).0;
        let around = near.saturating_sub(stride)..(near + stride).min(count);
        found.extend(misfits(&mut around.into_iter()));
        let (place, best) = least(&found);
        let enough = best + CHI_SQUARED * self.correlated(place);
        let known = found.iter().filter(|(_, misfit)| *misfit <= enough);
        let depths: Vec<f64> = known.map(|(place, _)| self.depth[*place]).collect();
        let place = self.until_it_moves(place);
        let step = self.depth[(place + 1).min(count - 1)] - self.depth[place];
        let error = 0.5 * range(&depths) / CHI_SQUARED.sqrt();
        Best {
            place,
            error: error.max(step.abs() / 12f64.sqrt()),
        }
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
    fn misfit(&self, place: usize) -> f64 {
        let count = (place + 1) as f64;
        let [sum, squares] = self.sums[place + 1];
        let zero = self.force[0] + sum / count;
        let from = self.depth[place];
        let mut total = 0.0;
        // Sums of the squares of (d − d_c)^p and of its products with the force, for each p.
        let mut fits = [[0.0; 2]; 3];
        for (d, f) in self.depth.iter().zip(self.force).skip(place + 1) {
            let (u, f) = ((d - from).max(0.0), f - zero);
            total += f * f;
            for (fit, power) in fits.iter_mut().zip([u, u * u.sqrt(), u * u]) {
                fit[0] += power * power;
                fit[1] += power * f;
            }
        }
        let gains = fits.iter().map(|[square, product]| {
            if *square > 0.0 && *product > 0.0 {
                product * (product / square)
            } else {
                0.0
            }
        });
        let gain = gains.fold(0.0, f64::max);
        let pressed = (self.depth.len() - place - 1) as f64;
        let [before, after] = self.variances;
        (squares - sum * sum / count).max(0.0) / before
            + (total - gain).max(0.0) / after
            + pressed * (after / before).ln()
    }
}

fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - values.iter().copied().fold(f64::INFINITY, f64::min)
}
