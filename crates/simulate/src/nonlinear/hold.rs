//! Jaws that take hold of the organ as it is now.

use super::moved::carry_back_anew;
use super::soft::Piece;
use super::target::Now;
use super::{Body, NonlinearOrgan, REACH_IN_RADII, jaws_radius};
use crate::contact;
use crate::grip::{Held, HeldArea, Hold, SeenHold, Swept};
use crate::simulation::Simulation;
use crate::state::SimulationState;

impl NonlinearOrgan {
    /// The jaws of tool `number` take hold of the place that the tool touches, or would touch a little ahead; whether
    /// there is one. The force stays what it was.
    pub(crate) fn take_hold(
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
            let ahead = carry_back_anew(simulation, tool, &swept.ahead(), state)?;
            contact::detect(&simulation.ground(tool), tool, None, &ahead)
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
        let held = Held::Area(HeldArea {
            frame,
            offset: swept.turned.inverse() * offset,
            force: swept.turned.inverse() * now.force,
        });
        let seen = SeenHold {
            triangle: contact.place.triangle,
            place: point,
            at: None,
            displaced: now.mean,
        };
        let area = Swept::face(&jaws);
        let own = &mut state.tools[number];
        own.grip.hold = Some(Hold::new(&swept, area, jaws.opening_m, held, seen));
        own.displaced = now.mean;
        own.solved = own.elastic;
        true
    }
}
