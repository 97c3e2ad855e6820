use std::collections::{BTreeMap, VecDeque};
use std::mem;

use nalgebra::Matrix3;

use super::grid::Grid;
use crate::flood::{Connectivity, flood};
use crate::isosurface::voxels_in_pieces;
use crate::{LabelMap, TriangleId, TriangleMesh, closest_on_triangle};

/// Voxels around a triangle in which its distance is computed; half the diagonal of a voxel and more, so that no path
/// through sides passes.
const SEED: f64 = 1.5;
/// Voxels within an envelope by which its deepest place lies below the closing's radius, at least: less is the skin of
/// a body that is open.
pub(super) const SKIN: f64 = 3.0;

/// A part of a body that may be lost where gaps stay open [-]: half of what its volume may be off.
const LITTLE: f64 = 0.005;

/// From a triangle to the middle of a voxel whose points all lie on one side of it [voxels]: half a diagonal.
pub(super) const ONE_SIDE: f32 = 0.87;

/// The distance of each voxel from a mesh, out to a requested distance, and the part that balls reach
/// from the border.
pub(super) struct Closing<'m> {
    pub(super) grid: &'m Grid,
    mesh: &'m TriangleMesh,
    /// Distance from the nearest triangle [m]; infinite beyond `known`.
    pub(super) distance: Vec<f32>,
    nearest: Vec<TriangleId>,
    /// Distance up to which distances are known [m].
    known: f64,
    /// The part that a ball reaches from the border.
    pub(super) outside: Vec<bool>,
}

impl<'m> Closing<'m> {
    /// The distances next to the triangles.
    pub(super) fn new(grid: &'m Grid, mesh: &'m TriangleMesh) -> Self {
        let count = grid.voxels() as usize;
        let known = SEED * grid.spacing;
        let mut closing = Self {
            grid,
            mesh,
            distance: vec![f32::INFINITY; count],
            nearest: vec![TriangleId(0); count],
            known,
            outside: Vec::new(),
        };
        for triangle in mesh.triangle_ids() {
            let [a, b, c] = mesh.positions(triangle);
            let [x, y, z] = grid.range(&a.inf(&b).inf(&c), &a.sup(&b).sup(&c), known);
            for k in z {
                for j in y.clone() {
                    for i in x.clone() {
                        closing.offer([i, j, k], triangle, known);
                    }
                }
            }
        }
        closing
    }

    /// Takes the distance of a voxel from `triangle` if it is the least and at most `most` [m].
    fn offer(&mut self, indices: [usize; 3], triangle: TriangleId, most: f64) -> bool {
        let place = self.grid.middle(indices);
        let on = closest_on_triangle(&self.mesh.positions(triangle), &place);
        let distance = (on.position - place).norm();
        let number = self.grid.number(indices);
        let is_less = distance <= most && (distance as f32) < self.distance[number];
        if is_less {
            self.distance[number] = distance as f32;
            self.nearest[number] = triangle;
        }
        is_less
    }

    /// Carries the nearest triangles outward, from voxel to voxel, to `reach` [m].
    pub(super) fn grow(&mut self, reach: f64) {
        if reach <= self.known {
            return;
        }
        let begin = (self.known - 2.0 * self.grid.spacing) as f32;
        let is_front = |&number: &usize| {
            let distance = self.distance[number];
            distance.is_finite() && distance >= begin
        };
        let mut open: VecDeque<usize> = (0..self.distance.len()).filter(is_front).collect();
        while let Some(number) = open.pop_front() {
            let triangle = self.nearest[number];
            for next in self.grid.neighbours(self.grid.indices(number)) {
                if self.offer(self.grid.indices(next), triangle, reach) {
                    open.push_back(next);
                }
            }
        }
        self.known = reach;
    }

    /// Finds the part that a ball of `radius` [m] reaches from the border, and whether any voxel lies deeper
    /// than a skin.
    pub(super) fn encloses(&mut self, radius: f64) -> bool {
        let skin = radius + SKIN * self.grid.spacing;
        self.grow(skin);
        let mut outside = vec![false; self.distance.len()];
        // The first voxel is in the margin.
        flood(self.grid.size, 0, Connectivity::Six, |number| {
            f64::from(self.distance[number]) > radius && !mem::replace(&mut outside[number], true)
        });
        let encloses = (0..outside.len())
            .any(|number| !outside[number] && f64::from(self.distance[number]) >= skin);
        self.outside = outside;
        encloses
    }

