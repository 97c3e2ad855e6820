//! Factors in 16 bits, through which one right side goes in a fraction of a millisecond and without an allocation: a
//! preconditioner, not a solution. Reading the factors is what takes time.

use std::ops::Range;

use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;

use super::Factors;

/// Rows of a column that lie side by side in memory.
const ROWS: usize = 16;

/// Columns that go through a vector together, which is then read and written once for all: those of a node.
const BLOCK: usize = 3;

/// [`ROWS`] entries of a column over its scale, raised by [`RAISED`]: the first half of them in the lower halves of the
/// words.
type Tile = [u32; ROWS / 2];

/// What makes an entry positive.
const RAISED: u16 = 1 << 15;

/// The bits of 2²³ as an `f32`, whose last bits are the units: with an entry in their place they are its value and 2²³.
const UNITS: u32 = 0x4B00_0000;

/// K = L D Lᵀ, supernode by supernode.
#[derive(Debug, Clone)]
pub(crate) struct SmallFactors {
    nodes: Vec<Supernode>,
    /// Rows of all supernodes below their triangles.
    rows: Vec<u32>,
    blocks: Vec<Block>,
    /// Tiles of all blocks, those of their columns one after the other: both ways through them go along the memory.
    tiles: Vec<Tile>,
    /// The squares of all blocks on the diagonal of L, column by column, where it is below that.
    squares: Vec<f32>,
    /// Scale of each column: its entries are at most [`i16::MAX`] of it.
    scales: Vec<f32>,
    /// 1/D.
    inverse: Vec<f32>,
}

#[derive(Debug, Clone)]
struct Supernode {
    start: usize,
    columns: usize,
    /// Below the triangle.
    rows: Range<usize>,
    blocks: Range<usize>,
}

impl Supernode {
    fn height(&self) -> usize {
        self.columns + self.rows.len()
    }
}

/// Neighbouring columns of a supernode: three, or one.
#[derive(Debug, Clone)]
struct Block {
    /// Its first column in the supernode.
    first: usize,
    columns: usize,
    /// Where it has entries below its square, in tiles.
    reach: Range<usize>,
    tiles: Range<usize>,
    square: Range<usize>,
}

/// Columns of the block that begins at column `first` of a supernode of so many.
fn block(first: usize, columns: usize) -> Range<usize> {
    let width = if first + BLOCK <= columns { BLOCK } else { 1 };
    first..first + width
}

/// Scale of a column whose entries below its square are these.
fn scale(entries: impl Iterator<Item = f64>) -> f64 {
    let largest = entries.fold(0.0_f64, |most, entry| most.max(entry.abs()));
    largest.max(f64::from(f32::MIN_POSITIVE)) / f64::from(i16::MAX)
}

impl Factors {
    /// Rounds L to what [`SmallFactors`] keep of it, so that both have the same solutions.
    pub(crate) fn round(&mut self) {
        let SymbolicCholeskyRaw::Supernodal(nodes) = self.symbolic.raw() else {
            unreachable!("supernodal factors were asked for");
        };
        let starts = nodes.col_ptr_for_val();
        for s in 0..nodes.n_supernodes() {
            let columns = nodes.supernode_end()[s] - nodes.supernode_begin()[s];
            let height = columns + nodes.supernode(s).pattern().len();
            let values = &mut self.values[starts[s]..starts[s + 1]];
            let mut first = 0;
            while first < columns {
                let block = block(first, columns);
                first = block.end;
                for column in block.clone() {
                    let entries = &mut values[height * column..][block.end..height];
                    let scale = scale(entries.iter().copied());
                    for entry in entries {
                        *entry = (*entry / scale).round() * scale;
                    }
                }
            }
        }
    }
}

impl SmallFactors {
    pub(crate) fn new(factors: &Factors) -> Self {
        let mut small = Self {
            nodes: Vec::new(),
            rows: Vec::new(),
            blocks: Vec::new(),
            tiles: Vec::with_capacity(factors.entries() / ROWS),
            squares: Vec::new(),
            scales: Vec::new(),
            inverse: Vec::new(),
        };
        for node in factors.supernodes() {
            let columns = node.top.ncols();
            let (rows, blocks) = (small.rows.len(), small.blocks.len());
            small.rows.extend(node.rows.iter().map(|&row| row as u32));
            let height = columns + node.rows.len();
            let entry = |row: usize, column: usize| match row.checked_sub(columns) {
                None => node.top[(row, column)],
                Some(below) if row < height => node.bottom[(below, column)],
                Some(_) => 0.0,
            };
            let mut first = 0;
            while first < columns {
                let block = block(first, columns);
                first = block.end;
                small.put_block(block, height, entry);
            }
            let diagonal = (0..columns).map(|k| (1.0 / node.top[(k, k)]) as f32);
            small.inverse.extend(diagonal);
            small.nodes.push(Supernode {
                start: node.start,
                columns,
                rows: rows..small.rows.len(),
                blocks: blocks..small.blocks.len(),
            });
        }
        small
    }

