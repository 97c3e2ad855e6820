//! A check that the forces of a step are a valid solution.

use std::f64::consts::PI;

use palpate_mechanics::nonlinear::Against;

use super::{Body, NonlinearOrgan, NonlinearWorkspace, jaws_radius};
use crate::tool::Tool;

/// Mean pressure of a load, and pressure of a point on a shaft [Young's moduli], beyond which a solution is invalid: a
/// flat punch eight radii deep in neo-Hookean tissue has a tenth of it.
const MAX_PRESSURE: f64 = 100.0;

/// Largest jump of a tool's force, as a multiple of its old and its expected force together, or of a pressure of
/// Young's modulus on the tool's area if that is more [-].
const LEAP: f64 = 5.0;

impl NonlinearOrgan {
    /// Whether the force of a tool is more than any tissue withstands, or jumps: the step had no solution.
    pub(super) fn is_invalid(
        &self,
        tools: &[Tool],
        body: &Body,
        workspace: &NonlinearWorkspace,
    ) -> bool {
        let modulus = |piece: usize| self.composition.pieces[piece].law().youngs_modulus();
        let each = tools.iter().zip(&body.loads).zip(&workspace.targets);
        let is_loaded_too_hard = each.enumerate().any(|(number, ((tool, load), target))| {
            let under_modulus = |radius: f64| modulus(body.on[number]) * PI * radius.powi(2);
            let radius = jaws_radius(tool).unwrap_or(tool.typical_radius);
            let elastic = body.histories[number].elastic().norm();
            let leaps = target.is_some_and(|target| {
                let known: f64 = target.forces.iter().map(|force| force.norm()).sum();
                elastic > LEAP * known.max(under_modulus(radius))
            });
            let force = body.state.force(number).norm();
            body.is_loaded[number] && (leaps || force > MAX_PRESSURE * under_modulus(load.radius))
        });
        is_loaded_too_hard
            || workspace.own.candidates.contacts.iter().any(|contact| {
                let Against::Tool { .. } = contact.against else {
                    return false;
                };
                let (area, piece) = self.shaft_skin.around(contact.point);
                let most = MAX_PRESSURE * modulus(piece) * area;
                body.state.force_of(&self.model, contact) > most
            })
    }
}
