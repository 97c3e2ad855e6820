//! A symmetric positive matrix that grows by blocks of rows, one for each facet, and its factor L.

use super::traction::MODES;

/// The matrix in factors. The last block's diagonal may change, for it keeps its Schur complement.
#[derive(Debug)]
pub(super) struct GrowingCholesky {
    /// Rows of L, lower triangles one after the other.
    factor: Vec<f64>,
    rows: usize,
    /// The rows of a new block, column by column.
    new: Vec<[f64; MODES]>,
}

/// The rows of a block without the blocks before it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// H − L Lᵀ of the columns before it.
    rest: [[f64; MODES]; MODES],
    /// Pivots that it would have alone.
    pub(super) alone: [f64; MODES],
}

/// A row whose pivot is below this part of what its facet alone would have is locked [-]: H does not distinguish
/// its jump from those before it, as where a slit is cut again. Of a long straight slit pivots are 0.2 and more.
const MIN_PIVOT: f64 = 0.1;

fn start(row: usize) -> usize {
    row * (row + 1) / 2
}

impl GrowingCholesky {
    pub(super) fn new(most: usize) -> Self {
        Self {
            factor: vec![0.0; start(most)],
            rows: 0,
            new: vec![[0.0; MODES]; most],
        }
    }

    /// The entries of new rows, column by column, to be written before [`Self::eliminate`].
    pub(super) fn new_columns(&mut self) -> &mut [[f64; MODES]] {
        &mut self.new
    }

    /// Eliminates the earlier rows from new rows.
    pub(super) fn eliminate(&mut self, rows: std::ops::Range<usize>, alone: [f64; MODES]) -> Block {
        let (first, count) = (rows.start, rows.len());
        let (above, below) = self.factor.split_at_mut(start(first));
        for column in 0..first {
            let other = &above[start(column)..=start(column) + column];
            let known = products(&other[..column], &self.new[..column]);
            for (value, known) in self.new[column].iter_mut().zip(known) {
                *value = (*value - known) / other[column];
            }
        }
        let mut rest = [[0.0; MODES]; MODES];
        for i in 0..count {
            for j in 0..=i {
                let known: f64 = self.new[..first].iter().map(|row| row[i] * row[j]).sum();
                rest[i][j] = self.new[first + j][i] - known;
            }
        }
        for mode in 0..count {
            let own = start(first + mode) - start(first);
            let row = &mut below[own..][..first];
            for (value, new) in row.iter_mut().zip(&self.new) {
                *value = new[mode];
            }
        }
        Block { rest, alone }
    }

    /// Makes the factor of a block's own columns, its diagonal raised by `more`. Whether no row is locked.
    pub(super) fn factor(
        &mut self,
        rows: std::ops::Range<usize>,
        block: &Block,
        more: &[f64; MODES],
    ) -> bool {
        let (first, count) = (rows.start, rows.len());
        self.rows = rows.end;
        let mut sound = true;
        let mut l = [[0.0; MODES]; MODES];
        for i in 0..count {
            for j in 0..i {
                let known: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
                l[i][j] = (block.rest[i][j] - known) / l[j][j];
            }
            let known: f64 = (0..i).map(|k| l[i][k] * l[i][k]).sum();
            let pivot = block.rest[i][i] + more[i] - known;
            if pivot >= MIN_PIVOT * block.alone[i] && pivot > 0.0 {
                l[i][i] = pivot.sqrt();
            } else {
                // It bears nothing, whatever stands before its diagonal.
                l[i] = [0.0; MODES];
                l[i][i] = f64::INFINITY;
                sound = false;
            }
            let own = start(first + i) + first;
            self.factor[own..=own + i].copy_from_slice(&l[i][..=i]);
        }
        sound
    }

    /// Leaves the first rows.
    pub(super) fn truncate(&mut self, rows: usize) {
        self.rows = self.rows.min(rows);
    }

    /// Replaces three right sides by L⁻¹ of them.
    pub(super) fn forward(&self, sides: &mut [crate::Vec3]) {
        for row in 0..self.rows {
            let here = &self.factor[start(row)..=start(row) + row];
            let (known, rest) = sides.split_at_mut(row);
            let mut side = rest[0];
            for (factor, known) in here.iter().zip(known.iter()) {
                side -= known * *factor;
            }
            rest[0] = side / here[row];
        }
    }

    /// Replaces a right side by L⁻ᵀ of it.
    pub(super) fn backward(&self, side: &mut [f64]) {
        for row in (0..self.rows).rev() {
            let here = &self.factor[start(row)..=start(row) + row];
            let (rest, value) = side.split_at_mut(row);
            value[0] /= here[row];
            for (factor, rest) in here.iter().zip(rest) {
                *rest -= factor * value[0];
            }
        }
    }
}

/// Sums of a row of L times each new row; in two halves, which do not depend on each other.
fn products(row: &[f64], new: &[[f64; MODES]]) -> [f64; MODES] {
    let mut sums = [[0.0; MODES]; 2];
    let (pairs, news) = (row.chunks_exact(2), new.chunks_exact(2));
    if let ([factor], [new]) = (pairs.remainder(), news.remainder()) {
        sums[0] = new.map(|value| factor * value);
    }
    for (factors, news) in pairs.zip(news) {
        for half in 0..2 {
            for mode in 0..MODES {
                sums[half][mode] += factors[half] * news[half][mode];
            }
        }
    }
    std::array::from_fn(|mode| sums[0][mode] + sums[1][mode])
}
