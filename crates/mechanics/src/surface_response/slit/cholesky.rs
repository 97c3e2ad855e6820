/// A symmetric positive matrix that grows by rows, and its factor L.
#[derive(Debug)]
pub(super) struct Grown {
    /// Lower triangles, row after row.
    matrix: Vec<f64>,
    factor: Vec<f64>,
    rows: usize,
}

/// A row whose pivot is below this part of what its facet alone would have is locked [-]: H does not tell its jump
/// from those before it, as where a slit is cut again. Of a long straight slit pivots are 0.2 and more.
const LEAST_PIVOT: f64 = 0.1;

fn start(row: usize) -> usize {
    row * (row + 1) / 2
}

impl Grown {
    pub(super) fn new(most: usize) -> Self {
        Self {
            matrix: vec![0.0; start(most)],
            factor: vec![0.0; start(most)],
            rows: 0,
        }
    }

    /// The entries of a row up to its diagonal, to be written before [`Self::factor`].
    pub(super) fn row(&mut self, row: usize) -> &mut [f64] {
        &mut self.matrix[start(row)..=start(row) + row]
    }

    /// Makes the factor of a row, whose diagonal is raised by `more` and whose pivot would be `alone` without those
    /// of other facets; those above it are made. Whether it is not locked.
    pub(super) fn factor(&mut self, row: usize, (more, alone): (f64, f64)) -> bool {
        let (above, here) = self.factor.split_at_mut(start(row));
        let here = &mut here[..=row];
        here.copy_from_slice(&self.matrix[start(row)..=start(row) + row]);
        here[row] += more;
        let diagonal = here[row];
        for column in 0..row {
            let other = &above[start(column)..=start(column) + column];
            let known = dot(&here[..column], &other[..column]);
            here[column] = (here[column] - known) / other[column];
        }
        let known = dot(&here[..row], &here[..row]);
        let pivot = diagonal - known;
        self.rows = row + 1;
        let sound = pivot >= LEAST_PIVOT * alone && pivot > 0.0;
        if sound {
            here[row] = pivot.sqrt();
        } else {
            here.fill(0.0);
            here[row] = f64::INFINITY;
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (fours_a, fours_b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = fours_a
        .remainder()
        .iter()
        .zip(fours_b.remainder())
        .map(|(a, b)| a * b)
        .sum();
    let mut sums = [0.0; 4];
    for (a, b) in fours_a.zip(fours_b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    rest + (sums[0] + sums[1]) + (sums[2] + sums[3])
}
