//! One step, as in the source (section 3.4): detect the collision, place the particles, solve for the displacement,
//! compute the force. [`touch`] finds the forces, which the hand needs at once; [`shape`] updates the display.

use palpate_files::Pose;
use palpate_files::session::{Event, Events};
use palpate_geometry::{TriangleId, Vec3};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::{ForceHistory, Limits};

use crate::contact::Contact;
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

/// Advances `state` by one step of `elapsed` [s] to `time` [s], with the tools at `poses` (none: absent). A first step
/// has an `elapsed` of zero: its depth then comes as a jump.
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

/// The part of [`step`] that finds the forces: [`ToolState::force`] and [`ToolState::stiffness`] are final after it.
/// [`shape`] completes the step, after the hand-over of the forces.
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
        let organ = state.bent_organ();
        let (tip, on) = at_rest(simulation, number, pose.as_ref(), state).unzip();
        let own = &mut state.tools[number];
        own.had_contact = own.contact.is_some();
        own.free_position = tip.filter(|_| own.contact.is_none());
        let is_reached = |contact: &Contact| match (&organ, on.flatten()) {
            (Some(organ), Some(on)) => organ.is_reached(simulation, on, contact),
            _ => true,
        };
        own.row.events = jumps | detect(simulation, tool, pose, tip, is_reached, own);
        if let (Some(pose), Some(_)) = (&pose, &simulation.nonlinear) {
            own.record_shaft_direction(tool, pose);
        }
        if let (Some(model), Some(cuts)) = (&simulation.cutting, &state.cuts) {
            cutting::track_blade(simulation, model, cuts, number, own);
        }
    }
    respond(simulation, elapsed, state, workspace);
    apply_estimated_inclusions(simulation, state);
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

/// The part of [`step`] that its forces do not need: cuts advance, the surface follows the organ at `time` [s], and the
/// rows of the tools are completed.
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

/// Updates the visible surface of `state` to its last step, whatever the period of [`SimulationState::show_every`].
/// Displaying a clone leaves the simulation unchanged: the surface decides when a shaft touches.
pub fn show(
    simulation: &Simulation,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    (state.shown_at, state.cuts_shown_at) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    move_surface(simulation, 0.0, state, workspace);
    show_cuts(simulation, 0.0, state);
}

/// Updates the visible surface to the organ at `time` [s], if it is due.
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

/// Position of a tip relative to the organ at rest [m], which only the nonlinear model moves under it, and there the
/// triangle that it touches or is closest to; none if it is clear of the organ.
fn at_rest(
    simulation: &Simulation,
    number: usize,
    pose: Option<&Pose>,
    state: &SimulationState,
) -> Option<(Vec3, Option<TriangleId>)> {
    let tip = Vec3::from(pose?.position_m);
    match &simulation.nonlinear {
        Some(organ) => {
            let (tip, on) = organ.carry_back(simulation, number, &tip, state)?;
            Some((tip, Some(on)))
        }
        None => Some((tip, None)),
    }
}

