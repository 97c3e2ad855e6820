//! The additional displacement of a narrow load on a wall, compared with a wide one and beyond that
//! on a half-space.
//!
//! A load of wave number k on one face of a free plate of the thickness t moves that face by
//!
//! ```text
//! G(k) = (1 − ν²)/(E k) (S + 1/(1/B + m)),   q = k t
//! S = (cosh q − 1)/(sinh q + q),   B = (cosh q + 1)/(sinh q − q)
//! ```
//!
//! S squeezes the plate and B bends it [Timoshenko and Goodier 1970, section 24]. Where it is curved it has to stretch to bend, which adds
//! the stiffness E t κ² per area, κ being the curvature across the wave [Donnell 1933]: m = (1 − ν²) t κ²/k. A half-space has S = B = 1 and
//! m = 0. So a point load goes farther than a load (1 − (r/R)²)² takes its own mean, beyond the same difference on a half-space, by
//!
//! ```text
//! 1/(2π)² ∫∫ (1 − f²(k R)) (G − 2 (1 − ν²)/(E k)) k dk dθ
//! ```
//!
//! with f the transform of the load and θ the direction of the wave. Waves longer than the wall is wide, or than the circumference
//! of its stronger curvature, are left out: the first move both loads alike, the second do not fit around it.
//!
//! *How we know*: tests of this module; `nonlinear_walls::…` of `simulate`, compared with finite elements of a tube under a
//! punch.
//!
//! *Limits*: one law, shallow shells, small strain, away from edges; the motion along the normal. Where a body is as round as it is thick it
//! is none of this, and nothing is added.

use std::f64::consts::{PI, SQRT_2};

use crate::layered::bump;

/// Samples of the integral over ln q, and its ends.
const SAMPLES: usize = 120;
const LOWEST: f64 = 1e-3;
const HIGHEST: f64 = 40.0;

/// Directions of waves in a quarter of a turn.
const DIRECTIONS: usize = 12;

/// Radii of loads over the thickness: the least, by what factor each next one is larger, and how many [-]. Under a load of the least
/// radius a wall is a half-space.
const MIN_RADIUS: f64 = 0.3;
const FACTOR: f64 = SQRT_2;
const RADII: usize = 11;

/// The Fourier operator of walls of one Poisson's ratio: the compliance at each wave number.
#[derive(Debug, Clone)]
pub struct WallOperator {
    harmonics: Vec<Harmonic>,
}

#[derive(Debug, Clone, Copy)]
struct Harmonic {
    /// q [-].
    number: f64,
    /// E k G of half a half-space, of a plate that is squeezed, and of one that bends, over k t [-].
    half: f64,
    squeezed: f64,
    bent: f64,
    /// Of the integral, for a load of each radius [-].
    weights: [f64; RADII],
}

/// The compliance of a wall for loads of several radii.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WallCompliance {
    /// [m]
    thickness: f64,
    /// The module's integral, times Young's modulus [1/m].
    yields: [f64; RADII],
}

impl WallOperator {
    /// Of walls with this Poisson's ratio [-].
    pub fn new(poissons_ratio: f64) -> Self {
        let step = (HIGHEST / LOWEST).ln() / SAMPLES as f64;
        let harmonics = (0..=SAMPLES).map(|sample| {
            let q = LOWEST * (step * sample as f64).exp();
            let half = (1.0 - poissons_ratio * poissons_ratio) / q;
            let end = if sample % SAMPLES == 0 { 0.5 } else { 1.0 };
            // sinh q − q, by its series where the difference would be lost.
            let bends = match q < 0.05 {
                true => q.powi(3) / 6.0 * (1.0 + q * q / 20.0),
                false => q.sinh() - q,
            };
            Harmonic {
                number: q,
                half,
                squeezed: half * (q.cosh() - 1.0) / (q.sinh() + q),
                bent: half * (q.cosh() + 1.0) / bends,
                weights: std::array::from_fn(|n| {
                    let load = bump(q * MIN_RADIUS * FACTOR.powi(n as i32));
                    end * step * q * q * (1.0 - load * load) / (2.0 * PI)
                }),
            }
        });
        Self {
            harmonics: harmonics.collect(),
        }
    }

