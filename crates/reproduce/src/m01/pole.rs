//! The pole of the built-in hemisphere, and the force on a frictionless flat tip there.

use nalgebra::{Matrix3, Vector3};
use palpate_geometry::{AabbTree, Organ, Surface};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::finite_elements::estimate::Estimated;
use palpate_mechanics::finite_elements::hemisphere::{
    self, HemisphereAnswer, HemisphereProblem, Patch,
};
use palpate_mechanics::finite_spheres::{Form, LocalContact, Surroundings};

use crate::Error;

/// The source names no modulus; errors and times do not depend on it [Pa].
pub(super) const YOUNGS_MODULUS: f64 = 1e4;

/// Both ways of making the equations, with their words.
pub(super) const FORMS: [(Form, &str); 2] = [(Form::Weak, "weak"), (Form::Strong, "strong")];

/// Poisson's ratios of the figures [-]; the source names none.
pub(super) const POISSONS_RATIOS: [f64; 2] = [0.3, 0.45];

/// Of the finite element force [-]: a third of the smallest differences that are shown.
const JUDGE_ACCURACY: f64 = 2e-3;

/// Radius of the hemisphere of the source [m]: 10 cm diameter.
pub(super) const RADIUS: f64 = 0.05;

/// A tip of `radius` [m] at the pole.
pub(super) fn contact(radius: f64) -> Result<LocalContact, Error> {
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
        surroundings: Surroundings::Hemisphere { radius: RADIUS },
        thickness: RADIUS,
    })
}

/// What the tip of `radius` [m] meets there, by finite elements, for a displacement of one metre: the
/// problem is linear.
pub(super) fn finite_elements(
    law: &LinearElastic,
    radius: f64,
) -> Result<Estimated<HemisphereAnswer>, Error> {
    let problem = hemisphere_problem(law, radius);
    Ok(hemisphere::solve(&problem, JUDGE_ACCURACY, |_| {})?)
}

/// The hemisphere with its base fixed, and a patch of `radius` [m] without friction that is moved by one
/// metre.
pub(super) fn hemisphere_problem(law: &LinearElastic, radius: f64) -> HemisphereProblem {
    HemisphereProblem {
        radius: RADIUS,
        patch_radius: radius,
        patch: Patch::Slip,
        law: *law,
        depth: 1.0,
    }
}
