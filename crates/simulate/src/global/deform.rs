//! The displayed organ: the displacements of the mechanical triangles, interpolated at every vertex.

use palpate_geometry::{NodeId, Vec3};
use palpate_mechanics::enhance::Press;
use palpate_mechanics::surface_response::PressedTip;

use super::enhanced_surface::DisplayedContact;
use super::{GlobalModel, GlobalWorkspace};
use crate::simulation::Simulation;
use crate::state::{SimulationState, ToolState};

/// New position of a vertex [m]; a vertex whose displacement is not finite stays.
pub(super) fn moved(from: &Vec3, by: &Vec3) -> Vec3 {
    match by.iter().all(|component| component.is_finite()) {
        true => from + by,
        false => *from,
    }
}

impl GlobalModel {
    /// Updates all vertices of the displayed surface, if it is due.
    pub(crate) fn deform(
        &self,
        simulation: &Simulation,
        time: f64,
        state: &mut SimulationState,
        workspace: &mut GlobalWorkspace,
    ) {
        if time < state.shown_at + state.show_every {
            return;
        }
        state.shown_at = time;
        let touched = state.tools.iter().any(ToolState::touches);
        if !touched && !state.shown_deformed {
            return;
        }
        state.shown_deformed = touched;
        self.find_field(simulation, state, workspace);
        self.carrier
            .interpolate(&workspace.field, &mut workspace.shown);
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

    /// Sums the displacements of all triangles [m] due to the tips and the jaws.
    pub(super) fn sum_field(
        &self,
        simulation: &Simulation,
        tools: &[ToolState],
        workspace: &mut GlobalWorkspace,
    ) {
        let GlobalWorkspace {
            sums, held, slit, ..
        } = workspace;
        sums.fill(0.0);
        let modulus = simulation.material.at_rest.youngs_modulus();
        for (tool, own) in simulation.tools.iter().zip(tools) {
            let contact = DisplayedContact::of(tool, own);
            if let (Some(contact), Some(load)) = (contact, self.load(tool, own)) {
                let tip = self.pressed(&contact.press, &(-own.elastic / modulus));
                self.response.add_field_of_tip(&load, &tip.force, sums);
                let surface = self.enhancement.interpolation().surface();
                self.response.sharpen(surface, &load, &tip, sums);
            }
        }
        let forces = held.forces();
        let forces = forces.map(|(_, touch, force)| (touch, force / modulus));
        self.response.add_fields(forces, sums);
        if let Some(slit) = slit {
            let tips = tools.iter().enumerate();
            let tips = tips.filter(|(_, own)| own.contact.is_some());
            let tips = tips.map(|(number, own)| (number, -own.elastic / modulus));
            let parts = held.forces_on_parts();
            let parts = parts.map(|(part, force)| (part, force / modulus));
            slit.add_field((tips, parts), sums);
        }
    }

    fn find_field(
        &self,
        simulation: &Simulation,
        state: &mut SimulationState,
        workspace: &mut GlobalWorkspace,
    ) {
        let Some(organ) = &mut state.organ_field else {
            return;
        };
        self.sum_field(simulation, &state.tools, workspace);
        let tools = simulation.tools.iter().zip(&state.tools);
        for (contact, (tool, own)) in organ.contacts.iter_mut().zip(tools) {
            *contact =
                DisplayedContact::of(tool, own).or_else(|| DisplayedContact::of_hold(tool, own));
        }
        for (vector, sums) in organ
            .displacements
            .iter_mut()
            .zip(workspace.sums.as_chunks().0)
        {
            let [x, y, z] = sums.map(f64::from);
            *vector = Vec3::new(x, y, z);
        }
        // Exactly as the jaws prescribe: influences are reciprocal to some percent only.
        for hold in state
            .tools
            .iter()
            .filter_map(|tool| tool.grip.grasp.as_ref())
        {
            for (part, triangles) in hold.patch().into_iter().flat_map(|patch| patch.parts()) {
                for one in triangles {
                    let touchable = self.response.touchable()[one.touch.index()];
                    let at = touchable.centroid + part.at - part.rest;
                    organ.displacements[touchable.triangle.index()] =
                        hold.carried(&at) - touchable.centroid;
                }
            }
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
