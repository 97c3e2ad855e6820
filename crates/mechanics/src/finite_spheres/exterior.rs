//! Corrections from the shells to the organ: the tool's radius, the tissue beyond the shells, and the
//! organ's size.
//!
//! Compliances add: C = C_shells + (k_c/r − k_o/R)/K̂, with r the radius of the fixed shell, R that of
//! a hemisphere of the organ's volume fixed at its base, and K̂ = F/(a d) of the half-space. A fixed
//! periphery stiffens (k_c > 0; the source's section 3.3 says the contrary), and so does a fixed base.
//!
//! One particle under the tool has no radius of its own: C_shells depends on h alone. So h = a/α, and
//! the half-space, whose solution is known, gives α: 1/α = Ĉ K̂ + k_c h/r. On a hemisphere the shells
//! answer to curvature as well, which k_o, measured on hemispheres, already contains; the shells' part
//! of it is subtracted there, so that curvature changes the force only where it is not 1/R. Both are
//! solved for when a model is made, for its particles, form and ν; a further constant makes the
//! tangential stiffness of the half-space exact.

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::layout::CapShape;
use super::model::Surroundings;
use super::settings::Form;
use crate::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use crate::{Limit, Limits, LinearElastic, Reached};

/// A row of the table of constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExteriorConstants {
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// k_c [-]: compliance that a clamped periphery removes.
    pub beyond_shells: f64,
    /// k_o [-]: compliance that a fixed base removes.
    pub organ_size: f64,
}

/// The constants that no closed form gives, from finite elements: `exterior::…` makes them again.
///
/// k_c is the limit of half a ball, fixed on its round side, whose radius is many times that of the
/// punch; k_o belongs to a patch of a twentieth of the radius on a hemisphere, both without friction.
pub const EXTERIOR_CONSTANTS: [ExteriorConstants; 5] = [
    ExteriorConstants::new(0.0, 0.925, 0.070),
    ExteriorConstants::new(0.15, 0.957, 0.427),
    ExteriorConstants::new(0.3, 1.074, 0.663),
    ExteriorConstants::new(0.4, 1.287, 0.739),
    ExteriorConstants::new(0.45, 1.494, 0.746),
];

impl ExteriorConstants {
    const fn new(poissons_ratio: f64, beyond_shells: f64, organ_size: f64) -> Self {
        Self {
            poissons_ratio,
            beyond_shells,
            organ_size,
        }
    }
}

/// Largest Poisson's ratio that the model is calibrated for [-]; above it the answer is that at this
/// ratio, times the ratio of the half-spaces.
pub const LARGEST_CALIBRATED_RATIO: f64 = 0.45;

/// Curvature [1/h] at which the answer of the shells to curvature is measured: a tip of 2 mm on an organ
/// of 50 mm.
const PROBE: f64 = 0.1;

/// No contact is stiffer than this many half-spaces: beyond, the tip is as large as the organ, and
/// the expansion in a/R means nothing.
const STIFFEST: f64 = 3.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Calibration {
    /// α = a/h [-].
    pub(super) radius_in_spacings: f64,
    beyond_shells: f64,
    organ_size: f64,
    beyond_shells_tangential: f64,
    organ_size_tangential: f64,
    /// K̂ [Pa], normal and tangential.
    half_space: f64,
    half_space_tangential: f64,
    youngs_modulus: f64,
    shells: f64,
    bond: Friction,
    form: Form,
}

/// Stiffness of a contact, and the part of its displacement that the fixed shell takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corrected {
    /// [N/m] per direction of the contact's frame; off-diagonal terms between the tangents only.
    pub(super) stiffness: Matrix3<f64>,
    /// [-], tangential and normal: from a shell that stays to one that moves as far as the tip, also where the stiffness
    /// is bounded or the organ is stiffer than its shells.
    pub(super) share: [f64; 2],
    /// Bounds that changed the stiffness.
    pub(super) limits: Limits,
}

