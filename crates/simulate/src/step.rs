//! One step, as the source lists it (section 3.4): detect the collision, place the particles, solve for
//! the displacement, compute the force. What a hand waits for is [`touch`]; what is seen, [`shape`].

use palpate_files::Pose;
use palpate_files::session::{Event, Events};
use palpate_geometry::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::{ForceHistory, Limits};

use crate::nonlinear::Body;
use crate::shaft::Shaft;
use crate::simulation::Simulation;
use crate::state::{SimulationState, SimulationWorkspace, ToolState};
use crate::tool::Tool;
use crate::{
    cutting, deform, energy, estimated_inclusions, grip, hand_speed, neighbour, orientation,
};

/// Depth beyond which no model here has been compared with tissue [m].
pub const TRUSTED_DEPTH: f64 = 0.010;

/// Takes `state` one step of `elapsed` [s] on to `time` [s], with the tools at `poses` (none: not there
/// yet). A first step has an `elapsed` of zero: whatever depth there is then comes as a jump.
pub fn step(
    simulation: &Simulation,
    time: f64,
    elapsed: f64,
    poses: &[Option<Pose>],
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    touch(simulation, time, elapsed, poses, state, workspace);
    shape(simulation, time, state, workspace);
}

/// The part of [`step`] that finds the forces: [`ToolState::force`] and [`ToolState::stiffness`] are those of the step
/// after it. [`shape`] completes the step, after the forces are handed over.
pub fn touch(
    simulation: &Simulation,
    time: f64,
    elapsed: f64,
    poses: &[Option<Pose>],
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    if let (Some(model), Some(cuts), Some(global), Some(workspace)) = (
        &simulation.cutting,
        &state.cuts,
        &simulation.global,
        &mut workspace.global,
    ) {
        global.follow_cuts(model, cuts, workspace);
    }
    if let Some(workspace) = &mut workspace.nonlinear {
        workspace.follow_cuts(simulation, elapsed, state);
    }
    for (number, tool) in simulation.tools.iter().enumerate() {
        let pose = poses.get(number).copied().flatten();
        let own = &mut state.tools[number];
        let jumps = hand_speed::follow(simulation, pose.as_ref(), elapsed, own);
        let tip = at_rest(simulation, number, pose.as_ref(), state);
        let own = &mut state.tools[number];
        own.met = tip.filter(|_| own.contact.is_none());
        own.row.events = jumps | detect(simulation, tool, pose, tip, own);
        if let (Some(pose), Some(_)) = (&pose, &simulation.nonlinear) {
            own.tell_whether_shaft_is_known(tool, pose);
        }
        if let (Some(model), Some(cuts)) = (&simulation.cutting, &state.cuts) {
            cutting::track_blade(simulation, model, cuts, number, own);
        }
    }
    respond(simulation, elapsed, state, workspace);
    feel_estimated_inclusions(simulation, state);
    grip::act(simulation, elapsed, state, workspace);
    for (number, tool) in simulation.tools.iter().enumerate() {
        let own = &mut state.tools[number];
        let failed = render_force(simulation, tool, time, elapsed, own);
        neighbour::press(simulation, number, state);
        let own = &mut state.tools[number];
        own.force += own.pushed.force;
        own.torque = own.pushed.torque;
        record(simulation, tool, time, failed, own);
        if own.touches() || own.is_pushed() {
            own.limits.count(&own.limited);
        }
    }
}

/// The part of [`step`] that no force of it waits for: cuts go on, the surface follows the organ at `time` [s], and the
/// rows of the tools are complete.
pub fn shape(
    simulation: &Simulation,
    time: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    energy::check(simulation, state);
    if let Some(model) = &simulation.cutting {
        for number in 0..simulation.tools.len() {
            cutting::advance(simulation, model, number, state);
        }
    }
    move_surface(simulation, time, state, workspace);
    show_cuts(simulation, time, state);
    for (number, tool) in simulation.tools.iter().enumerate() {
        touch_with_shaft(tool, number, state);
    }
}

