//! Particles, integration points and the functions of the particles there: made once for a model.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::super::layout::{Layout, Place};
use super::super::settings::Integration;
use super::super::shape_function::{Particles, ShapeFunctions};
use super::region::{TemplatePlace, half_ball_distance, in_half_ball};
use crate::Vec3;
use crate::gauss::gauss_points;

/// Radius of a sphere in mean distances of the six nearest particles.
const SUPPORT: f64 = 2.5;

/// The outermost particles sit half a spacing inside of the fixed boundary.
const LAST_SPACING: f64 = 0.5;

/// Points across the tip: Gauss in the angle β of r = a sin β, even around.
const ACROSS: usize = 8;
const AROUND: usize = 12;

#[derive(Debug, Clone)]
pub(super) struct TemplatePoint {
    pub(super) place: TemplatePlace,
    /// Weight in dσ dφ df.
    pub(super) weight: f64,
}

/// A place under the tip.
#[derive(Debug, Clone, Copy)]
pub(super) struct TipPoint {
    /// Distance from the contact [tip radii].
    pub(super) radius: f64,
    pub(super) azimuth: f64,
    /// Part of the load of a flat punch; they sum to one.
    pub(super) weight: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Template {
    pub(super) particles: Particles,
    pub(super) points: Vec<TemplatePoint>,
    /// Points × particles: φ_J, and ∂φ_J/∂y.
    pub(super) values: Vec<f64>,
    pub(super) slopes: Vec<Vec3>,
    pub(super) tip: Vec<TipPoint>,
}

impl Template {
    pub(super) fn new(layout: &Layout, integration: Integration) -> Self {
        let count = layout.places.len();
        let mut particles = Particles::with_capacity(count);
        let outermost = layout.shells as f64 + LAST_SPACING;
        particles
            .positions
            .extend(layout.places.iter().map(|place| {
                let Place {
                    radius,
                    azimuth,
                    fraction,
                } = *place;
                in_half_ball(&TemplatePlace {
                    distance: radius / outermost,
                    azimuth,
                    fraction,
                })
            }));
        particles.size_spheres(SUPPORT);
        let points = integration_points(integration, layout.shells);
        let mut values = vec![0.0; points.len() * count];
        let mut slopes = vec![Vec3::zeros(); points.len() * count];
        let mut functions = ShapeFunctions::with_capacity(count);
        for (at, point) in points.iter().enumerate() {
            functions.evaluate(&particles, &in_half_ball(&point.place));
            for (a, &j) in functions.particles.iter().enumerate() {
                values[at * count + j as usize] = functions.values[a];
                slopes[at * count + j as usize] = functions.gradients[a];
            }
        }
        Self {
            particles,
            points,
            values,
            slopes,
            tip: tip_points(),
        }
    }
}

/// Gauss points, dense toward the tip's edge, where strain grows as the inverse root of the distance:
/// σ and f are quadratic in what is integrated over, which takes that root away.
fn integration_points(integration: Integration, shells: usize) -> Vec<TemplatePoint> {
    let more = shells.saturating_sub(2);
    let (inside, outside, polar, around) = match integration {
        Integration::Coarse => (4, 6, 6, 12),
        Integration::Standard => (6, 9, 8, 16),
        Integration::Fine => (9, 14, 12, 24),
    };
    let (inside, outside) = (inside + more, outside + 2 * more);
    let (polar, around) = (polar + 2 * more, around + 6 * more);
    let edge = half_ball_distance(1.0);
    let mut along: Vec<_> = gauss_points(inside)
        .into_iter()
        .map(|(p, w)| (edge * (1.0 - p * p), 2.0 * edge * p * w))
        .collect();
    along.extend(gauss_points(outside).into_iter().map(|(p, w)| {
        let rest = 1.0 - edge;
        (edge + rest * p * p, 2.0 * rest * p * w)
    }));
    let mut points = Vec::new();
    for (level, (p, polar_weight)) in gauss_points(polar).into_iter().enumerate() {
        let (fraction, polar_weight) = (1.0 - p * p, 2.0 * p * polar_weight);
        let ring = around as f64 * (fraction * FRAC_PI_2).sin();
        let ring = ring.round().max(4.0) as usize;
        let turn = 0.5 * (level % 2) as f64;
        for &(distance, weight) in &along {
            points.extend((0..ring).map(|k| TemplatePoint {
                place: TemplatePlace {
                    distance,
                    azimuth: TAU * (k as f64 + turn) / ring as f64,
                    fraction,
                },
                weight: weight * polar_weight * TAU / ring as f64,
            }));
        }
    }
    points
}

fn tip_points() -> Vec<TipPoint> {
    let mut points = Vec::new();
    for (along, weight) in gauss_points(ACROSS) {
        let radius = (FRAC_PI_2 * along).sin();
        points.extend((0..AROUND).map(|k| TipPoint {
            radius,
            azimuth: TAU * (k as f64 + 0.5) / AROUND as f64,
            // r dr/√(1 − r²) = sin β dβ, whose integral is one.
            weight: FRAC_PI_2 * weight * radius / AROUND as f64,
        }));
    }
    points
}
