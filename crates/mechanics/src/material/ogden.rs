//! Ogden's law W = Σ_p 2 μ_p/α_p² (λ̄_1^α_p + λ̄_2^α_p + λ̄_3^α_p − 3) of the isochoric stretches λ̄_i, with up to
//! three terms, at constant volume or with ½ κ (J − 1)² [Ogden 1972, in the scaling of Abaqus]. At rest μ = Σ μ_p.
//! FEBio's coefficients are c_p = 2 μ_p and m_p = α_p.
//!
//! With x = λ̄², l = ln x and a = α/2, P̄ = F̄ S and the eigenvalues of S are s(x) = Σ μ (e^(a l) − 1)/(a x), up to a
//! multiple of 1/x, which is a pressure and which `Isochoric` removes. With m and h the mean and half the difference
//! of two logarithms, the divided difference of s is, for each term and without cancellation at equal stretches,
//!   μ e^(−2 m) [e^(a m) (sinh(a h)/(a h)) h coth h − ½ Σ (e^(a l) − 1)/a].
//! Nothing divides by α either: α = 0 is Hencky's law μ Σ (ln λ̄)².
//!
//! *How we know*: `laws` (the battery, with equal and nearly equal stretches), `stretches` (closed forms).
//!
//! *Limits*: a μ_p may be negative while their sum is positive; the law is stable at rest then, but not at every
//! stretch. So it may be with one term and |α| < 1, whose force in tension falls beyond some stretch. Where a power
//! overflows, stress is infinite or NaN.

use nalgebra::{Matrix3, Vector3};
use palpate_files::tissue::LawName;

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::principal::Principal;
use super::volume::Volume;
use crate::Error;

/// Most terms of the law.
const MAX_TERMS: usize = 3;

/// Ogden's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ogden {
    /// μ [Pa] and α [-] of each term; terms beyond the order are zero.
    terms: [[f64; 2]; MAX_TERMS],
    order: usize,
    volume: Volume,
}

impl Ogden {
    /// From one to three pairs of μ_p [Pa] and α_p [-]; the volume cannot change.
    ///
    /// # Errors
    /// Unless there are one to three terms of finite numbers and 0 < Σ μ_p.
    pub fn incompressible(terms: &[[f64; 2]]) -> Result<Self, Error> {
        Self::new(terms, Volume::INCOMPRESSIBLE)
    }

    /// From one to three pairs of μ_p [Pa] and α_p [-] and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// Unless there are one to three terms of finite numbers, 0 < Σ μ_p and 0 < κ.
    pub fn compressible(terms: &[[f64; 2]], bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(terms, Volume::compressible(bulk_modulus)?)
    }

    fn new(terms: &[[f64; 2]], volume: Volume) -> Result<Self, Error> {
        let order = terms.len();
        let shear: f64 = terms.iter().map(|[mu, _]| mu).sum();
        let finite = terms.as_flattened().iter().all(|value| value.is_finite());
        if !(finite && (1..=MAX_TERMS).contains(&order) && shear > 0.0 && shear.is_finite()) {
            return Err(Error::OgdenOutOfRange { order, shear });
        }
        let mut own = [[0.0; 2]; MAX_TERMS];
        own[..order].copy_from_slice(terms);
        Ok(Self {
            terms: own,
            order,
            volume,
        })
    }

    fn terms(&self) -> &[[f64; 2]] {
        &self.terms[..self.order]
    }

    /// Eigenvalues of S [Pa] from those of C̄ and their logarithms.
    fn principal_stresses(&self, squares: &Vector3<f64>, logs: &Vector3<f64>) -> Vector3<f64> {
        squares.zip_map(logs, |square, log| {
            let sum = |[mu, alpha]: &[f64; 2]| mu * power(0.5 * alpha, log);
            self.terms().iter().map(sum).sum::<f64>() / square
        })
    }

    /// The divided difference of s [Pa] between two eigenvalues of C̄, by their logarithms.
    fn divided_difference(&self, first: f64, second: f64) -> f64 {
        let (mean, half) = (0.5 * (first + second), 0.5 * (first - second));
        let coth = if half == 0.0 { 1.0 } else { half / half.tanh() };
        let term = |[mu, alpha]: &[f64; 2]| {
            let a = 0.5 * alpha;
            let sinh = if a * half == 0.0 {
                1.0
            } else {
                (a * half).sinh() / (a * half)
            };
            let powers = 0.5 * (power(a, first) + power(a, second));
            mu * ((a * mean).exp() * sinh * coth - powers)
        };
        (-2.0 * mean).exp() * self.terms().iter().map(term).sum::<f64>()
    }
}

/// (e^(a l) − 1)/a, which is l at a = 0.
fn power(a: f64, log: f64) -> f64 {
    if a == 0.0 {
        log
    } else {
        (a * log).exp_m1() / a
    }
}

/// (e^y − 1 − y)/y², which is ½ at 0.
fn second_remainder(y: f64) -> f64 {
    if y.is_nan() || y.abs() >= 1.0 {
        return (y.exp_m1() - y) / y.powi(2);
    }
    // Σ y^k/(k + 2)!, whose terms fall below the last digit before the twentieth.
    let (mut sum, mut term) = (0.0, 0.5);
    for k in 3..20 {
        sum += term;
        term *= y / f64::from(k);
    }
    sum
}

impl Law for Ogden {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        let logs = Principal::of(&Isochoric::of(f).f).squares.map(f64::ln);
        // The logarithms of the stretches sum to zero, so the part linear in them may go.
        let term = |[mu, alpha]: &[f64; 2]| {
            let each = logs.map(|log| {
                let log = 0.5 * log;
                log.powi(2) * second_remainder(alpha * log)
            });
            2.0 * mu * each.sum()
        };
        self.terms().iter().map(term).sum()
    }

    fn distortion_stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let logs = principal.squares.map(f64::ln);
        let stresses = self.principal_stresses(&principal.squares, &logs);
        isochoric.stress(&principal.stress(&stresses))
    }

    fn distortion_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let logs = principal.squares.map(f64::ln);
        let stresses = self.principal_stresses(&principal.squares, &logs);
        let differences = Matrix3::from_fn(|i, j| self.divided_difference(logs[i], logs[j]));
        let inner = principal.tangent(&stresses, &differences);
        isochoric.tangent(&principal.stress(&stresses), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        let keys = LawName::Ogden.row().keys();
        keys.zip(self.terms().as_flattened().iter().copied())
            .collect()
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let [mu, alpha] = self.terms[(index / 2).min(MAX_TERMS - 1)];
        let rates = principal.squares.map(|square| {
            let log = square.ln();
            if index.is_multiple_of(2) {
                return power(0.5 * alpha, log) / square;
            }
            // d/dα (e^(a l) − 1)/a = ½ l² e^(a l) (e^(−a l) − 1 + a l)/(a l)².
            let exponent = 0.5 * alpha * log;
            0.5 * mu * log.powi(2) * exponent.exp() * second_remainder(-exponent) / square
        });
        (isochoric.stress(&principal.stress(&rates)), 0.0)
    }
}