/// 1. The contact of the tip, which is at `tip` [m] relative to the organ at rest, where that `is_reached`.
fn detect(
    simulation: &Simulation,
    tool: &Tool,
    pose: Option<Pose>,
    tip: Option<Vec3>,
    is_reached: impl Fn(&Contact) -> bool,
    state: &mut ToolState,
) -> Events {
    let touched = state.touches();
    let mut events = grip::follow(tool, pose, state);
    state.pose = pose;
    let tip = tip.filter(|_| !state.is_grasping());
    state.contact = tip.and_then(|tip| {
        let last = state.contact.as_ref();
        let rest = simulation.rest_surface(tool);
        let found = state.clearance.detect(&rest, tool, last, &tip);
        found.filter(&is_reached)
    });
    match (touched, state.contact) {
        (false, Some(contact)) => {
            events.insert(Event::Contact);
            state.history_frame = None;
            state.forget_elsewhere(tool, &contact.point());
            // Where a tip begins to stick there is no shear yet, whatever the shear before.
            state.history.project_onto(&contact.normal());
        }
        (true, None) if !state.is_grasping() => events.insert(Event::Release),
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
    /// Records an event when the direction of its shaft becomes unknown, or known again: rows always have an
    /// orientation.
    fn record_shaft_direction(&mut self, tool: &Tool, pose: &Pose) {
        let is_unknown = Shaft::of(tool, pose).is_none();
        match (self.shaft_is_unknown, is_unknown) {
            (false, true) => self.row.events.insert(Event::ShaftUnknown),
            (true, false) => self.row.events.insert(Event::ShaftKnown),
            _ => {}
        }
        self.shaft_is_unknown = is_unknown;
    }

    /// Relaxes for the time that the tool was absent; returns the time of its re-entry into the tissue [s]. The state
    /// of an absent tool follows from its rows alone, so that a session can be replayed.
    fn re_enter(&mut self, simulation: &Simulation, time: f64, elapsed: f64) -> f64 {
        if !std::mem::take(&mut self.was_absent) {
            return elapsed;
        }
        let entry_time = elapsed.min(simulation.step);
        let absence = (time - self.row.time_s - entry_time).max(0.0);
        self.history
            .advance(&simulation.material.prony, Vec3::zeros(), absence);
        entry_time
    }

    /// Forgets the history of an earlier contact if the tool is at another location, `here` [m].
    pub(crate) fn forget_elsewhere(&mut self, tool: &Tool, here: &Vec3) {
        let near = tool.patches.radius();
        if self.history_at.is_none_or(|at| (at - here).norm() > near) {
            self.history = ForceHistory::default();
        }
    }
}

/// Steps 2 and 3: the elastic force and its stiffness, from the organ-scale model or from particles around each tip,
/// `elapsed` [s] after the last step.
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

/// The same again within a step, after tissue has slid in the jaws or out of them.
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

/// An inclusion below a tip that is in no model increases its force.
fn apply_estimated_inclusions(simulation: &Simulation, state: &mut SimulationState) {
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
            state.was_absent = true;
            0.0
        }
    };
    if let Some(contact) = &mut state.contact {
        contact.slide(tool, &mut state.elastic);
        if tool.friction.is_some() {
            // The tangential history stays tangential.
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
    let held = state.grip.grasp.as_ref().map(|hold| hold.displayed.place);
    let Some(here) = held.or(state.contact.map(|contact| contact.point())) else {
        return Events::NONE;
    };
    state.history_at = Some(here);
    if !relaxed.iter().all(|component| component.is_finite()) {
        // A force that is not finite counts as zero, and is reported.
        state.history = ForceHistory::default();
        return [Event::NonFiniteForce].into_iter().collect();
    }
    let Some(contact) = &mut state.contact else {
        state.with_pull = relaxed;
        state.force = relaxed;
        return Events::NONE;
    };
    // Tissue that has not yet recovered does not hold the tool: there is no adhesion.
    let normal = contact.normal();
    let outward = relaxed.dot(&normal);
    contact.is_pressed = outward > 0.0;
    // The history of the tangential force is separate from that of the normal force.
    let slides = contact.slides;
    contact.slide(tool, &mut relaxed);
    contact.slides |= slides;
    state.with_pull = match tool.tip_friction {
        Friction::Bonded => relaxed,
        // The history of a slide has other normals in it; nevertheless there is no friction.
        Friction::Frictionless => normal * outward,
    };
    if contact.is_pressed {
        state.force = state.with_pull;
    } else {
        // The tip sticks anew where it is pressed again: there is no shear yet.
        state.history.project_onto(&normal);
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
    let law = tool.law.on_curved_surface(contact.place.mean_curvature());
    let answer = law.force(&displacement, &response.stiffness);
    let frame = contact.frame();
    state.elastic = frame * answer.force;
    state.stiffness = frame * answer.stiffness * frame.transpose();
    state.limited = response.limits;
    state.limited.merge(&answer.limits);
    if !answer.force.iter().all(|component| component.is_finite()) {
        // `render_force` reports it; the surface stays unchanged.
        state.response = None;
    }
}

fn record(simulation: &Simulation, tool: &Tool, time: f64, failed: Events, state: &mut ToolState) {
    let Some(pose) = &state.pose else {
        return;
    };
    let tip = Vec3::from(pose.position_m);
    let turned = match &state.grip.grasp {
        Some(hold) => *hold.turned(),
        None => {
            let normal = state.contact.map(|contact| contact.normal());
            let trocar = tool.trocar.as_ref();
            orientation::orientation(&tip, trocar, pose.orientation, normal.as_ref())
        }
    };
    let held_depth = state.is_grasping().then(|| {
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

/// Updates the shape of the openings, if it is due.
fn show_cuts(simulation: &Simulation, time: f64, state: &mut SimulationState) {
    let due = time >= state.cuts_shown_at + state.show_every;
    let (Some(model), Some(cuts)) = (&simulation.cutting, &mut state.cuts) else {
        return;
    };
    if cuts.is_outdated() || due && cuts.has_openings() {
        state.cuts_shown_at = time;
        let rims = state.body.iter().flat_map(Body::rims);
        cuts.follow(simulation, state.deformed.vertices(), rims, model.width);
    }
}

/// Records when the shaft begins and ends to touch the deformed organ. A shaft of unknown direction stands on the
/// surface and touches nothing else.
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
