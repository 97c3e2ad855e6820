//! Solutions for a range of surface curvatures, made once and interpolated.
//!
//! A template depends on the tissue's ν and on the curvature of the surface alone (in units of h), and
//! on both smoothly, so that 729 solutions serve every contact on every organ.

use nalgebra::{Matrix3, Vector3};

use super::layout::CapShape;
use super::solution::Solution;

/// Solutions along each of the three axes: mean curvature, and the two of its difference. With five the
/// force at the steepest caps is off by 4 %, with nine by 1.2 % (2.1 % along the surface).
const PER_AXIS: usize = 9;

#[derive(Debug, Clone)]
pub(super) struct ReuseTable {
    entries: Vec<Entry>,
    largest: f64,
}

#[derive(Debug, Clone)]
struct Entry {
    stiffness: Matrix3<f64>,
    coefficients: Vec<Matrix3<f64>>,
    positions: Vec<crate::Vec3>,
    inverse_squares: Vec<f64>,
}

impl ReuseTable {
    /// `solve` fills the solution under a cap; `shells` is the number of shells.
    pub(super) fn new(
        shells: usize,
        solution: &mut Solution,
        mut solve: impl FnMut(CapShape, &mut Solution),
    ) -> Self {
        let largest = CapShape::steepest_curvature(shells);
        let value = |k: usize| largest * (2.0 * k as f64 / (PER_AXIS - 1) as f64 - 1.0);
        let mut entries = Vec::with_capacity(PER_AXIS.pow(3));
        for m in 0..PER_AXIS {
            for p in 0..PER_AXIS {
                for q in 0..PER_AXIS {
                    let (mean, half) = (value(m), value(p));
                    let curvature = Vector3::new(mean + half, value(q), mean - half);
                    // Beyond what a cap may be: the corners of cells that a cap can fall into.
                    solve(CapShape::steep(curvature), solution);
                    entries.push(Entry {
                        stiffness: solution.stiffness,
                        coefficients: solution.coefficients.clone(),
                        positions: solution.particles.positions.clone(),
                        inverse_squares: solution.particles.inverse_squares.clone(),
                    });
                }
            }
        }
        Self { entries, largest }
    }

    /// Fills `solution` for the shape `cap`.
    pub(super) fn interpolate(&self, cap: CapShape, solution: &mut Solution) {
        let k = cap.curvature();
        let axes = [0.5 * (k[0] + k[2]), 0.5 * (k[0] - k[2]), k[1]];
        let places = axes.map(|value| {
            let along = (value / self.largest + 1.0) * 0.5 * (PER_AXIS - 1) as f64;
            let below = along.floor().clamp(0.0, (PER_AXIS - 2) as f64);
            (below as usize, (along - below).clamp(0.0, 1.0))
        });
        solution.stiffness = Matrix3::zeros();
        solution.coefficients.fill(Matrix3::zeros());
        let count = solution.coefficients.len();
        solution.particles.positions.clear();
        solution
            .particles
            .positions
            .resize(count, crate::Vec3::zeros());
        solution.particles.inverse_squares.clear();
        solution.particles.inverse_squares.resize(count, 0.0);
        for corner in 0..8usize {
            let mut weight = 1.0;
            let mut index = 0;
            for (axis, (below, along)) in places.iter().enumerate() {
                let upper = (corner >> axis) & 1;
                weight *= if upper == 1 { *along } else { 1.0 - along };
                index = index * PER_AXIS + below + upper;
            }
            if weight > 0.0 {
                self.entries[index].add_to(solution, weight);
            }
        }
    }
}

impl Entry {
    fn add_to(&self, solution: &mut Solution, weight: f64) {
        solution.stiffness += self.stiffness * weight;
        let coefficients = solution.coefficients.iter_mut().zip(&self.coefficients);
        coefficients.for_each(|(sum, own)| *sum += own * weight);
        let positions = solution.particles.positions.iter_mut().zip(&self.positions);
        positions.for_each(|(sum, own)| *sum += own * weight);
        let inverse_squares = solution
            .particles
            .inverse_squares
            .iter_mut()
            .zip(&self.inverse_squares);
        inverse_squares.for_each(|(sum, own)| *sum += own * weight);
    }
}
