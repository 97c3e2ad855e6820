//! The part of a solid that a rigid tool will probably touch, from their shapes at rest.

use nalgebra::Matrix3;
use palpate_geometry::closest_on_triangle;

use super::super::rigid_tool::{RigidShape, RigidTool};
use crate::Vec3;

/// Points from which the mesh is graded; more are not needed.
const POINTS: usize = 400;

/// Edges of a triangle of the first samples, in the size of a tool or of the body [-].
const SAMPLE: f64 = 0.2;
/// How often samples are halved at most where a tool meets few of them.
const HALVINGS: usize = 6;
/// Fewest samples from which the size of a contact is known.
const FEWEST: usize = 24;

/// Places along a path, in sizes of the contact, and most of them on each part [-].
const ALONG: f64 = 1.0;
const MAX_PLACES: usize = 64;

/// A sphere presses tissue away: it touches half the area of the circle in which it cuts the surface at rest [Hertz 1881].
const TOUCHED: f64 = 0.5;

/// The part of the boundary that a tool meets on its path.
#[derive(Debug, Clone)]
pub(super) struct Footprint {
    /// Points of the boundary inside of the tool, somewhere on its path [m].
    pub(super) points: Vec<Vec3>,
    /// About the radius, or half the width, of the contact [m].
    pub(super) size: f64,
    /// Positions of the tool on its path, a few [m].
    positions: Vec<Vec3>,
    /// The sharp edge of a flat punch where it comes first.
    edge: Option<SharpEdge>,
    /// Distance from these places within which tissue that is not under the tool at rest may touch
    /// it [m].
    reach: f64,
}

/// A circle at which stress is infinite.
#[derive(Debug, Clone, Copy)]
struct SharpEdge {
    /// [m]
    center: Vec3,
    /// [-]
    axis: Vec3,
    /// [m]
    radius: f64,
}

impl SharpEdge {
    fn of(tool: &RigidTool) -> Option<Self> {
        match tool.shape {
            RigidShape::FlatPunch {
                radius,
                edge_radius: 0.0,
            } => Some(Self {
                center: tool.position(1.0),
                axis: tool.orientation * Vec3::z(),
                radius,
            }),
            _ => None,
        }
    }
}

/// A small part of the boundary: its middle [m] and area [m²].
type Sample = (Vec3, f64);

impl Footprint {
    /// Of `tool` on the `triangles` of a boundary of this `extent` [m].
    pub(super) fn new(tool: &RigidTool, triangles: &[[Vec3; 3]], extent: f64) -> Self {
        let mut spacing = SAMPLE * tool.shape.size().min(extent);
        let under = |position: &Vec3, spacing: f64| {
            let mut samples = Vec::new();
            for triangle in triangles {
                sample(triangle, tool, position, spacing, &mut samples);
            }
            samples
        };
        let mut found: Vec<Vec<Sample>> = Vec::new();
        for _ in 0..=HALVINGS {
            found = tool.path.iter().map(|at| under(at, spacing)).collect();
            if found.iter().any(|samples| samples.len() >= FEWEST) {
                break;
            }
            spacing *= 0.5;
        }
        let sizes = found.iter().filter_map(|samples| half_width(samples));
        let size = sizes.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { spacing };
        let mut positions = tool.path.clone();
        let mut longest: f64 = 0.0;
        for ends in tool.path.windows(2) {
            let length = (ends[1] - ends[0]).norm();
            longest += length;
            let places = ((length / (ALONG * size)).ceil() as usize).min(MAX_PLACES);
            let between = (1..places).map(|k| ends[0].lerp(&ends[1], k as f64 / places as f64));
            for position in between {
                found.push(under(&position, spacing));
                positions.push(position);
            }
        }
        let all: Vec<Vec3> = found.into_iter().flatten().map(|(at, _)| at).collect();
        let points = all.iter().step_by(all.len() / POINTS + 1).copied();
        Self {
            points: points.collect(),
            size,
            edge: SharpEdge::of(tool),
            positions,
            reach: (2.0 * size).max(0.5 * longest),
        }
    }

    /// Mean distance of its points from these `triangles` [m].
    pub(super) fn off(&self, triangles: &[[Vec3; 3]]) -> f64 {
        let all = self.points.iter().map(|point| {
            let distances = triangles
                .iter()
                .map(|triangle| (closest_on_triangle(triangle, point).position - point).norm());
            distances.fold(f64::INFINITY, f64::min)
        });
        all.sum::<f64>() / self.points.len().max(1) as f64
    }

    /// A function that changes its sign along the sharp edge of the tool [m], if it has one.
    pub(super) fn height(&self) -> Option<impl Fn(&Vec3) -> f64> {
        let edge = self.edge?;
        Some(move |point: &Vec3| {
            let off = point - edge.center;
            let along = off.dot(&edge.axis);
            let out = (off - along * edge.axis).norm() - edge.radius;
            out.max(along.abs() - edge.radius)
        })
    }

    /// Whether a `point` of the boundary at rest may touch the `tool`.
    pub(super) fn may_touch(&self, tool: &RigidTool, point: &Vec3) -> bool {
        let mut places = self.positions.iter();
        places.any(|position| tool.signed_distance(point, position).distance <= self.reach)
    }
}

/// The parts of a triangle that are inside of a tool, in pieces with edges below `spacing` [m].
fn sample(
    triangle: &[Vec3; 3],
    tool: &RigidTool,
    position: &Vec3,
    spacing: f64,
    out: &mut Vec<Sample>,
) {
    let [a, b, c] = triangle;
    let middle = (a + b + c) / 3.0;
    let reach = triangle.iter().map(|x| (x - middle).norm());
    let distance = tool.signed_distance(&middle, position).distance;
    if distance > reach.fold(0.0, f64::max) {
        return;
    }
    let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
    if longest <= spacing {
        if distance < 0.0 {
            out.push((middle, 0.5 * (b - a).cross(&(c - a)).norm()));
        }
        return;
    }
    let [d, e, f] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
    for part in [[*a, d, f], [d, *b, e], [f, e, *c], [d, e, f]] {
        sample(&part, tool, position, spacing, out);
    }
}

/// Half of the lesser width of what touches, as of an ellipse of these second moments.
fn half_width(samples: &[Sample]) -> Option<f64> {
    let area: f64 = samples.iter().map(|(_, area)| area).sum();
    if samples.len() < FEWEST || area <= 0.0 {
        return None;
    }
    let weighted = samples.iter().map(|(at, part)| *part / area * at);
    let middle: Vec3 = weighted.sum();
    let moments = samples.iter().map(|(at, part)| {
        let off = at - middle;
        *part / area * off * off.transpose()
    });
    let moments: Matrix3<f64> = moments.sum();
    let mut squares: Vec<f64> = moments.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    // The smallest is that of the depth.
    Some(2.0 * (TOUCHED * squares[1]).sqrt())
}
