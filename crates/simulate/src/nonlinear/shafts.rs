//! Contact of shafts with the bodies that bend, with Coulomb friction.
//!
//! A shaft is a rod that points of the boundary stay out of. On the piece that a tip or jaws load, the rod begins
//! behind them, and points within their load are not in contact with it. Other pieces of the body are in contact with
//! all of the rod, from its tip on. A rod does not turn about its own axis: its friction does not oppose that.
//!
//! On a tool in a trocar, of length ℓ and direction e, a force f at a distance s from the tip acts on the tip by its
//! work:
//!
//! ```text
//! F = (1 − (s/ℓ) (1 − e eᵀ)) f
//! ```
//!
//! On a free tool F is f, and the torque about the tip is s e × f.
//!
//! *How we know*: `nonlinear_shafts::…`.

use nalgebra::Matrix3;
use palpate_files::session::Event;
use palpate_geometry::Vec3;
use palpate_mechanics::nonlinear::{Against, NonlinearState, UnilateralContact, Workspace};
use palpate_mechanics::{Limit, Reached};

use super::shaft_skin::{POINTS, outward};
use super::{Body, NonlinearOrgan, NonlinearWorkspace, OrganWorkspace};
use crate::shaft::Shaft;
use crate::state::ToolState;
use crate::tool::Tool;

/// Points that are nearer than this may touch in the step [m].
const NEAR: f64 = 2e-3;

/// Largest motion of a shaft in a part of a step, in its radii [-]: contact points stay on their side of it.
const FARTHEST_IN_RADII: f64 = 0.5;
/// And at most [m].
const FARTHEST: f64 = 2e-3;

/// Largest area of a face, relative to rest [-].
const STRETCHED: f64 = 2.0;

/// A lag behind its tool above this is reported [m].
const REPORTED_LAG: f64 = 1e-4;

/// Cosine of the angle between the outward normal of a face and the direction from the axis to its point, below which the
/// face is turned to the shaft [-]: others are the far side of a wall.
const FACES: f64 = -0.2;

/// The motion of a tool's shaft in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShaftMotion {
    pub(super) tool: usize,
    before: Shaft,
    now: Shaft,
    /// The piece that the tip or the jaws load; the centre of the load at rest [m], and its radius.
    loaded: Option<(usize, Vec3, f64)>,
    /// Where it begins behind the tip [m]: on the loaded piece, and elsewhere.
    begins: [f64; 2],
    /// Coulomb friction coefficient [-].
    friction: f64,
    /// Bit mask of the pieces that it goes through.
    pierced: Pierced,
}

/// Bit mask of the pieces in which a shaft has appeared and that it has not left yet; pieces beyond the last bit share
/// it.
pub(super) type Pierced = u64;

/// The bit of a piece.
fn bit(piece: usize) -> Pierced {
    1 << piece.min(Pierced::BITS as usize - 1)
}

/// The load of tissue on a shaft, transferred to the tip.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pushed {
    /// [N], and [N m] about the tip.
    pub(crate) force: Vec3,
    pub(crate) torque: Vec3,
    /// Derivative of the force with the tip's position [N/m].
    pub(crate) gradient: Matrix3<f64>,
}

impl ShaftMotion {
    /// The motion of the shaft of tool `number`; if its direction is unknown, that of its jaws while they hold, and
    /// else of its tip. None if the tool is absent.
    pub(super) fn of(number: usize, tool: &Tool, own: &ToolState, body: &mut Body) -> Option<Self> {
        let before = &mut body.shafts[number];
        let Some(pose) = &own.pose else {
            *before = None;
            return None;
        };
        let turned = own.grip.grasp.as_ref().map(|hold| hold.turned());
        let now = Shaft::of(tool, pose).unwrap_or_else(|| Shaft::of_jaws(tool, pose, turned));
        let held = own.grip.grasp.as_ref().map(|hold| hold.displayed.place);
        let place = held.or(own.contact.map(|contact| contact.point()));
        let load = &body.loads[number];
        Some(Self {
            tool: number,
            before: before.unwrap_or(now),
            now,
            loaded: place.map(|place| (body.on[number], place, load.radius)),
            begins: [tool.shaft_begins(), tool.shaft_ends()],
            friction: tool.friction.unwrap_or(0.0),
            pierced: 0,
        })
    }