/// Moves the visible surface of `state` to its last step, however seldom [`SimulationState::show_every`] asks for it. A
/// picture of a clone leaves the simulation as it is: the surface decides when a shaft touches.
pub fn show(
    simulation: &Simulation,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    (state.shown_at, state.cuts_shown_at) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    move_surface(simulation, 0.0, state, workspace);
    show_cuts(simulation, 0.0, state);
}

/// Moves the visible surface to where the organ is at `time` [s], if it is time.
fn move_surface(
    simulation: &Simulation,
    time: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    if let (Some(global), Some(workspace)) = (&simulation.global, &mut workspace.global) {
        global.deform(simulation, time, state, workspace);
    } else if let (Some(organ), Some(workspace)) = (state.bent_organ(), &mut workspace.nonlinear) {
        organ.deform(simulation, time, state, workspace);
    } else {
        deform::deform(simulation, time, state, workspace);
    }
}

/// Where a tip is beside the organ at rest [m], which only the nonlinear model moves under it; none where it is clear.
fn at_rest(
    simulation: &Simulation,
    number: usize,
    pose: Option<&Pose>,
    state: &SimulationState,
) -> Option<Vec3> {
    let tip = Vec3::from(pose?.position_m);
    match &simulation.nonlinear {
        Some(organ) => organ.carry_back(simulation, number, &tip, state),
        None => Some(tip),
    }
}

/// 1. Where does the tip touch, which is at `tip` [m] beside the organ at rest?
fn detect(
    simulation: &Simulation,
    tool: &Tool,
    pose: Option<Pose>,
    tip: Option<Vec3>,
    state: &mut ToolState,
) -> Events {
    let touched = state.touches();
    let mut events = grip::follow(tool, pose, state);
    state.pose = pose;
    let tip = tip.filter(|_| !state.holds());
    state.contact = tip.and_then(|tip| {
        let last = state.contact.as_ref();
        let ground = simulation.ground(tool);
        state.clearance.detect(&ground, tool, last, &tip)
    });
    match (touched, state.contact) {
        (false, Some(contact)) => {
            events.insert(Event::Contact);
            state.history_frame = None;
            state.forget_elsewhere(tool, &contact.point());
            // Where a tip begins to stick nothing is sheared yet, whatever it sheared before.
            state.history.keep_along(&contact.normal());
        }
        (true, None) if !state.holds() => events.insert(Event::Release),
        _ => {}
    }
    let beyond = state.contact.is_some_and(|c| c.depth > TRUSTED_DEPTH);
    if beyond && !state.beyond_trust {
        events.insert(Event::DepthBeyondTrust);
    }
    state.beyond_trust = beyond;
    events
}

impl ToolState {
    /// Tells when the direction of its shaft is not known any more, or again: rows have an orientation all the same.
    fn tell_whether_shaft_is_known(&mut self, tool: &Tool, pose: &Pose) {
        let is_unknown = Shaft::of(tool, pose).is_none();
        match (self.shaft_is_unknown, is_unknown) {
            (false, true) => self.row.events.insert(Event::ShaftUnknown),
            (true, false) => self.row.events.insert(Event::ShaftKnown),
            _ => {}
        }
        self.shaft_is_unknown = is_unknown;
    }

    /// Relaxes while the tool was not there; how long its way into the tissue took [s]. What happens while a
    /// tool is away follows from its rows alone, so that a session can be played again.
    fn re_enter(&mut self, simulation: &Simulation, time: f64, elapsed: f64) -> f64 {
        if !std::mem::take(&mut self.is_away) {
            return elapsed;
        }
        let way_in = elapsed.min(simulation.step);
        let away = (time - self.row.time_s - way_in).max(0.0);
        self.history
            .advance(&simulation.material.prony, Vec3::zeros(), away);
        way_in
    }

    /// What tissue remembers of an earlier contact does not follow the tool to another place, `here` [m].
    pub(crate) fn forget_elsewhere(&mut self, tool: &Tool, here: &Vec3) {
        let near = tool.patches.radius();
        if self.history_at.is_none_or(|at| (at - here).norm() > near) {
            self.history = ForceHistory::default();
        }
    }
}

