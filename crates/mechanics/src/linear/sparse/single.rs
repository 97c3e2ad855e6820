//! Factors in single precision, through which one right side goes in a fraction of a millisecond and without an
//! allocation: a preconditioner, not a solution.

use std::ops::Range;

use super::Factors;

/// Sums that a product of two columns is added up in, so that they fit the registers of a processor.
const SUMS: usize = 8;

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
    #[inline(always)]
    pub(crate) fn solve(&self, x: &mut [f32], scratch: &mut [f32]) {
        for node in &self.nodes {
            let rows = &self.rows[node.rows.clone()];
            let below = &mut scratch[..rows.len()];
            below.fill(0.0);
            for (j, column) in self.columns(node).enumerate() {
                let at = node.start + j;
                let value = x[at];
                let top = &mut x[at + 1..node.start + node.columns];
                subtract(top, value, &column[j + 1..node.columns]);
                subtract(below, value, &column[node.columns..]);
            }
            for (&row, below) in rows.iter().zip(&*below) {
                x[row as usize] += below;
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
            for (j, column) in self.columns(node).enumerate().rev() {
                let (head, tail) = x.split_at_mut(node.start + j + 1);
                let top = product(&column[j + 1..node.columns], &tail[..node.columns - j - 1]);
                head[node.start + j] -= top + product(&column[node.columns..], below);
            }
        }
    }

    #[inline(always)]
    fn columns(&self, node: &Node) -> std::slice::ChunksExact<'_, f32> {
        self.values[node.values.clone()].chunks_exact(node.columns + node.rows.len())
    }
}

/// y ← y − a x.
#[inline(always)]
fn subtract(y: &mut [f32], a: f32, x: &[f32]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y -= a * x;
    }
}

/// xᵀ y.
#[inline(always)]
fn product(x: &[f32], y: &[f32]) -> f32 {
    let mut sums = [0.0; SUMS];
    let (many, rest) = x.as_chunks::<SUMS>();
    let (others, last) = y.as_chunks::<SUMS>();
    for (x, y) in many.iter().zip(others) {
        for (sum, (x, y)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum += x * y;
        }
    }
    let tail: f32 = rest.iter().zip(last).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f32>() + tail
}
