//! The covariance of Σ u r over correlated residuals r, for orthonormal columns u.
//!
//! Recordings are cut into blocks. What happens within a block is taken as independent of other blocks:
//! Σ over blocks of s sᵀ with s = Σ (u − ū)(r − r̄). The means r̄ of the blocks follow an autoregressive process
//! of an order that reaches over a beat of the heart, so
//!
//! ```text
//! cov = Sᵀ Γ S + Σ s sᵀ,    S = sums of u over blocks,  Γ = autocovariances of the process
//! ```
//!
//! A fit takes from the noise what its parameters can follow, which makes the residuals' autocovariances too
//! small. Those of the process are therefore raised until its own residuals, r̄ = (1 − Ū Sᵀ) n̄, would be
//! expected to show what was found, and multiplied with (N + k)/(N − k) for the k that were estimated
//! [Akaike 1969]. Draws of that process, seen as a fit leaves them, say by how much the covariance is too small all the
//! same, and how much it spreads: as one of so many degrees of freedom [Satterthwaite 1946]. Of several numbers of
//! blocks the one that says most is believed.
//!
//! *How we know*: `fit::coverage`; `independent::…`, on noise that is no such process.
//!
//! *Limits*: noise of one kind throughout; a recording of many correlation times.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::Random;

/// Blocks of one recording, at most: many see the quick part of the noise, few the slow one, and what one number of them makes
/// too small by chance another does not.
const BLOCKS: [usize; 3] = [800, 200, 50];
/// The number of blocks for which noise is drawn, and draws from which it is seen how much too small an estimate comes out.
const DRAWN: usize = 200;
const DRAWS: u64 = 40;
/// The order of the process, at most; less for few blocks.
const LARGEST_ORDER: usize = 60;
/// Autocovariances below this part of the first are none [-]: less than rounding leaves of their sums.
const FORGOTTEN: f64 = 1e-12;
/// Length, in orders of the process, after which its start has no influence.
const CORRELATION_TIMES: usize = 10;
/// Rounds in which the autocovariances are raised, at most.
const ROUNDS: usize = 6;

/// The covariance of Σ u r for the columns u of `directions`, and the degrees of freedom that it is known with [-].
pub(super) fn score_covariance(
    directions: &DMatrix<f64>,
    residuals: &[f64],
    recordings: &[usize],
) -> (DMatrix<f64>, f64) {
    let of = |most: usize| Blocks::new(directions, residuals, recordings, most);
    let (too_small, freedom) = of(DRAWN).draws(DRAWS);
    let covariances = BLOCKS.map(|most| {
        let blocks = of(most);
        blocks.between().1 * too_small + &blocks.within
    });
    let largest = covariances
        .into_iter()
        .max_by(|a, b| a.trace().total_cmp(&b.trace()));
    (largest.expect("there is a number of blocks"), freedom)
}

/// The seed of the draws.
const SEED: u64 = 1;

/// Residuals and directions by blocks.
struct Blocks {
    /// Mean residuals.
    means: Vec<f64>,
    /// Sums of the directions.
    sums: DMatrix<f64>,
    /// Means of the directions.
    averages: DMatrix<f64>,
    /// Σ s sᵀ.
    within: DMatrix<f64>,
    /// The blocks of each recording.
    recordings: Vec<Range<usize>>,
}

impl Blocks {
    fn new(
        directions: &DMatrix<f64>,
        residuals: &[f64],
        recordings: &[usize],
        most: usize,
    ) -> Self {
        let mut samples: Vec<Range<usize>> = Vec::new();
        let mut blocks: Vec<Range<usize>> = Vec::new();
        let mut start = 0;
        for &length in recordings {
            let count = length.min(most);
            blocks.push(samples.len()..samples.len() + count);
            let cut = |k: usize| start + k * length / count;
            samples.extend((0..count).map(|k| cut(k)..cut(k + 1)));
            start += length;
        }
        let width = directions.ncols();
        let mut found = Self {
            means: Vec::with_capacity(samples.len()),
            sums: DMatrix::zeros(samples.len(), width),
            averages: DMatrix::zeros(samples.len(), width),
            within: DMatrix::zeros(width, width),
            recordings: blocks,
        };
        for (block, rows) in samples.into_iter().enumerate() {
            let count = rows.len() as f64;
            let mean = residuals[rows.clone()].iter().sum::<f64>() / count;
            let part = directions.rows_range(rows.clone());
            let sum = part.row_sum();
            let deviations = residuals[rows].iter().map(|r| r - mean);
            let score = part
                .row_iter()
                .zip(deviations)
                .fold(sum.clone() * 0.0, |score, (u, r)| score + u * r);
            found.within += score.transpose() * &score;
            found.averages.set_row(block, &(&sum / count));
            found.sums.set_row(block, &sum);
            found.means.push(mean);
        }
        found
    }