    /// A wall with this thickness [m] and principal curvatures of its middle surface [1/m], as wide as `width` [m].
    pub fn compliance(&self, thickness: f64, curvatures: [f64; 2], width: f64) -> WallCompliance {
        let stretches: [f64; DIRECTIONS] = std::array::from_fn(|n| {
            let (sine, cosine) = (0.5 * PI * (n as f64 + 0.5) / DIRECTIONS as f64).sin_cos();
            let across = curvatures[0] * sine * sine + curvatures[1] * cosine * cosine;
            (thickness * across).powi(2)
        });
        let [one, other] = curvatures.map(f64::abs);
        let longest = thickness * one.max(other).max(1.0 / width);
        let mut yields = [0.0; RADII];
        for harmonic in self.harmonics.iter().filter(|own| own.number >= longest) {
            let bent = stretches
                .iter()
                .map(|own| 1.0 / (1.0 / harmonic.bent + own));
            let bent = bent.sum::<f64>() / DIRECTIONS as f64;
            let more = (harmonic.squeezed + bent - 2.0 * harmonic.half) / thickness;
            for (yields, weight) in yields.iter_mut().zip(&harmonic.weights) {
                *yields += weight * more;
            }
        }
        // Less than a half-space is what a body yields that is round rather than a wall.
        let yields = yields.map(|own| own.max(0.0));
        WallCompliance { thickness, yields }
    }
}

impl WallCompliance {
    /// The same wall with `times` its compliance.
    pub fn times(mut self, times: f64) -> Self {
        self.yields.iter_mut().for_each(|own| *own *= times);
        self
    }

    /// Displacement of a flat tip of radius `tip` [m] less the mean one of a load (1 − (r/R)²)² of the radius `load` [m], beyond the same
    /// difference on a half-space, times Young's modulus over the force [1/m]: as far as a point load, less the part that makes it
    /// nothing where the pressures of both have the same second moment, 2 a²/3 and R²/4.
    pub fn beyond_half_space(&self, [tip, load]: [f64; 2]) -> f64 {
        if self.thickness == 0.0 {
            return 0.0;
        }
        let part = (1.0 - 8.0 / 3.0 * (tip / load).powi(2)).max(0.0);
        let at = (load / (self.thickness * MIN_RADIUS)).ln() / FACTOR.ln();
        let at = at.clamp(0.0, (RADII - 1) as f64);
        let below = (at as usize).min(RADII - 2);
        let within = at - below as f64;
        part * ((1.0 - within) * self.yields[below] + within * self.yields[below + 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NU: f64 = 0.45;

    /// Closed form: on a thin plate of the stiffness D = E t³/(12 (1 − ν²)) a point load goes farther than one of the second moment
    /// s = R²/4 by s/(4 π D) ln w + …, w the width. Tolerance: 4 %, half a sample of the integral over ln q.
    #[test]
    fn a_wide_thin_plate_bends_as_its_closed_form() {
        let operator = WallOperator::new(NU);
        let (thickness, load) = (0.002, 0.01);
        let [narrow, wide] = [0.05, 0.8].map(|width| {
            let wall = operator.compliance(thickness, [0.0; 2], width);
            wall.beyond_half_space([0.0, load])
        });
        let stiffness = thickness.powi(3) / (12.0 * (1.0 - NU * NU));
        let expected = 0.25 * load * load / (4.0 * PI * stiffness) * f64::ln(16.0);
        let found = wide - narrow;
        assert!((found / expected - 1.0).abs() < 0.04, "{found} {expected}");
    }

    /// Judge: the half-space, whose compliance to the load is 2.408 (1 − ν²)/(π E R): a wall ten times as thick as the load is wide adds
    /// less than a hundredth of it. A tip as wide as the load goes as far; a curved wall yields less than a flat one.
    #[test]
    fn a_thick_wall_is_a_half_space() {
        let operator = WallOperator::new(NU);
        let load = 0.002;
        let of_load = 2.408 * (1.0 - NU * NU) / (PI * load);
        let thick = operator.compliance(0.02, [0.0; 2], 0.1);
        assert!(thick.beyond_half_space([0.0, load]).abs() < 0.01 * of_load);
        let [flat, curved] = [0.0, 100.0].map(|own| operator.compliance(0.002, [own, 0.0], 0.1));
        assert_eq!(flat.beyond_half_space([0.62 * load, load]), 0.0);
        let [flat, curved] = [flat, curved].map(|wall| wall.beyond_half_space([0.0, 3.0 * load]));
        assert!(0.0 < curved && curved < 0.7 * flat, "{curved} {flat}");
    }
}
