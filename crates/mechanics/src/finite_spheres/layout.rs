//! Where the particles sit: shells of radius h, 2h … around the contact, each of rings between the
//! organ's surface and the inward axis.
//!
//! A place is (r, φ, f): distance r [h] from the contact, azimuth φ, and the fraction f of the polar
//! angle between the axis (0) and the surface (1). The surface lies at the polar angle
//! ψ = π/2 − asin(κ r/2), κ being its curvature along φ: exact on a sphere.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;

use crate::{Error, Vec3};

/// The particle number of the source.
pub const SOURCE_PARTICLES: usize = 34;

/// Spacing [h] that the number of shells is chosen for.
const SPACING: f64 = 1.1;

/// Largest |κ r/2|: the surface turns by at most 37 degrees within the shells.
const STEEPEST: f64 = 0.6;

/// The surface around the contact up to second order; curvatures κ₁₁, κ₁₂, κ₂₂ [1/h] in the contact's
/// tangents, positive where the organ bulges out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CapShape {
    curvature: Vector3<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) radius: f64,
    pub(super) azimuth: f64,
    pub(super) fraction: f64,
}

/// The condition on a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// At the contact: carried by the tool.
    Tool,
    /// On the organ's surface: free of traction.
    Surface,
    /// Inside.
    Interior,
    /// In the outermost shell: fixed.
    Fixed,
}

/// Places and roles of all particles; the tool's is the first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layout {
    pub(super) places: Vec<Place>,
    pub(super) roles: Vec<Role>,
    pub(super) shells: usize,
}

impl CapShape {
    pub(super) const FLAT: Self = Self {
        curvature: Vector3::new(0.0, 0.0, 0.0),
    };

    /// From curvatures [1/h], made gentler where they would fold the outermost of `shells`; see
    /// [`Self::gentler`].
    pub(super) fn new(curvature: Vector3<f64>, shells: usize) -> Self {
        Self::steep(curvature * Self::gentler(&curvature, shells))
    }

    /// Largest principal curvature by magnitude, in the unit of `curvature`.
    pub(super) fn largest_principal(curvature: &Vector3<f64>) -> f64 {
        let mean = 0.5 * (curvature[0] + curvature[2]);
        let half = 0.5 * (curvature[0] - curvature[2]);
        mean.abs() + half.hypot(curvature[1])
    }

    /// The factor on curvatures [1/h] that keeps the outermost of `shells` from folding [-]; one where
    /// it would not fold.
    pub(super) fn gentler(curvature: &Vector3<f64>, shells: usize) -> f64 {
        let steepest = Self::largest_principal(curvature);
        let most = Self::steepest_curvature(shells);
        if steepest > most {
            most / steepest
        } else {
            1.0
        }
    }

    /// From curvatures [1/h] as they are. Where the surface would turn by more than a quarter it stays
    /// at a little less, which only the outer corners of the table of solutions reach.
    pub(super) fn steep(curvature: Vector3<f64>) -> Self {
        Self { curvature }
    }

    /// Largest curvature [1/h] that a cap of `shells` can have.
    pub(super) fn steepest_curvature(shells: usize) -> f64 {
        2.0 * STEEPEST / shells as f64
    }

    pub(super) fn curvature(&self) -> &Vector3<f64> {
        &self.curvature
    }

    /// Polar angle of the surface [rad] at distance `radius` [h] along (cos φ, sin φ).
    pub(super) fn surface_angle(&self, radius: f64, cosine: f64, sine: f64) -> f64 {
        let [k11, k12, k22] = self.curvature.into();
        let along = k11 * cosine * cosine + 2.0 * k12 * cosine * sine + k22 * sine * sine;
        FRAC_PI_2 - (0.5 * along * radius).clamp(-0.95, 0.95).asin()
    }

    /// The place in the contact's frame (first tangent, second tangent, outward normal) [h].
    pub(super) fn position(&self, place: &Place) -> Vec3 {
        let (sine, cosine) = place.azimuth.sin_cos();
        let polar = place.fraction * self.surface_angle(place.radius, cosine, sine);
        let (across, along) = polar.sin_cos();
        place.radius * Vec3::new(across * cosine, across * sine, -along)
    }

    /// The place `x` [h] in the template: itself, or above the surface the place of the surface at the same distance and
    /// azimuth.
    pub(super) fn below_surface(&self, x: &Vec3) -> Vec3 {
        let (radius, outwards) = (x.norm(), x.x.hypot(x.y));
        let (cosine, sine) = match outwards > 0.0 {
            true => (x.x / outwards, x.y / outwards),
            false => (1.0, 0.0),
        };
        let surface = self.surface_angle(radius, cosine, sine);
        if outwards.atan2(-x.z) <= surface {
            return *x;
        }
        let (across, along) = surface.sin_cos();
        radius * Vec3::new(across * cosine, across * sine, -along)
    }

    /// Outward unit normal of the surface above a `position` [h] on it.
    pub(super) fn surface_normal(&self, position: &Vec3) -> Vec3 {
        let [k11, k12, k22] = self.curvature.into();
        let (x, y) = (position.x, position.y);
        Vec3::new(k11 * x + k12 * y, k12 * x + k22 * y, 1.0).normalize()
    }
}

