//! The force of an indentation as a function of its depth, elastic and relaxed.
//!
//! Between the depths that are known the force follows monotone cubics [Fritsch and Carlson 1980], so it
//! never falls where the known forces rise. With one relaxation function for the whole body the force
//! of any history d(t) is the convolution of F(d(t)) with it: one elastic curve answers for every
//! stimulus.
//!
//! *How we know*: `curves::…`; `indentation::convolution_is_the_full_run`.
//!
//! *Limits*: beyond the last depth ([`IndentationCurve::deepest`]) the curve continues along its
//! tangent.

use crate::{ForceHistory, PronySeries, Vec3};

/// Elastic force over depth, both ascending from zero.
#[derive(Debug, Clone, PartialEq)]
pub struct IndentationCurve {
    depths: Vec<f64>,
    forces: Vec<f64>,
    slopes: Vec<f64>,
}

/// Parts of the way between two times of a history in which the elastic force is taken as linear.
const PARTS: usize = 16;

impl IndentationCurve {
    /// A curve with zero force at zero depth and no other data.
    pub fn zero() -> Self {
        Self {
            depths: vec![0.0],
            forces: vec![0.0],
            slopes: vec![0.0],
        }
    }

    /// Through `depths` [m] and `forces` [N]; zero depth is added. Depths that do not ascend are left
    /// out.
    pub fn through(depths: &[f64], forces: &[f64]) -> Self {
        let mut curve = Self::zero();
        for (&depth, &force) in depths.iter().zip(forces) {
            curve.push(depth, force);
        }
        curve.set_slopes();
        curve
    }

    /// With one more depth [m], beyond the last, and its force [N].
    pub fn extend(&mut self, depth: f64, force: f64) {
        self.push(depth, force);
        self.set_slopes();
    }

    fn push(&mut self, depth: f64, force: f64) {
        if depth > self.deepest() {
            self.depths.push(depth);
            self.forces.push(force);
        }
    }

    /// The last depth that is known [m].
    pub fn deepest(&self) -> f64 {
        self.depths.last().copied().unwrap_or(0.0)
    }

    /// Whether it has the forces of `other` at the depths of that one, but for a part [-].
    pub fn approximates(&self, other: &Self, part: f64) -> bool {
        let mut known = other.points();
        known.all(|(depth, force)| (self.force(depth) - force).abs() <= part * force.abs())
    }

    /// The known depths [m] and forces [N].
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.depths.iter().copied().zip(self.forces.iter().copied())
    }

    /// The same curve in other units: depths times `length` [-], forces times `force` [-]. So the curve
    /// of one indenter and modulus is that of all: F = C10 a² f(d/a).
    pub fn scaled(&self, length: f64, force: f64) -> Self {
        let times = |values: &[f64], factor: f64| values.iter().map(|x| x * factor).collect();
        Self {
            depths: times(&self.depths, length),
            forces: times(&self.forces, force),
            slopes: times(&self.slopes, force / length),
        }
    }

    /// Force [N] at `depth` [m]; zero without contact.
    pub fn force(&self, depth: f64) -> f64 {
        self.value_and_slope(depth).0
    }

    /// Stiffness dF/dd [N/m] at `depth` [m].
    pub fn stiffness(&self, depth: f64) -> f64 {
        self.value_and_slope(depth).1
    }

    /// Forces [N] at `times` [s] of a tissue that relaxes by `series`, when the depth goes linearly
    /// through `depths` [m]. Before the first time there was no contact; a first depth above zero is
    /// a step.
    pub fn relaxed(&self, series: &PronySeries, times: &[f64], depths: &[f64]) -> Vec<f64> {
        let mut history = ForceHistory::default();
        let mut before: Option<(f64, f64)> = None;
        let mut forces = Vec::with_capacity(times.len());
        for (&time, &depth) in times.iter().zip(depths) {
            let (start, from) = before.unwrap_or((time, depth));
            let parts = if depth == from { 1 } else { PARTS };
            let step = (time - start) / parts as f64;
            let mut force = 0.0;
            for part in 1..=parts {
                let depth = from + (depth - from) * part as f64 / parts as f64;
                let elastic = Vec3::new(self.force(depth), 0.0, 0.0);
                force = history.advance(series, elastic, step).x;
            }
            forces.push(force);
            before = Some((time, depth));
        }
        forces
    }

    fn value_and_slope(&self, depth: f64) -> (f64, f64) {
        let last = self.depths.len() - 1;
        if depth <= 0.0 {
            return (0.0, self.slopes[0]);
        }
        if depth >= self.depths[last] {
            let beyond = depth - self.depths[last];
            return (
                self.forces[last] + beyond * self.slopes[last],
                self.slopes[last],
            );
        }
        let place = self.depths.partition_point(|&d| d <= depth);
        let (d0, d1) = (self.depths[place - 1], self.depths[place]);
        let (f0, f1) = (self.forces[place - 1], self.forces[place]);
        let (m0, m1) = (self.slopes[place - 1], self.slopes[place]);
        let width = d1 - d0;
        let t = (depth - d0) / width;
        let (rise, run) = (f1 - f0, t * t);
        let value =
            f0 + rise * run * (3.0 - 2.0 * t) + width * t * (1.0 - t) * (m0 * (1.0 - t) - m1 * t);
        let slope = rise / width * 6.0 * t * (1.0 - t)
            + m0 * (1.0 - t) * (1.0 - 3.0 * t)
            + m1 * t * (3.0 * t - 2.0);
        (value, slope)
    }

    /// Slopes of the monotone cubics: weighted harmonic means of the secants; at the ends a parabola's.
    fn set_slopes(&mut self) {
        let count = self.depths.len();
        self.slopes = vec![0.0; count];
        if count < 2 {
            return;
        }
        let width = |i: usize| self.depths[i + 1] - self.depths[i];
        let secant = |i: usize| (self.forces[i + 1] - self.forces[i]) / width(i);
        for i in 1..count - 1 {
            let (a, b) = (secant(i - 1), secant(i));
            if a * b > 0.0 {
                let (w1, w2) = (2.0 * width(i) + width(i - 1), width(i) + 2.0 * width(i - 1));
                self.slopes[i] = (w1 + w2) / (w1 / a + w2 / b);
            }
        }
        self.slopes[0] = end_slope(secant(0), self.slopes[1], count);
        self.slopes[count - 1] = end_slope(secant(count - 2), self.slopes[count - 2], count);
    }
}

/// The slope at an end that makes a parabola with the slope at the next place, limited to be
/// monotone.
fn end_slope(secant: f64, next: f64, count: usize) -> f64 {
    if count == 2 {
        return secant;
    }
    let slope = 2.0 * secant - next;
    slope.clamp(0.0_f64.min(3.0 * secant), 0.0_f64.max(3.0 * secant))
}