    /// Whether the tool was absent before.
    fn appears(&self, body: &Body) -> bool {
        let before = body.shafts[self.tool];
        before.is_none_or(|before| before.length == 0.0 && self.now.length > 0.0)
    }

    /// Largest motion of its ends [m].
    pub(super) fn travel(&self) -> f64 {
        let end = |shaft: &Shaft| shaft.tip + shaft.along * shaft.length;
        let tip = (self.now.tip - self.before.tip).norm();
        tip.max((end(&self.now) - end(&self.before)).norm())
    }

    /// Its motion relative to the largest motion in a part of a step [-].
    pub(super) fn parts(&self) -> f64 {
        self.travel() / FARTHEST.min(FARTHEST_IN_RADII * self.now.radius)
    }

    /// Its position after this `part` of its motion [-].
    pub(super) fn after(&self, part: f64) -> Shaft {
        let (from, to) = (&self.before, &self.now);
        let along = from.along.lerp(&to.along, part);
        Shaft {
            tip: from.tip.lerp(&to.tip, part),
            along: along.try_normalize(1e-9).unwrap_or(to.along),
            length: from.length + part * (to.length - from.length),
            ..*to
        }
    }

    /// Whether the tip or the jaws load this point of a piece at rest [m].
    fn is_left_out(&self, piece: usize, rest: &Vec3) -> bool {
        self.loaded.is_some_and(|(loaded, middle, radius)| {
            loaded == piece && (rest - middle).norm() < radius
        })
    }
}