    /// From draws of noise of the kind that was found: by how much too small its covariance comes out [-], at least
    /// one, and the degrees of freedom of a variance that spreads as much [-].
    fn draws(&self, draws: u64) -> (f64, f64) {
        let (process, expected) = self.between();
        let mut random = Random::new(SEED);
        // Traces in units of each direction's own variance, so that all count alike.
        let count = self.sums.ncols();
        let scale = |k: usize| expected[(k, k)].max(f64::MIN_POSITIVE);
        let (mut scores, mut estimates) = (0.0, vec![0.0; count]);
        let mut squares = vec![0.0; count];
        for _ in 0..draws {
            let (score, again) = self.drawn(&process, &mut random);
            let (_, estimated) = again.between();
            for k in 0..count {
                let estimate = estimated[(k, k)] / scale(k);
                scores += score[k].powi(2) / scale(k);
                estimates[k] += estimate;
                squares[k] += estimate.powi(2);
            }
        }
        let draws = draws as f64;
        // Half the squared coefficient of variation, in the mean of the directions.
        let spreads = (0..count).map(|k| {
            let mean = estimates[k] / draws;
            0.5 * (squares[k] / draws / mean.powi(2) - 1.0).max(0.0)
        });
        let spread = spreads.sum::<f64>() / count as f64;
        let freedom = if spread > 0.0 {
            spread.recip().max(1.0)
        } else {
            f64::INFINITY
        };
        let too_small = scores / estimates.iter().sum::<f64>();
        let too_small = if too_small.is_finite() {
            too_small.max(1.0)
        } else {
            1.0
        };
        (too_small, freedom)
    }

    /// Noise of a process, seen as what a fit leaves of it, and its scores.
    fn drawn(&self, process: &Process, random: &mut Random) -> (DVector<f64>, Self) {
        let mut noise = Vec::with_capacity(self.means.len());
        for range in &self.recordings {
            noise.extend(process.drawn(range.len(), random));
        }
        let noise = DVector::from_vec(noise);
        let scores = self.sums.tr_mul(&noise);
        let left = noise - &self.averages * &scores;
        let again = Self {
            means: left.as_slice().to_vec(),
            sums: self.sums.clone(),
            averages: self.averages.clone(),
            within: self.within.clone(),
            recordings: self.recordings.clone(),
        };
        (scores, again)
    }

    /// The process of the noise, and Sᵀ Γ S.
    fn between(&self) -> (Process, DMatrix<f64>) {
        let longest = self.recordings.iter().map(Range::len).max().unwrap_or(0);
        let order = (longest / 8).min(LARGEST_ORDER);
        let observed = self.autocovariances(order);
        let mut raised = observed.clone();
        let mut process = Process::new(raised.clone());
        let (mut nearest, mut least) = (process.clone(), f64::INFINITY);
        for _ in 0..=ROUNDS {
            let expected = self.expected(&process.autocovariances(longest), order);
            let missing = observed.iter().zip(&expected).map(|(o, e)| o - e);
            let missing: Vec<f64> = missing.collect();
            let off: f64 = missing.iter().map(|m| m * m).sum();
            // Residuals that hardly forget are no end of raised: it stops where it leads away.
            if off.is_nan() || off >= least {
                break;
            }
            (nearest, least) = (process.clone(), off);
            raised.iter_mut().zip(missing).for_each(|(r, m)| *r += m);
            process = Process::new(raised.clone());
            raised.copy_from_slice(&process.autocovariances(order + 1));
        }
        let shared = self.shared(&nearest.autocovariances(longest));
        let [count, order] = [self.means.len(), order].map(|n| n as f64);
        let between = self.sums.transpose() * shared * ((count + order) / (count - order));
        (nearest, between)
    }

    /// Mean products of residuals so many blocks apart.
    fn autocovariances(&self, most: usize) -> Vec<f64> {
        let product = |lag: usize| {
            let pairs = self.pairs(lag);
            pairs
                .map(|(i, j)| self.means[i] * self.means[j])
                .sum::<f64>()
        };
        let count = self.means.len() as f64;
        (0..=most).map(|lag| product(lag) / count).collect()
    }

