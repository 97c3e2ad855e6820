//! Tips and jaws on the organ as it is now, and the step that moves it.
//!
//! Contact is sought on the organ at rest, with the tip carried back there: with X the touched place, Q the mean rotation
//! and ū the mean displacement of what the tip loads, Z what its force F moves that by,
//!
//! ```text
//! X + Qᵀ (tip − X − (ū − Z F))
//! ```
//!
//! is where the tip would be on an organ that it alone does not move. So depth is what it is with the other models: how
//! far the tip is below the surface that would be there without it.
//!
//! With C the tip's own compliance at the force F* that its law and the organ's compliance ask for, less that of its
//! load, the step solves W ᵀu + C F + o = d; o makes F* its solution where the organ is linear. What the factors at
//! rest say of Z then changes how fast the steps converge, and not where to.
//!
//! Where tissue relaxes, all of this is said of the elastic force Fₑ of a tool, of which F = γ Fₑ − Fₕ is left: the tissue
//! under a tip relaxes as that at the surface does, and the elements each as their own.

use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_files::session::Event;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use palpate_mechanics::nonlinear::{Conditions, NonlinearModel, Pace, advance};
use palpate_mechanics::{ForceHistory, Limits, PronySeries};

use super::moved::carry_back_anew;
use super::neighbours::StepMotion;
use super::shafts::{Pushed, ShaftMotion};
use super::soft::Piece;
use super::target::{Now, Target, farthest, positive, slippery};
use super::{Body, ITERATIONS_TOUCHING, NonlinearOrgan, NonlinearWorkspace};
use crate::grip::Held;
use crate::simulation::Simulation;
use crate::state::{SimulationState, ToolState};
use crate::tool::Tool;

/// A way that is longer than a step goes is taken in several, at most in so many [-].
const MOST_PARTS: usize = 8;

/// Displacements below this [m] are none: less than is seen or felt.
const AT_REST: f64 = 1e-6;

/// What is left of the largest displacement after a step in which nothing loads the organ, at most [-].
const SLOWEST_RETURN: f64 = 0.9;

/// After so many such steps on end it is put there: an element that is inside out may hold it elsewhere.
const LATEST: u32 = 100;

/// A tool that has let go is followed for so many steps at most: a fifth of a second, in which tissue goes back by 4 cm.
const LETS_GO_WITHIN: u32 = 40;

/// Scenes have no more tools.
const MOST_TOOLS: usize = 2;

/// Softer than this part of the organ around it, a contact is none yet [-].
const LEAST_STIFFNESS: f64 = 1e-6;

/// How the steps of a period ended.
#[derive(Debug, Clone, Copy, Default)]
struct Ended {
    /// Whether one of them had no answer.
    has_no_answer: bool,
    /// Whether elements of a body that relaxes are inside out.
    is_inverted: bool,
}

impl Body {
    /// The whole organ at rest, touched by nothing; nothing is allocated.
    pub(crate) fn reset(&mut self, organ: &Arc<NonlinearOrgan>) {
        self.forget_cuts(organ);
        self.state.reset(&organ.model);
        self.is_at_rest = true;
        self.late = 0;
        self.is_loaded.fill(false);
        self.lets_go.fill(0);
        self.histories.fill(ForceHistory::default());
        self.shafts.fill(None);
        self.clear_of_shafts.fill(0.0);
        self.pierced.fill(0);
    }

    /// Puts a body that nothing loads and that is as good as at rest there; whether it is.
    fn come_to_rest(&mut self, model: &NonlinearModel) -> bool {
        if !self.is_at_rest && self.state.is_within(model, AT_REST) {
            self.state.reset(model);
            self.is_at_rest = true;
        }
        self.is_at_rest
    }
}

impl NonlinearOrgan {
    /// Where the tip of tool `number` would be [m] on the organ at rest; none where it is clear of the organ.
    pub(crate) fn carry_back(
        &self,
        simulation: &Simulation,
        number: usize,
        tip: &Vec3,
        state: &SimulationState,
    ) -> Option<Vec3> {
        let own = &state.tools[number];
        match &own.contact {
            Some(contact) => Some(own.moved.back(&contact.point(), tip)),
            None => carry_back_anew(simulation, &simulation.tools[number], tip, state),
        }
    }

