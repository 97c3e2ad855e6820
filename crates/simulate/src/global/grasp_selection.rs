//! The choice of the triangles that jaws grasp when they shut.
//!
//! Those whose displaced centroids lie in the box that the jaws sweep; where triangles are larger than jaws, those of
//! which any part does. If there are more than the number of parts, the nearest to the tip and each next one farthest
//! from those before become parts, and the others join the nearest of these, up to the number that one tool can hold.
//!
//! The tip's force is distributed to them by their areas, and they are held at the resulting displacements. So neither
//! force nor organ jumps.

use palpate_geometry::Vec3;
use palpate_mechanics::surface_response::TouchId;

use super::enhanced_surface::DisplayedContact;
use super::{GlobalModel, GlobalWorkspace};
use crate::grip::{
    DisplayedGrasp, Grasp, Grasped, GraspedPart, GraspedPatch, GraspedTriangle, MAX_PARTS,
    MAX_TRIANGLES, Swept,
};
use crate::simulation::Simulation;
use crate::state::ToolState;

/// A triangle between jaws.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    touch: TouchId,
    /// Its centroid, in the tool's frame [m].
    place: Vec3,
    /// First and last x in that frame [m].
    across: (f64, f64),
    /// Squared distance to the nearest chosen one [m²], and its part.
    apart: f64,
    part: usize,
}

impl GlobalModel {
    /// The jaws of tool `number` grasp; returns whether there is anything between them.
    pub(crate) fn grasp(
        &self,
        simulation: &Simulation,
        number: usize,
        tools: &mut [ToolState],
        workspace: &mut GlobalWorkspace,
    ) -> bool {
        let tool = &simulation.tools[number];
        let (Some(swept), Some(jaws)) = (tools[number].swept(tool), tool.jaws) else {
            return false;
        };
        self.sum_field(simulation, tools, workspace);
        self.find_between(&swept, tools, workspace);
        let between = &mut workspace.between_jaws;
        let area: f64 = between.iter().map(|one| self.area(one.touch)).sum();
        let across = between.iter().map(|one| one.across);
        let across = across.fold((f64::INFINITY, f64::NEG_INFINITY), |all, one| {
            (all.0.min(one.0), all.1.max(one.1))
        });
        let thickness = swept.thickness(across.0, across.1);
        divide(between);
        let Some(mut patch) = self.patch(between) else {
            return false;
        };
        let pressed = area.min(Swept::face(&jaws));
        let touched = (tools[number].contact, tools[number].site);
        let before = DisplayedContact::of(tool, &tools[number]);
        loop {
            (tools[number].contact, tools[number].site) = (None, None);
            let hold = |patch: &GraspedPatch, displayed, tools: &mut [ToolState]| {
                let held = Grasped::Patch(patch.clone());
                tools[number].grip.grasp =
                    Some(Grasp::new(&swept, pressed, thickness, held, displayed));
            };
            let nowhere =
                before.map_or_else(|| self.displayed(simulation, &patch), DisplayedGrasp::of);
            hold(&patch, nowhere, tools);
            self.assemble(tools, workspace);
            self.place(simulation, number, &mut patch, tools, workspace);
            let displayed =
                before.map_or_else(|| self.displayed(simulation, &patch), DisplayedGrasp::of);
            hold(&patch, displayed, tools);
            workspace.held.factor(tools.len());
            if self.prepare_grasps(simulation, tools, workspace) {
                self.solve_grasped_forces(simulation, tools, workspace);
                return true;
            }
            tools[number].grip.grasp = None;
            (tools[number].contact, tools[number].site) = touched;
            if !patch.halve() {
                return false;
            }
        }
    }

    fn area(&self, touch: TouchId) -> f64 {
        self.response.touchable()[touch.index()].area
    }

    /// Lists the triangles between the jaws from the summed field.
    fn find_between(&self, swept: &Swept, tools: &[ToolState], workspace: &mut GlobalWorkspace) {
        let GlobalWorkspace {
            sums, between_jaws, ..
        } = workspace;
        let mesh = self.enhancement.interpolation().surface().mesh();
        let is_free = |touch| {
            let patches = tools.iter().filter_map(|tool| tool.grip.patch());
            let mut held = patches.flat_map(|patch| patch.triangles());
            held.all(|triangle| triangle.touch != touch)
        };
        between_jaws.clear();
        for large in [false, true] {
            for (index, triangle) in self.response.touchable().iter().enumerate() {
                let touch = TouchId(index as u32);
                let start = 3 * triangle.triangle.index();
                let by = Vec3::from_fn(|axis, _| f64::from(sums[start + axis]));
                let corners = mesh.positions(triangle.triangle);
                let corners = corners.map(|corner| swept.inside_of_tool(&(corner + by)));
                let place = corners.iter().sum::<Vec3>() / 3.0;
                let lies_between = match large {
                    false => swept.contains(&place),
                    true => swept.intersects(&corners),
                };
                if !lies_between || !is_free(touch) {
                    continue;
                }
                let [a, b, c] = corners.map(|corner| corner.x);
                between_jaws.push(Candidate {
                    touch,
                    place,
                    across: (a.min(b).min(c), a.max(b).max(c)),
                    apart: f64::INFINITY,
                    part: 0,
                });
            }
            if !between_jaws.is_empty() {
                return;
            }
        }
    }

