//! The exponential law W = γ/(2 α (α + 1)) Σ (exp(α (λ̄_i² − 1)) − 1) of the isochoric stretches λ̄_i,
//! at constant volume or with ½ κ (J − 1)². In simple tension its nominal stress is (6.2), with λ the
//! deformed over the undeformed length [Blatz, Chu and Wayland 1969]; the source has it inverted.
//!
//! W = γ/(2 α (α + 1)) (tr exp(α (C̄ − 1)) − 3), so P̄ = F̄ S with S = γ/(α + 1) exp(α (C̄ − 1)), which
//! `Isochoric` makes a stress. At rest μ = γ, E = 3 γ if incompressible. Nothing divides by α: the
//! limit α → 0 is a neo-Hookean law with C10 = γ/2; nothing divides by a difference of stretches.
//!
//! *How we know*: `laws` (the battery), `stretches` (closed forms).
//!
//! *Limits*: −1 < α; with α < 0 it softens, and beyond some stretch its force falls. Where the
//! exponential overflows, stress is infinite or NaN.

use nalgebra::Matrix3;

use super::isochoric::Isochoric;
use super::law::{Law, Tangent};
use super::principal::Principal;
use super::volume::Volume;
use crate::Error;

/// The exponential law of Blatz, Chu and Wayland.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponential {
    gamma: f64,
    alpha: f64,
    volume: Volume,
}

impl Exponential {
    /// From γ [Pa], the shear modulus at rest, and α [-]; the volume cannot change.
    ///
    /// # Errors
    /// Unless 0 < γ and −1 < α, both finite.
    pub fn incompressible(gamma: f64, alpha: f64) -> Result<Self, Error> {
        Self::new(gamma, alpha, Volume::INCOMPRESSIBLE)
    }

    /// From γ [Pa], α [-] and the bulk modulus κ [Pa].
    ///
    /// # Errors
    /// Unless 0 < γ, −1 < α and 0 < κ, all finite.
    pub fn compressible(gamma: f64, alpha: f64, bulk_modulus: f64) -> Result<Self, Error> {
        Self::new(gamma, alpha, Volume::compressible(bulk_modulus)?)
    }

    fn new(gamma: f64, alpha: f64, volume: Volume) -> Result<Self, Error> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if !(positive(gamma) && positive(alpha + 1.0)) {
            return Err(Error::ExponentialOutOfRange { gamma, alpha });
        }
        Ok(Self {
            gamma,
            alpha,
            volume,
        })
    }

    /// γ/(α + 1) [Pa].
    fn modulus(&self) -> f64 {
        self.gamma / (self.alpha + 1.0)
    }

    /// An eigenvalue of S [Pa] at one of C̄.
    fn principal_stress(&self, square: f64) -> f64 {
        self.modulus() * (self.alpha * (square - 1.0)).exp()
    }
}

/// (e^x − e^y)/(x − y) = e^((x + y)/2) sinh(h)/h with h = (x − y)/2.
fn divided_difference(x: f64, y: f64) -> f64 {
    let half = 0.5 * (x - y);
    if half.abs() > 1.0 {
        // Does not cancel, nor meet an infinite sinh.
        return (x.exp() - y.exp()) / (x - y);
    }
    let ratio = if half == 0.0 { 1.0 } else { half.sinh() / half };
    (0.5 * (x + y)).exp() * ratio
}

impl Law for Exponential {
    fn distortion_energy(&self, f: &Matrix3<f64>) -> f64 {
        let term = |square: f64| {
            let exponent = self.alpha * (square - 1.0);
            // (e^x − 1)/x, which is 1 at 0.
            let ratio = if exponent == 0.0 {
                1.0
            } else {
                exponent.exp_m1() / exponent
            };
            (square - 1.0) * ratio
        };
        let squares = Principal::of(&Isochoric::of(f).f).squares;
        0.5 * self.modulus() * squares.map(term).sum()
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
        let stresses = principal
            .squares
            .map(|square| self.principal_stress(square));
        let exponents = self.alpha * principal.squares.add_scalar(-1.0);
        // Between equal ones it is the derivative.
        let mut differences = Matrix3::from_diagonal(&(self.alpha * stresses));
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let difference = divided_difference(exponents[i], exponents[j]);
            differences[(i, j)] = self.modulus() * self.alpha * difference;
            differences[(j, i)] = differences[(i, j)];
        }
        let inner = principal.tangent(&stresses, &differences);
        isochoric.tangent(&principal.stress(&stresses), &inner)
    }

    fn volume(&self) -> Volume {
        self.volume
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![("gamma_pa", self.gamma), ("alpha", self.alpha)]
    }

    fn sensitivities(&self, index: usize, f: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
        if index == 0 {
            return (self.distortion_stress(f) / self.gamma, 0.0);
        }
        let isochoric = Isochoric::of(f);
        let principal = Principal::of(&isochoric.f);
        let rates = principal.squares.map(|square| {
            self.principal_stress(square) * (square - 1.0 - 1.0 / (self.alpha + 1.0))
        });
        (isochoric.stress(&principal.stress(&rates)), 0.0)
    }
}
