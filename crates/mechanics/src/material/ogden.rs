//! Ogden's law W = Σ_p 2 μ_p/α_p² (λ̄₁^α_p + λ̄₂^α_p + λ̄₃^α_p − 3) of the isochoric stretches λ̄_i, with one to
//! three terms, at constant volume or with ½ κ (J − 1)² [Ogden 1972]. At rest μ = Σ μ_p, E = 3 μ if incompressible.
//! α = 2 is a neo-Hookean law with C10 = μ/2; α = 2 and α = −2 together are Mooney-Rivlin.
//!
//! P̄ = F̄ S, which `Isochoric` makes a stress; the eigenvalue of S at c = λ̄² is Σ_p 2 μ_p/α_p (c^(α_p/2) − 1)/c. The −1
//! adds a pressure, which it leaves out, and keeps the digits of small α. Nothing divides by a difference of stretches.
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: |α_p| ≥ 0.001; the limit 0 is Hencky's law; a term with μ_p < 0 may be unstable at some stretch.

use nalgebra::Matrix3;

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::principal::Principal;
use super::volume::Volume;
use crate::Error;

/// The names of the parameters of each term.
const NAMES: [[&str; 2]; 3] = [
    ["mu_1_pa", "alpha_1"],
    ["mu_2_pa", "alpha_2"],
    ["mu_3_pa", "alpha_3"],
];

/// Ogden's law.
#[derive(Debug, Clone, PartialEq)]
pub struct Ogden {
    terms: Vec<Term>,
    volume: Volume,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    mu: f64,
    alpha: f64,
}

impl Ogden {
    /// From one to three pairs of μ [Pa] and α [-]; the volume cannot change.
    ///
    /// # Errors
    /// Unless there are one to three pairs, 0 < Σ μ and 0.001 ≤ |α| for each, all finite.
    pub fn incompressible(terms: &[[f64; 2]]) -> Result<Self, Error> {
        Self::new(terms, Volume::INCOMPRESSIBLE)
    }

    /// From one to three pairs of μ [Pa] and α [-], and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// As [`incompressible`](Self::incompressible), and unless 0 < κ.
    pub fn compressible(terms: &[[f64; 2]], bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(terms, Volume::compressible(bulk_modulus)?)
    }

    fn new(terms: &[[f64; 2]], volume: Volume) -> Result<Self, Error> {
        let sum: f64 = terms.iter().map(|[mu, _]| mu).sum();
        let can_be = |alpha: f64| alpha.is_finite() && alpha.abs() >= 1e-3;
        let count = (1..=NAMES.len()).contains(&terms.len());
        if !(count && sum > 0.0 && sum.is_finite() && terms.iter().all(|term| can_be(term[1]))) {
            return Err(Error::OgdenOutOfRange {
                terms: terms.to_vec(),
            });
        }
        let terms = terms.iter().map(|[mu, alpha]| Term {
            mu: *mu,
            alpha: *alpha,
        });
        Ok(Self {
            terms: terms.collect(),
            volume,
        })
    }

    /// An eigenvalue of S [Pa] at one of C̄.
    fn principal_stress(&self, square: f64) -> f64 {
        self.terms.iter().map(|term| term.stress(square)).sum()
    }
}

impl Term {
    /// 2 μ/α (c^(α/2) − 1)/c [Pa].
    fn stress(&self, square: f64) -> f64 {
        2.0 * self.mu / self.alpha * (0.5 * self.alpha * square.ln()).exp_m1() / square
    }

    /// The divided difference of [`Term::stress`] between two squares [Pa].
    fn difference(&self, x: f64, y: f64) -> f64 {
        let half = 0.5 * ((x - y) / y).ln_1p();
        let q = 0.5 * self.alpha;
        if half.abs().max((q * half).abs()) > 1.0 {
            // Does not cancel, nor meet an infinite sinh.
            return (self.stress(x) - self.stress(y)) / (x - y);
        }
        // With x = m e^h, y = m e^−h: x y times the difference is, up to 2 μ/α,
        // m^q sinh(q h)/tanh(h) − ½ (x^q − 1) − ½ (y^q − 1).
        let ratio = if half == 0.0 {
            q
        } else {
            (q * half).sinh() / half.tanh()
        };
        let less_one = |c: f64| (q * c.ln()).exp_m1();
        let sum = (x * y).powf(0.5 * q) * ratio - 0.5 * (less_one(x) + less_one(y));
        2.0 * self.mu / self.alpha * sum / (x * y)
    }

    /// ∂/∂α of [`Term::stress`] [Pa].
    fn by_exponent(&self, square: f64) -> f64 {
        let z = 0.5 * self.alpha * square.ln();
        // z e^z − (e^z − 1).
        let curved = z * z.exp_m1() - excess(z);
        2.0 * self.mu / self.alpha.powi(2) * curved / square
    }
}

/// e^z − 1 − z.
fn excess(z: f64) -> f64 {
    if z.abs() > 0.5 {
        return z.exp_m1() - z;
    }
    let mut power = z;
    let terms = (2..=18).map(|k| {
        power *= z / f64::from(k);
        power
    });
    terms.sum()
}

impl Law for Ogden {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        let squares = Principal::of(&Isochoric::of(f).f).squares;
        let of_term = |term: &Term| {
            // The logarithms add up to 0.
            let powers = squares.map(|square| excess(0.5 * term.alpha * square.ln()));
            2.0 * term.mu / term.alpha.powi(2) * powers.sum()
        };
        self.terms.iter().map(of_term).sum()
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let stresses = principal
            .squares
            .map(|square| self.principal_stress(square));
        isochoric.stress(&principal.stress(&stresses))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let squares = principal.squares;
        let stresses = squares.map(|square| self.principal_stress(square));
        let differences = Matrix3::from_fn(|i, j| {
            let each = self.terms.iter();
            each.map(|term| term.difference(squares[i], squares[j]))
                .sum()
        });
        let inner = principal.tangent(&stresses, &differences);
        isochoric.tangent(&principal.stress(&stresses), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        let each = NAMES.iter().zip(&self.terms);
        each.flat_map(|([mu, alpha], term)| [(*mu, term.mu), (*alpha, term.alpha)])
            .collect()
    }

    fn by_parameter(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let term = self.terms[(index / 2).min(self.terms.len() - 1)];
        let unit = Term { mu: 1.0, ..term };
        let rates = principal.squares.map(|square| match index % 2 {
            0 => unit.stress(square),
            _ => term.by_exponent(square),
        });
        (isochoric.stress(&principal.stress(&rates)), 0.0)
    }
}
