//! Factors in single precision, through which one right side goes in a fraction of a millisecond and without an
//! allocation: a preconditioner, not a solution.

use std::ops::Range;

use super::Factors;

/// Sums that a product of two columns is added up in, so that they fit the registers of a processor.
const SUMS: usize = 8;

/// Columns that go through a vector together, which is then read and written once for all: those of a node.
const BLOCK: usize = 3;

/// K = L D Lᵀ in `f32`, supernode by supernode.
#[derive(Debug, Clone)]
pub(crate) struct SingleFactors {
    nodes: Vec<Node>,
    /// Rows of all supernodes below their triangles.
    rows: Vec<u32>,
    /// Columns of all supernodes, each the triangle's part and what is below.
    values: Vec<f32>,
    /// 1/D.
    inverse: Vec<f32>,
}

#[derive(Debug, Clone)]
struct Node {
    start: usize,
    columns: usize,
    rows: Range<usize>,
    values: Range<usize>,
}

impl SingleFactors {
    pub(crate) fn new(factors: &Factors) -> Self {
        let mut single = Self {
            nodes: Vec::new(),
            rows: Vec::new(),
            values: Vec::with_capacity(factors.entries()),
            inverse: Vec::new(),
        };
        for node in factors.supernodes() {
            let rows = single.rows.len()..single.rows.len() + node.rows.len();
            single.rows.extend(node.rows.iter().map(|&row| row as u32));
            let begin = single.values.len();
            for column in 0..node.top.ncols() {
                let top = node.top.col(column).iter();
                let below = node.bottom.col(column).iter();
                single
                    .values
                    .extend(top.chain(below).map(|&value| value as f32));
                single
                    .inverse
                    .push((1.0 / node.top[(column, column)]) as f32);
            }
            single.nodes.push(Node {
                start: node.start,
                columns: node.top.ncols(),
                rows,
                values: begin..single.values.len(),
            });
        }
        single
    }

    /// Numbers of scratch that [`Self::solve`] needs.
    pub(crate) fn scratch(&self) -> usize {
        let longest = self.nodes.iter().map(|node| node.rows.len()).max();
        longest.unwrap_or(0)
    }

    /// Replaces `x`, in the order of elimination, by K⁻¹ x.
    pub(crate) fn solve(&self, x: &mut [f32], scratch: &mut [f32]) {
        let factors = self;
        pulp::Arch::new().dispatch(Solve {
            factors,
            x,
            scratch,
        });
    }

    #[inline(always)]
    fn substitute(&self, x: &mut [f32], scratch: &mut [f32]) {
        for node in &self.nodes {
            let rows = &self.rows[node.rows.clone()];
            let below = &mut scratch[..rows.len()];
            below.fill(0.0);
            let own = &mut x[node.start..][..node.columns];
            let (blocks, end) = (node.columns / BLOCK, node.columns);
            for block in 0..blocks {
                self.columns::<BLOCK>(node, BLOCK * block)
                    .forward(own, below);
            }
            for column in BLOCK * blocks..end {
                self.columns::<1>(node, column).forward(own, below);
            }
            for (&row, below) in rows.iter().zip(&*below) {
                x[row as usize] -= below;
            }
        }
        for (x, inverse) in x.iter_mut().zip(&self.inverse) {
            *x *= inverse;
        }
        for node in self.nodes.iter().rev() {
            let rows = &self.rows[node.rows.clone()];
            let below = &mut scratch[..rows.len()];
            for (below, &row) in below.iter_mut().zip(rows) {
                *below = x[row as usize];
            }
            let own = &mut x[node.start..][..node.columns];
            let (blocks, end) = (node.columns / BLOCK, node.columns);
            for column in (BLOCK * blocks..end).rev() {
                self.columns::<1>(node, column).backward(own, below);
            }
            for block in (0..blocks).rev() {
                self.columns::<BLOCK>(node, BLOCK * block)
                    .backward(own, below);
            }
        }
    }

    /// Columns of a supernode, from its column `first` on.
    #[inline(always)]
    fn columns<const N: usize>(&self, node: &Node, first: usize) -> Columns<'_, N> {
        let height = node.columns + node.rows.len();
        let values = &self.values[node.values.clone()];
        let columns = std::array::from_fn(|k| &values[height * (first + k)..][first..height]);
        Columns {
            first,
            square: columns.map(|column: &[f32]| &column[..N]),
            top: columns.map(|column| &column[N..node.columns - first]),
            below: columns.map(|column| &column[node.columns - first..]),
        }
    }
}

/// Forward and back substitution, compiled for the vector instructions of the processor and apart from the rest of a step:
/// inlined there, the products of back substitution are compiled without those instructions.
struct Solve<'a> {
    factors: &'a SingleFactors,
    x: &'a mut [f32],
    scratch: &'a mut [f32],
}

impl pulp::WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.factors.substitute(self.x, self.scratch);
    }
}