    fn put_block(
        &mut self,
        columns: Range<usize>,
        height: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) {
        let below = columns.end;
        let scales = columns
            .clone()
            .map(|column| scale((below..height).map(|row| entry(row, column))));
        let reach = below / ROWS..height.div_ceil(ROWS);
        let (tiles, square) = (self.tiles.len(), self.squares.len());
        for tile in reach.clone() {
            for (column, scale) in columns.clone().zip(scales.clone()) {
                let raised = |row: usize| {
                    let value = if row < below { 0.0 } else { entry(row, column) };
                    ((value / scale).round() as i16 as u16).wrapping_add(RAISED)
                };
                let row = ROWS * tile;
                self.tiles.push(std::array::from_fn(|i| {
                    let halves = [raised(row + i), raised(row + ROWS / 2 + i)].map(u32::from);
                    halves[0] | (halves[1] << 16)
                }));
            }
        }
        for column in columns.clone() {
            let rows = columns.clone().map(|row| {
                if row > column {
                    entry(row, column)
                } else {
                    0.0
                }
            });
            self.squares.extend(rows.map(|value| value as f32));
        }
        self.scales.extend(scales.map(|scale| scale as f32));
        self.blocks.push(Block {
            first: columns.start,
            columns: columns.len(),
            reach,
            tiles: tiles..self.tiles.len(),
            square: square..self.squares.len(),
        });
    }

    /// Numbers of scratch that [`Self::solve`] needs.
    pub(crate) fn scratch(&self) -> usize {
        let tallest = self.nodes.iter().map(Supernode::height).max();
        tallest.unwrap_or(0).next_multiple_of(ROWS)
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
    fn substitute<S: pulp::Simd>(&self, simd: S, x: &mut [f32], scratch: &mut [f32]) {
        for node in &self.nodes {
            let (values, rows) = self.begin(node, scratch);
            let (own, below) = values.split_at_mut(node.columns);
            own.copy_from_slice(&x[node.start..][..node.columns]);
            below.fill(0.0);
            for block in &self.blocks[node.blocks.clone()] {
                match block.columns {
                    BLOCK => self.columns::<BLOCK>(node, block).forward(simd, values),
                    _ => self.columns::<1>(node, block).forward(simd, values),
                }
            }
            let (own, below) = values.split_at(node.columns);
            x[node.start..][..node.columns].copy_from_slice(own);
            for (&row, below) in rows.iter().zip(below) {
                x[row as usize] += below;
            }
        }
        for (x, inverse) in x.iter_mut().zip(&self.inverse) {
            *x *= inverse;
        }
        for node in self.nodes.iter().rev() {
            let (values, rows) = self.begin(node, scratch);
            let (own, below) = values.split_at_mut(node.columns);
            own.copy_from_slice(&x[node.start..][..node.columns]);
            let (below, rest) = below.split_at_mut(rows.len());
            for (below, &row) in below.iter_mut().zip(rows) {
                *below = x[row as usize];
            }
            rest.fill(0.0);
            for block in self.blocks[node.blocks.clone()].iter().rev() {
                match block.columns {
                    BLOCK => self.columns::<BLOCK>(node, block).backward(simd, values),
                    _ => self.columns::<1>(node, block).backward(simd, values),
                }
            }
            x[node.start..][..node.columns].copy_from_slice(&values[..node.columns]);
        }
    }

    /// Scratch for all rows of a supernode, whole tiles, and which rows are below its triangle.
    #[inline(always)]
    fn begin<'a>(&self, node: &Supernode, scratch: &'a mut [f32]) -> (&'a mut [f32], &[u32]) {
        let size = node.height().next_multiple_of(ROWS);
        (&mut scratch[..size], &self.rows[node.rows.clone()])
    }

    #[inline(always)]
    fn columns<const N: usize>(&self, node: &Supernode, block: &Block) -> Columns<'_, N> {
        let scales = &self.scales[node.start + block.first..];
        Columns {
            first: block.first,
            below: ROWS * block.reach.start..ROWS * block.reach.end,
            tiles: self.tiles[block.tiles.clone()].as_chunks().0,
            square: self.squares[block.square.clone()].as_chunks().0,
            scales: std::array::from_fn(|k| scales[k]),
        }
    }
}

/// Forward and back substitution, compiled for the vector instructions of the processor and apart from the rest of a step:
/// inlined there, it is compiled without them.
struct Solve<'a> {
    factors: &'a SmallFactors,
    x: &'a mut [f32],
    scratch: &'a mut [f32],
}

impl pulp::WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        match S::F32_LANES <= ROWS / 2 {
            true => self.factors.substitute(simd, self.x, self.scratch),
            // Vectors longer than half a tile, which another crate may ask pulp for.
            false => self
                .factors
                .substitute(pulp::Scalar::new(), self.x, self.scratch),
        }
    }
}

