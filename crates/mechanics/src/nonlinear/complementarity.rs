//! The complementarity problem of tool forces and unilateral contacts.
//!
//! ```text
//! w = S x + q,   w = 0 in bilateral rows,   x ≥ 0, w ≥ 0, x w = 0 in unilateral rows,   x = 0 in open rows
//! ```
//!
//! with S symmetric and positive: the active contacts are found by block principal pivoting, which goes over to single
//! pivots where the blocks do not help, and so ends [Portugal, Júdice and Vicente 1994]. Nothing is allocated.

/// Exchanges of blocks that may pass without progress.
const PATIENCE: u32 = 3;

/// Solutions to try: a handful is the rule, and single pivots may need more than a step has time for.
const MAX_SOLUTIONS: usize = 50;

/// Tolerance of zero, over the largest entry [-].
const ZERO: f64 = 1e-9;

/// The condition of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// w = 0.
    Bilateral,
    /// x ≥ 0, w ≥ 0, x w = 0.
    Unilateral,
    /// x = 0.
    Open,
}

/// The problem, its solution and the factors of its active part.
#[derive(Debug, Clone)]
pub(super) struct Complementarity {
    /// S, row by row, `room` in each.
    matrix: Vec<f64>,
    pub(super) q: Vec<f64>,
    pub(super) x: Vec<f64>,
    pub(super) kinds: Vec<Kind>,
    pub(super) active: Vec<bool>,
    is_infeasible: Vec<bool>,
    /// The active rows, and S of these = L Lᵀ.
    free: Vec<usize>,
    factor: Vec<f64>,
    right: Vec<f64>,
    room: usize,
}

impl Complementarity {
    pub(super) fn new(room: usize) -> Self {
        Self {
            matrix: vec![0.0; room * room],
            q: vec![0.0; room],
            x: vec![0.0; room],
            kinds: vec![Kind::Unilateral; room],
            active: vec![false; room],
            is_infeasible: vec![false; room],
            free: Vec::with_capacity(room),
            factor: vec![0.0; room * room],
            right: vec![0.0; room],
            room,
        }
    }

