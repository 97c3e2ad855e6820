//! Integration points of the weak form and of the strong form's force: shell by shell in (r, φ, f).
//!
//! Gauss points in r and f, even spacing in φ, fewer of them towards the axis. The map is that of
//! [`super::layout`], so the points fill the organ's side of the surface at any curvature:
//! dV = r² sin ψ (∂ψ/∂f) dr df dφ.

use std::f64::consts::TAU;

use super::layout::CapShape;
use super::settings::Integration;
use crate::Vec3;
use crate::gauss::gauss_points;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    /// [h]
    pub(super) position: Vec3,
    /// [h³]
    pub(super) weight: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Pattern {
    radius: f64,
    fraction: f64,
    cosine: f64,
    sine: f64,
    weight: f64,
}

/// The points of a layout, before the shape of the surface is known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Quadrature {
    pattern: Vec<Pattern>,
}

impl Integration {
    /// Gauss points in r and in f, and the most points around, in each shell.
    fn orders(self) -> (usize, usize, f64) {
        match self {
            Self::Coarse => (2, 4, 12.0),
            Self::Standard => (3, 6, 18.0),
            Self::Fine => (4, 8, 24.0),
        }
    }
}

impl Quadrature {
    pub(super) fn new(integration: Integration, shells: usize) -> Self {
        let (radial, polar, around) = integration.orders();
        let mut pattern = Vec::new();
        for shell in 0..shells {
            for (r, r_weight) in gauss_points(radial) {
                for (level, (fraction, f_weight)) in gauss_points(polar).into_iter().enumerate() {
                    let flat_angle = fraction * 0.25 * TAU;
                    let count = (around * flat_angle.sin()).round().max(4.0) as usize;
                    for k in 0..count {
                        let turn = 0.5 * (level % 2) as f64;
                        let (sine, cosine) = (TAU * (k as f64 + turn) / count as f64).sin_cos();
                        pattern.push(Pattern {
                            radius: shell as f64 + r,
                            fraction,
                            cosine,
                            sine,
                            weight: r_weight * f_weight * TAU / count as f64,
                        });
                    }
                }
            }
        }
        Self { pattern }
    }

    pub(super) fn count(&self) -> usize {
        self.pattern.len()
    }

    /// The points below a surface of this shape.
    pub(super) fn points(&self, cap: CapShape) -> impl Iterator<Item = Point> {
        self.pattern.iter().map(move |p| {
            let surface = cap.surface_angle(p.radius, p.cosine, p.sine);
            let (across, along) = (p.fraction * surface).sin_cos();
            Point {
                position: p.radius * Vec3::new(across * p.cosine, across * p.sine, -along),
                weight: p.weight * p.radius * p.radius * across * surface,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::Layout;
    use super::super::solution::Solution;
    use super::*;
    use nalgebra::Vector3;

    /// Closed forms: half a ball, and the common part of two balls (a lens without its far cap).
    #[test]
    fn volume_is_that_of_the_cap() {
        let radius = 2.0f64;
        for curvature in [0.0, 0.3] {
            let cap = CapShape::new(Vector3::new(curvature, 0.0, curvature), 2);
            let quadrature = Quadrature::new(Integration::Standard, 2);
            let volume: f64 = quadrature.points(cap).map(|p| p.weight).sum();
            let pi = std::f64::consts::PI;
            // ∫ 2π r² (1 − cos ψ) dr with cos ψ = κ r/2.
            let exact = 2.0 * pi * (radius.powi(3) / 3.0 - curvature * radius.powi(4) / 8.0);
            // Six Gauss points over a quarter turn of sine: the first neglected term.
            assert!((volume / exact - 1.0).abs() < 1e-9, "{volume} {exact}");
        }
    }

    #[test]
    fn numbers_of_points_are_those_named() {
        let count = |integration| Quadrature::new(integration, 2).count();
        assert_eq!(count(Integration::Coarse), 128);
        assert_eq!(count(Integration::Standard), 414);
        assert_eq!(count(Integration::Fine), 960);
    }

    /// Where no sphere reached a point its functions would be none, and the body would have a hole there.
    #[test]
    fn every_template_reaches_its_points() {
        let numbers = (12..40).chain((40..=600).step_by(112));
        for particles in numbers {
            let layout = Layout::new(particles).unwrap();
            let steepest = CapShape::steepest_curvature(layout.shells);
            let points = Quadrature::new(Integration::Fine, layout.shells);
            for (first, second) in [
                (0.0, 0.0),
                (1.0, 1.0),
                (-1.0, -1.0),
                (1.0, -1.0),
                (1.0, 0.0),
            ] {
                let cap = CapShape::steep(Vector3::new(first, 0.0, second) * steepest);
                // The smallest support of either form; larger spheres reach what smaller ones do.
                let mut solution = Solution::new(particles);
                solution.place(&layout, cap, 1.6);
                let spheres = &solution.particles;
                let reached = |x: &Vec3| {
                    let mut spheres = spheres.positions.iter().zip(&spheres.inverse_squares);
                    spheres.any(|(at, inverse)| (at - x).norm_squared() * inverse < 1.0)
                };
                assert!(points.points(cap).all(|point| reached(&point.position)));
            }
        }
    }
}