/// Steps 2 and 3: the elastic force and its stiffness, of the whole organ or of particles around each tip. `elapsed` [s] have
/// gone by since the last step.
pub(crate) fn respond(
    simulation: &Simulation,
    elapsed: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    if let (Some(global), Some(workspace)) = (&simulation.global, &mut workspace.global) {
        return global.press(simulation, &mut state.tools, workspace);
    }
    if let (Some(organ), Some(body), Some(workspace)) = (
        state.bent_organ(),
        &mut state.body,
        &mut workspace.nonlinear,
    ) {
        return organ.press(simulation, elapsed, &mut state.tools, body, workspace);
    }
    let tools = simulation.tools.iter().zip(&mut state.tools);
    for ((tool, state), workspace) in tools.zip(&mut workspace.models) {
        state.limited = Limits::NONE;
        if grip::answer(simulation, tool, state, workspace) {
            continue;
        }
        state.response = state
            .contact
            .filter(|contact| contact.place.radius > 0.0)
            .map(|contact| tool.model.respond(&contact.place, workspace));
        answer(tool, state);
    }
}

/// The same once more in a step, after tissue has slid in its jaws or out of them.
pub(crate) fn respond_again(
    simulation: &Simulation,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    match &simulation.nonlinear {
        Some(organ) => organ.press_again(&mut state.tools),
        None => respond(simulation, 0.0, state, workspace),
    }
}

/// Where an inclusion that is in no model lies under a tip, the tip is pushed harder.
fn feel_estimated_inclusions(simulation: &Simulation, state: &mut SimulationState) {
    let SimulationState {
        tools, estimated, ..
    } = state;
    if estimated.is_empty() {
        return;
    }
    for (tool, own) in simulation.tools.iter().zip(tools) {
        estimated_inclusions::stiffen(simulation, estimated, tool, own);
    }
}

/// 4. The force on the tool: elastic, then relaxed; only jaws are pulled.
fn render_force(
    simulation: &Simulation,
    tool: &Tool,
    time: f64,
    elapsed: f64,
    state: &mut ToolState,
) -> Events {
    let elapsed = match state.pose {
        Some(_) => state.re_enter(simulation, time, elapsed),
        None => {
            state.is_away = true;
            0.0
        }
    };
    if let Some(contact) = &mut state.contact {
        contact.slide(tool, &mut state.elastic);
        if tool.friction.is_some() {
            // What it remembers along the surface stays along the surface.
            let frame = contact.frame();
            if let Some(before) = state.history_frame.replace(frame) {
                state.history.turn(&(frame * before.transpose()));
            }
        }
    }
    let mut relaxed = state
        .history
        .advance(&simulation.material.prony, state.elastic, elapsed);
    state.force = Vec3::zeros();
    state.with_pull = Vec3::zeros();
    let held = state.grip.hold.as_ref().map(|hold| hold.seen.place);
    let Some(here) = held.or(state.contact.map(|contact| contact.point())) else {
        return Events::NONE;
    };
    state.history_at = Some(here);
    if !relaxed.iter().all(|component| component.is_finite()) {
        // A force that is no number is none, and is told.
        state.history = ForceHistory::default();
        return [Event::NonFiniteForce].into_iter().collect();
    }
    let Some(contact) = &mut state.contact else {
        state.with_pull = relaxed;
        state.force = relaxed;
        return Events::NONE;
    };
    // Tissue that has not come back yet does not hold the tool: there is no adhesion.
    let normal = contact.normal();
    let outward = relaxed.dot(&normal);
    contact.is_pressed = outward > 0.0;
    // The history of the force along the surface is another than that of its normal part.
    let slides = contact.slides;
    contact.slide(tool, &mut relaxed);
    contact.slides |= slides;
    state.with_pull = match tool.bond {
        Friction::Bonded => relaxed,
        // The history of a slide has other normals in it; there is no friction all the same.
        Friction::Frictionless => normal * outward,
    };
    if contact.is_pressed {
        state.force = state.with_pull;
    } else {
        // It sticks anew where it is pressed again: nothing is sheared there yet.
        state.history.keep_along(&normal);
    }
    Events::NONE
}

