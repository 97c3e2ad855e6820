//! The displacement between the particles, for display.
//!
//! Under the tip it is that of a rigid punch, (2/π) asin(a/r), further out the moving-least-squares
//! field corrected for the fixed shell, u = (1 − s) Σ φ_J U_J + s, and beyond the shells the rest s
//! decays as 1/r and is faded out.
//!
//! φ_J means nothing outside the template: few spheres reach there, and grow without bound. An organ bends away from the
//! template's surface, by more than a tip's radius where it is folded; what is above it moves as the surface below does.
//!
//! The strong form's answer to a tangential displacement has poles, and is not used for the force either: along the
//! surface its tip moves the organ as the punch does everywhere.
//!
//! *How we know*: `field::…`.
//!
//! *Limits*: over the steepest saddles, where it has poles, the strong form shows up to six times the depth of the tip.

use super::layout::CapShape;
use super::settings::Form;
use super::shape_function::ShapeFunctions;
use super::solution::Solution;
use super::weight::quartic;
use crate::Vec3;

/// Beyond this many radii of the outermost shell nothing is shown to move.
pub(super) const SHOWN: f64 = 2.0;

/// The tip's displacement and how it spreads, in the contact's frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    /// Displacement of the tip [m]: tangents, outward normal.
    pub(super) tip: Vec3,
    /// Shares of the exterior, tangential and normal [-].
    pub(super) share: [f64; 2],
    /// a/h [-].
    pub(super) radius_in_spacings: f64,
    /// Number of shells.
    pub(super) shells: f64,
    /// How the field was solved.
    pub(super) form: Form,
    /// The surface of the template.
    pub(super) cap: CapShape,
}

impl Spread {
    /// Displacement [m] at `x` [h], both in the contact's frame.
    pub(super) fn at(&self, solution: &Solution, functions: &mut ShapeFunctions, x: &Vec3) -> Vec3 {
        let distance = x.norm();
        let outward = distance / self.shells;
        let punch = (self.radius_in_spacings / distance.max(self.radius_in_spacings)).asin()
            * std::f64::consts::FRAC_2_PI;
        let normal = Vec3::new(0.0, 0.0, self.tip.z);
        let (solved, punched) = match self.form {
            Form::Weak => (self.tip, Vec3::zeros()),
            Form::Strong => (normal, self.tip - normal),
        };
        let punched = punched * (punch * fade(outward));
        let shared = Vec3::new(self.share[0], self.share[0], self.share[1]);
        let rest = shared.component_mul(&solved);
        if outward >= 1.0 {
            return rest * (fade(outward) / outward) + punched;
        }
        functions.evaluate_values(&solution.particles, &self.cap.below_surface(x));
        let mut moved = Vec3::zeros();
        let inner = solved - rest;
        for (&j, &value) in functions.particles.iter().zip(&functions.values) {
            moved += solution.coefficients[j as usize] * inner * value;
        }
        // The punch alone up to the tip's edge, nothing of it from the first shell on.
        let beyond_edge = (distance - self.radius_in_spacings).max(0.0);
        let near = quartic(beyond_edge / (1.0 - self.radius_in_spacings).max(0.25));
        near * punch * solved + (1.0 - near) * (moved + rest) + punched
    }
}

/// One at the outermost shell, zero at `SHOWN` of its radii, flat at both.
fn fade(outward: f64) -> f64 {
    smooth_fall((outward - 1.0) / (SHOWN - 1.0))
}

/// One up to zero, zero from one on, flat at both.
pub(super) fn smooth_fall(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    1.0 - along * along * (3.0 - 2.0 * along)
}
