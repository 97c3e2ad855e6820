//! Supports of the body while the indenter is at a depth.

use super::super::super::relaxation::RelaxationStep;
use super::super::super::supports::{Sliding, Supports};
use super::super::contact::{ContactStatus, Part};
use super::IndentationRun;

impl IndentationRun {
    pub(super) fn supports<'a>(
        &self,
        statuses: &[ContactStatus],
        depth: f64,
        relaxing: Option<&'a RelaxationStep>,
    ) -> Supports<'a> {
        let mut supports = Supports {
            prescribed: self.rest.clone(),
            sliding: Vec::new(),
            pressures: Vec::new(),
            pressed: Vec::new(),
            growths: Vec::new(),
            contacts: None,
            dead_load: None,
            relaxing,
            stray: None,
        };
        for (&node, status) in self.top.iter().zip(statuses) {
            let (at, rest) = (
                self.model.mesh().nodes[node].x,
                self.model.mesh().nodes[node].y,
            );
            let prescribed = &mut supports.prescribed[2 * node..2 * node + 2];
            match *status {
                ContactStatus::Free => {}
                ContactStatus::Stuck { at: place, .. } => {
                    prescribed[0] = Some(place.radius - at);
                    prescribed[1] = Some((place.above - rest) - depth);
                }
                // On the axis the lowest point is met.
                ContactStatus::Sliding { .. } if at == 0.0 => prescribed[1] = Some(-depth),
                ContactStatus::Sliding { part, slip } => {
                    // A face lies on the surface as it is at rest.
                    let lowest = if part == Part::Face { rest } else { 0.0 };
                    supports.sliding.push(Sliding {
                        node,
                        surface: self.indenter.surface(part, lowest - depth),
                        force_ratio: slip.force_ratio,
                    });
                }
            }
        }
        supports
    }
}
