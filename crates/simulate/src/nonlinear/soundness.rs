//! Whether the forces of a step are an answer.

use std::f64::consts::PI;

use palpate_mechanics::nonlinear::Against;

use super::{Body, NonlinearOrgan, NonlinearWorkspace};

/// Mean pressure of a load, and pressure of a point on a shaft [Young's moduli], beyond which there is no answer: a flat punch eight
/// radii deep in neo-Hookean tissue has a tenth of it.
const MOST_PRESSURE: f64 = 100.0;

/// The force of a tool leaps by less than so many times what it was and what it was to become [-].
const LEAP: f64 = 5.0;

impl NonlinearOrgan {
    /// Whether the force of a tool is more than any tissue withstands, or leaps: the step had no answer.
    pub(super) fn is_unsound(&self, body: &Body, workspace: &NonlinearWorkspace) -> bool {
        let modulus = |piece: usize| self.composition.pieces[piece].law().youngs_modulus();
        let mut loads = body.loads.iter().zip(&workspace.targets).enumerate();
        let is_loaded_too_hard = loads.any(|(number, (load, target))| {
            let under_modulus = modulus(body.on[number]) * PI * load.radius.powi(2);
            let elastic = body.histories[number].elastic().norm();
            let leaps = target.is_some_and(|target| {
                let known: f64 = target.forces.iter().map(|force| force.norm()).sum();
                elastic > LEAP * known.max(under_modulus)
            });
            let force = body.state.force(number).norm();
            body.is_loaded[number] && (leaps || force > MOST_PRESSURE * under_modulus)
        });
        is_loaded_too_hard
            || workspace.own.candidates.contacts.iter().any(|contact| {
                let Against::Tool { .. } = contact.against else {
                    return false;
                };
                let (area, piece) = self.shaft_skin.around(contact.point);
                let most = MOST_PRESSURE * modulus(piece) * area;
                body.state.force_of(&self.model, contact) > most
            })
    }
}
