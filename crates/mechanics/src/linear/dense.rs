//! A square matrix, its factors and the scratch to make them, allocated once.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par};

/// A dense system of fixed size; factors replace the matrix.
pub(crate) struct DenseSystem {
    pub(crate) matrix: Mat<f64>,
    pub(crate) right: Mat<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    scratch: MemBuffer,
}

impl DenseSystem {
    pub(crate) fn new(size: usize, right_sides: usize) -> Self {
        let needed = StackReq::any_of(&[
            factor::lu_in_place_scratch::<usize, f64>(size, size, Par::Seq, Default::default()),
            solve::solve_in_place_scratch::<usize, f64>(size, right_sides, Par::Seq),
        ]);
        Self {
            matrix: Mat::zeros(size, size),
            right: Mat::zeros(size, right_sides),
            forward: vec![0; size],
            inverse: vec![0; size],
            scratch: MemBuffer::new(needed),
        }
    }

    pub(crate) fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.right.fill(0.0);
    }

    /// Replaces the right sides by the solutions. A singular matrix leaves values that are not
    /// finite; the caller checks.
    pub(crate) fn solve(&mut self) {
        let stack = MemStack::new(&mut self.scratch);
        factor::lu_in_place(
            self.matrix.as_mut(),
            &mut self.forward,
            &mut self.inverse,
            Par::Seq,
            stack,
            Default::default(),
        );
        let order = PermRef::new_checked(&self.forward, &self.inverse, self.forward.len());
        let right: MatMut<'_, f64> = self.right.as_mut();
        solve::solve_in_place(
            self.matrix.as_ref(),
            self.matrix.as_ref(),
            order,
            right,
            Par::Seq,
            stack,
        );
    }
}
