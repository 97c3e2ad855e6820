//! Sparse symmetric systems, definite or not: K = L D Lᵀ, the symbolic part done once for a pattern.
//!
//! A mixed finite element matrix is quasi-definite (positive for displacements, negative for
//! pressures), so it has such factors in any order of elimination [Vanderbei 1995], and by Sylvester's
//! law the signs of D count its negative eigenvalues. That count shows whether an equilibrium is stable.
//!
//! *How we know*: the tests below; every solver of `finite_elements` stands on it.
//!
//! *Limits*: no pivoting; an exactly singular matrix is reported, a nearly singular one is the caller's
//! to notice.

mod many;
mod small;

pub(crate) use small::SmallFactors;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

/// The sparsity pattern of a symmetric matrix: its lower triangle, column by column, rows
/// ascending.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    symbolic: SymbolicSparseColMat<usize>,
}

impl Pattern {
    /// From the pairs (column, row), row ≥ column, in any order and with repeats; every diagonal entry
    /// is added.
    pub(crate) fn new(size: usize, mut entries: Vec<(u32, u32)>) -> Self {
        entries.extend((0..size as u32).map(|i| (i, i)));
        entries.sort_unstable();
        entries.dedup();
        let mut columns = vec![0; size + 1];
        for &(column, _) in &entries {
            columns[column as usize + 1] += 1;
        }
        for column in 0..size {
            columns[column + 1] += columns[column];
        }
        let rows = entries.iter().map(|&(_, row)| row as usize).collect();
        Self {
            symbolic: SymbolicSparseColMat::new_checked(size, size, columns, None, rows),
        }
    }

    pub(crate) fn size(&self) -> usize {
        self.symbolic.nrows()
    }

    pub(crate) fn entries(&self) -> usize {
        self.symbolic.row_idx().len()
    }

    /// Index of the entry (`row`, `column`), row ≥ column, among the values.
    ///
    /// # Panics
    /// When there is no such entry.
    pub(crate) fn index(&self, row: usize, column: usize) -> usize {
        let start = self.symbolic.col_ptr()[column];
        let found = self.rows(column).binary_search(&row);
        start + found.expect("the pattern was made from the same couplings")
    }

    /// Rows of the entries of `column`, beginning with the diagonal.
    pub(crate) fn rows(&self, column: usize) -> &[usize] {
        &self.symbolic.row_idx()[self.range(column)]
    }

    /// Indices of the values of `column`.
    pub(crate) fn range(&self, column: usize) -> std::ops::Range<usize> {
        self.symbolic.col_ptr()[column]..self.symbolic.col_ptr()[column + 1]
    }

    /// y ← K x for the symmetric matrix with these lower `values`.
    pub(crate) fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for column in 0..self.size() {
            let (rows, range) = (self.rows(column), self.range(column));
            let mut diagonal = values[range.start] * x[column];
            for (&row, &value) in rows[1..].iter().zip(&values[range][1..]) {
                y[row] += value * x[column];
                diagonal += value * x[row];
            }
            y[column] += diagonal;
        }
    }

    fn view(&self) -> SymbolicSparseColMatRef<'_, usize> {
        self.symbolic.as_ref()
    }
}

/// The order of elimination and the room for the factors, made once for a pattern.
pub(crate) struct Factors {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    scratch: MemBuffer,
}

impl std::fmt::Debug for Factors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Factors of {} unknowns", self.symbolic.nrows())
    }
}

/// The matrix has no factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Singular;

impl Factors {
    /// # Errors
    /// When there is not enough memory.
    pub(crate) fn new(pattern: &Pattern) -> Result<Self, Singular> {
        let symbolic = factorize_symbolic_cholesky(
            pattern.view(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )
        .map_err(|_| Singular)?;
        let needed = faer::dyn_stack::StackReq::any_of(&[
            symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        let mut values = Vec::new();
        values
            .try_reserve_exact(symbolic.len_val())
            .map_err(|_| Singular)?;
        values.resize(symbolic.len_val(), 0.0);
        Ok(Self {
            values,
            scratch: MemBuffer::try_new(needed).map_err(|_| Singular)?,
            symbolic,
        })
    }

    /// Numbers in the factor L.
    pub(crate) fn entries(&self) -> usize {
        self.values.len()
    }

    /// Factors the matrix with these lower `values` of `pattern`.
    pub(crate) fn factor(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), Singular> {
        let matrix = SparseColMatRef::new(pattern.view(), values);
        self.symbolic
            .factorize_numeric_ldlt(
                &mut self.values,
                matrix,
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.scratch),
                Default::default(),
            )
            .map_err(|_| Singular)?;
        if self.pivots().all(f64::is_finite) {
            Ok(())
        } else {
            Err(Singular)
        }
    }

    /// Replaces `right` by the solution.
    pub(crate) fn solve(&mut self, right: &mut [f64]) {
        let size = right.len();
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right, size, 1),
            Par::Seq,
            MemStack::new(&mut self.scratch),
        );
    }

