//! Closed surfaces with a hole: rows of vertices around an axis, spaced in proportion to their radius, so
//! that triangles are equilateral up to the curvature. Each row is turned by half a step against the last.

use std::f64::consts::PI;

use crate::NodeId;

/// Radius (x) and length along the axis (y).
pub(super) type Vec2 = nalgebra::Vector2<f64>;

/// Parameters of an outline run from 0 to 4, one unit per part.
pub(super) const PARTS: f64 = 4.0;
const SAMPLES: usize = 4_000;

/// A closed outline that is turned around the axis, and how rows are spaced on it.
pub(super) struct Profile {
    outline: fn(f64) -> Vec2,
    /// ∫ ds / radius up to evenly spaced parameters, and more where the outline turns.
    lengths: Vec<f64>,
}

impl Profile {
    /// Of the outline that has a point for each parameter from 0 to 4 and `begins` in that direction. Rims are
    /// kept round by `rim_weight` rows per radian of turn, against rows per radius of length [-].
    pub(super) fn new(outline: fn(f64) -> Vec2, rim_weight: f64, begins: Vec2) -> Self {
        let mut lengths = vec![0.0];
        let mut last = outline(0.0);
        let mut last_direction = begins;
        for sample in 1..=SAMPLES {
            let next = outline(PARTS * sample as f64 / SAMPLES as f64);
            let chord = next - last;
            let own = 2.0 * chord.norm() / (next.x + last.x);
            let turn = chord.angle(&last_direction);
            lengths.push(lengths[sample - 1] + own + rim_weight * turn);
            (last, last_direction) = (next, chord);
        }
        Self { outline, lengths }
    }

    pub(super) fn conformal_length(&self) -> f64 {
        self.lengths[SAMPLES]
    }

    /// The parameter a `fraction` of the way around.
    pub(super) fn parameter(&self, fraction: f64) -> f64 {
        let wanted = fraction * self.conformal_length();
        let after = self
            .lengths
            .partition_point(|&l| l <= wanted)
            .clamp(1, SAMPLES);
        let (low, high) = (self.lengths[after - 1], self.lengths[after]);
        let sample = (after - 1) as f64 + (wanted - low) / (high - low);
        PARTS * sample / SAMPLES as f64
    }

    /// Radius and length along the axis, a `fraction` of the way around.
    pub(super) fn point(&self, fraction: f64) -> Vec2 {
        (self.outline)(self.parameter(fraction))
    }
}

/// Rows and steps around, both for nearly `triangles` triangles and nearly equilateral ones.
pub(super) fn grid_size(triangles: usize, conformal_length: f64) -> (usize, usize) {
    let rows_per_step = conformal_length / (3f64.sqrt() * PI);
    let steps = (0.5 * triangles as f64 / rows_per_step).sqrt();
    let cost = |rows: usize, steps: usize| {
        let count = (2 * rows * steps) as f64 / triangles as f64;
        let shape = rows as f64 / (rows_per_step * steps as f64);
        // A count that is off by 1 % is as bad as triangles that are stretched by 10 %.
        100.0 * (count - 1.0).powi(2) + shape.ln().powi(2)
    };
    (steps as usize / 2..=2 * steps as usize)
        .flat_map(|steps| {
            let steps = steps.max(8);
            // An even number of half turns of a step closes the rows.
            let pairs = (0.25 * triangles as f64 / steps as f64).round() as usize;
            [pairs.saturating_sub(1), pairs, pairs + 1].map(|pairs| (2 * pairs.max(4), steps))
        })
        .min_by(|&a, &b| cost(a.0, a.1).total_cmp(&cost(b.0, b.1)))
        .expect("the range of steps holds at least one")
}

/// The triangles between the rows, and from the last row to the first.
pub(super) fn grid_triangles(rows: usize, steps: usize) -> Vec<[NodeId; 3]> {
    let node = |row: usize, step: usize| NodeId(((row % rows) * steps + step % steps) as u32);
    let mut triangles = Vec::with_capacity(2 * rows * steps);
    for row in 0..rows {
        let shift = row % 2;
        for step in 0..steps {
            let (here, next) = (node(row, step), node(row, step + 1));
            let below = node(row + 1, step + shift);
            let below_next = node(row + 1, step + shift + 1);
            triangles.extend([[here, below, next], [next, below, below_next]]);
        }
    }
    triangles
}
