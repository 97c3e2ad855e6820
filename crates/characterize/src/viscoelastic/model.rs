use nalgebra::DMatrix;
use palpate_mechanics::branch;

use crate::inverse::ZeroErrors;

/// One recording as its relaxation is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxationRecord {
    /// Times [s], ascending.
    pub time: Vec<f64>,
    /// Elastic force of the depths relative to that of the largest, as far as it is known [-].
    pub shape: Vec<f64>,
    /// ln of the depths relative to the largest [-]; of no depth, zero, where the shape is zero too.
    pub logarithm: Vec<f64>,
    /// Force relative to the largest of all courses [-].
    pub force: Vec<f64>,
    /// Change of the shape by one standard error of the first contact [-].
    pub by_contact: Vec<f64>,
    /// The same by the motion of the tissue.
    pub by_motion: Vec<f64>,
    /// Standard error of the force without load, relative to the largest force [-].
    pub zero_error: f64,
}

/// Samples of a moving depth that a thinned course keeps, at most about.
const THINNED: usize = 200;
/// A thinned hold keeps one of so many samples of those before it [-].
const SCALE: f64 = 50.0;

impl RelaxationRecord {
    /// Of `force` [N] at `depth` [m], where the elastic force is `shape` [any unit]; none without
    /// depth or force. `largest_force` [N] is one for all courses of a fit: a sensor's noise is
    /// as many newtons in each.
    pub fn new(
        time: &[f64],
        depth: &[f64],
        force: &[f64],
        largest_force: f64,
        shape: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let deepest = depth.iter().copied().fold(0.0, f64::max);
        let most = shape(deepest);
        if !(deepest > 0.0 && most > 0.0 && largest_force > 0.0) {
            return None;
        }
        let relative = |d: f64| (d / deepest).max(0.0);
        Some(Self {
            time: time.to_vec(),
            shape: depth.iter().map(|&d| shape(d.max(0.0)) / most).collect(),
            logarithm: depth
                .iter()
                .map(|&d| relative(d).max(f64::MIN_POSITIVE).ln())
                .collect(),
            force: force.iter().map(|f| f / largest_force).collect(),
            by_contact: vec![0.0; time.len()],
            by_motion: vec![0.0; time.len()],
            zero_error: 0.0,
        })
    }

    /// The same, of a recording whose zeros are known with these errors; the rest as for [`Self::new`].
    pub fn with_zeros(
        mut self,
        depth: &[f64],
        zeros: ZeroErrors,
        largest_force: f64,
        shape: impl Fn(f64) -> f64,
    ) -> Self {
        let most = shape(depth.iter().copied().fold(0.0, f64::max));
        let change = |by: f64| {
            let of = |d: &f64| {
                let ends = [d + by, d - by].map(|d| shape(d.max(0.0)));
                0.5 * (ends[0] - ends[1]) / most
            };
            depth.iter().map(of).collect()
        };
        self.by_contact = change(zeros.depth);
        self.by_motion = change(zeros.motion);
        self.zero_error = zeros.force / largest_force;
        self
    }

    /// What is seen of it when its hold is taken for that of a step: from the largest force on.
    pub(super) fn after_the_peak(&self) -> Self {
        let most = |best: usize, at: usize| {
            if self.force[at] > self.force[best] {
                at
            } else {
                best
            }
        };
        let peak = (0..self.force.len()).fold(0, most);
        let start = self.time[peak];
        Self {
            time: self.time[peak..].iter().map(|t| t - start).collect(),
            shape: vec![1.0; self.time.len() - peak],
            logarithm: vec![0.0; self.time.len() - peak],
            force: self.force[peak..].to_vec(),
            // A step has no ramp to be shifted on.
            by_contact: vec![0.0; self.time.len() - peak],
            by_motion: vec![0.0; self.time.len() - peak],
            zero_error: self.zero_error,
        }
    }