    /// The part that no ball of a `narrow` radius [m] covers, if that is the same body as for a `wide` one, which found the present
    /// outside: narrow balls reach no place where a wide one has room, and leave the body in one piece, but for a little. They then
    /// define the outside.
    pub(super) fn same_body(&mut self, narrow: f64, wide: f64) -> Option<LabelMap> {
        let outside = mem::take(&mut self.outside);
        if self.encloses(narrow) {
            let places = outside.iter().zip(&self.outside).zip(&self.distance);
            let reached = places.filter(|((before, now), distance)| {
                !**before && **now && f64::from(**distance) > wide
            });
            let map = self.inside(narrow);
            let [body, pieces] = voxels_in_pieces(&map, 1);
            if (reached.count() + pieces) as f64 <= LITTLE * body as f64 {
                return Some(map);
            }
        }
        self.outside = outside;
        None
    }

    /// The part that no ball of `radius` [m] covers, as label 1.
    pub(super) fn inside(&self, radius: f64) -> LabelMap {
        within(self.grid, &self.outside, radius, false)
    }
}

/// The voxels within `radius` [m] of those that are `set`, or the others, as label 1. The nearest voxel that is set is half a voxel
/// beyond the radius on the mean.
pub(super) fn within(grid: &Grid, set: &[bool], radius: f64, is_within: bool) -> LabelMap {
    let limit = (radius / grid.spacing + 0.5).powi(2) as f32;
    LabelMap {
        size: grid.size,
        labels: squared_distances(grid, set)
            .into_iter()
            .map(|squared| u16::from((squared <= limit) == is_within))
            .collect(),
        steps: Matrix3::from_diagonal_element(grid.spacing),
        origin: grid.origin,
        names: BTreeMap::new(),
        warnings: Vec::new(),
    }
}

/// The squared distance of each voxel from the nearest one that is `set` [voxels²]: lower envelopes of parabolas along
/// each axis [Felzenszwalb and Huttenlocher 2012].
fn squared_distances(grid: &Grid, set: &[bool]) -> Vec<f32> {
    let mut all: Vec<f32> = set
        .iter()
        .map(|&is_set| if is_set { 0.0 } else { f32::INFINITY })
        .collect();
    let strides = [1, grid.size[0], grid.size[0] * grid.size[1]];
    for (length, stride) in grid.size.into_iter().zip(strides) {
        for lines in all.chunks_exact_mut(length * stride) {
            along_lines(lines, length, stride);
        }
    }
    all
}

/// Adjacent lines are read and written together, in the order of memory.
const TOGETHER: usize = 32;

/// Lower envelopes along the lines of `length` numbers, each `stride` from the next, that fill `all`.
fn along_lines(all: &mut [f32], length: usize, stride: usize) {
    let mut lines = vec![0.0; length * TOGETHER.min(stride)];
    let mut parabolas = Parabolas::default();
    for first in (0..stride).step_by(TOGETHER) {
        let count = TOGETHER.min(stride - first);
        for k in 0..length {
            let numbers = &all[first + k * stride..][..count];
            for (line, &number) in numbers.iter().enumerate() {
                lines[line * length + k] = number;
            }
        }
        for line in lines.chunks_exact_mut(length).take(count) {
            parabolas.lower(line);
        }
        for k in 0..length {
            let numbers = &mut all[first + k * stride..][..count];
            for (line, number) in numbers.iter_mut().enumerate() {
                *number = lines[line * length + k];
            }
        }
    }
}

/// The lower envelope of parabolas over one line.
#[derive(Debug, Default)]
struct Parabolas {
    places: Vec<usize>,
    /// Where each begins to be the lowest.
    begins: Vec<f64>,
    heights: Vec<f64>,
}

impl Parabolas {
    /// The least of `line[i] + (k − i)²` over i takes the place of each `line[k]`.
    fn lower(&mut self, line: &mut [f32]) {
        // What is nearest to itself.
        if line.iter().all(|&height| height == 0.0) {
            return;
        }
        self.places.clear();
        self.begins.clear();
        self.heights.clear();
        self.heights
            .extend(line.iter().map(|&height| f64::from(height)));
        for (q, &height) in self.heights.iter().enumerate() {
            if !height.is_finite() {
                continue;
            }
            let lift = |i: usize| self.heights[i] + (i * i) as f64;
            let mut begin = f64::NEG_INFINITY;
            while let Some(&last) = self.places.last() {
                begin = (lift(q) - lift(last)) / (2.0 * (q - last) as f64);
                if begin > self.begins[self.places.len() - 1] {
                    break;
                }
                self.places.pop();
                self.begins.pop();
                begin = f64::NEG_INFINITY;
            }
            self.places.push(q);
            self.begins.push(begin);
        }
        if self.places.is_empty() {
            return;
        }
        let mut which = 0;
        for (k, least) in line.iter_mut().enumerate() {
            let begins = |which: usize| {
                self.begins
                    .get(which)
                    .is_some_and(|&begin| begin <= k as f64)
            };
            while begins(which + 1) {
                which += 1;
            }
            let place = self.places[which];
            let away = k as f64 - place as f64;
            *least = (self.heights[place] + away * away) as f32;
        }
    }
}
