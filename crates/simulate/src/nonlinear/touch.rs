//! Contact of tips and jaws with the organ in its present state, and the step that moves it.
//!
//! The contact search uses the organ at rest, with the tip carried back there: with X the contact location, Q the mean
//! rotation and ū the mean displacement of the tip's load, Z its self-compliance and F its force,
//!
//! ```text
//! X + Qᵀ (tip − X − (ū − Z F))
//! ```
//!
//! is the position of the tip relative to an organ that this tip alone does not displace. So the depth has the same
//! meaning as in the other models: the distance of the tip below the surface as it would be without it.
//!
//! With C the tip's own compliance at the force F* from its law and the organ's compliance, less that of its load, the
//! step solves W ᵀu + C F + o = d; o makes F* its solution where the organ is linear. The Z from the factors at rest
//! then affects only how fast the steps converge, and not the result.
//!
//! Where tissue relaxes, all of this holds for the elastic force Fₑ of a tool, of which F = γ Fₑ − Fₕ remains: the
//! tissue under a tip relaxes like that at the surface, and each element like its own.

use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_files::session::Event;
use palpate_geometry::{TriangleId, Vec3};
use palpate_mechanics::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use palpate_mechanics::nonlinear::{Conditions, NonlinearModel, StepSettings, advance};
use palpate_mechanics::{ForceHistory, Limits, PronySeries};

use super::moved::carry_back_anew;
use super::neighbours::StepMotion;
use super::shafts::{Pushed, ShaftMotion};
use super::soft::Piece;
use super::target::{Now, Target, farthest, positive, slippery};
use super::{Body, ITERATIONS_TOUCHING, NonlinearOrgan, NonlinearWorkspace};
use crate::contact::Contact;
use crate::grip::Grasped;
use crate::simulation::Simulation;
use crate::state::{SimulationState, ToolState};
use crate::tool::Tool;

/// A motion longer than a step allows is divided into several steps, at most this many [-].
const MAX_PARTS: usize = 8;

/// Displacements below this [m] count as zero: they can be neither seen nor felt.
const AT_REST: f64 = 1e-6;

/// Largest ratio of the largest displacement after a step to that before, when nothing loads the organ [-].
const SLOWEST_RETURN: f64 = 0.9;

/// After this many such steps in succession it is set to rest: an inverted element may block it elsewhere.
const MAX_STALLED: u32 = 100;

/// Largest number of steps for which a released tool is still followed: a fifth of a second, in which tissue recovers
/// by 4 cm.
const MAX_RELEASE_STEPS: u32 = 40;

/// Scenes have no more tools.
const MAX_TOOLS: usize = 2;

/// A contact softer than this part of the organ around it does not count yet [-].
const MIN_STIFFNESS: f64 = 1e-6;

/// The result of the steps of a period.
#[derive(Debug, Clone, Copy, Default)]
struct Ended {
    /// Whether one of them had no solution.
    has_no_answer: bool,
    /// Whether elements of a relaxing body are inverted.
    is_inverted: bool,
}

impl Body {
    /// The whole organ at rest, touched by nothing; nothing is allocated.
    pub(crate) fn reset(&mut self, organ: &Arc<NonlinearOrgan>) {
        self.forget_cuts(organ);
        self.state.reset(&organ.model);
        self.is_at_rest = true;
        self.stalled = 0;
        self.is_loaded.fill(false);
        self.release_steps.fill(0);
        self.histories.fill(ForceHistory::default());
        self.shafts.fill(None);
        self.clear_of_shafts.fill(0.0);
        self.pierced.fill(0);
    }

    /// Sets an unloaded body that is nearly at rest to rest; returns whether it is.
    fn set_to_rest(&mut self, model: &NonlinearModel) -> bool {
        if !self.is_at_rest && self.state.is_within(model, AT_REST) {
            self.state.reset(model);
            self.is_at_rest = true;
        }
        self.is_at_rest
    }
}

