//! What the stress of an earlier depth contributes to the force at a later one.
//!
//! Tissue relaxes at every point by S(t) = Sₑ(t) − Σ gᵢ hᵢ(t), τᵢ ḣᵢ = Sₑ − hᵢ, with S the second Piola-Kirchhoff
//! stress [Simo 1987]. Virtual work along the elastic path, whose strains are E(d), gives the force
//! ```text
//! F(t) = Fₑ(d) − Σ gᵢ ∫ κ(d, d(s)) Fₑ(d(s)) exp(−(t − s)/τᵢ) ds/τᵢ,   d = d(t)
//! κ(d, d′) = ∫ Sₑ(d′) : ∂E/∂d (d) dV / Fₑ(d′),   κ(d, d) = 1
//! ```
//! At small strain κ = 1, and the force is the product of an elastic force and G(t) (6.5). At finite strain an
//! earlier stress does less work on a later strain. Relaxing tissue deforms otherwise than elastic tissue only as far
//! as its stress has relaxed unevenly, which changes this force in second order.
//!
//! *How we know*: `hereditary::…`: against full runs with internal variables, to six radii.
//!
//! *Limits*: incompressible tissue; κ is a cubic of both depths, fitted while the indenter goes in.

use nalgebra::{SMatrix, SVector};

use crate::branch;

/// κ of an indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HereditaryFactor {
    /// Length that depths are counted in [m].
    length: f64,
    /// Of the polynomial by which (κ − 1)/(x′ − x) is approximated, x = d/length [-]; in the order of [`POWERS`].
    coefficients: [f64; TERMS],
}

/// Powers of x and of x′ in the polynomial.
const POWERS: [[i32; 2]; TERMS] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
const TERMS: usize = 6;
/// One more than the largest power of x in κ.
const ORDERS: usize = 4;

/// The mean of κ over an interval of later depths, for one earlier depth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FactorSample {
    /// The interval of d [m].
    pub(crate) later: [f64; 2],
    /// d′ [m].
    pub(crate) earlier: f64,
    /// The mean of κ [-].
    pub(crate) mean: f64,
    /// What it counts [-].
    pub(crate) weight: f64,
}

impl HereditaryFactor {
    /// κ = 1: the force is the product of an elastic force and G(t).
    pub const ONE: Self = Self {
        length: 1.0,
        coefficients: [0.0; TERMS],
    };

    /// From the `coefficients` [-] of 1, x, x′, x², x x′ and x′² in (κ − 1)/(x′ − x), with x = d/`length`, x′ = d′/`length` [m].
    pub const fn new(length: f64, coefficients: [f64; TERMS]) -> Self {
        Self {
            length,
            coefficients,
        }
    }

    /// Its coefficients [-].
    pub fn coefficients(&self) -> [f64; TERMS] {
        self.coefficients
    }

    /// The nearest to `samples`, with depths counted in `length` [m].
    pub(crate) fn nearest(length: f64, samples: &[FactorSample]) -> Self {
        let mut matrix = SMatrix::<f64, TERMS, TERMS>::zeros();
        let mut right = SVector::<f64, TERMS>::zeros();
        for sample in samples {
            let earlier = sample.earlier / length;
            let [from, to] = sample.later.map(|depth| depth / length);
            // The mean of x^p over the interval.
            let mean = |p: i32| {
                (to.powi(p + 1) - from.powi(p + 1)) / (f64::from(p + 1) * (to - from))
            };
            let row = SVector::<f64, TERMS>::from_fn(|place, _| {
                let [p, q] = POWERS[place];
                earlier.powi(q) * (earlier * mean(p) - mean(p + 1))
            });
            matrix += row * row.transpose() * sample.weight;
            right += row * (sample.weight * (sample.mean - 1.0));
        }
        let found = matrix.cholesky().map(|factors| factors.solve(&right));
        Self {
            length,
            coefficients: found.map_or([0.0; TERMS], |found| found.into()),
        }
    }

    /// The same with depths `length` [-] times as large.
    pub fn scaled(&self, length: f64) -> Self {
        Self {
            length: length * self.length,
            ..*self
        }
    }

    /// κ [-] at a `depth` [m], of the stress at an `earlier` one [m].
    pub fn at(&self, depth: f64, earlier: f64) -> f64 {
        let x = depth / self.length;
        let of_powers = self.of_earlier(earlier);
        of_powers.iter().rev().fold(0.0, |sum, own| sum * x + own)
    }

    /// What one branch of a series has relaxed towards [N] at each time [s], for the elastic forces [N] at `depths`
    /// [m], and its change with the logarithm of the branch's `time_constant` [s]: as [`branch`], with κ.
    pub fn branch(
        &self,
        time_constant: f64,
        times: &[f64],
        depths: &[f64],
        elastic: &[f64],
    ) -> (Vec<f64>, Vec<f64>) {
        if self.coefficients == [0.0; TERMS] {
            return branch(time_constant, times, elastic);
        }
        let (mut values, mut slopes) = (vec![0.0; times.len()], vec![0.0; times.len()]);
        let of_powers: Vec<[f64; ORDERS]> = depths.iter().map(|d| self.of_earlier(*d)).collect();
        for power in 0..ORDERS {
            let weighted = elastic.iter().zip(&of_powers);
            let weighted: Vec<f64> = weighted.map(|(force, of)| force * of[power]).collect();
            let (value, slope) = branch(time_constant, times, &weighted);
            for (place, depth) in depths.iter().enumerate() {
                let x = (depth / self.length).powi(power as i32);
                values[place] += x * value[place];
                slopes[place] += x * slope[place];
            }
        }
        (values, slopes)
    }

    /// κ as a polynomial of x: the factors [-] of 1, x, x² and x³ for an earlier depth [m].
    pub(crate) fn of_earlier(&self, earlier: f64) -> [f64; ORDERS] {
        let earlier = earlier / self.length;
        let mut factors = [1.0, 0.0, 0.0, 0.0];
        for ([p, q], coefficient) in POWERS.into_iter().zip(self.coefficients) {
            let own = coefficient * earlier.powi(q);
            factors[p as usize] += own * earlier;
            factors[p as usize + 1] -= own;
        }
        factors
    }

    /// The powers 1, x, x² and x³ of a later depth [m].
    pub(crate) fn of_later(&self, depth: f64) -> [f64; ORDERS] {
        let x = depth / self.length;
        [1.0, x, x * x, x * x * x]
    }
}
