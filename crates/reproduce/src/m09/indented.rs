//! The probe on the side of the esophagus as a straight tube: at finite strain, and at small strain.

use palpate_mechanics::contact::Friction;
use std::sync::{Arc, OnceLock};

use palpate_mechanics::finite_elements::tube::{Ends, TubeProblem, TubePunch, indent};
use palpate_mechanics::{IndentationCurve, Law, LinearElastic, NeoHookean};

use super::organ::printed;
use crate::Error;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;

/// Depths of table 5-1 that are above the tube's axis, and one more [mm].
const DEPTHS_MM: [u32; 6] = [1, 2, 4, 5, 6, 7];
/// As much as meshes give that take minutes [-].
const ACCURACY: f64 = 0.1;
/// Of the simulator's tissue [-].
pub(crate) const POISSONS_RATIO: f64 = 0.45;

/// Force on the tube.
pub(crate) struct IndentedTube {
    /// Elastic force [N] over depth [m] for a Young's modulus of 1 Pa: without pressure all force is proportional to it.
    pub(crate) unit: IndentationCurve,
    /// Relative error of the curve [-].
    pub(crate) error: f64,
}

/// Of neo-Hookean tissue at finite strain; solved once for all figures.
pub(crate) fn at_finite_strain(rows: &Rows<'_>) -> Result<&'static IndentedTube, Error> {
    static SOLVED: OnceLock<IndentedTube> = OnceLock::new();
    if let Some(solved) = SOLVED.get() {
        return Ok(solved);
    }
    // E = 6 C10.
    let law = NeoHookean::incompressible(1.0 / 6.0)?;
    let solved = indented(rows, Arc::new(law), None)?;
    Ok(SOLVED.get_or_init(|| solved))
}

/// Of linear tissue with the simulator's Poisson's ratio, at small strain; `length` [m] between the fixed ends, or the
/// source's.
pub(crate) fn at_small_strain(rows: &Rows<'_>, length: Option<f64>) -> Result<IndentedTube, Error> {
    let law = LinearElastic::new(1.0, POISSONS_RATIO)?;
    indented(rows, Arc::new(law), length)
}

fn indented(
    rows: &Rows<'_>,
    law: Arc<dyn Law>,
    length: Option<f64>,
) -> Result<IndentedTube, Error> {
    let mut tube = printed()?.tube;
    tube.length = length.unwrap_or(tube.length);
    let problem = TubeProblem {
        tube,
        law,
        ends: Ends::Fixed,
    };
    let punch = TubePunch {
        radius: RADIUS,
        face: Friction::Bonded,
        pressure: 0.0,
        depths: DEPTHS_MM.map(|depth| 1e-3 * f64::from(depth)).to_vec(),
    };
    let found = indent(&problem, &punch, ACCURACY, &mut rows.meshes("tube, "))?;
    Ok(IndentedTube {
        unit: IndentationCurve::through(&punch.depths, &found.answer.forces),
        error: found.error,
    })
}