impl NonlinearOrgan {
    /// Position of the tip of tool `number` [m] relative to the organ at rest, and the triangle that it touches or is
    /// closest to; none if it is clear of the organ.
    pub(crate) fn carry_back(
        &self,
        simulation: &Simulation,
        number: usize,
        tip: &Vec3,
        state: &SimulationState,
    ) -> Option<(Vec3, TriangleId)> {
        let own = &state.tools[number];
        match &own.contact {
            Some(contact) => Some((
                own.moved.back(&contact.point(), tip),
                contact.place.triangle,
            )),
            None => carry_back_anew(simulation, &simulation.tools[number], tip, state),
        }
    }

    /// Whether a contact is on the same piece of the organ as the triangle `on` that its tip is closest to.
    pub(crate) fn is_reached(
        &self,
        simulation: &Simulation,
        on: TriangleId,
        contact: &Contact,
    ) -> bool {
        let rest = simulation.surface.mesh();
        self.detached.is_same(rest, [on, contact.place.triangle])
    }

    /// Computes the elastic force and the stiffness of every tool, and moves the organ.
    pub(crate) fn press(
        &self,
        simulation: &Simulation,
        elapsed: f64,
        tools: &mut [ToolState],
        body: &mut Body,
        workspace: &mut NonlinearWorkspace,
    ) {
        let series = &simulation.material.prony;
        for (number, (tool, own)) in simulation.tools.iter().zip(tools.iter_mut()).enumerate() {
            own.elastic = Vec3::zeros();
            own.stiffness = Matrix3::zeros();
            own.limited = Limits::NONE;
            workspace.targets[number] = self.target(tool, number, own, series, elapsed, body);
            own.pushed = Pushed::default();
            workspace.shafts[number] = ShaftMotion::of(number, tool, own, body);
        }
        let has_shafts = self.keep_near_shafts(&mut workspace.shafts, body);
        let is_free = workspace.targets.iter().all(Option::is_none);
        if is_free && !has_shafts && body.set_to_rest(&self.model) {
            return;
        }
        let before = body.state.largest(&self.model);
        let ended = self.go(simulation, elapsed, body, workspace);
        if ended.has_no_answer
            || body.state.largest(&self.model) > self.composition.size
            || self.is_invalid(&simulation.tools, body, workspace)
        {
            body.state.reset(&self.model);
            body.histories.fill(ForceHistory::default());
            tools.iter_mut().for_each(ToolState::release);
            return;
        }
        // An unloaded organ returns to rest; inverted elements may not get there. A relaxing body takes its time.
        let left = body.state.largest(&self.model);
        let is_slow = left > SLOWEST_RETURN * before && left > AT_REST;
        let state = &body.state;
        let is_held = state.has_friction() || state.has_self_contact() || state.touches_tools();
        let lags = is_free && is_slow && !is_held && (ended.is_inverted || !self.model.relaxes());
        body.stalled = if lags { body.stalled + 1 } else { 0 };
        if body.stalled > MAX_STALLED {
            body.state.reset(&self.model);
        } else if lags {
            body.state.shrink(&self.model, SLOWEST_RETURN);
        }
        self.push_shafts(tools, body, workspace);
        for (number, (own, target)) in tools.iter_mut().zip(&workspace.targets).enumerate() {
            if let (Some(target), false) = (target, body.release_steps[number] > 0) {
                own.elastic = -body.histories[number].elastic();
                target.report_lag(body, number, own);
                workspace.own.candidates.report(own);
            }
            own.solved = own.elastic;
            if let Some(hold) = &own.grip.grasp {
                own.displaced = hold.displaced();
            }
        }
    }