    /// Finds the elastic force and the stiffness of every tool, and moves the organ.
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
        if is_free && !has_shafts && body.come_to_rest(&self.model) {
            return;
        }
        let before = body.state.largest(&self.model);
        let ended = self.go(simulation, elapsed, body, workspace);
        if ended.has_no_answer
            || body.state.largest(&self.model) > self.composition.size
            || self.is_unsound(&simulation.tools, body, workspace)
        {
            body.state.reset(&self.model);
            body.histories.fill(ForceHistory::default());
            tools.iter_mut().for_each(ToolState::lose);
            return;
        }
        // Rest is where an organ goes that nothing loads; elements that were turned inside out may not find there. What
        // relaxes takes its time.
        let is_late = body.state.largest(&self.model) > SLOWEST_RETURN * before;
        let state = &body.state;
        let is_held = state.has_friction() || state.touches_itself() || state.touches_tools();
        let lags = is_free && is_late && !is_held && (ended.is_inverted || !self.model.relaxes());
        body.late = if lags { body.late + 1 } else { 0 };
        if body.late > LATEST {
            body.state.reset(&self.model);
        } else if lags {
            body.state.shrink(&self.model, SLOWEST_RETURN);
        }
        self.push_shafts(tools, body, workspace);
        for (number, (own, target)) in tools.iter_mut().zip(&workspace.targets).enumerate() {
            if let (Some(target), false) = (target, body.lets_go[number] > 0) {
                own.elastic = -body.histories[number].elastic();
                target.tell_pace(body, number, own);
                workspace.own.candidates.report(own);
            }
            own.solved = own.elastic;
            if let Some(hold) = &own.grip.hold {
                own.displaced = hold.displaced();
            }
        }
    }

    /// What a tool does in this step; or what it leaves, that has let go.
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
        let mut target = match own.holds() {
            true => self.hold(tool, number, own, body),
            // A tip that touches again while tissue goes back takes it from there.
            false if body.lets_go[number] > 0 && own.contact.is_none() => None,
            false => self.touch(tool, number, own, series, elapsed, body),
        };
        let steps = &mut body.lets_go[number];
        *steps = match (&target, *steps) {
            (Some(_), _) => 0,
            (None, 0) if body.is_loaded[number] => LETS_GO_WITHIN,
            (None, steps) => steps.saturating_sub(1),
        };
        if *steps > 0 {
            target = self.let_go(number, body);
            if target.is_none() {
                body.lets_go[number] = 0;
            }
        }
        body.is_loaded[number] = target.is_some();
        target
    }

    /// Turns what a tool's force was with what it touches, and forgets it where the tool has.
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
        } else if own.holds() || tool.friction.is_none() {
            // That of a tip with friction turns with its contact.
            own.history.turn(by.matrix());
        }
    }

    /// Moves the organ as far as the tools have it, and no farther than a step can, while it relaxes for so long [s].
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
        let own = |target: &Option<Target>| target.map_or(0.0, |target| target.way.norm());
        let shafts = || workspace.shafts.iter().flatten();
        let ways = targets.iter().zip(&body.loads);
        let ways = ways.map(|(target, load)| own(target) / farthest(load));
        let asked = ways.chain(shafts().map(ShaftMotion::parts));
        let asked = asked.fold(0.0, f64::max);
        let parts = (asked.ceil() as usize).clamp(1, MOST_PARTS);
        let reach = (MOST_PARTS as f64 / asked).min(1.0) / parts as f64;
        let way = targets
            .iter()
            .map(own)
            .chain(shafts().map(ShaftMotion::way));
        let way = reach * way.fold(0.0, f64::max);
        let mut pace = Pace {
            iterations: self.composition.iterations,
            elapsed: elapsed / parts as f64,
        };
        let mut ended = Ended::default();
        for part in 1..=parts {
            // What bends moves under what it touches.
            let has_shafts = workspace.shafts.iter().any(Option::is_some);
            if part == 1 || self.touching.is_some() || has_shafts {
                let candidates = &mut workspace.own.candidates;
                let motion = StepMotion {
                    shafts: &workspace.shafts,
                    parts: [part - 1, part].map(|part| reach * part as f64),
                    way,
                };
                candidates.find(self, &simulation.neighbours, motion, &body.state);
                let is_hard = candidates.touches_itself(&body.state) || candidates.touches_shafts();
                pace.iterations = match is_hard {
                    true => ITERATIONS_TOUCHING,
                    false => self.composition.iterations,
                };
            }
            let left = 1.0 - reach * part as f64;
            let relaxes: [_; MOST_TOOLS] = std::array::from_fn(|number| {
                let history = body.histories.get(number);
                history.map_or((1.0, Vec3::zeros()), |own| {
                    own.foresee(series, pace.elapsed)
                })
            });
            let couplings: [_; MOST_TOOLS] = std::array::from_fn(|number| {
                let target = targets.get(number)?.as_ref()?;
                let nodes = &body.loads[number].nodes;
                Some(target.coupling(nodes, left, reach, relaxes[number]))
            });
            let conditions = Conditions {
                couplings: &couplings[..targets.len().min(MOST_TOOLS)],
                contacts: &workspace.own.candidates.contacts,
            };
            let (state, solver) = (&mut body.state, &mut workspace.own.solver);
            let advance = advance(&self.model, conditions, pace, state, solver);
            ended.has_no_answer |= advance.has_no_answer();
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

    /// The forces after tissue has slid in its jaws, as far as the organ is linear: the next step solves for them.
    pub(crate) fn press_again(&self, tools: &mut [ToolState]) {
        for own in tools {
            own.elastic = match &own.grip.hold {
                Some(hold) => own.solved - own.stiffness * (hold.displaced() - own.displaced),
                None if own.contact.is_some() => own.solved,
                None => Vec3::zeros(),
            };
        }
    }

    /// What a tip that touches does.
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
            // Its points touch the tip as a shaft.
            now.force = -own.pushed.force;
        }
        let tip = Vec3::from(pose.position_m);
        let free = now.mean - now.yields * now.force;
        own.moved.go(&free, &now.turn);
        if let Some(met) = own.met.take() {
            own.moved.meet(&place.point, &tip, &met);
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
        let further = frame.tr_mul(&now.yields) * frame - self.of_load(&now) + local;
        let law = piece.tip_law(number, tool).beside(place.mean_curvature());
        let over = exchange.map(|exchange| (exchange, piece.law()));
        let (answer, _) = tool.force_in_series(&law, &moved, &further, over);
        own.stiffness = frame * answer.stiffness * frame.transpose();
        own.limited = answer.limits;
        let goal = -(frame * answer.force);
        let (follows, history) = body.histories[number].foresee(series, elapsed);
        // Tissue that has not come back yet does not hold the tip.
        if self.model.relaxes() && (follows * goal - history).dot(&contact.normal()) >= 0.0 {
            own.elastic = -goal;
            return None;
        }
        let (along, stiffness) = match tool.bond {
            Friction::Frictionless => (Some(contact.normal()), slippery(&answer.stiffness)),
            Friction::Bonded => (None, answer.stiffness),
        };
        let tip_and_organ = frame * stiffness.try_inverse()? * frame.transpose();
        // A tip that hardly touches.
        if now.yields.trace() < LEAST_STIFFNESS * tip_and_organ.trace() {
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

    /// What jaws that hold do.
    fn hold(&self, tool: &Tool, number: usize, own: &mut ToolState, body: &Body) -> Option<Target> {
        let hold = own.grip.hold.as_ref()?;
        let Held::Area(area) = &hold.held else {
            return None;
        };
        let now = Now::of(self, body, number);
        let compliance = self.of_jaws(tool, number, &area.frame, body, &now)?;
        own.stiffness = (compliance + now.yields).try_inverse()?;
        let displacement = hold.displaced();
        let offset = hold.in_scene(&area.offset);
        let jump = displacement - offset - compliance * now.force - now.mean;
        Some(Target {
            along: None,
            forces: [now.force + own.stiffness * jump, now.force],
            displacement,
            compliance,
            offset,
            jump,
            way: now.yields * own.stiffness * jump,
        })
    }

    /// What is left of a tool that has let go: its place goes back to where there is no force, no farther in a step than a
    /// step follows well. None once the rest is a small way.
    fn let_go(&self, number: usize, body: &Body) -> Option<Target> {
        let now = Now::of(self, body, number);
        let back = -(now.yields * body.state.force(number));
        let way = back.norm();
        let farthest = farthest(&body.loads[number]);
        (way > farthest).then(|| {
            let displacement = now.mean + back * (farthest / way);
            Target {
                along: None,
                forces: [now.force; 2],
                displacement,
                compliance: Matrix3::zeros(),
                offset: Vec3::zeros(),
                jump: displacement - now.mean,
                way: displacement - now.mean,
            }
        })
    }

    /// What a load makes of its own half-space [m/N], in the frame of the contact.
    fn of_load(&self, now: &Now) -> Matrix3<f64> {
        let [along, normal] = now.own;
        Matrix3::from_diagonal(&Vec3::new(along, along, normal))
    }

    /// The compliance of jaws [m/N] beyond that of their load: that of a bonded flat tip of their faces' area, in the `frame`
    /// at rest that the organ has turned since.
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
    /// Loses what it touches and holds of an organ whose answer was none.
    fn lose(&mut self) {
        if self.touches() {
            self.row.events.insert(Event::NoEquilibrium);
            self.row.events.insert(Event::Release);
        }
        if self.grip.hold.take().is_some() {
            self.row.events.insert(Event::GripRelease);
        }
        self.contact = None;
        self.pushed = Pushed::default();
        self.elastic = Vec3::zeros();
        self.stiffness = Matrix3::zeros();
    }
}
