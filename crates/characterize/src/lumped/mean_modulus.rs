use palpate_files::Estimate;

use crate::Error;
use crate::fit::{Fit, Parameter, Settings, correlated_uncertainty, least_squares};

/// The end of an indenter, for a half-space of linear tissue without friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contact {
    /// A flat punch of this radius [m] (6.1).
    Flat(f64),
    /// A sphere of this radius [m], indented much less than that [Hertz 1881].
    Sphere(f64),
    /// A cone with this angle [rad] between its axis and its side [Sneddon 1965].
    Cone(f64),
}

impl Contact {
    /// The force [N] at `depth` [m] of a tissue with E/(1 − ν²) = 1 Pa.
    fn unit_force(self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        match self {
            Self::Flat(radius) => 2.0 * radius * depth, // (6.1)
            Self::Sphere(radius) => 4.0 / 3.0 * radius.sqrt() * depth.powf(1.5),
            Self::Cone(angle) => 2.0 / std::f64::consts::PI * angle.tan() * depth * depth,
        }
    }

    /// The radius [m] of what touches at `depth` [m], in the same closed forms.
    pub(super) fn face_radius(self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        match self {
            Self::Flat(radius) => radius,
            Self::Sphere(radius) => (radius * depth).sqrt().min(radius),
            Self::Cone(angle) => 2.0 / std::f64::consts::PI * angle.tan() * depth,
        }
    }
}

/// Young's modulus [Pa] of incompressible tissue, ν = ½, from one `force` [N] at `depth` [m]: a secant.
///
/// # Errors
/// Without contact, or when the specimen is `hollow`, for which the half-space says nothing.
pub fn mean_modulus(contact: Contact, hollow: bool, depth: f64, force: f64) -> Result<f64, Error> {
    if hollow {
        return Err(Error::HollowOrgan);
    }
    let unit = contact.unit_force(depth);
    if unit > 0.0 && unit.is_finite() && force.is_finite() {
        return Ok(0.75 * force / unit);
    }
    Err(Error::NoContact {
        cause: "the depth is not above zero",
    })
}

/// Young's modulus [Pa] of incompressible tissue from a whole loading curve: `depths` [m] and `forces` [N].
///
/// # Errors
/// Without samples in contact, or when the specimen is `hollow`.
pub fn fit_modulus(
    contact: Contact,
    hollow: bool,
    depths: &[f64],
    forces: &[f64],
) -> Result<(Estimate, Fit), Error> {
    let deepest =
        (0..depths.len().min(forces.len())).max_by(|&i, &j| depths[i].total_cmp(&depths[j]));
    let [depth, force] = deepest.map_or([0.0; 2], |i| [depths[i], forces[i]]);
    let start = mean_modulus(contact, hollow, depth, force)?;
    let parameter = Parameter::new("youngs_modulus_pa", start.abs()).within(0.0, f64::INFINITY);
    let fit = least_squares(
        &[parameter],
        depths.len().min(forces.len()),
        &Settings::default(),
        |values, residuals| {
            for (residual, (&depth, force)) in residuals.iter_mut().zip(depths.iter().zip(forces)) {
                *residual = contact.unit_force(depth) * values[0] / 0.75 - force;
            }
            Some(())
        },
    )?;
    let known = correlated_uncertainty(&fit, &[fit.residuals.len()]);
    let modulus = Estimate {
        value: fit.parameters[0].value,
        standard_error: known.standard_error(0),
    };
    Ok((modulus, fit))
}
