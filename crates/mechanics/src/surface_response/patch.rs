use nalgebra::Matrix3;

use super::response::{SurfaceResponse, TouchId};
use crate::Vec3;
use crate::boundary_elements::Precision;
use crate::contact::Friction;

/// A touchable triangle whose displacement is prescribed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedTriangle {
    /// The triangle.
    pub triangle: TouchId,
    /// Its displacement [m]; of one that slips only the component along its normal.
    pub displacement: Vec3,
}

/// Whether forces are reciprocal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reciprocity {
    /// As in an elastic solid: contacts make no energy.
    Imposed,
    /// As solved: equal to a new solution with these displacements prescribed.
    AsSolved,
}

/// How triangles are moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchContact {
    /// Whether they may slide along the surface.
    pub friction: Friction,
    /// Whether forces are reciprocal.
    pub reciprocity: Reciprocity,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
}

/// Scratch for up to a number of triangles.
#[derive(Debug)]
pub struct PatchWorkspace {
    most: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
    forces: Vec<Vec3>,
}

impl PatchWorkspace {
    /// For at most `most` triangles at a time.
    pub fn new(most: usize) -> Self {
        Self {
            most,
            matrix: vec![0.0; 9 * most * most],
            right: vec![0.0; 3 * most],
            forces: vec![Vec3::zeros(); most],
        }
    }
}

impl<T: Precision> SurfaceResponse<T> {
    /// The forces [N] on triangles that are moved, one for each, all others being free: the capacitance
    /// solve p = Ξ⁻¹ d (4.7). None when there are more than the workspace is for, one is named twice or cannot be
    /// touched, or the influences are too far from reciprocal.
    pub fn press<'w>(
        &self,
        moved: &[MovedTriangle],
        contact: &PatchContact,
        workspace: &'w mut PatchWorkspace,
    ) -> Option<&'w [Vec3]> {
        let known = |one: &MovedTriangle| one.triangle.index() < self.touchable().len();
        if moved.len() > workspace.most || !moved.iter().all(known) {
            return None;
        }
        let axes = match contact.friction {
            Friction::Bonded => 3,
            Friction::Frictionless => 1,
        };
        let size = axes * moved.len();
        let matrix = &mut workspace.matrix[..size * size];
        let right = &mut workspace.right[..size];
        for (i, row) in moved.iter().enumerate() {
            let normal = self.touchable()[row.triangle.index()].normal;
            for (j, column) in moved.iter().enumerate() {
                let block = match contact.reciprocity {
                    Reciprocity::Imposed => self.compliance(row.triangle, column.triangle),
                    Reciprocity::AsSolved => self.influence(row.triangle, column.triangle),
                };
                match contact.friction {
                    Friction::Bonded => put(matrix, size, i, j, &block),
                    Friction::Frictionless => {
                        let along = self.touchable()[column.triangle.index()].normal;
                        matrix[size * i + j] = normal.dot(&(block * along));
                    }
                }
            }
            match contact.friction {
                Friction::Bonded => {
                    right[3 * i..3 * i + 3].copy_from_slice(row.displacement.as_slice())
                }
                Friction::Frictionless => right[i] = normal.dot(&row.displacement),
            }
        }
        eliminate(matrix, right)?;
        let forces = &mut workspace.forces[..moved.len()];
        for (i, (force, row)) in forces.iter_mut().zip(moved).enumerate() {
            *force = contact.youngs_modulus
                * match contact.friction {
                    Friction::Bonded => Vec3::from_column_slice(&right[3 * i..3 * i + 3]),
                    Friction::Frictionless => {
                        self.touchable()[row.triangle.index()].normal * right[i]
                    }
                };
        }
        Some(forces)
    }
}

fn put(matrix: &mut [f64], size: usize, i: usize, j: usize, block: &Matrix3<f64>) {
    for a in 0..3 {
        for b in 0..3 {
            matrix[size * (3 * i + a) + 3 * j + b] = block[(a, b)];
        }
    }
}

/// Replaces `right` by the solution. Rows are not exchanged: the symmetric part of the matrix is
/// positive definite, for work is done; where it is not, there is no answer.
fn eliminate(matrix: &mut [f64], right: &mut [f64]) -> Option<()> {
    let size = right.len();
    for k in 0..size {
        let (above, below) = matrix.split_at_mut(size * (k + 1));
        let pivot_row = &above[size * k..];
        let pivot = pivot_row[k];
        if pivot <= 0.0 || !pivot.is_finite() {
            return None;
        }
        for (i, row) in below.chunks_exact_mut(size).enumerate() {
            let factor = row[k] / pivot;
            for (value, above) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                *value -= factor * above;
            }
            right[k + 1 + i] -= factor * right[k];
        }
    }
    for k in (0..size).rev() {
        let row = &matrix[size * k..size * (k + 1)];
        let known: f64 = (k + 1..size).map(|j| row[j] * right[j]).sum();
        right[k] = (right[k] - known) / row[k];
    }
    Some(())
}