    /// Some of its samples: where the depth changes and, of a hold, some of each time scale. Between them the
    /// elastic force goes on linearly, as it did.
    pub(super) fn thinned(&self) -> Self {
        let moves = |i: usize| i > 0 && self.shape[i] != self.shape[i - 1];
        let moving = (0..self.time.len()).filter(|&i| moves(i)).count();
        let every = (moving / THINNED).max(1);
        let (mut kept, mut moved, mut next) = (Vec::new(), 0, 0);
        for i in 0..self.time.len() {
            moved += usize::from(moves(i));
            let turns = i + 1 < self.time.len() && moves(i) != moves(i + 1);
            if i >= next || turns || (moves(i) && moved % every == 0) {
                kept.push(i);
                next = i + 1 + (i as f64 / SCALE) as usize;
            }
        }
        let of = |values: &[f64]| kept.iter().map(|&i| values[i]).collect();
        Self {
            time: of(&self.time),
            shape: of(&self.shape),
            logarithm: of(&self.logarithm),
            force: of(&self.force),
            by_contact: of(&self.by_contact),
            by_motion: of(&self.by_motion),
            zero_error: self.zero_error,
        }
    }

    /// How long it lasts [s].
    pub(super) fn length(&self) -> f64 {
        self.time.last().unwrap_or(&0.0) - self.time.first().unwrap_or(&0.0)
    }

    /// Samples in which the depth changes.
    pub(super) fn ramp(&self) -> usize {
        let partly = |x: &&f64| **x > 0.02 && **x < 0.98;
        self.shape.iter().filter(partly).count()
    }

    /// Its largest force [-].
    pub(super) fn peak(&self) -> f64 {
        self.force.iter().copied().fold(0.0, f64::max)
    }

    /// Its largest force over that of the last tenth, less one [-].
    pub(super) fn drop(&self) -> f64 {
        let last = &self.force[self.force.len() - self.force.len().div_ceil(10)..];
        let end = last.iter().sum::<f64>() / last.len() as f64;
        let peak = self.peak();
        (peak / end.max(1e-3 * peak) - 1.0).clamp(1e-2, 1e2)
    }

    /// Elastic force with the exponent `mu` [-], and its change with it [-].
    fn elastic(&self, mu: f64) -> (Vec<f64>, Vec<f64>) {
        let each = self
            .shape
            .iter()
            .zip(&self.logarithm)
            .map(|(&shape, &log)| {
                // Most samples are of a hold, where the logarithm is zero.
                let value = match shape > 0.0 {
                    true if log == 0.0 => shape,
                    true => shape * (mu * log).exp(),
                    false => 0.0,
                };
                (value, if value > 0.0 { value * log } else { 0.0 })
            });
        each.unzip()
    }
}

/// The forces of several courses with one relaxation: parameters are μ, then for each term the ratio
/// ρᵢ = gᵢ/(1 − Σ g) and ln τᵢ, then the size of each course. With ρ ≥ 0 every series is one that relaxes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Model<'a> {
    pub(super) records: &'a [RelaxationRecord],
    pub(super) terms: usize,
}

impl Model<'_> {
    pub(super) fn samples(&self) -> usize {
        self.records.iter().map(|course| course.force.len()).sum()
    }

    /// Residuals [-] and their derivatives; none where a number is out of hand.
    pub(super) fn evaluate(
        &self,
        parameters: &[f64],
        residuals: &mut [f64],
        jacobian: &mut DMatrix<f64>,
    ) -> Option<()> {
        let series = terms(parameters, self.terms);
        let mut start = 0;
        for (number, course) in self.records.iter().enumerate() {
            let size = parameters[1 + 2 * self.terms + number];
            let (elastic, by_mu) = course.elastic(parameters[0]);
            let (force, columns) = relaxed(&course.time, &elastic, &by_mu, &series);
            let rows = course.force.len();
            for row in 0..rows {
                residuals[start + row] = size * force[row] - course.force[row];
            }
            for (place, column) in columns.iter().enumerate() {
                for row in 0..rows {
                    jacobian[(start + row, place)] = size * column[row];
                }
            }
            for other in 0..self.records.len() {
                let place = 1 + 2 * self.terms + other;
                let own = other == number;
                for row in 0..rows {
                    jacobian[(start + row, place)] = if own { force[row] } else { 0.0 };
                }
            }
            start += rows;
        }
        residuals.iter().all(|r| r.is_finite()).then_some(())
    }
}

