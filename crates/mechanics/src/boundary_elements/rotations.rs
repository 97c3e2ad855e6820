//! Rotations of the whole solid, which need no traction.
//!
//! The rows of ½ 1 + T sum to zero, so that a translation needs no traction. A rotation u = ω × (y − xᵢ) varies on a panel,
//! whose displacement is constant here, so that
//!
//! ```text
//! ρᵢ ω = Σⱼ (½ 1 + T)ᵢⱼ ω × (yⱼ − xᵢ)
//! ```
//!
//! is not zero: panels resist being turned, and a slender solid, whose parts turn as it bends, is too stiff, a beam ten
//! times as long as thick by a factor of ten. Each row is corrected by the smallest change of its entries for the panels around panel i, weighted by
//! area over squared distance as the kernel is, after which both motions need none:
//!
//! ```text
//! δTᵢⱼ = −ρᵢ (Σ w Ωᵀ Ω)⁻¹ Ωⱼᵀ wⱼ,   δTᵢᵢ = −Σ δTᵢⱼ,   Ωⱼ ω = ω × (yⱼ − xᵢ),   wⱼ = Aⱼ/|yⱼ − xᵢ|²
//! ```
//!
//! *How we know*: `boundary_elements::rigid_motions_have_no_traction`, `boundary_response::a_slender_beam_bends_as_beams_do`,
//! `thin_lobes::…`. With weights of the area alone forces differ by two thousandths.

use nalgebra::Matrix3;
use palpate_geometry::TriangleId;

use super::assembly::Influences;
use super::precision::Precision;
use crate::Vec3;
use crate::cores::{cores, on_all_cores};

impl Influences<'_> {
    /// Corrects the columns of free panels in `system`, which are those of ½ 1 + T, where others are `held`.
    pub(super) fn free_rotations<T: Precision>(&self, held: &[bool], system: &mut [T]) {
        let residuals = self.residuals(held, system);
        for (target, residual) in residuals.iter().enumerate() {
            self.correct((target, residual), held, system);
        }
    }

    /// ρ of each row [m].
    fn residuals<T: Precision>(&self, held: &[bool], system: &[T]) -> Vec<Matrix3<f64>> {
        let count = self.panels.len();
        let mut residuals = vec![Matrix3::zeros(); count];
        let share = count.div_ceil(cores());
        on_all_cores(residuals.chunks_mut(share).enumerate(), |(k, rows)| {
            for (source, &is_held) in held.iter().enumerate() {
                let traction = self.traction_blocks(source);
                for (target, residual) in (k * share..).zip(rows.iter_mut()) {
                    let block = match is_held {
                        true => traction(target),
                        false => block(system, count, source, target),
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
        (target, residual): (usize, &Matrix3<f64>),
        held: &[bool],
        system: &mut [T],
    ) {
        let nodes = self.surface.mesh().corners(TriangleId(target as u32));
        let adjacency = self.surface.adjacency();
        let around = nodes.iter().flat_map(|&node| adjacency.around(node));
        let mut around: Vec<usize> = around.map(|triangle| triangle.index()).collect();
        around.sort_unstable();
        around.dedup();
        around.retain(|&source| source != target);
        let turned = |source: usize| {
            let offset = self.offset(source, target);
            let weight = self.panels[source].area / offset.norm_squared();
            (-offset.cross_matrix(), weight)
        };
        let sum: Matrix3<f64> = around
            .iter()
            .map(|&source| {
                let (turn, weight) = turned(source);
                turn.transpose() * turn * weight
            })
            .sum();
        // Panels around one lie on no straight line.
        let Some(inverse) = sum.try_inverse() else {
            return;
        };
        let mut own = Matrix3::zeros();
        let count = self.panels.len();
        for &source in &around {
            let (turn, weight) = turned(source);
            let change = -residual * inverse * turn.transpose() * weight;
            own -= change;
            add(system, count, (source, target), held, &change);
        }
        add(system, count, (target, target), held, &own);
    }

    /// From the centroid of a panel to that of another [m].
    fn offset(&self, source: usize, target: usize) -> Vec3 {
        self.panels[source].centroid - self.panels[target].centroid
    }
}

/// What the displacement of a free panel does to another one.
fn block<T: Precision>(system: &[T], count: usize, source: usize, target: usize) -> Matrix3<f64> {
    let first = 9 * count * source + 3 * target;
    Matrix3::from_fn(|row, column| system[first + 3 * count * column + row].into())
}

/// Adds to that; a held panel has no displacement.
fn add<T: Precision>(
    system: &mut [T],
    count: usize,
    (source, target): (usize, usize),
    held: &[bool],
    change: &Matrix3<f64>,
) {
    if held[source] {
        return;
    }
    let first = 9 * count * source + 3 * target;
    for column in 0..3 {
        for row in 0..3 {
            let entry = &mut system[first + 3 * count * column + row];
            *entry = T::of((*entry).into() + change[(row, column)]);
        }
    }
}
