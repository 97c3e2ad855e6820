//! The laws of the kernel, in one form that is stable under compression and inversion:
//!
//! ```text
//! Ψ = c₁₀ (I₁ − 3) + c₀₁ (I₂ − 3) − (2 c₁₀ + 4 c₀₁) (J − 1) + (c₁₀ + ½ λ₁) (J − 1)² + ½ (λ − λ₁) (J̄ − 1)²
//! ```
//!
//! with the invariants of C themselves, not of its isochoric part, and J̄ the mean of J over the element, so that the
//! law at rest is Hooke's with μ = 2 (c₁₀ + c₀₁) and λ [Smith, de Goes and Kim 2018], without their logarithm. At constant
//! volume these are the neo-Hookean and Mooney-Rivlin laws of `material`.
//!
//! Changes of volume that vary within an element cost λ₁ = min(λ, 2 μ), as at a Poisson's ratio of 1/3: with all of λ the
//! elements lock, and with none of it a wall of one element bends as at a ratio of 0, 15 % too easily. With J̄ in place
//! of J in c₁₀ as well they would lower the energy: a tip's force came out 4 % too small on every mesh.

use super::lanes::{LANES, Lanes, Scalar};
use crate::{Error, LinearElastic};

/// Parameters of the law of an element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moduli<T> {
    /// c₁₀ [Pa].
    pub c10: T,
    /// c₀₁ [Pa].
    pub c01: T,
    /// λ [Pa].
    pub dilation: T,
}

impl Moduli<f64> {
    /// A Mooney-Rivlin law (`c01` = 0: neo-Hookean) of the `poissons_ratio` [-] at rest; `c10` and `c01` in [Pa].
    ///
    /// # Errors
    /// When they are those of no solid at rest.
    pub fn mooney_rivlin(c10: f64, c01: f64, poissons_ratio: f64) -> Result<Self, Error> {
        let shear = 2.0 * (c10 + c01);
        let at_rest = LinearElastic::new(2.0 * shear * (1.0 + poissons_ratio), poissons_ratio)?;
        let lame = 2.0 * at_rest.shear_modulus() * poissons_ratio / (1.0 - 2.0 * poissons_ratio);
        Ok(Self {
            c10,
            c01,
            dilation: lame,
        })
    }
}

impl Moduli<f64> {
    /// The moduli of an element that several tissues share, each with its part of the volume [-]: the mean of the bounds of
    /// Voigt and Reuss for the shear modulus and for the bulk modulus [Hill 1952], with the part of c₀₁ in shear that
    /// Voigt's has.
    pub fn mixed(parts: impl Iterator<Item = (Self, f64)>) -> Self {
        let (mut sum, mut c01, mut bulk) = ([0.0; 2], 0.0, [0.0; 2]);
        for (moduli, part) in parts.filter(|(_, part)| *part > 0.0) {
            let own = moduli.c10 + moduli.c01;
            c01 += part * moduli.c01;
            for (sum, value) in [
                (&mut sum, own),
                (&mut bulk, moduli.dilation + 4.0 / 3.0 * own),
            ] {
                *sum = [sum[0] + part * value, sum[1] + part / value];
            }
        }
        let mean = |[voigt, reuss]: [f64; 2]| 0.5 * (voigt + 1.0 / reuss);
        let all = mean(sum);
        let c01 = all * c01 / sum[0];
        Self {
            c10: all - c01,
            c01,
            dilation: mean(bulk) - 4.0 / 3.0 * all,
        }
    }
}

impl<T: Scalar> Moduli<Lanes<T>> {
    /// What (J̄ − 1) and what (J − 1) contributes to the pressure: λ − λ₁ and 2 c₁₀ + λ₁ [Pa].
    #[inline(always)]
    pub(super) fn of_dilations(&self) -> [Lanes<T>; 2] {
        let [two, four] = [2.0, 4.0].map(Lanes::splat);
        let at_points = self.dilation.min(four * (self.c10 + self.c01));
        [self.dilation - at_points, two * self.c10 + at_points]
    }

    pub(super) fn put(&mut self, lane: usize, moduli: &Moduli<f64>) {
        debug_assert!(lane < LANES);
        self.c10.0[lane] = T::of(moduli.c10);
        self.c01.0[lane] = T::of(moduli.c01);
        self.dilation.0[lane] = T::of(moduli.dilation);
    }
}