    /// The target of a tool in this step, or of a released one.
    fn target(
        &self,
        tool: &Tool,
        number: usize,
        own: &mut ToolState,
        series: &PronySeries,
        elapsed: f64,
        body: &mut Body,
    ) -> Option<Target> {
        self.turn_history(tool, number, own, body);
        let mut target = match own.is_grasping() {
            true => self.hold(tool, number, own, body),
            // A tip that touches again during the recovery starts from the present state.
            false if body.release_steps[number] > 0 && own.contact.is_none() => None,
            false => self.touch(tool, number, own, series, elapsed, body),
        };
        let steps = &mut body.release_steps[number];
        *steps = match (&target, *steps) {
            (Some(_), _) => 0,
            (None, 0) if body.is_loaded[number] => MAX_RELEASE_STEPS,
            (None, steps) => steps.saturating_sub(1),
        };
        if *steps > 0 {
            target = self.release_target(number, body);
            if target.is_none() {
                body.release_steps[number] = 0;
            }
        }
        body.is_loaded[number] = target.is_some();
        target
    }

    /// Rotates the history of a tool's force with its contact location, and resets it after a release.
    fn turn_history(&self, tool: &Tool, number: usize, own: &mut ToolState, body: &mut Body) {
        let nodes = &body.loads[number].nodes;
        if !self.model.relaxes() || nodes.is_empty() {
            return;
        }
        let turn = body.state.mean_rotation(nodes);
        let by = turn * body.turns[number].inverse();
        body.turns[number] = turn;
        body.histories[number].turn(by.matrix());
        if own.history == ForceHistory::default() {
            body.histories[number] = ForceHistory::default();
        } else if own.is_grasping() || tool.friction.is_none() {
            // The history of a tip with friction turns with its contact.
            own.history.turn(by.matrix());
        }
    }

    /// Moves the organ to the tools' targets, but no farther than a step allows, while it relaxes for this long [s].
    fn go(
        &self,
        simulation: &Simulation,
        elapsed: f64,
        body: &mut Body,
        workspace: &mut NonlinearWorkspace,
    ) -> Ended {
        body.is_at_rest = false;
        let series = &simulation.material.prony;
        let targets = &workspace.targets;
        let own = |target: &Option<Target>| target.map_or(0.0, |target| target.travel.norm());
        let shafts = || workspace.shafts.iter().flatten();
        let travels = targets.iter().zip(&body.loads);
        let travels = travels.map(|(target, load)| own(target) / farthest(load));
        let asked = travels.chain(shafts().map(ShaftMotion::parts));
        let asked = asked.fold(0.0, f64::max);
        let parts = (asked.ceil() as usize).clamp(1, MAX_PARTS);
        let reach = (MAX_PARTS as f64 / asked).min(1.0) / parts as f64;
        let travel = targets
            .iter()
            .map(own)
            .chain(shafts().map(ShaftMotion::travel));
        let travel = reach * travel.fold(0.0, f64::max);
        let mut pace = StepSettings {
            iterations: self.composition.iterations,
            elapsed: elapsed / parts as f64,
        };
        let mut ended = Ended::default();
        for part in 1..=parts {
            // Bodies that bend move under their contacts.
            let has_shafts = workspace.shafts.iter().any(Option::is_some);
            if part == 1 || self.touching.is_some() || has_shafts {
                let candidates = &mut workspace.own.candidates;
                let motion = StepMotion {
                    shafts: &workspace.shafts,
                    parts: [part - 1, part].map(|part| reach * part as f64),
                    travel,
                };
                candidates.find(self, &simulation.neighbours, motion, &body.state);
                let is_hard = candidates.has_self_contact() || candidates.touches_shafts();
                pace.iterations = match is_hard {
                    true => ITERATIONS_TOUCHING,
                    false => self.composition.iterations,
                };
            }
            let left = 1.0 - reach * part as f64;
            let relaxes: [_; MAX_TOOLS] = std::array::from_fn(|number| {
                let history = body.histories.get(number);
                history.map_or((1.0, Vec3::zeros()), |own| {
                    own.predict(series, pace.elapsed)
                })
            });
            let couplings: [_; MAX_TOOLS] = std::array::from_fn(|number| {
                let target = targets.get(number)?.as_ref()?;
                let nodes = &body.loads[number].nodes;
                Some(target.coupling(nodes, left, reach, relaxes[number]))
            });
            let conditions = Conditions {
                couplings: &couplings[..targets.len().min(MAX_TOOLS)],
                contacts: &workspace.own.candidates.contacts,
            };
            let (state, solver) = (&mut body.state, &mut workspace.own.solver);
            let advance = advance(&self.model, conditions, pace, state, solver);
            ended.has_no_answer |= advance.has_no_equilibrium();
            ended.is_inverted = advance.is_inverted;
            for (number, own) in body.histories.iter_mut().enumerate() {
                let (follows, history) = relaxes[number];
                let elastic = (body.state.force(number) + history) / follows;
                own.advance(series, elastic, pace.elapsed);
            }
        }
        for motion in workspace.shafts.iter().flatten() {
            body.shafts[motion.tool] = Some(motion.after(reach * parts as f64));
        }
        ended
    }

