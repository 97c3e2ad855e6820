use std::ops::ControlFlow;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};
use palpate_geometry::on_all_cores;

use super::precision::Precision;

/// Columns that are eliminated at once.
const PANEL: usize = 192;
/// Columns that a core updates at once.
const BLOCK: usize = 256;

/// L and U of a square matrix with its rows in another order, in the matrix's own memory.
pub(super) struct Factors<T> {
    size: usize,
    matrix: Vec<T>,
    /// Which row of the matrix stands in each row of the factors.
    order: Vec<usize>,
}

impl<T: Precision> Factors<T> {
    /// Of `matrix`, column by column, on all cores. `progress` receives the part done [-] and may
    /// cancel.
    pub(super) fn new(
        size: usize,
        mut matrix: Vec<T>,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> ControlFlow<(), Self> {
        let mut order: Vec<usize> = (0..size).collect();
        for start in (0..size).step_by(PANEL) {
            let width = PANEL.min(size - start);
            let (left, right) = matrix.split_at_mut((start + width) * size);
            let (left, panel) = left.split_at_mut(start * size);
            let moved = eliminate(panel, size, start, width);
            on_all_cores(left.chunks_mut(size * BLOCK), |block| {
                move_rows(block, size, &moved);
            });
            move_rows(&mut order, size, &moved);
            let panel = MatRef::from_column_major_slice(panel, size, width);
            on_all_cores(right.chunks_mut(size * BLOCK), |block| {
                move_rows(block, size, &moved);
                update(block, panel, start);
            });
            let rest = (size - start - width) as f64 / size as f64;
            progress(1.0 - rest.powi(3))?;
        }
        ControlFlow::Continue(Self {
            size,
            matrix,
            order,
        })
    }

    /// Replaces right sides, column by column, by their solutions. On one core.
    pub(super) fn solve(&self, right: &mut [T]) {
        let mut column = vec![T::of(0.0); self.size];
        for side in right.chunks_exact_mut(self.size) {
            column.copy_from_slice(side);
            for (place, &row) in side.iter_mut().zip(&self.order) {
                *place = column[row];
            }
        }
        let sides = right.len() / self.size;
        let mut right = MatMut::from_column_major_slice_mut(right, self.size, sides);
        let both = MatRef::from_column_major_slice(&self.matrix, self.size, self.size);
        solve_unit_lower_triangular_in_place(both, right.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(both, right, Par::Seq);
    }
}

/// Factors the columns of `panel` from the row `start` on; answers which rows moved, as (to, from).
fn eliminate<T: Precision>(
    panel: &mut [T],
    size: usize,
    start: usize,
    width: usize,
) -> Vec<(usize, usize)> {
    let below = size - start;
    let mut forward = vec![0_usize; below];
    let mut backward = vec![0_usize; below];
    let needed = lu_in_place_scratch::<usize, T>(below, width, Par::Seq, Default::default());
    let mut scratch = MemBuffer::new(needed);
    lu_in_place(
        MatMut::from_column_major_slice_mut(panel, size, width).subrows_mut(start, below),
        &mut forward,
        &mut backward,
        Par::Seq,
        MemStack::new(&mut scratch),
        Default::default(),
    );
    let rows = forward.iter().enumerate();
    rows.filter(|(to, from)| to != *from)
        .map(|(to, from)| (start + to, start + from))
        .collect()
}

fn move_rows<T: Copy>(columns: &mut [T], size: usize, moved: &[(usize, usize)]) {
    let mut taken = Vec::with_capacity(moved.len());
    for column in columns.chunks_exact_mut(size) {
        taken.clear();
        taken.extend(moved.iter().map(|(_, from)| column[*from]));
        for ((to, _), value) in moved.iter().zip(&taken) {
            column[*to] = *value;
        }
    }
}

/// Takes the panel's multiples off the rows of a block to its right.
fn update<T: Precision>(block: &mut [T], panel: MatRef<'_, T>, start: usize) {
    let (size, width) = (panel.nrows(), panel.ncols());
    let columns = block.len() / size;
    let block = MatMut::from_column_major_slice_mut(block, size, columns);
    let (mut above, below) = block
        .subrows_mut(start, size - start)
        .split_at_row_mut(width);
    let (triangle, rest) = panel.subrows(start, size - start).split_at_row(width);
    solve_unit_lower_triangular_in_place(triangle, above.as_mut(), Par::Seq);
    let minus = T::of(-1.0);
    matmul(below, Accum::Add, rest, above.as_ref(), minus, Par::Seq);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the product. Wider than a panel and a block, so that all parts are met.
    #[test]
    fn solutions_solve() {
        let size = 2 * BLOCK + 77;
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
        };
        let matrix: Vec<f64> = (0..size * size).map(|_| random()).collect();
        let right: Vec<f64> = (0..2 * size).map(|_| random()).collect();
        let factors = Factors::new(size, matrix.clone(), &mut |_| ControlFlow::Continue(()));
        let ControlFlow::Continue(factors) = factors else {
            panic!("nobody cancelled");
        };
        let mut found = right.clone();
        factors.solve(&mut found);
        for (found, right) in found.chunks(size).zip(right.chunks(size)) {
            for row in 0..size {
                let sum: f64 = (0..size).map(|k| matrix[k * size + row] * found[k]).sum();
                // Rounding, times the condition of a random matrix.
                assert!((sum - right[row]).abs() < 1e-9, "{row}");
            }
        }
    }
}