impl Layout {
    /// A layout of exactly `particles`.
    ///
    /// # Errors
    /// Below 12, which cannot fill two shells, and above 600.
    pub(super) fn new(particles: usize) -> Result<Self, Error> {
        if !(12..=600).contains(&particles) {
            return Err(Error::ParticlesOutOfRange { particles });
        }
        let shells = if particles == SOURCE_PARTICLES {
            // The layout that the source's number was tried with; others of its size do worse.
            vec![vec![6, 3, 1], vec![10, 8, 4, 1]]
        } else {
            even_shells(particles)
        };
        Ok(Self::from_rings(&shells))
    }

    /// `shells[k][j]` particles in ring j of shell k + 1, surface first, axis last.
    fn from_rings(shells: &[Vec<usize>]) -> Self {
        let mut layout = Self {
            places: vec![Place {
                radius: 0.0,
                azimuth: 0.0,
                fraction: 0.0,
            }],
            roles: vec![Role::Tool],
            shells: shells.len(),
        };
        for (shell, rings) in shells.iter().enumerate() {
            let intervals = rings.len() - 1;
            for (ring, &count) in rings.iter().enumerate() {
                let role = match (shell + 1 == shells.len(), ring) {
                    (true, _) => Role::Fixed,
                    (false, 0) => Role::Surface,
                    (false, _) => Role::Interior,
                };
                // Neighbouring rings are turned against each other.
                let turn = if (shell + ring) % 2 == 0 { 0.0 } else { 0.5 };
                for k in 0..count {
                    layout.places.push(Place {
                        radius: (shell + 1) as f64,
                        azimuth: TAU * (k as f64 + turn) / count as f64,
                        fraction: 1.0 - ring as f64 / intervals as f64,
                    });
                    layout.roles.push(role);
                }
            }
        }
        layout
    }
}

/// Rings for a number of particles without a layout of its own: as evenly spaced as they go.
fn even_shells(particles: usize) -> Vec<Vec<usize>> {
    let count = |rings: &[Vec<usize>]| 1 + rings.iter().flatten().sum::<usize>();
    let widest_that_fits = |shells: usize| {
        let mut spacing = 0.4;
        while count(&rings(shells, spacing)) > particles && spacing < 4.0 {
            spacing += 0.01;
        }
        spacing
    };
    let shells = (2..=8)
        .filter(|&shells| count(&rings(shells, widest_that_fits(shells))) <= particles)
        .min_by(|&a, &b| {
            let off = |shells| (widest_that_fits(shells) - SPACING).abs();
            off(a).total_cmp(&off(b))
        })
        .unwrap_or(2);
    let mut rings = rings(shells, widest_that_fits(shells));
    // What is left over thickens the outermost surface ring.
    rings[shells - 1][0] += particles - count(&rings);
    rings
}

fn rings(shells: usize, spacing: f64) -> Vec<Vec<usize>> {
    (1..=shells)
        .map(|shell| {
            let radius = shell as f64;
            let intervals = (FRAC_PI_2 * radius / spacing).round().max(1.0) as usize;
            (0..=intervals)
                .map(|ring| {
                    if ring == intervals {
                        return 1;
                    }
                    let polar = FRAC_PI_2 * (1.0 - ring as f64 / intervals as f64);
                    ((TAU * radius * polar.sin() / spacing).round() as usize).max(3)
                })
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_particles_is_met_exactly() {
        for particles in 12..=600 {
            let layout = Layout::new(particles).unwrap();
            assert_eq!(layout.places.len(), particles);
            assert!(layout.shells >= 2);
            let fixed = layout.roles.iter().filter(|r| **r == Role::Fixed).count();
            assert!(fixed > 0 && fixed < particles - 1, "{particles}");
        }
        assert!(Layout::new(11).is_err());
    }

    /// Judge: the surface particles of the template, which are on it, and what is above and below them.
    #[test]
    fn what_is_above_the_surface_is_taken_to_it() {
        let cap = CapShape::new(Vector3::new(0.3, -0.1, -0.2), 2);
        let layout = Layout::new(34).unwrap();
        for place in layout.places.iter().filter(|p| p.fraction == 1.0) {
            let position = cap.position(place);
            let turned = |fraction: f64| cap.position(&Place { fraction, ..*place });
            // Rounding.
            assert!((cap.below_surface(&position) - position).norm() < 1e-14);
            assert_eq!(cap.below_surface(&turned(0.9)), turned(0.9));
            assert!((cap.below_surface(&turned(1.3)) - position).norm() < 1e-14);
        }
        for x in [Vec3::zeros(), -1.5 * Vec3::z()] {
            assert_eq!(cap.below_surface(&x), x);
        }
        assert!((cap.below_surface(&Vec3::z()).norm() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn surface_particles_lie_on_the_sphere() {
        let curvature = 0.2;
        let cap = CapShape::new(Vector3::new(curvature, 0.0, curvature), 2);
        let layout = Layout::new(34).unwrap();
        let center = Vec3::new(0.0, 0.0, -1.0 / curvature);
        for place in layout.places.iter().filter(|p| p.fraction == 1.0) {
            let position = cap.position(place);
            // Rounding.
            assert!(((position - center).norm() * curvature - 1.0).abs() < 1e-14);
            let radial = (position - center).normalize();
            // The normal is to second order in κ r.
            assert!(cap.surface_normal(&position).dot(&radial) > 0.99);
        }
    }
}