/// Neighbouring columns of a supernode, which go through a vector together.
struct Columns<'a, const N: usize> {
    first: usize,
    /// Their rows of the triangle: between these columns, and below.
    square: [&'a [f32]; N],
    top: [&'a [f32]; N],
    below: [&'a [f32]; N],
}

impl<const N: usize> Columns<'_, N> {
    /// Their part of L⁻¹ in the supernode's `own` values; adds what is to be taken from the values `below`.
    #[inline(always)]
    fn forward(&self, own: &mut [f32], below: &mut [f32]) {
        let (own, top) = own[self.first..].split_at_mut(N);
        let mut values = [0.0; N];
        for j in 0..N {
            let before: f32 = (0..j).map(|k| self.square[k][j] * values[k]).sum();
            values[j] = own[j] - before;
        }
        own.copy_from_slice(&values);
        add_scaled(below, &values, &self.below);
        add_scaled(top, &values.map(|value| -value), &self.top);
    }

    /// Their part of L⁻ᵀ.
    #[inline(always)]
    fn backward(&self, own: &mut [f32], below: &[f32]) {
        let (own, top) = own[self.first..].split_at_mut(N);
        let (of_top, of_below) = (products(&self.top, top), products(&self.below, below));
        for j in (0..N).rev() {
            let after: f32 = (j + 1..N).map(|k| self.square[j][k] * own[k]).sum();
            own[j] -= after + of_top[j] + of_below[j];
        }
    }
}

/// y ← y + Σ a x.
#[inline(always)]
pub(crate) fn add_scaled<const N: usize>(y: &mut [f32], a: &[f32; N], x: &[&[f32]; N]) {
    let x = x.map(|x| &x[..y.len()]);
    for (i, y) in y.iter_mut().enumerate() {
        for k in 0..N {
            *y += a[k] * x[k][i];
        }
    }
}

/// xᵀ y of each x.
#[inline(always)]
fn products<const N: usize>(x: &[&[f32]; N], y: &[f32]) -> [f32; N] {
    let mut sums = [[0.0; SUMS]; N];
    let (many, rest) = y.as_chunks::<SUMS>();
    let chunks = x.map(|x| &x.as_chunks::<SUMS>().0[..many.len()]);
    for (i, y) in many.iter().enumerate() {
        for k in 0..N {
            for (sum, (x, y)) in sums[k].iter_mut().zip(chunks[k][i].iter().zip(y)) {
                *sum += x * y;
            }
        }
    }
    std::array::from_fn(|k| {
        let last = &x[k][SUMS * many.len()..];
        let tail: f32 = last.iter().zip(rest).map(|(x, y)| x * y).sum();
        sums[k].iter().sum::<f32>() + tail
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::sparse::Pattern;

    /// A cube of nodes with three unknowns each, but one in the last, which all couple with those of the neighbouring
    /// nodes: against the factors in `f64`. There are supernodes of many blocks, and one with a column left over.
    #[test]
    fn a_solution_agrees_with_the_factors_in_double_precision() {
        let (side, axes) = (6_u32, 3);
        let place = |node: u32| [node % side, node / side % side, node / side / side];
        let are_near = |a: u32, b: u32| {
            let pairs = place(a).into_iter().zip(place(b));
            pairs.map(|(a, b)| a.abs_diff(b)).sum::<u32>() <= 1
        };
        let size = axes * side.pow(3) - 2;
        let all = (0..size).flat_map(|column| (column..size).map(move |row| (column, row)));
        let entries = all
            .filter(|&(column, row)| are_near(column / axes, row / axes))
            .collect();
        let pattern = Pattern::new(size as usize, entries);
        let value = |column: usize, row: usize| {
            // Larger than the sum of at most twenty others, each at most one.
            if column == row {
                22.0
            } else {
                ((column + 7 * row) as f64).sin()
            }
        };
        let columns = 0..pattern.size();
        let values: Vec<f64> = columns
            .flat_map(|column| pattern.rows(column).iter().map(move |&row| (column, row)))
            .map(|(column, row)| value(column, row))
            .collect();
        let mut factors = Factors::new(&pattern).unwrap();
        factors.factor(&pattern, &values).unwrap();
        let mut exact: Vec<f64> = (0..pattern.size()).map(|i| (i as f64).cos()).collect();
        let mut x: Vec<f32> = exact.iter().map(|&value| value as f32).collect();
        factors.solve_many(&mut exact, 1);
        let single = SingleFactors::new(&factors);
        let widths = single.nodes.iter().map(|node| node.columns);
        assert!(widths.clone().any(|width| width % BLOCK != 0) && widths.max() > Some(2 * BLOCK));
        single.solve(&mut x, &mut vec![f32::NAN; single.scratch()]);
        let largest = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (x, exact) in x.iter().zip(&exact) {
            // Some hundred products a number, each rounded to half of 1.2e-7, in a matrix of condition below 20.
            assert!(
                (f64::from(*x) - exact).abs() < 1e-5 * largest,
                "{x} {exact}"
            );
        }
    }
}
