//! The organ that is seen: every vertex carried by the displacements of the mechanical triangles.

use palpate_geometry::{NodeId, Vec3};

use super::enhanced_surface::SeenContact;
use super::{GlobalModel, GlobalWorkspace};
use crate::simulation::Simulation;
use crate::state::SimulationState;

/// Where a vertex goes [m]; it stays where its displacement is no number.
pub(super) fn moved(from: &Vec3, by: &Vec3) -> Vec3 {
    match by.iter().all(|component| component.is_finite()) {
        true => from + by,
        false => *from,
    }
}

impl GlobalModel {
    /// Moves all vertices of the shown surface, if it is time.
    pub(crate) fn deform(
        &self,
        (simulation, time): (&Simulation, f64),
        state: &mut SimulationState,
        workspace: &mut GlobalWorkspace,
    ) {
        if time < state.shown_at + state.show_every {
            return;
        }
        state.shown_at = time;
        let touched = state.tools.iter().any(|tool| tool.contact.is_some());
        if !touched && !state.shown_deformed {
            return;
        }
        state.shown_deformed = touched;
        self.find_field(simulation, state, workspace);
        self.carrier.carry(&workspace.field, &mut workspace.shown);
        let rest = simulation.surface.mesh();
        for (number, (from, by)) in rest.vertices().iter().zip(&workspace.shown).enumerate() {
            let to = moved(from, by);
            state.deformed.move_vertex(NodeId(number as u32), to);
        }
        state.tree.refit_all(&state.deformed);
    }

    fn find_field(
        &self,
        simulation: &Simulation,
        state: &mut SimulationState,
        workspace: &mut GlobalWorkspace,
    ) {
        let Some(organ) = &mut state.whole else {
            return;
        };
        workspace.sums.fill(0.0);
        let modulus = simulation.material.at_rest.youngs_modulus();
        for (number, (tool, own)) in simulation.tools.iter().zip(&state.tools).enumerate() {
            organ.contacts[number] = SeenContact::of(tool, own);
            if organ.contacts[number].is_none() {
                continue;
            }
            if let Some(load) = self.load(tool, own) {
                let pushed = -own.elastic / modulus;
                self.response
                    .add_field_of_tip(&load, &pushed, &mut workspace.sums);
            }
        }
        for (vector, sums) in organ
            .displacements
            .iter_mut()
            .zip(workspace.sums.as_chunks().0)
        {
            let [x, y, z] = sums.map(f64::from);
            *vector = Vec3::new(x, y, z);
        }
        let interpolation = self.enhancement.interpolation();
        let contacts = organ.contacts.iter().flatten();
        workspace.presses.clear();
        workspace
            .presses
            .extend(contacts.map(|contact| contact.press));
        workspace
            .field
            .update(interpolation, &organ.displacements, &workspace.presses);
    }
}