    fn pairs(&self, lag: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let pairs = move |range: &Range<usize>| {
            let last = range.end.saturating_sub(lag).max(range.start);
            (range.start..last).map(move |i| (i, i + lag))
        };
        self.recordings.iter().flat_map(pairs)
    }

    /// Γ S, lag by lag.
    fn shared(&self, autocovariances: &[f64]) -> DMatrix<f64> {
        let mut shared = &self.sums * autocovariances[0];
        let least = FORGOTTEN * autocovariances[0];
        let last = autocovariances.iter().rposition(|c| c.abs() > least);
        for column in 0..self.sums.ncols() {
            let from = self.sums.column(column);
            let mut into = shared.column_mut(column);
            for range in &self.recordings {
                let from = &from.as_slice()[range.clone()];
                let into = &mut into.as_mut_slice()[range.clone()];
                let lags = autocovariances[1..=last.unwrap_or(0)].iter().zip(1..);
                for (covariance, lag) in lags.take_while(|(_, lag)| *lag < from.len()) {
                    add(covariance, &from[lag..], into);
                    add(covariance, from, &mut into[lag..]);
                }
            }
        }
        shared
    }

    /// The mean products that residuals of a process are expected to show.
    fn expected(&self, autocovariances: &[f64], most: usize) -> Vec<f64> {
        let shared = self.shared(autocovariances);
        let twice = &self.averages * (self.sums.transpose() * &shared);
        let count = self.means.len() as f64;
        let lost = |i: usize, j: usize| -> f64 {
            (0..self.sums.ncols())
                .map(|k| {
                    self.averages[(i, k)] * (shared[(j, k)] - twice[(j, k)])
                        + shared[(i, k)] * self.averages[(j, k)]
                })
                .sum()
        };
        let product = |lag: usize| {
            let pairs = self.pairs(lag);
            pairs
                .map(|(i, j)| autocovariances[lag] - lost(i, j))
                .sum::<f64>()
                / count
        };
        (0..=most).map(product).collect()
    }
}

/// Adds `factor` times the first numbers of `from` to `into`, as far as both go.
fn add(factor: &f64, from: &[f64], into: &mut [f64]) {
    for (sum, value) in into.iter_mut().zip(from) {
        *sum += factor * value;
    }
}

/// An autoregressive process, from its autocovariances by the recursion of Levinson and Durbin.
#[derive(Clone)]
struct Process {
    first: Vec<f64>,
    coefficients: Vec<f64>,
    /// Variance of what is new in each block.
    innovation: f64,
}

impl Process {
    /// Autocovariances that no process has are brought back to where one does.
    fn new(mut first: Vec<f64>) -> Self {
        let mut coefficients: Vec<f64> = Vec::new();
        first[0] = first[0].max(0.0);
        let mut left = first[0];
        for order in 1..first.len() {
            let predicted: f64 = coefficients
                .iter()
                .enumerate()
                .map(|(k, c)| c * first[order - 1 - k])
                .sum();
            let reflection = if left > 0.0 {
                ((first[order] - predicted) / left).clamp(-0.9999, 0.9999)
            } else {
                0.0
            };
            first[order] = predicted + reflection * left;
            let before = coefficients.clone();
            for (coefficient, other) in coefficients.iter_mut().zip(before.iter().rev()) {
                *coefficient -= reflection * other;
            }
            coefficients.push(reflection);
            left *= 1.0 - reflection * reflection;
        }
        Self {
            first,
            coefficients,
            innovation: left.max(0.0),
        }
    }

    /// So many blocks of its noise.
    fn drawn(&self, count: usize, random: &mut Random) -> Vec<f64> {
        let (new, start) = (
            self.innovation.sqrt(),
            CORRELATION_TIMES * (self.coefficients.len() + 1),
        );
        let mut all: Vec<f64> = Vec::with_capacity(start + count);
        for _ in 0..start + count {
            let past = self.coefficients.iter().zip(all.iter().rev());
            let follows: f64 = past.map(|(c, v)| c * v).sum();
            all.push(follows + new * random.normal());
        }
        all.split_off(start)
    }

    /// So many autocovariances.
    fn autocovariances(&self, count: usize) -> Vec<f64> {
        let mut values = self.first.clone();
        for _ in values.len()..count {
            let next = self
                .coefficients
                .iter()
                .zip(values.iter().rev())
                .map(|(c, v)| c * v)
                .sum();
            values.push(next);
        }
        values.truncate(count);
        values
    }
}