    /// Number of negative eigenvalues of the factored matrix.
    pub(crate) fn negative_eigenvalues(&self) -> usize {
        self.pivots().filter(|&pivot| pivot < 0.0).count()
    }

    fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        let SymbolicCholeskyRaw::Supernodal(supernodal) = self.symbolic.raw() else {
            unreachable!("supernodal factors were asked for");
        };
        (0..supernodal.n_supernodes()).flat_map(move |s| {
            let columns = supernodal.supernode_end()[s] - supernodal.supernode_begin()[s];
            let start = supernodal.col_ptr_for_val()[s];
            let length = supernodal.col_ptr_for_val()[s + 1] - start;
            let rows = length.checked_div(columns).unwrap_or(0);
            (0..columns).map(move |i| self.values[start + i * (rows + 1)])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of springs with constraints: [K B; Bᵀ −ε], indefinite with as many negative eigenvalues
    /// as constraints.
    #[test]
    fn solves_and_counts_an_indefinite_system() {
        let (springs, constraints) = (40, 7);
        let size = springs + constraints;
        let mut entries = Vec::new();
        let mut values = std::collections::BTreeMap::new();
        let mut put = |row: usize, column: usize, value: f64| {
            entries.push((column as u32, row as u32));
            values.insert((column, row), value);
        };
        for i in 0..springs {
            put(i, i, 2.5);
            if i + 1 < springs {
                put(i + 1, i, -1.0);
            }
        }
        for c in 0..constraints {
            put(springs + c, 3 * c, 1.0);
            put(springs + c, 5 * c + 2, -1.0);
            put(springs + c, springs + c, -1e-6);
        }
        let pattern = Pattern::new(size, entries);
        let values: Vec<f64> = (0..size)
            .flat_map(|column| pattern.rows(column).iter().map(move |&row| (column, row)))
            .map(|place| values[&place])
            .collect();
        let mut factors = Factors::new(&pattern).unwrap();
        factors.factor(&pattern, &values).unwrap();
        assert_eq!(factors.negative_eigenvalues(), constraints);
        let exact: Vec<f64> = (0..size).map(|i| (i as f64).sin()).collect();
        let mut right = right_side(&pattern, &values, &exact);
        factors.solve(&mut right);
        for (found, exact) in right.iter().zip(&exact) {
            // Six digits go to the weak diagonal.
            assert!((found - exact).abs() < 1e-9, "{found} {exact}");
        }
        solves_many(&factors, &exact, &right_side(&pattern, &values, &exact));
    }

    fn right_side(pattern: &Pattern, values: &[f64], exact: &[f64]) -> Vec<f64> {
        let mut right = vec![0.0; exact.len()];
        pattern.multiply(values, exact, &mut right);
        right
    }

    /// The same side once as it is, once zero and once doubled.
    fn solves_many(factors: &Factors, exact: &[f64], right: &[f64]) {
        let places = factors.places();
        let mut sides = vec![0.0; 3 * right.len()];
        for (value, &place) in right.iter().zip(&places) {
            sides[3 * place..][..3].copy_from_slice(&[*value, 0.0, 2.0 * value]);
        }
        factors.solve_many(&mut sides, 3);
        for (exact, &place) in exact.iter().zip(&places) {
            let [once, zero, twice] = [0, 1, 2].map(|k| sides[3 * place + k]);
            // As above.
            assert!((once - exact).abs() < 1e-9 && (twice - 2.0 * exact).abs() < 2e-9);
            assert!(zero == 0.0);
        }
    }
}
