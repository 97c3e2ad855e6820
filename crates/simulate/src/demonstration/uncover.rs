//! Uncovering a target that the organ hides from a tool: where to grasp the organ, and how far to lift it.
//!
//! The straight path from the target to the tool's trocar is turned about the target until it is clear of the organ.
//! The rim is the part of the organ that is nearest to the clear path, at the point where the straight path leaves the
//! organ. It is lifted by the turn at that point, and some more.

use nalgebra::{Rotation3, Unit};
use palpate_files::scene::TouchGoal;
use palpate_geometry::Vec3;

use super::paths::{BITE, RestSurface, steps_to_grasp};
use super::{FREE, SLOW, Step};
use crate::Simulation;

/// Paths are turned in steps of this angle [rad], to this many sides, and at most this far [rad].
const TURN: f64 = 0.01;
const SIDES: u32 = 36;
const FARTHEST: f64 = 1.2;

/// A clear path passes the organ at this distance from its shaft [m].
const CLEAR: f64 = 0.001;

/// Additional lift of the rim beyond the straight path [m]: next to the jaws it sags, and the shaft is thick.
const LIFT_MARGIN: f64 = 0.010;

/// Distances from the target at which the tool comes in and slows down [m].
const APPROACH: f64 = 0.09;
const SLOWS: f64 = 0.002;

/// A straight path from a target to the trocar of its tool.
struct AccessPath<'s> {
    simulation: &'s Simulation,
    target: Vec3,
    /// Away from the target, with its length [m].
    outward: Vec3,
    /// Radius of the shaft with its clearance [m].
    radius: f64,
}

/// The rim of the hiding part of the organ.
struct Rim {
    place: Vec3,
    /// The required displacement of the rim [m].
    lift: Vec3,
}

/// Touches the target with the first of the tools; the second one lifts the organ out of the way.
pub(super) fn touched(
    simulation: &Simulation,
    goal: &TouchGoal,
    tool: usize,
    holder: Option<usize>,
) -> Vec<Step> {
    let target = Vec3::from(goal.target_m);
    let bodies = simulation.neighbours.iter();
    let nearest = bodies.map(|body| body.nearest(&target, None));
    let nearest = nearest.min_by(|one, other| one.distance.abs().total_cmp(&other.distance.abs()));
    let normal = nearest.map_or(-Vec3::y(), |nearest| nearest.normal);
    let own = &simulation.tools[tool];
    let on = target + own.overhang() * normal;
    let outward = match own.trocar {
        Some(trocar) => trocar - on,
        None => 2.0 * APPROACH * normal,
    };
    let path = AccessPath {
        simulation,
        target: on,
        outward,
        radius: own.shaft_radius() + CLEAR,
    };
    let mut steps = Vec::new();
    if let (Some(holder), Some(rim)) = (holder, path.rim()) {
        let rest = RestSurface(simulation);
        steps.extend(steps_to_grasp(&rest, holder, &rim.place));
        steps.push(Step::Move {
            tool: holder,
            to: rest.above_surface(&rim.place, -BITE) + rim.lift,
            speed: SLOW,
            cuts: false,
        });
    }
    let before = |distance: f64, speed: f64| Step::Move {
        tool,
        to: on + distance * outward.normalize(),
        speed,
        cuts: false,
    };
    steps.extend([
        before(APPROACH.min(0.8 * outward.norm()), FREE),
        Step::Wait(0.5),
        before(SLOWS, FREE),
    ]);
    steps.push(Step::Pull {
        tool,
        wanted: -goal.force_n * normal,
    });
    steps
}

impl AccessPath<'_> {
    fn is_clear(&self, outward: &Vec3) -> bool {
        let (mesh, tree) = (self.simulation.surface.mesh(), &self.simulation.tree);
        let ends = [&self.target, &(self.target + outward)];
        !tree.is_near_segment(mesh, ends, self.radius)
    }

    /// The path with the least turn that is clear; none if none is.
    fn clear(&self) -> Option<Vec3> {
        let along = self.outward.normalize();
        let aside = along.cross(&Vec3::z()).try_normalize(1e-6);
        let aside = aside.unwrap_or(Vec3::x());
        let turns = (1..).map(|number| TURN * f64::from(number));
        let turns = turns.take_while(|turn| *turn < FARTHEST);
        let sides = |turn: f64| {
            (0..SIDES).map(move |side| {
                let round = std::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
                let axis = Rotation3::from_axis_angle(&Unit::new_unchecked(along), round) * aside;
                Rotation3::from_axis_angle(&Unit::new_unchecked(axis), turn) * self.outward
            })
        };
        turns.flat_map(sides).find(|path| self.is_clear(path))
    }

    /// The rim of the hiding part; none if nothing hides the target, or nothing can be lifted out of the way.
    fn rim(&self) -> Option<Rim> {
        if self.is_clear(&self.outward) {
            return None;
        }
        let clear = self.clear()?;
        let (mesh, tree) = (self.simulation.surface.mesh(), &self.simulation.tree);
        // Where the straight path leaves the organ, the rim is below it.
        let length = self.outward.norm();
        let (from, inward) = (self.target + self.outward, -self.outward / length);
        let leaves = tree.cast(mesh, &from, &inward, length)?;
        let part = 1.0 - leaves.distance / length;
        let nearest = tree.nearest(mesh, &(self.target + part * clear));
        let back = part * (self.outward - clear);
        let lift = back.norm() + LIFT_MARGIN;
        Some(Rim {
            place: nearest.on.position,
            lift: lift * back.try_normalize(1e-9)?,
        })
    }
}
