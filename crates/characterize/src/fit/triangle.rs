//! Linear least squares in place, and the damped step between bounds that is made from it.

use nalgebra::{DMatrix, DVectorView, DVectorViewMut};

/// Turns the first `columns` columns of `matrix` into an upper triangle by Householder's reflections,
/// which are applied to its other columns too. Below the triangle scratch is left.
pub(super) fn triangularize(matrix: &mut DMatrix<f64>, columns: usize) {
    let rows = matrix.nrows();
    for column in 0..columns.min(rows) {
        let (done, others) = matrix.as_mut_slice().split_at_mut((column + 1) * rows);
        let reflector = &mut done[column * rows + column..];
        let norm = DVectorView::from_slice(reflector, rows - column).norm();
        if norm == 0.0 {
            continue;
        }
        let diagonal = -norm.copysign(reflector[0]);
        reflector[0] -= diagonal;
        let factor = (diagonal * reflector[0]).recip();
        let along = DVectorView::from_slice(reflector, rows - column);
        for other in others.chunks_exact_mut(rows) {
            let part = &mut other[column..];
            let mut part = DVectorViewMut::from_slice(part, rows - column);
            let share = factor * along.dot(&part);
            part.axpy(share, &along, 1.0);
        }
        reflector[0] = diagonal;
    }
}

/// The `y` that makes |R y + q|² + μ |y|² least between the bounds of each entry, with `triangle` = [R q].
///
/// Entries beyond their bounds are fixed on them, the farthest first, and the others are solved again.
pub(super) fn bounded_step(triangle: &DMatrix<f64>, damping: f64, bounds: &[[f64; 2]]) -> Vec<f64> {
    let mut step = vec![0.0; bounds.len()];
    let mut fixed = vec![false; bounds.len()];
    loop {
        damped_step(triangle, damping, &fixed, &mut step);
        let beyond = |i: usize| (bounds[i][0] - step[i]).max(step[i] - bounds[i][1]);
        let farthest = (0..step.len())
            .filter(|&i| !fixed[i] && beyond(i) > 0.0)
            .max_by(|&i, &j| beyond(i).total_cmp(&beyond(j)));
        let Some(farthest) = farthest else {
            return step;
        };
        fixed[farthest] = true;
        step[farthest] = step[farthest].clamp(bounds[farthest][0], bounds[farthest][1]);
    }
}

/// Solves for the free entries, given the fixed ones.
fn damped_step(triangle: &DMatrix<f64>, damping: f64, fixed: &[bool], step: &mut [f64]) {
    let count = fixed.len();
    let free: Vec<usize> = (0..count).filter(|&i| !fixed[i]).collect();
    let mut system = DMatrix::zeros(count + free.len(), free.len() + 1);
    for (column, &i) in free.iter().enumerate() {
        system
            .view_mut((0, column), (count, 1))
            .copy_from(&triangle.view((0, i), (count, 1)));
        system[(count + column, column)] = damping.sqrt();
    }
    for row in 0..count {
        let moved: f64 = (0..count)
            .filter(|&i| fixed[i])
            .map(|i| triangle[(row, i)] * step[i])
            .sum();
        system[(row, free.len())] = triangle[(row, count)] + moved;
    }
    triangularize(&mut system, free.len());
    for column in (0..free.len()).rev() {
        let later: f64 = (column + 1..free.len())
            .map(|k| system[(column, k)] * step[free[k]])
            .sum();
        step[free[column]] = -(system[(column, free.len())] + later) / system[(column, column)];
    }
}
