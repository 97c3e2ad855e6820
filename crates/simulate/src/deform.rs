//! Updates the displayed surface if it is due: moves every vertex near a contact by the model's displacement field,
//! adds those of several contacts, and refits the bounding boxes of the moved vertices.

use palpate_geometry::{NodeId, Vec3};
use palpate_mechanics::finite_spheres::LocalContact;

use crate::simulation::Simulation;
use crate::state::{SimulationState, SimulationWorkspace};

pub(crate) fn deform(
    simulation: &Simulation,
    time: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    if time < state.shown_at + state.show_every {
        return;
    }
    state.shown_at = time;
    workspace.refit.clear();
    let turn = workspace.next_turn();
    mark_for_refit(simulation, state, workspace, turn);
    return_to_rest(simulation, state);
    for number in 0..simulation.tools.len() {
        press(simulation, number, state, workspace);
    }
    mark_for_refit(simulation, state, workspace, turn);
    state.tree.refit(&state.deformed, &workspace.refit);
}

fn return_to_rest(simulation: &Simulation, state: &mut SimulationState) {
    let rest = simulation.surface.mesh().vertices();
    for node in state.moved.0.drain(..) {
        state.deformed.move_vertex(node, rest[node.index()]);
    }
}

fn press(
    simulation: &Simulation,
    number: usize,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    let tool = &simulation.tools[number];
    let own = &state.tools[number];
    if own.response.is_none() {
        return;
    }
    if let Some((place, displaced)) = own.grip.shown_place() {
        return move_near(simulation, number, &displaced, &place, state, workspace);
    }
    let (Some(contact), Some(pose)) = (&own.contact, &own.pose) else {
        return;
    };
    let place = contact.place;
    let moved = contact.displacement(tool, &Vec3::from(pose.position_m));
    let tip = place.frame * moved;
    move_near(simulation, number, &tip, &place, state, workspace);
}

/// Moves the vertices near a contact that tool `number` has displaced by `tip` [m].
fn move_near(
    simulation: &Simulation,
    number: usize,
    tip: &Vec3,
    place: &LocalContact,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    let tool = &simulation.tools[number];
    // In another workspace than the step's, this solves again.
    let response = tool.model.respond(place, &mut workspace.models[number]);
    let reach = tool.model.shown_radius(place.radius);
    collect_near(simulation, workspace, place, reach);
    for index in 0..workspace.near.len() {
        let node = workspace.near[index];
        let rest = simulation.surface.mesh().vertices()[node.index()];
        let model = &mut workspace.models[number];
        let by = tool.model.displacement(place, &response, model, tip, &rest);
        let from = state.deformed.vertices()[node.index()];
        if by.iter().all(|component| component.is_finite()) {
            state.deformed.move_vertex(node, from + by);
            if from == rest {
                state.moved.0.push(node);
            }
        }
    }
}

/// The vertices within `reach` [m] of a location, found from neighbour to neighbour: parts that are near only through
/// air are not moved.
fn collect_near(
    simulation: &Simulation,
    workspace: &mut SimulationWorkspace,
    place: &LocalContact,
    reach: f64,
) {
    let turn = workspace.next_turn();
    let mesh = simulation.surface.mesh();
    workspace.near.clear();
    let visit = |node: NodeId, workspace: &mut SimulationWorkspace| {
        let mark = &mut workspace.visited[node.index()];
        let near = (mesh.vertices()[node.index()] - place.point).norm() < reach;
        if *mark != turn && near {
            workspace.near.push(node);
        }
        *mark = turn;
    };
    for node in mesh.corners(place.triangle) {
        visit(node, workspace);
    }
    let mut next = 0;
    while next < workspace.near.len() {
        let node = workspace.near[next];
        next += 1;
        for &triangle in simulation.surface.adjacency().around(node) {
            for other in mesh.corners(triangle) {
                visit(other, workspace);
            }
        }
    }
}

fn mark_for_refit(
    simulation: &Simulation,
    state: &SimulationState,
    workspace: &mut SimulationWorkspace,
    turn: u32,
) {
    for &node in &state.moved.0 {
        for &triangle in simulation.surface.adjacency().around(node) {
            let mark = &mut workspace.visited_triangles[triangle.index()];
            if *mark != turn {
                *mark = turn;
                workspace.refit.push(triangle);
            }
        }
    }
}
