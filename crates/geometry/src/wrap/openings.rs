//! Openings of a body that are wider than its gaps: where they are capped.
//!
//! The widest ball that reaches a place from outside is as wide as the narrowest part of its path. Where a wider one would have room,
//! the place lies behind an opening. From there and from outside both sides grow into narrower and narrower places, and the
//! cap lies where they meet: across an opening where it is narrowest, and flat where its rim is, as the watershed of the distance
//! from the triangles [Meyer 1994].

use super::closing::{Closing, ONE_SIDE};
use super::grid::Grid;
use crate::{TriangleMesh, Vec3};

/// Voxels across the longest side of the mesh, at most [-].
const ACROSS: f64 = 100.0;

/// Widths that are distinguished in a voxel [-].
const LEVELS: f64 = 8.0;

/// By how many voxels there is more room behind an opening than in it, at least [-]: next to an open sheet there is
/// less.
const ROOMIER: f64 = 3.0;

/// Least width behind an opening as a part of the largest [-]: a narrower recess of the body stays open.
const PART: f64 = 0.5;

/// How often the sides are smoothed: over some four voxels.
const SMOOTHINGS: usize = 16;

/// The side of an opening on which a place lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Unknown,
    Outside,
    Inside,
}

/// The two sides of the openings of a body.
pub(super) struct Openings {
    grid: Grid,
    /// 1 outside, −1 inside and between them across a cap; none where a triangle is near [-].
    sides: Vec<Option<f32>>,
    /// The width of the widest [m].
    pub(super) width: f64,
}

impl Openings {
    /// Those of what `mesh` encloses, on voxels of `spacing` [m] or more; none where nothing lies behind one.
    pub(super) fn find(mesh: &TriangleMesh, spacing: f64) -> Option<Self> {
        let (low, high) = mesh.bounds();
        let grid = Grid::around(mesh, spacing.max((high - low).max() / ACROSS), 0.0);
        let mut closing = Closing::new(&grid, mesh);
        closing.grow(f64::INFINITY);
        let widths = Widths::new(&closing);
        let count = closing.distance.len();
        let border: Vec<_> = (0..count)
            .filter(|number| grid.is_border(*number))
            .map(|number| (number, Side::Outside))
            .collect();
        let mut ways = vec![0; count];
        widths.grow(&border, |number, width, _| ways[number] = width);
        let room = |number: usize| widths.of[number].saturating_sub(ways[number]);
        let roomiest = (0..count)
            .filter(|number| ways[*number] > 0)
            .map(room)
            .max()?;
        let least = (ROOMIER * LEVELS).max(PART * roomiest as f64) as usize;
        if roomiest < least {
            return None;
        }
        let behind: Vec<usize> = (0..count)
            .filter(|number| ways[*number] > 0 && room(*number) >= least)
            .collect();
        let width = behind.iter().map(|number| ways[*number]).max()?;
        let mut seeds = border;
        seeds.extend(behind.into_iter().map(|number| (number, Side::Inside)));
        let mut sides = vec![Side::Unknown; count];
        widths.grow(&seeds, |number, _, side| sides[number] = side);
        let width = 2.0 * width as f64 / LEVELS * grid.spacing;
        let sides = smoothed(&grid, &sides);
        Some(Self { grid, sides, width })
    }

    /// Removes from the outside of `closing` the inner side of the openings, and a layer of `radius` [m] beyond, which balls of this
    /// radius restore.
    pub(super) fn close(&self, closing: &mut Closing<'_>, radius: f64) {
        let grid = closing.grid;
        let places = closing.outside.iter().enumerate();
        let sides = places.map(|(number, is_outside)| match is_outside {
            true => self.side_at(&grid.middle(grid.indices(number))),
            false => Side::Unknown,
        });
        let mut sides: Vec<Side> = sides.collect();
        let of = |sides: &[Side], wanted: fn(&Side) -> bool| -> Vec<usize> {
            (0..sides.len())
                .filter(|number| wanted(&sides[*number]))
                .collect()
        };
        let mut front = of(&sides, |side| *side != Side::Unknown);
        while !front.is_empty() {
            front = closing.spread(&mut sides, front, Side::Unknown);
        }
        let mut front = of(&sides, |side| *side == Side::Inside);
        for _ in 0..(radius / grid.spacing).round() as usize {
            front = closing.spread(&mut sides, front, Side::Outside);
        }
        for (outside, side) in closing.outside.iter_mut().zip(sides) {
            *outside &= side != Side::Inside;
        }
    }

