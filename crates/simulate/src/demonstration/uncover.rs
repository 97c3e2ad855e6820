//! A place that the organ hides from a tool: where to grasp what is in the way, and how far to lift it.
//!
//! The straight way from the target to the tool's trocar is turned about the target until it is clear of the organ. The rim
//! is the part of the organ that is nearest to the clear way where the straight one leaves the organ. It then goes back by
//! what was turned there, and some more.

use nalgebra::{Rotation3, Unit};
use palpate_files::scene::TouchGoal;
use palpate_geometry::Vec3;

use super::ways::{BITE, RestSurface, grasped};
use super::{FREE, SLOW, Step};
use crate::Simulation;

/// Ways are turned by so much at a time [rad], to so many sides, and no farther [rad].
const TURN: f64 = 0.01;
const SIDES: u32 = 36;
const FARTHEST: f64 = 1.2;

/// A way that is clear passes the organ at this distance from its shaft [m].
const CLEAR: f64 = 0.001;

/// How much farther than to the straight way the rim is lifted [m]: beside the jaws it sags, and the shaft is thick.
const ABOVE_WAY: f64 = 0.010;

/// Before the target, where the tool comes in and where it slows down [m].
const COMES_IN: f64 = 0.09;
const SLOWS: f64 = 0.002;

/// A straight way from a target to where its tool comes from.
struct AccessPath<'s> {
    simulation: &'s Simulation,
    target: Vec3,
    /// Away from the target, with its length [m].
    outward: Vec3,
    /// Of the shaft, with what is clear around it [m].
    radius: f64,
}

/// The rim of what is in the way.
struct Rim {
    place: Vec3,
    /// The way by which it has to be lifted [m].
    lift: Vec3,
}

/// Touches the target with the first of the tools; the second one lifts what is in the way of it.
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
        None => 2.0 * COMES_IN * normal,
    };
    let way = AccessPath {
        simulation,
        target: on,
        outward,
        radius: own.shaft_radius() + CLEAR,
    };
    let mut steps = Vec::new();
    if let (Some(holder), Some(rim)) = (holder, way.rim()) {
        let ground = RestSurface(simulation);
        steps.extend(grasped(&ground, holder, &rim.place));
        steps.push(Step::Move {
            tool: holder,
            to: ground.over(&rim.place, -BITE) + rim.lift,
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
        before(COMES_IN.min(0.8 * outward.norm()), FREE),
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

    /// The least turned way that is clear; none where none is.
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
        turns.flat_map(sides).find(|way| self.is_clear(way))
    }

    /// The rim of what is in the way; none where nothing is, or nothing can be lifted out of it.
    fn rim(&self) -> Option<Rim> {
        if self.is_clear(&self.outward) {
            return None;
        }
        let clear = self.clear()?;
        let (mesh, tree) = (self.simulation.surface.mesh(), &self.simulation.tree);
        // Where the straight way leaves the organ, the rim is below it.
        let length = self.outward.norm();
        let (from, inward) = (self.target + self.outward, -self.outward / length);
        let leaves = tree.cast(mesh, &from, &inward, length)?;
        let part = 1.0 - leaves.distance / length;
        let nearest = tree.nearest(mesh, &(self.target + part * clear));
        let back = part * (self.outward - clear);
        let lift = back.norm() + ABOVE_WAY;
        Some(Rim {
            place: nearest.on.position,
            lift: lift * back.try_normalize(1e-9)?,
        })
    }
}