impl Model<'_> {
    /// What the zeros of the courses do to the residuals [-], each column by one standard error of one of them, and the motion of
    /// the tissue to all of them.
    pub(super) fn systematic(&self, parameters: &[f64]) -> Vec<Vec<f64>> {
        let series = terms(parameters, self.terms);
        let (samples, mut start, mut columns) = (self.samples(), 0, Vec::new());
        let mut of_motion = Vec::with_capacity(samples);
        for (number, course) in self.records.iter().enumerate() {
            let size = parameters[1 + 2 * self.terms + number];
            let rows = start..start + course.force.len();
            let mut own = |change: Vec<f64>| {
                let mut column = vec![0.0; samples];
                column[rows.clone()].copy_from_slice(&change);
                columns.push(column);
            };
            let by_depth = |change: &[f64]| {
                let (force, _) = relaxed(&course.time, change, change, &series);
                force.into_iter().map(move |change| size * change)
            };
            if course.by_contact.iter().any(|change| *change != 0.0) {
                own(by_depth(&course.by_contact).collect());
            }
            of_motion.extend(by_depth(&course.by_motion));
            if course.zero_error > 0.0 {
                own(vec![-course.zero_error; course.force.len()]);
            }
            start = rows.end;
        }
        let moves = of_motion.iter().any(|change| *change != 0.0);
        columns.extend(moves.then_some(of_motion));
        columns
    }
}

/// Pairs of gᵢ [-] and τᵢ [s] of the parameters.
pub(crate) fn terms(parameters: &[f64], terms: usize) -> Vec<(f64, f64)> {
    let pairs = || (0..terms).map(|i| (parameters[1 + 2 * i], parameters[2 + 2 * i]));
    let whole = 1.0 + pairs().map(|(ratio, _)| ratio).sum::<f64>();
    pairs()
        .map(|(ratio, log)| (ratio / whole, log.exp()))
        .collect()
}

/// Relaxed force of a course of size one, and its change with μ and with each ρᵢ and ln τᵢ.
fn relaxed(
    time: &[f64],
    elastic: &[f64],
    by_mu: &[f64],
    series: &[(f64, f64)],
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let left: f64 = 1.0 - series.iter().map(|(g, _)| g).sum::<f64>();
    let branches: Vec<_> = series
        .iter()
        .map(|&(_, tau)| branch(tau, time, elastic))
        .collect();
    let mut lost = vec![0.0; time.len()];
    for ((g, _), (values, _)) in series.iter().zip(&branches) {
        add(&mut lost, *g, values);
    }
    let mut columns = Vec::with_capacity(1 + 2 * series.len());
    let mut mu = by_mu.to_vec();
    for &(g, tau) in series {
        add(&mut mu, -g, &branch(tau, time, by_mu).0);
    }
    columns.push(mu);
    for ((g, _), (values, slopes)) in series.iter().zip(&branches) {
        // ∂gⱼ/∂ρᵢ = (δᵢⱼ − gⱼ)(1 − Σ g).
        columns.push(
            lost.iter()
                .zip(values)
                .map(|(l, h)| left * (l - h))
                .collect(),
        );
        columns.push(slopes.iter().map(|slope| -g * slope).collect());
    }
    let force = elastic.iter().zip(&lost).map(|(e, l)| e - l).collect();
    (force, columns)
}

fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}