    /// The side of a place [m], interpolated between the middles of voxels: no two around it lie on different sides of a triangle.
    fn side_at(&self, place: &Vec3) -> Side {
        let indices = (place - self.grid.origin) / self.grid.spacing;
        let low = indices.map(f64::floor);
        let (mut sum, mut is_known) = (0.0, false);
        for corner in 0..8 {
            let step = [0, 1, 2].map(|axis| f64::from(corner >> axis & 1));
            let mut at = [0; 3];
            let mut weight = 1.0;
            for axis in 0..3 {
                let index = low[axis] + step[axis];
                if !(index >= 0.0 && index < self.grid.size[axis] as f64) {
                    return Side::Outside;
                }
                at[axis] = index as usize;
                weight *= 1.0 - (indices[axis] - index).abs();
            }
            if let Some(side) = self.sides[self.grid.number(at)] {
                sum += weight * f64::from(side);
                is_known |= weight > 0.0;
            }
        }
        match is_known {
            false => Side::Unknown,
            true if sum < 0.0 => Side::Inside,
            true => Side::Outside,
        }
    }
}

/// Sides as numbers that even out across a cap, whose steps from voxel to voxel vanish; means of neighbours, none through triangles.
fn smoothed(grid: &Grid, sides: &[Side]) -> Vec<Option<f32>> {
    let as_number = |side: &Side| match side {
        Side::Unknown => None,
        Side::Outside => Some(1.0),
        Side::Inside => Some(-1.0),
    };
    let mut smooth: Vec<Option<f32>> = sides.iter().map(as_number).collect();
    for _ in 0..SMOOTHINGS {
        let mean = |number: usize| {
            let own = smooth[number]?;
            let around = grid.neighbours(grid.indices(number));
            let (sum, count) = around
                .filter_map(|other| smooth[other])
                .fold((own, 1.0), |(sum, count), side| (sum + side, count + 1.0));
            Some(sum / count)
        };
        smooth = (0..smooth.len()).map(mean).collect();
    }
    smooth
}

impl Closing<'_> {
    /// Gives neighbours of the voxels of a `front`, which are outside and on the side `over`, the sides of these; which they are.
    fn spread(&self, sides: &mut [Side], front: Vec<usize>, over: Side) -> Vec<usize> {
        let mut next_front = Vec::new();
        for number in front {
            for next in self.grid.neighbours(self.grid.indices(number)) {
                if self.outside[next] && sides[next] == over {
                    sides[next] = sides[number];
                    next_front.push(next);
                }
            }
        }
        next_front
    }
}

/// How wide a ball around each voxel may be [`LEVELS`]; 0 where a triangle is so near that the voxel may lie on both of its sides.
struct Widths<'g> {
    grid: &'g Grid,
    of: Vec<usize>,
}

impl<'g> Widths<'g> {
    fn new(closing: &Closing<'g>) -> Self {
        let spacing = closing.grid.spacing as f32;
        let of = closing
            .distance
            .iter()
            .map(|distance| match *distance > ONE_SIDE * spacing {
                true => (LEVELS as f32 * distance / spacing) as usize,
                false => 0,
            });
        Self {
            grid: closing.grid,
            of: of.collect(),
        }
    }

    /// Grows from `seeds`, widest paths first; `reached` receives each voxel, the width of the path to it, and the side of its
    /// seed.
    fn grow(&self, seeds: &[(usize, Side)], mut reached: impl FnMut(usize, usize, Side)) {
        let widest = self.of.iter().copied().max().unwrap_or(0);
        let mut is_known = vec![false; self.of.len()];
        let mut fronts: Vec<Vec<(usize, Side)>> = vec![Vec::new(); widest + 1];
        for &(number, side) in seeds {
            is_known[number] = true;
            fronts[widest].push((number, side));
        }
        for width in (1..fronts.len()).rev() {
            let mut next = 0;
            while let Some(&(number, side)) = fronts[width].get(next) {
                next += 1;
                reached(number, width, side);
                for other in self.grid.neighbours(self.grid.indices(number)) {
                    if !is_known[other] && self.of[other] > 0 {
                        is_known[other] = true;
                        fronts[self.of[other].min(width)].push((other, side));
                    }
                }
            }
        }
    }
}