    /// The patch of the triangles that were divided into parts.
    fn patch(&self, between: &[Candidate]) -> Option<GraspedPatch> {
        let of = |part: usize| between.iter().filter(move |one| one.part == part);
        let all: f64 = between.iter().map(|one| self.area(one.touch)).sum();
        let area = |part| -> f64 { of(part).map(|one| self.area(one.touch)).sum() };
        let centroid = |touch: TouchId| self.response.touchable()[touch.index()].centroid;
        let count = between.last().map_or(0, |one| one.part + 1);
        let parts = (0..count).map(|part| {
            let moment = of(part).map(|one| centroid(one.touch) * self.area(one.touch));
            GraspedPart {
                rest: moment.sum::<Vec3>() / area(part),
                share: area(part) / all,
                ..GraspedPart::default()
            }
        });
        let triangles = between.iter().map(|one| {
            let triangle = GraspedTriangle {
                touch: one.touch,
                weight: self.area(one.touch) / area(one.part),
            };
            (one.part, triangle)
        });
        GraspedPatch::new(parts, triangles)
    }

    /// Positions of the parts of a patch when they bear the force of the tip, in addition to the action of other tools.
    fn place(
        &self,
        simulation: &Simulation,
        number: usize,
        patch: &mut GraspedPatch,
        tools: &[ToolState],
        workspace: &mut GlobalWorkspace,
    ) {
        let softness = 1.0 / simulation.material.at_rest.youngs_modulus();
        let own = patch.clone();
        // If there are fewer parts than chosen, these bear all of it.
        let all: f64 = own.parts().map(|(part, _)| part.share).sum();
        let force = -tools[number].elastic / all;
        let shares = own.parts().map(|(part, _)| part.share);
        let GlobalWorkspace { held, slit, .. } = workspace;
        let borne = held.borne(number, force, shares);
        for ((part, (_, moved)), by) in patch.parts_mut().iter_mut().zip(own.parts()).zip(borne) {
            part.at = part.rest + by * softness;
            for (tool, state) in simulation.tools.iter().zip(tools) {
                for share in self.load(tool, state).iter().flat_map(|load| load.shares()) {
                    let tip = GraspedTriangle {
                        touch: share.triangle,
                        weight: share.weight,
                    };
                    part.at -= self.between_parts(moved, &[tip]) * state.elastic * softness;
                }
            }
            if let Some(slit) = slit {
                let tips = tools.iter().enumerate();
                let tips = tips.filter(|(_, state)| state.contact.is_some());
                let tips = tips.map(|(tip, state)| (tip, -state.elastic));
                part.at += slit.carry(&self.response, moved, tips) * softness;
            }
        }
    }

    /// The displayed point of a patch that no tip has touched: its middle.
    fn displayed(&self, simulation: &Simulation, patch: &GraspedPatch) -> DisplayedGrasp {
        let parts = || patch.parts().map(|(part, _)| part);
        let all: f64 = parts().map(|part| part.share).sum();
        let middle = parts().map(|part| part.rest * part.share).sum::<Vec3>() / all;
        let displaced = parts().map(|part| (part.at - part.rest) * part.share);
        let triangles = patch.triangles().iter();
        let touchable = triangles.map(|one| &self.response.touchable()[one.touch.index()]);
        let facing: Vec3 = touchable.map(|one| one.normal * one.area).sum();
        let interpolation = self.enhancement.interpolation();
        let at = interpolation.nearest_facing(&self.tree, &middle, &facing);
        let place = interpolation.place(&at);
        let (triangle, place) = match self.enhancement.has_finer_display() {
            false => (at.triangle, place),
            true => {
                let nearest = simulation.tree.nearest(simulation.surface.mesh(), &place);
                (nearest.triangle, nearest.on.position)
            }
        };
        DisplayedGrasp {
            triangle,
            place,
            at: Some(at),
            displaced: displaced.sum::<Vec3>() / all,
        }
    }
}

impl DisplayedGrasp {
    fn of(contact: DisplayedContact) -> Self {
        Self {
            triangle: contact.triangle,
            place: contact.place,
            at: Some(contact.press.at),
            displaced: contact.press.displacement,
        }
    }
}

/// Divides the triangles between the jaws into parts, in their order: around the one nearest to the tip, then each time
/// around the one farthest from those before.
fn divide(between: &mut Vec<Candidate>) {
    let near = |one: &Candidate| one.place.norm_squared();
    let first = between.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
    let mut next = first.map(|one| one.place);
    for part in 0..MAX_PARTS {
        let Some(place) = next else {
            break;
        };
        for one in between.iter_mut() {
            let apart = (one.place - place).norm_squared();
            if apart < one.apart {
                (one.apart, one.part) = (apart, part);
            }
        }
        let farthest = between.iter().max_by(|a, b| a.apart.total_cmp(&b.apart));
        next = farthest.filter(|one| one.apart > 0.0).map(|one| one.place);
    }
    let nearest_first = |a: &Candidate, b: &Candidate| {
        let apart = a.apart.total_cmp(&b.apart);
        apart.then(a.touch.cmp(&b.touch))
    };
    between.sort_unstable_by(nearest_first);
    between.truncate(MAX_TRIANGLES);
    between.sort_unstable_by_key(|one| (one.part, one.touch));
}