/// A block of columns.
struct Columns<'a, const N: usize> {
    first: usize,
    /// The rows of its tiles.
    below: Range<usize>,
    tiles: &'a [[Tile; N]],
    square: &'a [[f32; N]],
    scales: [f32; N],
}

impl<const N: usize> Columns<'_, N> {
    /// Their part of L⁻¹ in the `values` of the supernode's rows.
    #[inline(always)]
    fn forward<S: pulp::Simd>(&self, simd: S, values: &mut [f32]) {
        let mut own = [0.0; N];
        for j in 0..N {
            let before: f32 = (0..j).map(|k| self.square[k][j] * own[k]).sum();
            own[j] = values[self.first + j] - before;
        }
        values[self.first..][..N].copy_from_slice(&own);
        let factors: [_; N] = std::array::from_fn(|k| simd.splat_f32s(-self.scales[k] * own[k]));
        let rows = values[self.below.clone()].as_chunks_mut::<ROWS>().0;
        for (rows, tiles) in rows.iter_mut().zip(self.tiles) {
            let (low, high) = rows.split_at_mut(ROWS / 2);
            let (low, high) = (S::as_mut_simd_f32s(low).0, S::as_mut_simd_f32s(high).0);
            let words = tiles.each_ref().map(|tile| S::as_simd_u32s(tile).0);
            for (i, (low, high)) in low.iter_mut().zip(high).enumerate() {
                for (words, &factor) in words.iter().zip(&factors) {
                    let entries = entries(simd, words[i]);
                    *low = simd.mul_add_f32s(entries[0], factor, *low);
                    *high = simd.mul_add_f32s(entries[1], factor, *high);
                }
            }
        }
    }

    /// Their part of L⁻ᵀ.
    #[inline(always)]
    fn backward<S: pulp::Simd>(&self, simd: S, values: &mut [f32]) {
        let mut sums = [simd.splat_f32s(0.0); N];
        let rows = values[self.below.clone()].as_chunks::<ROWS>().0;
        // From below: the rows of the supernode itself wait for the blocks after this one.
        for (rows, tiles) in rows.iter().zip(self.tiles).rev() {
            let (low, high) = rows.split_at(ROWS / 2);
            let (low, high) = (S::as_simd_f32s(low).0, S::as_simd_f32s(high).0);
            let words = tiles.each_ref().map(|tile| S::as_simd_u32s(tile).0);
            for (i, (&low, &high)) in low.iter().zip(high).enumerate() {
                for (words, sum) in words.iter().zip(&mut sums) {
                    let entries = entries(simd, words[i]);
                    *sum = simd.mul_add_f32s(entries[0], low, *sum);
                    *sum = simd.mul_add_f32s(entries[1], high, *sum);
                }
            }
        }
        let own = &mut values[self.first..][..N];
        for j in (0..N).rev() {
            let after: f32 = (j + 1..N).map(|k| self.square[j][k] * own[k]).sum();
            own[j] -= after + self.scales[j] * simd.reduce_sum_f32s(sums[j]);
        }
    }
}

/// The entries in the lower and in the upper halves of the words, over their scale.
#[inline(always)]
fn entries<S: pulp::Simd>(simd: S, words: S::u32s) -> [S::f32s; 2] {
    let lower = simd.and_u32s(words, simd.splat_u32s(u32::from(u16::MAX)));
    let upper = simd.wrapping_dyn_shr_u32s(words, simd.splat_u32s(16));
    let units = simd.splat_u32s(UNITS);
    let raised = simd.splat_f32s(f32::from_bits(UNITS) + f32::from(RAISED));
    [lower, upper].map(|entry| {
        let value = simd.transmute_f32s_u32s(simd.or_u32s(entry, units));
        simd.sub_f32s(value, raised)
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
        factors.round();
        let small = SmallFactors::new(&factors);
        let mut rounded: Vec<f64> = x.iter().map(|&x| x.into()).collect();
        factors.solve_many(&mut rounded, 1);
        let widths = small.nodes.iter().map(|node| node.columns);
        assert!(widths.clone().any(|width| width % BLOCK != 0) && widths.max() > Some(2 * BLOCK));
        small.solve(&mut x, &mut vec![f32::NAN; small.scratch()]);
        let largest = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for ((x, exact), rounded) in x.iter().zip(&exact).zip(&rounded) {
            // Some hundred products a number, each rounded to half of 1.2e-7, in a matrix of condition below 20.
            assert!((f64::from(*x) - rounded).abs() < 1e-5 * largest);
            // Some hundred products a number, there and back, with entries of at most a tenth that are rounded to half of
            // 3e-5 of that, all to one side.
            assert!(
                (f64::from(*x) - exact).abs() < 3e-4 * largest,
                "{x} {exact}"
            );
        }
    }
}