/// Constants at ν, linear between the rows; k_c as k_c (1 − ν), which varies least. Outside the rows
/// the nearest one is taken.
pub(super) fn constants(poissons_ratio: f64) -> ExteriorConstants {
    let above = |row: &ExteriorConstants| row.poissons_ratio >= poissons_ratio;
    let last = EXTERIOR_CONSTANTS.len() - 1;
    let high = EXTERIOR_CONSTANTS
        .iter()
        .position(above)
        .unwrap_or(last)
        .max(1);
    let (low, high) = (EXTERIOR_CONSTANTS[high - 1], EXTERIOR_CONSTANTS[high]);
    let span = high.poissons_ratio - low.poissons_ratio;
    let along = ((poissons_ratio - low.poissons_ratio) / span).clamp(0.0, 1.0);
    let between = |a: f64, b: f64| a + along * (b - a);
    let scaled = |row: ExteriorConstants| row.beyond_shells * (1.0 - row.poissons_ratio);
    ExteriorConstants {
        poissons_ratio,
        beyond_shells: between(scaled(low), scaled(high)) / (1.0 - poissons_ratio),
        organ_size: between(low.organ_size, high.organ_size),
    }
}

impl Calibration {
    /// `solve` gives the stiffness [E h] of the shells under a cap; `shells` is their number.
    pub(super) fn new(
        law: LinearElastic,
        bond: Friction,
        form: Form,
        shells: usize,
        mut solve: impl FnMut(CapShape) -> Matrix3<f64>,
    ) -> Self {
        let modulus = law.youngs_modulus();
        let half_space = half_space_stiffness(&law, 1.0, bond);
        let half_space_tangential = half_space_tangential_stiffness(&law, 1.0);
        let known = constants(law.poissons_ratio());
        let flat = solve(CapShape::FLAT);
        let round = solve(CapShape::new(PROBE * Vector3::new(1.0, 0.0, 1.0), shells));
        let slope = (1.0 / round[(2, 2)] - 1.0 / flat[(2, 2)]) / PROBE;
        let shells = shells as f64;
        let in_half_spaces = half_space / modulus;
        let inverse = in_half_spaces / flat[(2, 2)] + known.beyond_shells / shells;
        let tangential = mean_tangential(&flat);
        let tangential_slope = (1.0 / mean_tangential(&round) - 1.0 / tangential) / PROBE;
        Self {
            radius_in_spacings: 1.0 / inverse,
            beyond_shells: known.beyond_shells,
            organ_size: known.organ_size + slope * in_half_spaces,
            beyond_shells_tangential: shells
                * (inverse - half_space_tangential / modulus / tangential),
            organ_size_tangential: tangential_slope * half_space_tangential / modulus,
            half_space,
            half_space_tangential,
            youngs_modulus: modulus,
            shells,
            bond,
            form,
        }
    }

    /// Stiffness of a contact whose shells of spacing `spacing` [m] have the stiffness `shells` [E h], in
    /// `surroundings`.
    pub(super) fn correct(
        &self,
        shells: &Matrix3<f64>,
        spacing: f64,
        surroundings: &Surroundings,
    ) -> Corrected {
        match surroundings {
            Surroundings::Hemisphere { radius } => self.on_hemisphere(shells, spacing, *radius),
            Surroundings::Known(structural) => self.in_known(shells, spacing, structural),
        }
    }

