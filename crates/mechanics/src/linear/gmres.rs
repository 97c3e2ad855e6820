//! Generalised minimal residuals, restarted [Saad and Schultz 1986]: the source's solver (section 3.3).
//!
//! Rows are scaled by their diagonal first, which is enough preconditioning for systems of this size.

use super::dense::DenseSystem;

/// Limits of an iteration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Krylov {
    /// Size of the space between restarts.
    pub(crate) space: usize,
    /// How often it starts.
    pub(crate) cycles: usize,
}

impl Krylov {
    /// For small systems.
    pub(crate) const SMALL: Self = Self {
        space: 60,
        cycles: 20,
    };
}

/// Adds the product of a matrix and the first to the second.
type AddProduct<'a> = &'a mut dyn FnMut(&[f64], &mut [f64]);

/// Solves a system of a matrix that is known by its products alone, to the relative `tolerance`. The solution, and the number
/// of iterations.
///
/// # Errors
/// When the residual stays larger.
pub(crate) fn solve_by_products(
    right: &[f64],
    most: Krylov,
    tolerance: f64,
    add_product: AddProduct<'_>,
) -> Result<(Vec<f64>, usize), NotConverged> {
    let mut gmres = Gmres::within(most, right.len(), 0);
    gmres.right.copy_from_slice(right);
    gmres.diagonal.fill(1.0);
    match gmres.iterate(tolerance, add_product) {
        (iterations, residual) if residual <= tolerance => Ok((gmres.solution, iterations)),
        (_, residual) => Err(NotConverged { residual }),
    }
}

/// Scratch of the iteration.
#[derive(Debug)]
pub(crate) struct Gmres {
    size: usize,
    space: usize,
    cycles: usize,
    basis: Vec<f64>,
    hessenberg: Vec<f64>,
    rotations: Vec<(f64, f64)>,
    residuals: Vec<f64>,
    solution: Vec<f64>,
    right: Vec<f64>,
    /// Of all right sides, until the last is known.
    solutions: Vec<f64>,
    diagonal: Vec<f64>,
}

/// Some right side was not solved to the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NotConverged {
    /// Largest relative residual of a right side [-].
    pub(crate) residual: f64,
}

impl Gmres {
    /// For systems of this `size` with so many `right_sides`.
    pub(crate) fn new(size: usize, right_sides: usize) -> Self {
        Self::within(Krylov::SMALL, size, right_sides)
    }

    fn within(most: Krylov, size: usize, right_sides: usize) -> Self {
        let space = most.space.min(size);
        Self {
            size,
            space,
            cycles: most.cycles,
            basis: vec![0.0; size * (space + 1)],
            hessenberg: vec![0.0; (space + 1) * space],
            rotations: vec![(0.0, 0.0); space],
            residuals: vec![0.0; space + 1],
            solution: vec![0.0; size],
            right: vec![0.0; size],
            solutions: vec![0.0; size * right_sides],
            diagonal: vec![0.0; size],
        }
    }

    /// Replaces every right side of `system` by the solution to the relative `tolerance`; answers the
    /// number of iterations over all of them.
    ///
    /// # Errors
    /// When the residual of one stays larger. `system` is as it was then.
    pub(crate) fn solve(
        &mut self,
        system: &mut DenseSystem,
        tolerance: f64,
    ) -> Result<usize, NotConverged> {
        for row in 0..self.size {
            let pivot = system.matrix[(row, row)];
            self.diagonal[row] = if pivot == 0.0 { 1.0 } else { 1.0 / pivot };
        }
        let (mut iterations, mut worst) = (0, 0.0_f64);
        for column in 0..system.right.ncols() {
            for (row, value) in self.right.iter_mut().enumerate() {
                *value = system.right[(row, column)];
            }
            let matrix = &system.matrix;
            let (more, relative) = self.iterate(tolerance, &mut |x, product| {
                for (col, &x) in x.iter().enumerate() {
                    for (value, entry) in product.iter_mut().zip(matrix.col(col).iter()) {
                        *value += entry * x;
                    }
                }
            });
            iterations += more;
            worst = if relative > worst || relative.is_nan() {
                relative
            } else {
                worst
            };
            self.solutions[column * self.size..][..self.size].copy_from_slice(&self.solution);
        }
        if worst > tolerance || worst.is_nan() {
            return Err(NotConverged { residual: worst });
        }
        for column in 0..system.right.ncols() {
            for row in 0..self.size {
                system.right[(row, column)] = self.solutions[column * self.size + row];
            }
        }
        Ok(iterations)
    }

    /// Solves for `self.right`; answers the number of iterations and the relative residual that is left [-].
    fn iterate(&mut self, tolerance: f64, add_product: AddProduct<'_>) -> (usize, f64) {
        let mut iterations = 0;
        self.solution.fill(0.0);
        let scaled = self.right.iter().zip(&self.diagonal);
        for (value, (right, scale)) in self.basis.iter_mut().zip(scaled) {
            *value = right * scale;
        }
        let size = norm(&self.basis[..self.size]);
        let mut residual = size;
        for _ in 0..self.cycles {
            iterations += self.cycle(residual, tolerance * size, add_product);
            residual = self.residual(add_product);
            if residual <= tolerance * size {
                break;
            }
        }
        // A right side of zeros is its own solution; NaN is no convergence.
        let is_solved = size == 0.0;
        (iterations, if is_solved { 0.0 } else { residual / size })
    }

