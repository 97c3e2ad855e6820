use std::collections::HashMap;

use super::net::Net;
use crate::check::self_intersection::{Placed, triangles_meet};
use crate::{NodeId, Vec3};

/// Cells of the grid, as multiples of the mean edge [-].
const CELL: f64 = 1.3;

/// The grid is made anew when this part of the triangles is left [-].
const THINNED: f64 = 0.25;

/// A triangle as a change would leave it.
pub(super) struct Fresh {
    pub(super) nodes: [u32; 3],
    pub(super) corners: [Vec3; 3],
    /// Twice the area vector of what was there before [m²].
    pub(super) before: Vec3,
}

/// What a change must keep to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Demands {
    /// Least shape of the new triangles [-], unless there was a worse one; see [`shape`].
    pub(super) shape: f64,
    /// Cosine of the largest turn of a triangle [-].
    pub(super) turn: f64,
    /// Whether new triangles must not pass through others.
    pub(super) apart: bool,
}

/// How equilateral a triangle is [-]: 1 when it is, 0 when it has no area.
pub(super) fn shape(corners: &[Vec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let sides = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    let quality = 2.0 * 3f64.sqrt() * double_area(corners).norm() / sides;
    if quality.is_nan() { 0.0 } else { quality }
}

/// Twice the area vector [m²].
pub(super) fn double_area([a, b, c]: &[Vec3; 3]) -> Vec3 {
    (b - a).cross(&(c - a))
}

/// Says whether a change may be made, and knows which triangles are near.
pub(super) struct Guard {
    cells: HashMap<[i32; 3], Vec<u32>>,
    cell: f64,
    live: usize,
}

impl Guard {
    pub(super) fn new(net: &Net) -> Self {
        let (mut sum, mut sides) = (0.0, 0.0);
        for triangle in net.triangles() {
            let [a, b, c] = net.placed(triangle);
            sum += (b - a).norm() + (c - b).norm() + (a - c).norm();
            sides += 3.0;
        }
        let mut guard = Self {
            cells: HashMap::new(),
            cell: CELL * f64::max(sum / sides, f64::MIN_POSITIVE),
            live: net.live(),
        };
        for triangle in net.triangles() {
            guard.note(triangle, &net.placed(triangle));
        }
        guard
    }

    /// Notes where a triangle is now. Where it was before stays noted and does no harm.
    pub(super) fn note(&mut self, triangle: u32, corners: &[Vec3; 3]) {
        let [a, b, c] = corners;
        let cell = self.cell;
        for_each_cell(cell, &a.inf(b).inf(c), &a.sup(b).sup(c), |key| {
            let noted = self.cells.entry(key).or_default();
            if !noted.contains(&triangle) {
                noted.push(triangle);
            }
        });
    }

    /// Makes the grid coarser when few triangles are left.
    pub(super) fn keep_up(&mut self, net: &Net) {
        if (net.live() as f64) < THINNED * self.live as f64 {
            *self = Self::new(net);
        }
    }

    /// Whether the triangles `old` may be replaced by `new`.
    pub(super) fn admits(&self, net: &Net, old: &[u32], new: &[Fresh], demands: Demands) -> bool {
        let before = old.iter().map(|&t| shape(&net.placed(t)));
        let least = before.fold(demands.shape, f64::min);
        let fair = |fresh: &Fresh| {
            let after = double_area(&fresh.corners);
            let turn = after.dot(&fresh.before);
            // What had no area may turn as it likes.
            let upright = turn > demands.turn * after.norm() * fresh.before.norm()
                || fresh.before == Vec3::zeros();
            upright && shape(&fresh.corners) >= least && after != Vec3::zeros()
        };
        new.iter().all(fair) && !(demands.apart && self.meets(net, old, new))
    }

    /// Whether a new triangle passes through another one, old ones left out.
    fn meets(&self, net: &Net, old: &[u32], new: &[Fresh]) -> bool {
        let new: Vec<Boxed> = new.iter().map(|f| Boxed::new(f.nodes, f.corners)).collect();
        let low = new.iter().fold(new[0].low, |low, one| low.inf(&one.low));
        let high = new
            .iter()
            .fold(new[0].high, |high, one| high.sup(&one.high));
        let mut near = Vec::new();
        for_each_cell(self.cell, &low, &high, |key| {
            near.extend(self.cells.get(&key).into_iter().flatten());
        });
        near.sort_unstable();
        near.dedup();
        let others = near
            .into_iter()
            .filter(|t| net.is_live(*t) && !old.contains(t))
            .map(|t| Boxed::new(net.corners(t), net.placed(t)));
        let mut near_enough = others.filter(|other| other.reaches(&low, &high));
        near_enough.any(|other| new.iter().any(|one| one.meets(&other)))
            || (1..new.len()).any(|k| new[..k].iter().any(|one| one.meets(&new[k])))
    }
}

/// A triangle and the box around it [m].
struct Boxed {
    placed: Placed,
    low: Vec3,
    high: Vec3,
}

impl Boxed {
    fn new(nodes: [u32; 3], corners: [Vec3; 3]) -> Self {
        let [a, b, c] = &corners;
        Self {
            low: a.inf(b).inf(c),
            high: a.sup(b).sup(c),
            placed: Placed {
                nodes: nodes.map(NodeId),
                corners,
            },
        }
    }

    fn reaches(&self, low: &Vec3, high: &Vec3) -> bool {
        (0..3).all(|k| self.low[k] <= high[k] && low[k] <= self.high[k])
    }

    fn meets(&self, other: &Self) -> bool {
        self.reaches(&other.low, &other.high) && triangles_meet(&self.placed, &other.placed)
    }
}

fn for_each_cell(cell: f64, low: &Vec3, high: &Vec3, mut visit: impl FnMut([i32; 3])) {
    let number = |length: f64| (length / cell).floor() as i32;
    for i in number(low.x)..=number(high.x) {
        for j in number(low.y)..=number(high.y) {
            for k in number(low.z)..=number(high.z) {
                visit([i, j, k]);
            }
        }
    }
}
