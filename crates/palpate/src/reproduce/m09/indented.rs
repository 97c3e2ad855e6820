//! The probe on the side of the esophagus as a straight tube: at finite strain, and at small strain.

use std::sync::{Arc, OnceLock};

use palpate_mechanics::finite_elements::estimate::Progress;
use palpate_mechanics::finite_elements::indentation::Grip;
use palpate_mechanics::finite_elements::tube::{Ends, TubeProblem, TubePunch, indent};
use palpate_mechanics::{IndentationCurve, Law, LinearElastic, NeoHookean};

use super::organ::printed;
use crate::failure::Failure;
use crate::reproduce::Rows;
use crate::reproduce::virtual_rig::RADIUS;

/// Depths of table 5-1 that are above the tube's axis, and one more [mm].
const DEPTHS_MM: [u32; 6] = [1, 2, 4, 5, 6, 7];
/// As much as meshes give that take minutes [-].
const ACCURACY: f64 = 0.1;
/// Of the simulator's tissue [-].
pub(in crate::reproduce) const POISSONS_RATIO: f64 = 0.45;

/// Force on the tube.
pub(in crate::reproduce) struct IndentedTube {
    /// Elastic force [N] over depth [m] for a Young's modulus of 1 Pa: without pressure all force is proportional to it.
    pub(in crate::reproduce) unit: IndentationCurve,
    /// Relative error of the curve [-].
    pub(in crate::reproduce) error: f64,
}

/// Of neo-Hookean tissue at finite strain; solved once for all figures.
pub(in crate::reproduce) fn at_finite_strain(
    rows: &Rows<'_>,
) -> Result<&'static IndentedTube, Failure> {
    static SOLVED: OnceLock<IndentedTube> = OnceLock::new();
    // E = 6 C10.
    let law = || Ok(Arc::new(NeoHookean::incompressible(1.0 / 6.0)?) as Arc<dyn Law>);
    once(rows, &SOLVED, law)
}

/// Of linear tissue with the simulator's Poisson's ratio, at small strain.
pub(in crate::reproduce) fn at_small_strain(
    rows: &Rows<'_>,
) -> Result<&'static IndentedTube, Failure> {
    static SOLVED: OnceLock<IndentedTube> = OnceLock::new();
    let law = || Ok(Arc::new(LinearElastic::new(1.0, POISSONS_RATIO)?) as Arc<dyn Law>);
    once(rows, &SOLVED, law)
}

fn once(
    rows: &Rows<'_>,
    solved: &'static OnceLock<IndentedTube>,
    law: impl Fn() -> Result<Arc<dyn Law>, Failure>,
) -> Result<&'static IndentedTube, Failure> {
    match solved.get() {
        Some(solved) => Ok(solved),
        None => {
            let own = indented(rows, law()?)?;
            Ok(solved.get_or_init(|| own))
        }
    }
}

fn indented(rows: &Rows<'_>, law: Arc<dyn Law>) -> Result<IndentedTube, Failure> {
    let problem = TubeProblem {
        tube: printed()?.tube,
        law,
        ends: Ends::Held,
    };
    let punch = TubePunch {
        radius: RADIUS,
        face: Grip::Stick,
        pressure: 0.0,
        depths: DEPTHS_MM.map(|depth| 1e-3 * f64::from(depth)).to_vec(),
    };
    let found = indent(&problem, &punch, ACCURACY, &mut |progress: Progress| {
        let (mesh, part) = (progress.mesh + 1, 100.0 * progress.part);
        rows.say(format!("tube, mesh {mesh}, {part:.0} %"));
    })?;
    Ok(IndentedTube {
        unit: IndentationCurve::through(&punch.depths, &found.answer.forces),
        error: found.error,
    })
}