    /// Puts the scaled residual into the first basis vector; answers its norm.
    fn residual(&mut self, add_product: AddProduct<'_>) -> f64 {
        let residual = &mut self.basis[..self.size];
        for (value, right) in residual.iter_mut().zip(&self.right) {
            *value = -right;
        }
        add_product(&self.solution, residual);
        for (value, scale) in residual.iter_mut().zip(&self.diagonal) {
            *value *= -scale;
        }
        norm(residual)
    }

    /// Goes on from a residual of size `start` in the first basis vector.
    fn cycle(&mut self, start: f64, goal: f64, add_product: AddProduct<'_>) -> usize {
        let n = self.size;
        if start <= goal || start == 0.0 {
            return 0;
        }
        self.basis[..n].iter_mut().for_each(|v| *v /= start);
        self.residuals.fill(0.0);
        self.residuals[0] = start;
        let mut done = 0;
        while done < self.space && self.residuals[done].abs() > goal {
            self.extend(done, add_product);
            self.rotate(done);
            done += 1;
        }
        self.update(done);
        done
    }

    /// The next basis vector, made orthogonal by modified Gram and Schmidt.
    fn extend(&mut self, k: usize, add_product: AddProduct<'_>) {
        let n = self.size;
        let (known, new) = self.basis.split_at_mut((k + 1) * n);
        let new = &mut new[..n];
        new.fill(0.0);
        add_product(&known[k * n..], new);
        for (value, scale) in new.iter_mut().zip(&self.diagonal) {
            *value *= scale;
        }
        for i in 0..=k {
            let old = &known[i * n..(i + 1) * n];
            let along: f64 = old.iter().zip(new.iter()).map(|(a, b)| a * b).sum();
            self.hessenberg[i * self.space + k] = along;
            for (value, o) in new.iter_mut().zip(old) {
                *value -= along * o;
            }
        }
        let length = norm(new);
        self.hessenberg[(k + 1) * self.space + k] = length;
        if length > 0.0 {
            new.iter_mut().for_each(|v| *v /= length);
        }
    }

    fn rotate(&mut self, k: usize) {
        let at = |row: usize| row * self.space + k;
        for i in 0..k {
            let (c, s) = self.rotations[i];
            let (upper, lower) = (self.hessenberg[at(i)], self.hessenberg[at(i + 1)]);
            self.hessenberg[at(i)] = c * upper + s * lower;
            self.hessenberg[at(i + 1)] = c * lower - s * upper;
        }
        let (upper, lower) = (self.hessenberg[at(k)], self.hessenberg[at(k + 1)]);
        let length = upper.hypot(lower);
        let (c, s) = if length > 0.0 {
            (upper / length, lower / length)
        } else {
            (1.0, 0.0)
        };
        self.rotations[k] = (c, s);
        self.hessenberg[at(k)] = length;
        self.residuals[k + 1] = -s * self.residuals[k];
        self.residuals[k] *= c;
    }

    fn update(&mut self, done: usize) {
        for i in (0..done).rev() {
            let mut value = self.residuals[i];
            for j in i + 1..done {
                value -= self.hessenberg[i * self.space + j] * self.residuals[j];
            }
            self.residuals[i] = value / self.hessenberg[i * self.space + i];
        }
        for i in 0..done {
            let step = self.residuals[i];
            let direction = &self.basis[i * self.size..(i + 1) * self.size];
            for (value, d) in self.solution.iter_mut().zip(direction) {
                *value += step * d;
            }
        }
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The judge is the direct factorisation of the same matrix.
    #[test]
    fn agrees_with_the_factors() {
        let size = 40;
        let mut system = DenseSystem::new(size, 2);
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1);
            (state >> 33) as f64 / 2f64.powi(31) - 0.5
        };
        for i in 0..size {
            for j in 0..size {
                system.matrix[(i, j)] = random() + if i == j { 4.0 } else { 0.0 };
            }
            system.right[(i, 0)] = random();
            system.right[(i, 1)] = random();
        }
        let (matrix, right) = (system.matrix.clone(), system.right.clone());
        let iterations = Gmres::new(size, 2).solve(&mut system, 1e-12).unwrap();
        let iterated = system.right.clone();
        (system.matrix, system.right) = (matrix, right);
        system.solve();
        assert!(iterations > 4 && iterations < 2 * size);
        for column in 0..2 {
            for row in 0..size {
                let difference = iterated[(row, column)] - system.right[(row, column)];
                // The residual is relative 1e-12 and the matrix well conditioned.
                assert!(difference.abs() < 1e-10, "{difference}");
            }
        }
    }

    /// A cyclic shift of more rows than the Krylov space holds: GMRES makes no progress before the last
    /// row [Nachtigal, Reddy and Trefethen 1992]. It reports that, and leaves the system to the
    /// factors.
    #[test]
    fn stagnation_is_an_error_and_changes_nothing() {
        let size = 2 * Krylov::SMALL.space;
        let mut system = DenseSystem::new(size, 1);
        for row in 0..size {
            system.matrix[(row, (row + 1) % size)] = 1.0;
        }
        system.right[(0, 0)] = 1.0;
        let (matrix, right) = (system.matrix.clone(), system.right.clone());
        let failed = Gmres::new(size, 1).solve(&mut system, 1e-10).unwrap_err();
        // Rounding: no step of the iteration reduces the residual.
        assert!((failed.residual - 1.0).abs() < 1e-12, "{failed:?}");
        assert!(system.matrix == matrix && system.right == right);
        system.solve();
        assert!((system.right[(1, 0)] - 1.0).abs() < 1e-15);
    }
}
