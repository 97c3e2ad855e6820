//! Grasping in the nonlinear model.

use super::moved::carry_back_anew;
use super::soft::Piece;
use super::target::Now;
use super::{Body, NonlinearOrgan, REACH_IN_RADII, jaws_radius};
use crate::contact;
use crate::grip::{DisplayedGrasp, Grasp, Grasped, GraspedArea, Swept};
use crate::simulation::Simulation;
use crate::state::SimulationState;

impl NonlinearOrgan {
    /// The jaws of tool `number` grasp the tissue at the tool's contact, or a little ahead of it; returns whether there
    /// is any. The force does not change.
    pub(crate) fn grasp(
        &self,
        simulation: &Simulation,
        number: usize,
        state: &mut SimulationState,
    ) -> bool {
        let tool = &simulation.tools[number];
        let own = &state.tools[number];
        let (Some(swept), Some(jaws), Some(radius)) =
            (own.swept(tool), tool.jaws, jaws_radius(tool))
        else {
            return false;
        };
        let ahead = || {
            if own.had_contact {
                // The surface may be that of an earlier step.
                return None;
            }
            let (ahead, on) = carry_back_anew(simulation, tool, &swept.far_end(), state)?;
            let found = contact::detect(&simulation.rest_surface(tool), tool, None, &ahead);
            found.filter(|contact| self.is_reached(simulation, on, contact))
        };
        let Some(contact) = own.contact.or_else(ahead) else {
            return false;
        };
        let Some(body) = &mut state.body else {
            return false;
        };
        let Body { loads, on, .. } = body;
        on[number] = Piece::with(&self.composition.pieces, contact.place.triangle.0);
        let (point, frame) = (contact.point(), contact.place.frame);
        let reach = REACH_IN_RADII * radius;
        let boundary = self.model.boundary();
        boundary.spread(&point, &contact.rest_normal(), reach, &mut loads[number]);
        let now = Now::of(self, body, number);
        let Some(compliance) = self.of_jaws(tool, number, &frame, body, &now) else {
            return false;
        };
        let offset = -(compliance * now.force);
        let held = Grasped::Area(GraspedArea {
            frame,
            offset: swept.turned.inverse() * offset,
            force: swept.turned.inverse() * now.force,
        });
        let displayed = DisplayedGrasp {
            triangle: contact.place.triangle,
            place: point,
            at: None,
            displaced: now.mean,
        };
        let area = Swept::face(&jaws);
        let own = &mut state.tools[number];
        own.grip.grasp = Some(Grasp::new(&swept, area, jaws.opening_m, held, displayed));
        own.displaced = now.mean;
        own.solved = own.elastic;
        true
    }
}
