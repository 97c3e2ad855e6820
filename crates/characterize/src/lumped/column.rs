use palpate_files::Estimate;
use palpate_files::tissue::EffectiveColumn;
use palpate_mechanics::Exponential;
use palpate_mechanics::finite_elements::uniaxial::nominal_stress;

use super::Contact;
use crate::Error;
use crate::fit::{Fit, Parameter, Settings, least_squares, uncertainty, warnings};
use crate::fit::{misfit, missed};

/// The exponential law on a column (6.2), and the fit that found it.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnFit {
    /// The parameters with their standard errors; area and length were chosen, not found.
    pub column: EffectiveColumn,
    /// The fit of γ and α.
    pub fit: Fit,
    /// The part of the force that the law does not follow: its root mean square over the largest [-].
    pub misfit: f64,
    /// Warnings, in plain sentences.
    pub warnings: Vec<String>,
}

/// The least length of a column over the largest depth [-]. Pressed to less than three quarters of its
/// length a column stiffens more than tissue under an indenter does, even with α = 0.
const MIN_LENGTH: f64 = 4.0;
/// Least α, start and largest α [-]; below the least the law is a neo-Hookean one.
pub(super) const ALPHAS: [f64; 3] = [1e-3, 1.0, 100.0];

/// Cross-section [m²] and length [m] of the column that stands for the tissue under an indenter.
///
/// Its face is that of the indenter at the largest depth, πa². Its length 3πa/8 makes EA/L the stiffness
/// (8/3) E a of the half-space, unless that is less than four times the depth: then it is four times that.
pub fn column_size(contact: Contact, deepest: f64) -> [f64; 2] {
    let radius = contact.face_radius(deepest);
    let half_space = 3.0 * std::f64::consts::PI / 8.0 * radius;
    let area = std::f64::consts::PI * radius * radius;
    [area, half_space.max(MIN_LENGTH * deepest)]
}

/// Steady force [N] of a column at `depth` [m]: (6.2) with λ = 1 − d/L, times the area.
///
/// # Errors
/// Where the law has no stress, as at depths beyond the length.
pub fn column_force(column: &EffectiveColumn, depth: f64) -> Result<f64, Error> {
    let law = Exponential::incompressible(column.gamma_pa.value, column.alpha.value)?;
    let stretch = 1.0 - depth / column.effective_length_m.value;
    Ok(-nominal_stress(&law, stretch)? * column.effective_area_m2.value)
}

/// γ and α of a column from a static response: steady `forces` [N] at `depths` [m], each an observation of
/// its own.
///
/// # Errors
/// When a depth or a force is missing, or there are fewer than two observations.
pub fn fit_column(contact: Contact, depths: &[f64], forces: &[f64]) -> Result<ColumnFit, Error> {
    let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let (deepest, largest) = (most(depths), most(forces));
    let [area, length] = column_size(contact, deepest);
    if !(area > 0.0 && largest > 0.0) {
        return Err(Error::NoContactForce);
    }
    let column = |gamma: f64, alpha: f64| EffectiveColumn {
        gamma_pa: gamma.into(),
        alpha: alpha.into(),
        effective_area_m2: area.into(),
        effective_length_m: length.into(),
    };
    let [least, start, greatest] = ALPHAS;
    let gamma = largest / column_force(&column(1.0, start), deepest)?;
    let parameters = [
        Parameter::new("gamma_pa", gamma).within(0.0, f64::INFINITY),
        Parameter::new("alpha", start).within(least, greatest),
    ];
    let settings = Settings::default();
    let fit = least_squares(&parameters, depths.len(), &settings, |p, residuals| {
        let column = column(p[0], p[1]);
        for (residual, (&depth, force)) in residuals.iter_mut().zip(depths.iter().zip(forces)) {
            *residual = column_force(&column, depth).ok()? - force;
        }
        Some(())
    })?;
    let known = uncertainty(&fit);
    let misfit = misfit(&fit, largest);
    let mut said = warnings(&fit, &known, None);
    said.extend(missed("exponential on a column", "force", misfit));
    let [gamma_pa, alpha] = [0, 1].map(|place| Estimate {
        value: fit.parameters[place].value,
        standard_error: known.standard_error(place),
    });
    Ok(ColumnFit {
        column: EffectiveColumn {
            gamma_pa,
            alpha,
            ..column(1.0, start)
        },
        misfit,
        warnings: said,
        fit,
    })
}
