//! Paths over the surface of an organ at rest.

use palpate_geometry::Vec3;

use super::{FREE, SLOW, Step};
use crate::Simulation;
use crate::polyline::Polyline;

/// Height of a waiting tip over the surface [m].
const ABOVE: f64 = 0.012;

/// Depth of a probe's press [m], and of a grasper before its jaws shut [m].
const PRESS: f64 = 0.005;
pub(super) const BITE: f64 = 0.0016;

/// Distance from the line at which the other hand holds [m], and its pull away from the line [m].
const ASIDE: f64 = 0.0055;
const STRETCH: f64 = 0.0005;

/// Overshoot of a cut beyond the ends of its line [m].
const BEYOND: f64 = 0.002;

/// Spacing of the points of a path over the surface [m].
const SPACING: f64 = 0.001;

/// The rest surface, as a script uses it.
pub(super) struct RestSurface<'s>(pub(super) &'s Simulation);

impl RestSurface<'_> {
    /// The nearest point of the surface [m], and the outward normal there.
    pub(super) fn at(&self, place: &Vec3) -> (Vec3, Vec3) {
        let mesh = self.0.surface().mesh();
        let nearest = self.0.tree.nearest(mesh, place);
        let normal = mesh.area_vector(nearest.triangle).normalize();
        (nearest.on.position, normal)
    }

    /// At this height above the surface [m], or below it.
    pub(super) fn above_surface(&self, place: &Vec3, height: f64) -> Vec3 {
        let (point, normal) = self.at(place);
        point + height * normal
    }

    /// The middle of the part of the surface that faces a direction [m].
    pub(super) fn facing(&self, direction: &Vec3) -> Vec3 {
        let mesh = self.0.surface().mesh();
        let (low, high) = mesh.bounds();
        let (middle, extent) = (0.5 * (low + high), (high - low).norm());
        let from = middle + extent * direction;
        let hit = self.0.tree.cast(mesh, &from, &-direction, 2.0 * extent);
        hit.map_or(middle, |hit| from - hit.distance * direction)
    }
}

/// Presses next to a place, and on it.
pub(super) fn steps_to_find(rest: &RestSurface<'_>, target: &Vec3) -> Vec<Step> {
    let (_, normal) = rest.at(target);
    let across = normal.cross(&Vec3::z()).try_normalize(1e-6);
    let across = across.unwrap_or(Vec3::x());
    let along = normal.cross(&across);
    let beside = [
        0.022 * across,
        0.016 * along,
        -0.012 * across,
        Vec3::zeros(),
    ];
    let mut steps = Vec::new();
    for (number, aside) in beside.iter().enumerate() {
        let place = target + aside;
        let to = |height: f64, speed: f64| Step::Move {
            tool: 0,
            to: rest.above_surface(&place, height),
            speed,
            cuts: false,
        };
        steps.extend([to(ABOVE, FREE), to(0.001, FREE), to(-PRESS, SLOW)]);
        steps.push(Step::Wait(0.8));
        match number + 1 == beside.len() {
            true => steps.push(Step::Mark),
            false => steps.extend([to(0.001, SLOW), to(ABOVE, FREE)]),
        }
    }
    steps
}

/// Grasps where the surface faces the pull, and pulls.
pub(super) fn steps_to_pull(rest: &RestSurface<'_>, tool: usize, wanted: Vec3) -> Vec<Step> {
    let place = rest.facing(&wanted.normalize());
    let mut steps = steps_to_grasp(rest, tool, &place);
    steps.push(Step::Pull { tool, wanted });
    steps
}

pub(super) fn steps_to_grasp(rest: &RestSurface<'_>, tool: usize, place: &Vec3) -> Vec<Step> {
    let to = |height: f64, speed: f64| Step::Move {
        tool,
        to: rest.above_surface(place, height),
        speed,
        cuts: false,
    };
    vec![
        to(ABOVE, FREE),
        Step::Wait(0.5),
        to(0.001, FREE),
        to(-BITE, SLOW),
        Step::Grip { tool, to: 1.0 },
        Step::Wait(0.3),
    ]
}

/// Depth of a blade that opens each layer but the next [m]: half way between their lower faces.
pub(super) fn depths(simulation: &Simulation, layers: usize) -> Vec<f64> {
    let bottoms = simulation.cut_depths();
    let depth = |number: usize| {
        let bottom = bottoms[number];
        match bottoms.get(number + 1) {
            Some(next) => 0.5 * (bottom + next),
            None => bottom + 0.0003,
        }
    };
    (0..layers.min(bottoms.len())).map(depth).collect()
}

/// The position at which the non-cutting hand holds [m], and the direction of its pull there: next to the middle of an
/// open line and outside a closed one, on the side of the left hand.
fn hold(rest: &RestSurface<'_>, line: &Polyline) -> (Vec3, Vec3) {
    if line.is_closed() {
        let leftmost = line.points().min_by(|one, other| one.x.total_cmp(&other.x));
        let leftmost = leftmost.unwrap_or_else(|| line.at(0.0));
        let (sum, count) = line
            .points()
            .fold((Vec3::zeros(), 0.0), |(sum, count), point| {
                (sum + point, count + 1.0)
            });
        let aside = (leftmost - sum / count).normalize();
        return (leftmost + ASIDE * aside, aside);
    }
    let middle = 0.5 * line.length();
    let along = (line.at(middle + SPACING) - line.at(middle)).normalize();
    let (middle, normal) = rest.at(&line.at(middle));
    let aside = normal.cross(&along).normalize();
    let aside = if aside.x > 0.0 { -aside } else { aside };
    (middle + ASIDE * aside, aside)
}

/// Holds the tissue next to a line, if a tool can hold, and cuts along it, once for each depth.
pub(super) fn steps_to_cut(
    rest: &RestSurface<'_>,
    line: &Polyline,
    depths: &[f64],
    blade: usize,
    grasper: Option<usize>,
) -> Vec<Step> {
    let mut steps = Vec::new();
    if let Some(tool) = grasper {
        let (place, aside) = hold(rest, line);
        steps.extend(steps_to_grasp(rest, tool, &place));
        steps.push(Step::Move {
            tool,
            to: rest.above_surface(&place, -BITE) + STRETCH * aside,
            speed: SLOW,
            cuts: false,
        });
    }
    // A closed line has no end for the overshoot, and continues around beyond it.
    let start = if line.is_closed() { 0.0 } else { -BEYOND };
    let length = line.length() + BEYOND - start;
    let pieces = (length / SPACING).ceil() as u32;
    for depth in depths {
        let place = |piece: u32| line.at(start + length * f64::from(piece) / f64::from(pieces));
        let over = |piece: u32, height: f64, speed: f64, cuts: bool| Step::Move {
            tool: blade,
            to: rest.above_surface(&place(piece), height),
            speed,
            cuts,
        };
        steps.extend([over(0, ABOVE, FREE, false), over(0, 0.001, FREE, false)]);
        steps.push(over(0, -depth, SLOW, false));
        steps.extend((0..=pieces).map(|piece| over(piece, -depth, SLOW, true)));
        steps.extend([
            over(pieces, 0.001, SLOW, false),
            over(pieces, ABOVE, FREE, false),
        ]);
    }
    steps
}