    pub(super) fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.matrix[row * self.room + column]
    }

    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        self.matrix[row * self.room + column]
    }

    /// Solves for the first `count` rows; `active` is where the unilateral ones begin. Returns whether it was solved; if
    /// not, the result is the last trial without tensile forces, or zero where S is not positive.
    pub(super) fn solve(&mut self, count: usize) -> bool {
        for (active, kind) in self.active.iter_mut().zip(&self.kinds[..count]) {
            match kind {
                Kind::Bilateral => *active = true,
                Kind::Unilateral => {}
                Kind::Open => *active = false,
            }
        }
        let (mut fewest, mut patience) = (count + 1, PATIENCE);
        for _ in 0..MAX_SOLUTIONS {
            if !self.factor(count) {
                self.x[..count].fill(0.0);
                return false;
            }
            self.x[..count].fill(0.0);
            for (k, &row) in self.free.iter().enumerate() {
                self.right[k] = -self.q[row];
            }
            self.substitute();
            for (k, &row) in self.free.iter().enumerate() {
                self.x[row] = self.right[k];
            }
            let (number, last) = self.infeasible(count);
            if number == 0 {
                return true;
            }
            if number < fewest {
                (fewest, patience) = (number, PATIENCE);
            } else if patience > 0 {
                patience -= 1;
            } else {
                self.active[last] = !self.active[last];
                continue;
            }
            for row in 0..count {
                self.is_infeasible[row] = self.violates(row, count);
            }
            for (active, is_infeasible) in self.active[..count].iter_mut().zip(&self.is_infeasible)
            {
                *active ^= is_infeasible;
            }
        }
        for (x, kind) in self.x.iter_mut().zip(&self.kinds[..count]) {
            if *kind == Kind::Unilateral {
                *x = x.max(0.0);
            }
        }
        false
    }

    /// Solves S t = `right` in the active rows, which are those of the last [`Self::solve`]; zero in the others.
    pub(super) fn solve_active(&mut self, right: &[f64], t: &mut [f64]) {
        for (k, &row) in self.free.iter().enumerate() {
            self.right[k] = right[row];
        }
        self.substitute();
        t.fill(0.0);
        for (k, &row) in self.free.iter().enumerate() {
            t[row] = self.right[k];
        }
    }

    /// Whether [`Self::solve_active`] has an answer in this row, other than zero.
    pub(super) fn is_free(&self, row: usize) -> bool {
        self.free.binary_search(&row).is_ok()
    }

    /// How many rows are infeasible, and the last of them.
    fn infeasible(&self, count: usize) -> (usize, usize) {
        let (mut number, mut last) = (0, 0);
        for row in 0..count {
            if self.violates(row, count) {
                (number, last) = (number + 1, row);
            }
        }
        (number, last)
    }

    /// w of a row of the first `count`.
    pub(super) fn left(&self, row: usize, count: usize) -> f64 {
        let entries = &self.matrix[row * self.room..][..count];
        let sum: f64 = entries.iter().zip(&self.x).map(|(s, x)| s * x).sum();
        sum + self.q[row]
    }

    /// Makes w of a row zero by its own x.
    pub(super) fn relax(&mut self, row: usize, count: usize) {
        self.x[row] -= self.left(row, count) / self.get(row, row);
    }

    /// Takes a step that makes w of two rows smaller by their own x, which begin at `first`.
    pub(super) fn relax_pair(&mut self, first: usize, count: usize) {
        let second = first + 1;
        let own = self.get(first, first).max(self.get(second, second));
        let size = own + self.get(first, second).abs();
        let left = [first, second].map(|row| self.left(row, count));
        self.x[first] -= left[0] / size;
        self.x[second] -= left[1] / size;
    }

    fn violates(&self, row: usize, count: usize) -> bool {
        if self.kinds[row] != Kind::Unilateral {
            return false;
        }
        let zero = |values: &[f64]| {
            let largest = values[..count]
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            -ZERO * largest
        };
        if self.active[row] {
            self.x[row] < zero(&self.x)
        } else {
            self.left(row, count) < zero(&self.q)
        }
    }

    /// Cholesky's factors of the active rows; whether they are positive.
    fn factor(&mut self, count: usize) -> bool {
        let Self { free, active, .. } = self;
        free.clear();
        free.extend((0..count).filter(|&row| active[row]));
        let size = free.len();
        for i in 0..size {
            for j in 0..=i {
                let mut sum = self.matrix[free[i] * self.room + free[j]];
                for k in 0..j {
                    sum -= self.factor[i * self.room + k] * self.factor[j * self.room + k];
                }
                if i != j {
                    self.factor[i * self.room + j] = sum / self.factor[j * self.room + j];
                } else if sum > 0.0 {
                    self.factor[i * self.room + i] = sum.sqrt();
                } else {
                    free.clear();
                    return false;
                }
            }
        }
        true
    }

    /// `right` becomes (L Lᵀ)⁻¹ `right`.
    fn substitute(&mut self) {
        let size = self.free.len();
        let (l, room, right) = (&self.factor, self.room, &mut self.right);
        for i in 0..size {
            let sum: f64 = (0..i).map(|k| l[i * room + k] * right[k]).sum();
            right[i] = (right[i] - sum) / l[i * room + i];
        }
        for i in (0..size).rev() {
            let sum: f64 = (i + 1..size).map(|k| l[k * room + i] * right[k]).sum();
            right[i] = (right[i] - sum) / l[i * room + i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Complementarity, Kind};

    /// A number in [-1, 1) of a linear congruential sequence.
    fn draw(state: &mut u64) -> f64 {
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Judge: the conditions themselves, of random positive matrices; from any beginning there is one solution.
    #[test]
    fn random_problems_meet_their_conditions() {
        let mut random = 1;
        for count in [1, 2, 5, 20, 60] {
            for trial in 0..20 {
                let tools = count.min(trial % 7);
                let mut problem = Complementarity::new(64);
                problem.kinds[..tools].fill(Kind::Bilateral);
                let root: Vec<f64> = (0..count * count).map(|_| draw(&mut random)).collect();
                for i in 0..count {
                    for j in 0..count {
                        let sum: f64 = (0..count)
                            .map(|k| root[i * count + k] * root[j * count + k])
                            .sum();
                        *problem.at(i, j) = sum + if i == j { 0.01 } else { 0.0 };
                    }
                    problem.q[i] = draw(&mut random);
                    problem.active[i] = draw(&mut random) > 0.0;
                }
                assert!(problem.solve(count));
                for i in 0..count {
                    let w: f64 = (0..count).map(|j| *problem.at(i, j) * problem.x[j]).sum();
                    let (w, x) = (w + problem.q[i], problem.x[i]);
                    let good = match i < tools {
                        true => w.abs() < 1e-7,
                        false => x > -1e-6 && w > -1e-6 && (x * w).abs() < 1e-5,
                    };
                    assert!(good, "{count} rows, {trial}, row {i}: x {x}, w {w}");
                }
            }
        }
    }
}
