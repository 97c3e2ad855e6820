//! The organ that is seen: every vertex carried by the displacements of the mechanical triangles.

use palpate_geometry::{NodeId, Vec3};
use palpate_mechanics::enhance::Press;

use super::{GlobalModel, GlobalWorkspace};
use crate::simulation::Simulation;
use crate::state::SimulationState;

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
            let finite = by.iter().all(|component| component.is_finite());
            let to = if finite { from + by } else { *from };
            state.deformed.move_vertex(NodeId(number as u32), to);
        }
        state.tree.refit_all(&state.deformed);
    }

    fn find_field(
        &self,
        simulation: &Simulation,
        state: &SimulationState,
        workspace: &mut GlobalWorkspace,
    ) {
        workspace.sums.fill(0.0);
        workspace.presses.clear();
        let modulus = simulation.material.at_rest.youngs_modulus();
        for (tool, own) in simulation.tools.iter().zip(&state.tools) {
            let (Some(contact), Some(pose), Some(site)) = (&own.contact, &own.pose, own.site)
            else {
                continue;
            };
            if let Some(load) = self.load(tool, own) {
                let pushed = -own.elastic / modulus;
                self.response
                    .add_field_of_tip(&load, &pushed, &mut workspace.sums);
            }
            let moved = contact.displacement(tool, &Vec3::from(pose.position_m));
            workspace.presses.push(Press {
                at: site,
                tip: tool.tip,
                displacement: contact.place.frame * moved,
            });
        }
        for (vector, sums) in workspace
            .displacements
            .iter_mut()
            .zip(workspace.sums.as_chunks().0)
        {
            let [x, y, z] = sums.map(f64::from);
            *vector = Vec3::new(x, y, z);
        }
        let interpolation = self.enhancement.interpolation();
        let presses = &workspace.presses;
        workspace
            .field
            .update(interpolation, &workspace.displacements, presses);
    }
}
