use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use super::net::Net;
use crate::check::self_intersection::{Placed, triangles_meet};
use crate::{NodeId, Vec3};

/// Cells of the grid, as multiples of the mean edge [-].
const CELL: f64 = 1.3;

/// The grid is made anew when this part of the triangles is left [-].
const THINNED: f64 = 0.25;

/// A triangle as a change would leave it.
pub(super) struct NewTriangle {
    pub(super) nodes: [u32; 3],
    pub(super) corners: [Vec3; 3],
    /// Twice the area vector of the triangle it replaces [m²].
    pub(super) before: Vec3,
}

/// Conditions on a change.
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

/// Checks whether a change is allowed, with a grid to find near triangles.
pub(super) struct Guard {
    /// Triangles by cell; see [`key`]. Never walked over.
    cells: HashMap<u64, Vec<u32>, BuildHasherDefault<KeyHasher>>,
    cell: f64,
    live: usize,
    /// Lowest and highest corner of the box around each triangle as it is now [m].
    boxes: Vec<[Vec3; 2]>,
    /// The last query that visited each triangle.
    asked: Vec<u32>,
    question: u32,
}

/// The number of a cell. Cells that are two million apart may have the same, which makes a triangle be looked at more
/// often, and no more.
fn key([i, j, k]: [i32; 3]) -> u64 {
    let bits = |index: i32| index as u64 & 0x1F_FFFF;
    bits(i) << 42 | bits(j) << 21 | bits(k)
}

/// Spreads the numbers of cells over all bits: multiplication by the golden ratio [Knuth 1998, 6.4].
#[derive(Default)]
struct KeyHasher(u64);

impl Hasher for KeyHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }

    fn write_u64(&mut self, number: u64) {
        let spread = (self.0 ^ number).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        self.0 = spread ^ spread >> 29;
    }
}

impl Guard {
    pub(super) fn new(net: &Net) -> Self {
        let (mut sum, mut sides) = (0.0, 0.0);
        for triangle in net.triangles() {
            let [a, b, c] = net.placed(triangle);
            sum += (b - a).norm() + (c - b).norm() + (a - c).norm();
            sides += 3.0;
        }
        let triangles = net.triangles().last().map_or(0, |last| last as usize + 1);
        let mut guard = Self {
            cells: HashMap::default(),
            cell: CELL * f64::max(sum / sides, f64::MIN_POSITIVE),
            live: net.live(),
            boxes: vec![[Vec3::zeros(); 2]; triangles],
            asked: vec![0; triangles],
            question: 0,
        };
        for triangle in net.triangles() {
            guard.note(triangle, &net.placed(triangle));
        }
        guard
    }

    /// Enters the current cells of a triangle. Its earlier cells stay entered, which is harmless.
    pub(super) fn note(&mut self, triangle: u32, corners: &[Vec3; 3]) {
        let [a, b, c] = corners;
        let cell = self.cell;
        let [low, high] = [a.inf(b).inf(c), a.sup(b).sup(c)];
        self.boxes[triangle as usize] = [low, high];
        for_each_cell(cell, &low, &high, |cell| {
            let noted = self.cells.entry(key(cell)).or_default();
            if !noted.contains(&triangle) {
                noted.push(triangle);
            }
        });
    }

    /// Makes the grid coarser when few triangles are left.
    pub(super) fn coarsen_grid(&mut self, net: &Net) {
        if (net.live() as f64) < THINNED * self.live as f64 {
            *self = Self::new(net);
        }
    }

    /// Whether the triangles `old` may be replaced by `new`.
    pub(super) fn admits(
        &mut self,
        net: &Net,
        old: &[u32],
        new: &[NewTriangle],
        demands: Demands,
    ) -> bool {
        let before = old.iter().map(|&t| shape(&net.placed(t)));
        let least = before.fold(demands.shape, f64::min);
        let fair = |fresh: &NewTriangle| {
            let after = double_area(&fresh.corners);
            let turn = after.dot(&fresh.before);
            // A triangle without area may turn freely.
            let upright = turn > demands.turn * after.norm() * fresh.before.norm()
                || fresh.before == Vec3::zeros();
            upright && shape(&fresh.corners) >= least && after != Vec3::zeros()
        };
        new.iter().all(fair) && !(demands.apart && self.meets(net, old, new))
    }

    /// Whether a new triangle passes through another one, old ones left out.
    fn meets(&mut self, net: &Net, old: &[u32], new: &[NewTriangle]) -> bool {
        let new: Vec<Boxed> = new.iter().map(|f| Boxed::new(f.nodes, f.corners)).collect();
        let low = new.iter().fold(new[0].low, |low, one| low.inf(&one.low));
        let high = new
            .iter()
            .fold(new[0].high, |high, one| high.sup(&one.high));
        self.question = match self.question.checked_add(1) {
            Some(question) => question,
            None => {
                self.asked.fill(0);
                1
            }
        };
        for &triangle in old {
            self.asked[triangle as usize] = self.question;
        }
        let Self {
            cells,
            boxes,
            asked,
            question,
            ..
        } = self;
        let mut meets_near = |triangle: u32| {
            let last = &mut asked[triangle as usize];
            if std::mem::replace(last, *question) == *question || !net.is_live(triangle) {
                return false;
            }
            let [lowest, highest] = &boxes[triangle as usize];
            let near = |one: &&Boxed| one.reaches(lowest, highest);
            if !new.iter().any(|one| near(&one)) {
                return false;
            }
            let other = Boxed::new(net.corners(triangle), net.placed(triangle));
            new.iter().filter(near).any(|one| one.meets(&other))
        };
        let mut found = false;
        for_each_cell(self.cell, &low, &high, |cell| {
            if let Some(noted) = cells.get(&key(cell)).filter(|_| !found) {
                found = noted.iter().any(|&triangle| meets_near(triangle));
            }
        });
        found || (1..new.len()).any(|k| new[..k].iter().any(|one| one.meets(&new[k])))
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
