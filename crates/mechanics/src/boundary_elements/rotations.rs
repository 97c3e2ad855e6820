//! Rotations of the whole solid, which need no traction.
//!
//! The rows of ½ 1 + T sum to zero, so that a translation needs no traction. A rotation u = ω × (y − xᵢ) varies on a panel,
//! whose displacement is constant here, so that
//!
//! ```text
//! ρᵢ ω = Σⱼ (½ 1 + T)ᵢⱼ ω × (yⱼ − xᵢ)
//! ```
//!
//! is not zero: panels resist being turned, and a slender solid, whose parts turn as it bends, is too stiff (a beam ten
//! times as long as thick by a factor of ten). Each row is corrected by the smallest change of its entries for the panels
//! around panel i, weighted by area over squared distance as the kernel is, after which a rotation needs none either:
//!
//! ```text
//! δTᵢⱼ = −ρᵢ (Σ w Ωᵀ Ω)⁻¹ Ωⱼᵀ wⱼ,   δTᵢᵢ = −Σ δTᵢⱼ,   Ωⱼ ω = ω × (yⱼ − xᵢ),   wⱼ = Aⱼ/|yⱼ − xᵢ|²
//! ```
//!
//! *How we know*: `boundary_elements::rigid_motions_have_no_traction`, `boundary_response::a_slender_beam_bends_as_beams_do`,
//! `thin_lobes::…`. With weights of the area alone forces differ by two thousandths.

use nalgebra::Matrix3;
use palpate_geometry::{TriangleId, cores, on_all_cores};

use super::assembly::Influences;
use super::precision::Precision;
use crate::Vec3;

/// Columns of ½ 1 + T, in which the columns of fixed panels have another meaning.
pub(super) struct TractionColumns<'a, T> {
    /// Three for each panel, one after the other.
    pub(super) columns: &'a mut [T],
    /// Whether a panel is fixed.
    pub(super) fixed: &'a [bool],
}

impl<T: Precision> TractionColumns<'_, T> {
    /// The first entry of what the displacement of `source` does to `target`.
    fn first(&self, source: usize, target: usize) -> usize {
        9 * self.fixed.len() * source + 3 * target
    }

    fn block(&self, source: usize, target: usize) -> Matrix3<f64> {
        let (first, size) = (self.first(source, target), 3 * self.fixed.len());
        Matrix3::from_fn(|row, column| self.columns[first + size * column + row].into())
    }

    /// Adds to that; a fixed panel has no displacement.
    fn add(&mut self, source: usize, target: usize, change: &Matrix3<f64>) {
        if self.fixed[source] {
            return;
        }
        let (first, size) = (self.first(source, target), 3 * self.fixed.len());
        for column in 0..3 {
            for row in 0..3 {
                let entry = &mut self.columns[first + size * column + row];
                *entry = T::of((*entry).into() + change[(row, column)]);
            }
        }
    }
}

impl Influences<'_> {
    /// Corrects the columns of free panels.
    pub(super) fn free_rotations<T: Precision>(&self, mut columns: TractionColumns<'_, T>) {
        let residuals = self.residuals(&columns);
        for (target, residual) in residuals.iter().enumerate() {
            self.correct(target, residual, &mut columns);
        }
    }

    /// ρ of each row [m].
    fn residuals<T: Precision>(&self, columns: &TractionColumns<'_, T>) -> Vec<Matrix3<f64>> {
        let count = self.panels.len();
        let mut residuals = vec![Matrix3::zeros(); count];
        let share = count.div_ceil(cores());
        on_all_cores(residuals.chunks_mut(share).enumerate(), |(k, rows)| {
            for (source, &is_fixed) in columns.fixed.iter().enumerate() {
                let traction = is_fixed.then(|| self.traction_blocks(source));
                for (target, residual) in (k * share..).zip(rows.iter_mut()) {
                    let block = match &traction {
                        Some(traction) => traction(target),
                        None => columns.block(source, target),
                    };
                    *residual -= block * self.offset(source, target).cross_matrix();
                }
            }
        });
        residuals
    }

    /// Corrects the row of panel `target`.
    fn correct<T: Precision>(
        &self,
        target: usize,
        residual: &Matrix3<f64>,
        columns: &mut TractionColumns<'_, T>,
    ) {
        let nodes = self.surface.mesh().corners(TriangleId(target as u32));
        let adjacency = self.surface.adjacency();
        let around = nodes.iter().flat_map(|&node| adjacency.around(node));
        let mut around: Vec<usize> = around.map(|triangle| triangle.index()).collect();
        around.sort_unstable();
        around.dedup();
        around.retain(|&source| self.offset(source, target).norm_squared() > 0.0);
        let turned = |source: usize| {
            let offset = self.offset(source, target);
            let weight = self.panels[source].area / offset.norm_squared();
            (-offset.cross_matrix(), weight)
        };
        let squares = around.iter().map(|&source| {
            let (turn, weight) = turned(source);
            turn.transpose() * turn * weight
        });
        // Panels around one lie on no straight line.
        let Some(inverse) = squares.sum::<Matrix3<f64>>().try_inverse() else {
            return;
        };
        let mut own = Matrix3::zeros();
        for &source in &around {
            let (turn, weight) = turned(source);
            let change = -residual * inverse * turn.transpose() * weight;
            own -= change;
            columns.add(source, target, &change);
        }
        columns.add(target, target, &own);
    }

    /// From the centroid of a panel to that of another [m].
    fn offset(&self, source: usize, target: usize) -> Vec3 {
        self.panels[source].centroid - self.panels[target].centroid
    }
}
