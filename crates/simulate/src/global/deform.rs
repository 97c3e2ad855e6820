//! The organ that is seen: every vertex carried by the displacements of the mechanical triangles.

use palpate_geometry::{NodeId, Vec3};
use palpate_mechanics::enhance::Press;
use palpate_mechanics::surface_response::PressedTip;

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

    /// A tip with its `force` over Young's modulus [m²].
    fn pressed(&self, press: &Press, force: &Vec3) -> PressedTip {
        let interpolation = self.enhancement.interpolation();
        PressedTip {
            tip: press.tip,
            radius: press.tip.contact_radius(press.displacement.norm()),
            place: interpolation.place(&press.at),
            normal: interpolation.normal(&press.at),
            own: press.own,
            force: *force,
        }
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
            let contact = SeenContact::of(tool, own);
            organ.contacts[number] = contact;
            if let (Some(contact), Some(load)) = (contact, self.load(tool, own)) {
                let tip = self.pressed(&contact.press, &(-own.elastic / modulus));
                let sums = &mut workspace.sums;
                self.response.add_field_of_tip(&load, &tip.force, sums);
                let surface = self.enhancement.interpolation().surface();
                self.response.sharpen(surface, &load, &tip, sums);
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
