//! Many right sides at once: their rows are processed together, so that a factor is read once for all,
//! and rows that are zero in all of them are skipped.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_unit_upper_triangular_in_place,
};
use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;
use faer::{Accum, MatMut, MatRef, Par};

use super::Factors;

/// Columns of L that have their rows in common.
pub(super) struct Supernode<'a> {
    pub(super) start: usize,
    /// Unit lower triangle, D on its diagonal.
    pub(super) top: MatRef<'a, f64>,
    pub(super) bottom: MatRef<'a, f64>,
    /// Rows of `bottom`.
    pub(super) rows: &'a [usize],
}

impl Factors {
    /// Place of each unknown in the order of elimination.
    pub(crate) fn places(&self) -> Vec<usize> {
        let size = self.symbolic.nrows();
        let order = self.symbolic.perm();
        order.map_or((0..size).collect(), |order| order.arrays().1.to_vec())
    }

    /// Replaces right sides by their solutions, `width` of them: number `width` · i + k is that of the
    /// k-th one at place i of the order of elimination. On one core.
    pub(crate) fn solve_many(&self, sides: &mut [f64], width: usize) {
        let nodes = self.supernodes();
        let longest = nodes.iter().map(|node| node.rows.len()).max().unwrap_or(0);
        let mut scratch = vec![0.0; longest * width];
        for node in &nodes {
            node.forward(sides, width, &mut scratch);
        }
        for node in nodes.iter().rev() {
            node.backward(sides, width, &mut scratch);
        }
    }

    pub(super) fn supernodes(&self) -> Vec<Supernode<'_>> {
        let SymbolicCholeskyRaw::Supernodal(nodes) = self.symbolic.raw() else {
            unreachable!("supernodal factors were asked for");
        };
        let values = nodes.col_ptr_for_val();
        (0..nodes.n_supernodes())
            .map(|s| {
                let (start, rows) = (nodes.supernode_begin()[s], nodes.supernode(s).pattern());
                let columns = nodes.supernode_end()[s] - start;
                let part = &self.values[values[s]..values[s + 1]];
                let height = columns + rows.len();
                let (top, bottom) =
                    MatRef::from_column_major_slice(part, height, columns).split_at_row(columns);
                Supernode {
                    start,
                    top,
                    bottom,
                    rows,
                }
            })
            .collect()
    }
}

impl Supernode<'_> {
    /// Its part of L⁻¹.
    fn forward(&self, sides: &mut [f64], width: usize, scratch: &mut [f64]) {
        let head = self.head(sides, width);
        if head.iter().all(|value| *value == 0.0) {
            return;
        }
        let mut head = MatMut::from_row_major_slice_mut(head, self.top.ncols(), width);
        solve_unit_lower_triangular_in_place(self.top, head.as_mut(), Par::Seq);
        let tail = &mut scratch[..self.rows.len() * width];
        let product = MatMut::from_row_major_slice_mut(tail, self.rows.len(), width);
        matmul(
            product,
            Accum::Replace,
            self.bottom,
            head.as_ref(),
            1.0,
            Par::Seq,
        );
        for (&row, tail) in self.rows.iter().zip(tail.chunks_exact(width)) {
            for (value, less) in sides[row * width..][..width].iter_mut().zip(tail) {
                *value -= less;
            }
        }
    }

    /// Its part of L⁻ᵀ D⁻¹.
    fn backward(&self, sides: &mut [f64], width: usize, scratch: &mut [f64]) {
        let tail = &mut scratch[..self.rows.len() * width];
        for (&row, tail) in self.rows.iter().zip(tail.chunks_exact_mut(width)) {
            tail.copy_from_slice(&sides[row * width..][..width]);
        }
        let head = self.head(sides, width);
        for (column, values) in head.chunks_exact_mut(width).enumerate() {
            let inverse = 1.0 / self.top[(column, column)];
            for value in values {
                *value *= inverse;
            }
        }
        let mut head = MatMut::from_row_major_slice_mut(head, self.top.ncols(), width);
        let tail = MatRef::from_row_major_slice(tail, self.rows.len(), width);
        let below = self.bottom.transpose();
        matmul(head.as_mut(), Accum::Add, below, tail, -1.0, Par::Seq);
        solve_unit_upper_triangular_in_place(self.top.transpose(), head, Par::Seq);
    }

    fn head<'s>(&self, sides: &'s mut [f64], width: usize) -> &'s mut [f64] {
        &mut sides[self.start * width..][..self.top.ncols() * width]
    }
}