    /// The forces after tissue has slid in the jaws, by linearization: the next step solves for them.
    pub(crate) fn press_again(&self, tools: &mut [ToolState]) {
        for own in tools {
            own.elastic = match &own.grip.grasp {
                Some(hold) => own.solved - own.stiffness * (hold.displaced() - own.displaced),
                None if own.contact.is_some() => own.solved,
                None => Vec3::zeros(),
            };
        }
    }

    /// The target of a tip in contact.
    fn touch(
        &self,
        tool: &Tool,
        number: usize,
        own: &mut ToolState,
        series: &PronySeries,
        elapsed: f64,
        body: &mut Body,
    ) -> Option<Target> {
        let (pose, contact) = (own.pose?, own.contact.as_mut()?);
        let place = contact.place;
        body.on[number] = Piece::with(&self.composition.pieces, place.triangle.0);
        let piece = &self.composition.pieces[body.on[number]];
        let is_wrapped = piece.bends_around[number];
        let force = match is_wrapped {
            true => own.pushed.force.norm(),
            false => body.histories[number].elastic().norm(),
        };
        let reach = super::REACH_IN_RADII * tool.touching_radius(piece.law(), force);
        let load = &mut body.loads[number];
        let boundary = self.model.boundary();
        boundary.spread(&place.point, &contact.rest_normal(), reach, load);
        let mut now = Now::of(self, body, number);
        if is_wrapped {
            // The wall's points touch the tip as they do a shaft.
            now.force = -own.pushed.force;
        }
        let tip = Vec3::from(pose.position_m);
        own.moved.go(&now.free(), &now.turn);
        if let Some(met) = own.free_position.take() {
            own.moved.begin_contact(&place.point, &tip, &met);
        }
        contact.turn = now.turn;
        let frame = contact.frame();
        let tip = own.moved.back(&place.point, &tip);
        let moved = contact.displacement(tool, &tip);
        own.displaced = own.moved.by + frame * moved;
        if is_wrapped {
            return None;
        }
        let radius = tool.typical_radius;
        let (of_wall, exchange) = self.local_compliance(number, tool, body);
        let local = self.rim(body, number, radius) + of_wall;
        let local = place.frame.tr_mul(&local) * place.frame;
        let further = frame.tr_mul(&now.compliance) * frame - self.of_load(&now) + local;
        let law = piece
            .tip_law(number, tool)
            .on_curved_surface(place.mean_curvature());
        let over = exchange.map(|exchange| (exchange, piece.law()));
        let (answer, _) = tool.force_in_series(&law, &moved, &further, over);
        own.stiffness = frame * answer.stiffness * frame.transpose();
        own.limited = answer.limits;
        let goal = -(frame * answer.force);
        let (follows, history) = body.histories[number].predict(series, elapsed);
        // Tissue that has not yet recovered does not hold the tip.
        if self.model.relaxes() && (follows * goal - history).dot(&contact.normal()) >= 0.0 {
            own.elastic = -goal;
            return None;
        }
        let (along, stiffness) = match tool.tip_friction {
            Friction::Frictionless => (Some(contact.normal()), slippery(&answer.stiffness)),
            Friction::Bonded => (None, answer.stiffness),
        };
        let tip_and_organ = frame * stiffness.try_inverse()? * frame.transpose();
        // A tip with little contact.
        if now.compliance.trace() < MIN_STIFFNESS * tip_and_organ.trace() {
            return None;
        }
        Some(Target::new(
            along,
            own.displaced,
            &tip_and_organ,
            &goal,
            &now,
        ))
    }