    /// The half-space's stiffness in series with `further` [1/m], which holds the curvature as well: of the shells only
    /// the share of the displacement is taken.
    fn in_known(
        &self,
        shells: &Matrix3<f64>,
        spacing: f64,
        structural: &Matrix3<f64>,
    ) -> Corrected {
        let (unit, radius) = (
            self.youngs_modulus * spacing,
            self.radius_in_spacings * spacing,
        );
        let mut limits = Limits::NONE;
        let mut bounded = |limit, least: f64, compliance: f64| {
            if compliance >= least {
                return compliance;
            }
            let unbounded = half_spaces(STIFFEST * least / compliance);
            let used = STIFFEST;
            limits.add(limit, Reached { unbounded, used });
            least
        };
        let own = 1.0 / (self.half_space * radius);
        let normal = own + structural[(2, 2)] / self.youngs_modulus;
        let normal = bounded(Limit::LocalStiffness, own / STIFFEST, normal);
        let inside = 1.0 / (shells[(2, 2)] * unit);
        let mut stiffness = Matrix3::zeros();
        stiffness[(2, 2)] = 1.0 / normal;
        let mut share = [0.0, (1.0 - inside / normal).clamp(0.0, 1.0)];
        if self.bond == Friction::Bonded {
            let own = 1.0 / (self.half_space_tangential * radius);
            let along = structural.fixed_view::<2, 2>(0, 0) / self.youngs_modulus
                + Matrix2::from_diagonal_element(own);
            let mean = 0.5 * along.trace();
            let spread = (0.5 * (along[(0, 0)] - along[(1, 1)])).hypot(along[(0, 1)]);
            let stiffest = mean - spread;
            let more = bounded(Limit::LocalShearStiffness, own / STIFFEST, stiffest) - stiffest;
            let along = along + Matrix2::from_diagonal_element(more);
            let inverse = along.try_inverse();
            let both = inverse.unwrap_or_else(|| Matrix2::repeat(f64::NAN));
            stiffness.fixed_view_mut::<2, 2>(0, 0).copy_from(&both);
            let of_shells = shells.fixed_view::<2, 2>(0, 0).trace() * unit;
            share[0] = (1.0 - both.trace() / of_shells).clamp(0.0, 1.0);
        }
        Corrected {
            stiffness,
            share,
            limits,
        }
    }

    fn on_hemisphere(&self, shells: &Matrix3<f64>, spacing: f64, organ_radius: f64) -> Corrected {
        let unit = self.youngs_modulus * spacing;
        let held_at = self.shells * spacing;
        let inside = 1.0 / (shells[(2, 2)] * unit);
        let outside =
            (self.beyond_shells / held_at - self.organ_size / organ_radius) / self.half_space;
        let radius = self.radius_in_spacings * spacing;
        let mut limits = Limits::NONE;
        let mut normal = inside + outside;
        let least = 1.0 / (STIFFEST * self.half_space * radius);
        if normal < least {
            let unbounded = half_spaces(STIFFEST * least / normal);
            let used = STIFFEST;
            limits.add(Limit::LocalStiffness, Reached { unbounded, used });
            normal = least;
        }
        let mut stiffness = Matrix3::zeros();
        stiffness[(2, 2)] = 1.0 / normal;
        let mut share = [0.0, (1.0 - inside / normal).clamp(0.0, 1.0)];
        match (self.bond, self.form) {
            (Friction::Frictionless, _) => {}
            (Friction::Bonded, Form::Strong) => {
                stiffness[(0, 0)] = self.half_space_tangential * radius;
                stiffness[(1, 1)] = stiffness[(0, 0)];
            }
            (Friction::Bonded, Form::Weak) => {
                let along = shells.fixed_view::<2, 2>(0, 0) * unit;
                let mut beyond = (self.beyond_shells_tangential / held_at
                    - self.organ_size_tangential / organ_radius)
                    / self.half_space_tangential;
                // As above: not stiffer than the expansion means.
                let least = -0.5 / along.norm();
                if beyond < least {
                    let unbounded = half_spaces(1.0 / (1.0 - 0.5 * beyond / least));
                    let used = 2.0;
                    limits.add(Limit::LocalShearStiffness, Reached { unbounded, used });
                    beyond = least;
                }
                // (along⁻¹ + c 1)⁻¹ = (1 + c along)⁻¹ along, which needs no inverse of `along`. The sum is
                // not singular: `along` is positive definite, and c above −0.5/|along|.
                let sum = Matrix2::identity() + beyond * along;
                let inverse = sum.try_inverse();
                let both = inverse.unwrap_or_else(|| Matrix2::repeat(f64::NAN)) * along;
                stiffness.fixed_view_mut::<2, 2>(0, 0).copy_from(&both);
                share[0] = (1.0 - both.trace() / along.trace()).clamp(0.0, 1.0);
            }
        }
        Corrected {
            stiffness,
            share,
            limits,
        }
    }
}

/// A stiffness in half-spaces; one that is negative is that of a compliance below zero, which nothing
/// bounds.
fn half_spaces(stiffness: f64) -> f64 {
    if stiffness > 0.0 {
        stiffness
    } else {
        f64::INFINITY
    }
}

fn mean_tangential(stiffness: &Matrix3<f64>) -> f64 {
    0.5 * (stiffness[(0, 0)] + stiffness[(1, 1)])
}