/// Distance of a point [m] from the axis between `ends` [m], and the direction away from it.
fn from_axis([start, end]: &[Vec3; 2], place: &Vec3) -> (f64, Vec3) {
    let axis = end - start;
    let square = axis.norm_squared();
    let part = match square > 0.0 {
        true => (axis.dot(&(place - start)) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    let away = place - (start + axis * part);
    let distance = away.norm();
    (distance, away / distance)
}

impl NonlinearOrgan {
    /// Where a shaft begins behind its tip at a piece [m].
    fn shaft_begins(&self, motion: &ShaftMotion, piece: usize) -> f64 {
        let is_loaded = motion.loaded.is_none_or(|(loaded, ..)| loaded == piece);
        let is_dimple = is_loaded && !self.composition.pieces[piece].bends_around[motion.tool];
        motion.begins[usize::from(!is_dimple)]
    }

    /// Whether a shaft may touch the body in `state` at its position after a step; stores its clearance [m] in `clear`.
    fn is_near(&self, motion: &ShaftMotion, clear: &mut f64, state: &NonlinearState) -> bool {
        let travel = (motion.now.tip - motion.before.tip).norm();
        let turned = (motion.now.along - motion.before.along).norm();
        *clear -= travel + turned * motion.now.length;
        if *clear > 0.0 {
            return false;
        }
        let mut least = f64::INFINITY;
        self.for_each_near_face(motion, &motion.now, state, |_, _, gap| {
            least = least.min(gap);
        });
        *clear = least - NEAR;
        *clear <= 0.0
    }

    /// Current position of a point [m].
    fn place(&self, point: usize, state: &NonlinearState) -> Vec3 {
        let own = &self.model.tool_points()[point];
        self.shaft_skin.places[point] + own.displacement(&state.displacements)
    }

    /// Visits faces with the part of the axis that they may touch, and a lower bound of their gap [m].
    fn for_each_near_face(
        &self,
        motion: &ShaftMotion,
        shaft: &Shaft,
        state: &NonlinearState,
        mut visit: impl FnMut(usize, [Vec3; 2], f64),
    ) {
        for (number, face) in self.shaft_skin.faces.iter().enumerate() {
            let Some(axis) = shaft.axis(self.shaft_begins(motion, face.piece)) else {
                continue;
            };
            let (distance, _) = from_axis(&axis, &self.place(number * POINTS, state));
            visit(
                number,
                axis,
                distance - shaft.radius - STRETCHED * face.extent,
            );
        }
    }

    /// A shaft that appears in a piece, as where a trocar lies behind an organ, passes through it without contact until
    /// it has left it.
    fn let_out(&self, motion: &mut ShaftMotion, body: &mut Body) {
        let was = match motion.appears(body) {
            true => Pierced::MAX,
            false => body.pierced[motion.tool],
        };
        if was != 0 {
            let from_tip = ShaftMotion {
                loaded: None,
                begins: [motion.begins[1]; 2],
                ..*motion
            };
            let pierced = self.pierced(&from_tip, &body.state);
            body.pierced[motion.tool] = was & pierced;
        }
        motion.pierced = body.pierced[motion.tool];
    }

    /// The pieces in which a shaft is: those whose boundary is closer to its axis than its radius, whatever its side.
    fn pierced(&self, motion: &ShaftMotion, state: &NonlinearState) -> Pierced {
        let mut pierced = 0;
        self.for_each_near_face(motion, &motion.now, state, |number, axis, bound| {
            let face = &self.shaft_skin.faces[number];
            // A piece that bends around a tip is in contact with it wherever it appears, as with a tip that has a law
            // of its own.
            if bound > 0.0 || self.composition.pieces[face.piece].bends_around[motion.tool] {
                return;
            }
            let mut points = face.points(motion.now.radius);
            let place = |k: usize| self.place(number * POINTS + k, state);
            if points.any(|k| from_axis(&axis, &place(k)).0 < motion.now.radius) {
                pierced |= bit(face.piece);
            }
        });
        pierced
    }

    /// Keeps those of the `motions` that may touch the body; sets the others to none.
    pub(super) fn keep_near_shafts(
        &self,
        motions: &mut [Option<ShaftMotion>],
        body: &mut Body,
    ) -> bool {
        for (number, own) in motions.iter_mut().enumerate() {
            let Some(motion) = own else { continue };
            self.let_out(motion, body);
            if !body.is_at_rest {
                body.clear_of_shafts[number] = 0.0;
            }
            let clear = &mut body.clear_of_shafts[number];
            if !self.is_near(motion, clear, &body.state) {
                body.shafts[number] = Some(motion.now);
                *own = None;
            }
        }
        motions.iter().any(Option::is_some)
    }

    /// Visits the contacts of the body in `state` with a shaft that may be active, each with its gap [m], for the
    /// motion `from` this fraction of its step to that one [-].
    pub(super) fn meet_shaft(
        &self,
        motion: &ShaftMotion,
        [from, part]: [f64; 2],
        state: &NonlinearState,
        mut visit: impl FnMut(f64, UnilateralContact),
    ) {
        let (was, shaft) = (motion.after(from), motion.after(part));
        let points = self.model.tool_points();
        self.for_each_near_face(motion, &shaft, state, |number, axis, bound| {
            let is_pierced = motion.pierced & bit(self.shaft_skin.faces[number].piece) != 0;
            if bound > NEAR || is_pierced {
                return;
            }
            let face = &self.shaft_skin.faces[number];
            let set = face.points(shaft.radius);
            let place = |k: usize| self.place(number * POINTS + k, state);
            let outward = outward(set.clone(), place);
            for point in set.map(|k| number * POINTS + k) {
                let rest = &self.shaft_skin.places[point];
                let moved = points[point].displacement(&state.displacements);
                let (distance, normal) = from_axis(&axis, &(rest + moved));
                let gap = distance - shaft.radius;
                let is_active = gap < NEAR && normal.dot(&outward) < FACES;
                let is_wrapped = self.composition.pieces[face.piece].bends_around[motion.tool];
                if is_active && (is_wrapped || !motion.is_left_out(face.piece, rest)) {
                    let at = shaft.at(&(rest + moved));
                    let moves = shaft.tip - was.tip + (shaft.along - was.along) * at;
                    visit(
                        gap,
                        UnilateralContact {
                            point: point as u32,
                            normal,
                            offset: gap - normal.dot(&moved),
                            friction: motion.friction,
                            against: Against::Tool {
                                number: motion.tool,
                                motion: moves,
                            },
                        },
                    );
                }
            }
        });
    }

    /// Computes the loads on the shafts after a step, and reports a shaft that lags behind its tool.
    pub(super) fn push_shafts(
        &self,
        tools: &mut [ToolState],
        body: &Body,
        workspace: &mut NonlinearWorkspace,
    ) {
        let NonlinearWorkspace {
            shafts,
            own: OrganWorkspace { solver, candidates },
            ..
        } = workspace;
        for motion in shafts.iter().flatten() {
            let own = &mut tools[motion.tool];
            let Some(shaft) = body.shafts[motion.tool] else {
                continue;
            };
            let contacts = &candidates.contacts;
            own.take_push(self.push(&shaft, motion.tool, contacts, &body.state, solver));
            candidates.report(own);
            let lag = (motion.now.tip - shaft.tip).norm();
            if own.is_pushed() && lag > REPORTED_LAG {
                let unbounded = (motion.now.tip - motion.before.tip).norm();
                let reached = Reached {
                    unbounded,
                    used: unbounded - lag,
                };
                own.limited.add(Limit::Pace, reached);
            }
        }
    }

    /// The load on a shaft due to the last step's `contacts`, at its position after the step.
    fn push(
        &self,
        shaft: &Shaft,
        tool: usize,
        contacts: &[UnilateralContact],
        state: &NonlinearState,
        solver: &mut Workspace,
    ) -> Option<Pushed> {
        let at = |contact: &UnilateralContact| shaft.at(&self.place(contact.point as usize, state));
        // With this vector a, a point of the rod moves by a · x along `direction` when the tip moves by x; the same
        // vector transfers a force there to the tip.
        let at_tip = |contact: &UnilateralContact, direction: &Vec3| match shaft.is_in_trocar {
            false => *direction,
            true => {
                let across = direction - shaft.along * shaft.along.dot(direction);
                direction - across * (at(contact) / shaft.length)
            }
        };
        let mut pushed = Pushed::default();
        for contact in contacts {
            if !is_of(contact, tool) {
                continue;
            }
            let force = contact.normal * state.force_of(&self.model, contact)
                + state.friction_of(&self.model, contact);
            pushed.force -= at_tip(contact, &force);
            if !shaft.is_in_trocar {
                let arm = shaft.along * at(contact);
                pushed.torque -= arm.cross(&force);
            }
        }
        if pushed == Pushed::default() {
            return Some(pushed);
        }
        pushed.gradient = -solver.contact_stiffness(|number, direction| {
            let contact = &contacts[number];
            match is_of(contact, tool) {
                true => at_tip(contact, direction),
                false => Vec3::zeros(),
            }
        });
        let all = pushed.force.iter().chain(&pushed.torque);
        let mut all = all.chain(&pushed.gradient);
        all.all(|component| component.is_finite()).then_some(pushed)
    }
}

/// Whether a contact is with this tool.
fn is_of(contact: &UnilateralContact, tool: usize) -> bool {
    matches!(contact.against, Against::Tool { number, .. } if number == tool)
}

impl ToolState {
    /// Whether tissue touches its shaft.
    pub(crate) fn is_pushed(&self) -> bool {
        self.pushed != Pushed::default()
    }

    /// Stores the load of tissue on its shaft; a load that is not finite counts as zero, and is reported.
    pub(super) fn take_push(&mut self, pushed: Option<Pushed>) {
        if pushed.is_none() {
            self.row.events.insert(Event::NonFiniteForce);
        }
        self.pushed = pushed.unwrap_or_default();
    }
}