/// The elastic force of the local model's contact, and its stiffness at this depth.
fn answer(tool: &Tool, state: &mut ToolState) {
    state.elastic = Vec3::zeros();
    state.stiffness = nalgebra::Matrix3::zeros();
    let (Some(contact), Some(pose), Some(response)) =
        (&state.contact, &state.pose, &state.response)
    else {
        return;
    };
    let displacement = contact.displacement(tool, &Vec3::from(pose.position_m));
    let law = tool.law.beside(contact.place.mean_curvature());
    let answer = law.force(&displacement, &response.stiffness);
    let frame = contact.frame();
    state.elastic = frame * answer.force;
    state.stiffness = frame * answer.stiffness * frame.transpose();
    state.limited = response.limits;
    state.limited.merge(&answer.limits);
    if !answer.force.iter().all(|component| component.is_finite()) {
        // `render_force` tells; the surface stays where it is.
        state.response = None;
    }
}

fn record(simulation: &Simulation, tool: &Tool, time: f64, failed: Events, state: &mut ToolState) {
    let Some(pose) = &state.pose else {
        return;
    };
    let tip = Vec3::from(pose.position_m);
    let turned = match &state.grip.hold {
        Some(hold) => *hold.turned(),
        None => {
            let normal = state.contact.map(|contact| contact.normal());
            let trocar = tool.trocar.as_ref();
            orientation::orientation(&tip, trocar, pose.orientation, normal.as_ref())
        }
    };
    let held_depth = state.holds().then(|| {
        let (_, signed) = simulation.surface.signed_distance(&simulation.tree, &tip);
        (tool.overhang() - signed).max(0.0)
    });
    let touches = state.touches();
    let row = &mut state.row;
    row.time_s = time;
    row.position_m = pose.position_m;
    row.orientation = [turned.i, turned.j, turned.k, turned.w];
    row.grip = pose.grip;
    row.cut = pose.cut;
    row.force_n = state.force.into();
    row.torque_nm = state.torque.into();
    row.contact = touches;
    row.depth_m = held_depth.unwrap_or(state.contact.map_or(0.0, |contact| contact.depth));
    row.grip_force_n = state.grip_force;
    row.events = row.events | failed;
}

/// Takes the openings to where the organ is, if it is time.
fn show_cuts(simulation: &Simulation, time: f64, state: &mut SimulationState) {
    let due = time >= state.cuts_shown_at + state.show_every;
    let (Some(model), Some(cuts)) = (&simulation.cutting, &mut state.cuts) else {
        return;
    };
    if cuts.is_behind() || due && cuts.are_there() {
        state.cuts_shown_at = time;
        let rims = state.body.iter().flat_map(Body::rims);
        cuts.follow(simulation, state.deformed.vertices(), rims, model.width);
    }
}

/// Tells when the shaft begins to touch the deformed organ, and when it no longer does. A shaft of unknown direction stands on
/// the surface and touches nothing else.
fn touch_with_shaft(tool: &Tool, number: usize, state: &mut SimulationState) {
    let own = &mut state.tools[number];
    let Some(pose) = &own.pose else {
        return;
    };
    let axis = Shaft::of(tool, pose).and_then(|shaft| shaft.axis(tool.shaft_begins()));
    let touches = axis.is_some_and(|[start, end]| {
        let (mesh, radius) = (&state.deformed, tool.shaft_radius());
        state.tree.is_near_segment(mesh, [&start, &end], radius)
    });
    match (own.shaft_touches, touches) {
        (false, true) => own.row.events.insert(Event::ShaftContact),
        (true, false) => own.row.events.insert(Event::ShaftRelease),
        _ => {}
    }
    own.shaft_touches = touches;
}
