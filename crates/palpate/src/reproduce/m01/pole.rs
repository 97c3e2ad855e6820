//! The pole of the built-in hemisphere, and what a flat tip without friction meets there.

use nalgebra::{Matrix3, Vector3};
use palpate_geometry::{AabbTree, Organ, Surface};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::contact::{Bond, half_space_stiffness};
use palpate_mechanics::finite_spheres::{EXTERIOR_CONSTANTS, Form, LocalContact};

use crate::failure::Failure;

/// The source names no modulus; errors and times do not depend on it [Pa].
pub(super) const YOUNGS_MODULUS: f64 = 1e4;

/// Both ways of making the equations, with their words.
pub(super) const FORMS: [(Form, &str); 2] = [(Form::Weak, "weak"), (Form::Strong, "strong")];

/// Radius of the hemisphere of the source [m]: 10 cm diameter.
pub(super) const RADIUS: f64 = 0.05;

/// A tip of `radius` [m] at the pole.
pub(super) fn contact(radius: f64) -> Result<LocalContact, Failure> {
    let organ = Organ::Hemisphere;
    let surface = Surface::new(organ.surface_mesh(organ.default_triangles())?)?;
    let above = Vector3::new(0.0, 0.0, 2.0 * RADIUS);
    let nearest = AabbTree::new(surface.mesh()).nearest(surface.mesh(), &above);
    Ok(LocalContact {
        point: nearest.on.position,
        frame: Matrix3::identity(),
        curvature: Vector3::new(1.0, 0.0, 1.0) / RADIUS,
        triangle: nearest.triangle,
        radius,
        organ_radius: RADIUS,
    })
}

/// Stiffness [N/m] in closed form: the half-space's K, with k_o of the table of constants for the
/// held base: K / (1 − k_o a/R).
pub(super) fn stiffness(law: &LinearElastic, radius: f64) -> Option<f64> {
    let nu = law.poissons_ratio();
    let constants = EXTERIOR_CONSTANTS
        .iter()
        .find(|row| row.poissons_ratio == nu)?;
    let half_space = half_space_stiffness(law, radius, Bond::Slip);
    Some(half_space / (1.0 - constants.organ_size * radius / RADIUS))
}