    /// The target of jaws that hold.
    fn hold(&self, tool: &Tool, number: usize, own: &mut ToolState, body: &Body) -> Option<Target> {
        let hold = own.grip.grasp.as_ref()?;
        let Grasped::Area(area) = &hold.grasped else {
            return None;
        };
        let now = Now::of(self, body, number);
        let compliance = self.of_jaws(tool, number, &area.frame, body, &now)?;
        own.stiffness = (compliance + now.compliance).try_inverse()?;
        let displacement = hold.displaced();
        let offset = hold.in_scene(&area.offset);
        let jump = displacement - offset - compliance * now.force - now.mean;
        let goal = now.force + own.stiffness * (jump - now.drag * now.force);
        Some(Target {
            along: None,
            forces: [goal, now.force],
            displacement,
            compliance,
            offset,
            jump,
            travel: now.travel(&goal),
        })
    }

    /// The target of a released tool: its load returns to zero force, no farther in a step than a step follows well.
    /// None once the remaining displacement is small.
    fn release_target(&self, number: usize, body: &Body) -> Option<Target> {
        let now = Now::of(self, body, number);
        let back = (now.drag - now.compliance) * body.state.force(number);
        let travel = back.norm();
        let farthest = farthest(&body.loads[number]);
        (travel > farthest).then(|| {
            let displacement = now.mean + back * (farthest / travel);
            Target {
                along: None,
                forces: [now.force; 2],
                displacement,
                compliance: Matrix3::zeros(),
                offset: Vec3::zeros(),
                jump: displacement - now.mean,
                travel: displacement - now.mean,
            }
        })
    }

    /// Self-compliance of a load on its own half-space [m/N], in the contact frame.
    fn of_load(&self, now: &Now) -> Matrix3<f64> {
        let [along, normal] = now.own;
        Matrix3::from_diagonal(&Vec3::new(along, along, normal))
    }

    /// Compliance of jaws [m/N] beyond that of their load: that of a bonded flat tip with the area of their faces, in
    /// the `frame` at rest, rotated with the organ.
    pub(super) fn of_jaws(
        &self,
        tool: &Tool,
        number: usize,
        frame: &Matrix3<f64>,
        body: &Body,
        now: &Now,
    ) -> Option<Matrix3<f64>> {
        let radius = super::jaws_radius(tool)?;
        let piece = &self.composition.pieces[body.on[number]];
        let [along, normal] = piece.regions.yields_to_tip(radius);
        let law = piece.law();
        let along = along / half_space_tangential_stiffness(law, radius);
        let normal = normal / half_space_stiffness(law, radius, Friction::Bonded);
        let rim = self.rim(body, number, radius);
        let own = Matrix3::from_diagonal(&Vec3::new(along, along, normal)) - self.of_load(now)
            + frame.tr_mul(&rim) * frame;
        let frame = now.turn * frame;
        Some(positive(&(frame * own * frame.transpose())))
    }
}

impl ToolState {
    /// Releases contact and held tissue of an organ whose solution was invalid.
    fn release(&mut self) {
        if self.touches() {
            self.row.events.insert(Event::NoEquilibrium);
            self.row.events.insert(Event::Release);
        }
        if self.grip.grasp.take().is_some() {
            self.row.events.insert(Event::GripRelease);
        }
        self.contact = None;
        self.pushed = Pushed::default();
        self.elastic = Vec3::zeros();
        self.stiffness = Matrix3::zeros();
    }
}
