//! Galerkin's condition on the moving-least-squares functions, with the prescribed displacements as
//! constraints u(x_I) = Σ φ_J(x_I) U_J.
//!
//! Splitting the particles into prescribed (p) and free (f) ones, the constraints D_p U_p + D_f U_f = g
//! are solved for U_p = T U_f + q g_tool. The combinations ψ = φ M, M = [T q; 1 0], of the functions meet
//! the constraints by themselves, and Galerkin's condition on them is a positive definite system in U_f
//! alone. Lagrange multipliers on the same rows give the same, at thirty times the size; the force on
//! the tool is the multiplier of its row, (3-12) to (3-14) with the functions' values in place of the
//! identity.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use nalgebra::Matrix3;

use super::layout::CapShape;
use super::quadrature::Quadrature;
use super::shape_function::ShapeFunctions;
use super::solution::{Partition, Solution, Solved};
use crate::LinearElastic;
use crate::linear::dense::DenseSystem;
use crate::linear::gmres::Gmres;

/// Radius of a sphere in mean distances to its six nearest neighbours.
pub(super) const SUPPORT: f64 = 1.6;

pub(super) struct WeakForm {
    partition: Partition,
    functions: ShapeFunctions,
    constraints: DenseSystem,
    /// M: particles × (free + tool).
    combinations: Mat<f64>,
    /// √w ∂φ/∂x_k at the integration points, for k = 0, 1, 2: particles × points.
    slopes: [Mat<f64>; 3],
    /// √w ∂ψ/∂x_k: row k (free + tool) + a, a column per point.
    combined: Mat<f64>,
    /// ∫ ∂ψ_a/∂x_i ∂ψ_b/∂x_k dV [h], rows and columns as in `combined`.
    gradients: Mat<f64>,
    /// K [E h] between the free particles, and with the tool last.
    stiffness: Vec<Matrix3<f64>>,
    reduced: DenseSystem,
}

impl WeakForm {
    pub(super) fn new(partition: Partition, points: usize) -> Self {
        let (prescribed, free) = (partition.prescribed.len(), partition.free.len());
        let (count, columns) = (prescribed + free, free + 1);
        Self {
            functions: ShapeFunctions::with_capacity(count),
            constraints: DenseSystem::new(prescribed, columns),
            combinations: Mat::zeros(count, columns),
            slopes: [(); 3].map(|()| Mat::zeros(count, points)),
            combined: Mat::zeros(3 * columns, points),
            gradients: Mat::zeros(3 * columns, 3 * columns),
            stiffness: vec![Matrix3::zeros(); columns * columns],
            reduced: DenseSystem::new(3 * free, 3),
            partition,
        }
    }

    pub(super) fn free_unknowns(&self) -> usize {
        3 * self.partition.free.len()
    }

    pub(super) fn assemble(
        &mut self,
        solution: &Solution,
        quadrature: &Quadrature,
        cap: CapShape,
        law: &LinearElastic,
    ) {
        self.meet_constraints(solution);
        self.evaluate_slopes(solution, quadrature, cap);
        self.integrate();
        self.apply_law(law);
    }

    /// M: the combinations of functions that meet the constraints.
    fn meet_constraints(&mut self, solution: &Solution) {
        let free = self.partition.free.len();
        self.constraints.clear();
        for (row, &node) in self.partition.prescribed.iter().enumerate() {
            self.functions
                .evaluate_values(&solution.particles, &solution.particles.positions[node]);
            for (&j, &value) in self.functions.particles.iter().zip(&self.functions.values) {
                let j = j as usize;
                if let Ok(column) = self.partition.prescribed.binary_search(&j) {
                    self.constraints.matrix[(row, column)] = value;
                } else if let Ok(column) = self.partition.free.binary_search(&j) {
                    self.constraints.right[(row, column)] = -value;
                }
            }
        }
        self.constraints.right[(0, free)] = 1.0;
        self.constraints.solve();
        self.combinations.fill(0.0);
        for (row, &node) in self.partition.prescribed.iter().enumerate() {
            for column in 0..=free {
                self.combinations[(node, column)] = self.constraints.right[(row, column)];
            }
        }
        for (column, &node) in self.partition.free.iter().enumerate() {
            self.combinations[(node, column)] = 1.0;
        }
    }

    fn evaluate_slopes(&mut self, solution: &Solution, quadrature: &Quadrature, cap: CapShape) {
        for slopes in &mut self.slopes {
            slopes.fill(0.0);
        }
        for (column, point) in quadrature.points(cap).enumerate() {
            let root = point.weight.sqrt();
            self.functions
                .evaluate(&solution.particles, &point.position);
            let [x, y, z] = &mut self.slopes;
            let (mut x, mut y, mut z) = (x.col_mut(column), y.col_mut(column), z.col_mut(column));
            let gradients = &self.functions.gradients;
            for (&j, gradient) in self.functions.particles.iter().zip(gradients) {
                x[j as usize] = root * gradient.x;
                y[j as usize] = root * gradient.y;
                z[j as usize] = root * gradient.z;
            }
        }
    }

    fn integrate(&mut self) {
        let columns = self.partition.free.len() + 1;
        for (k, slopes) in self.slopes.iter().enumerate() {
            matmul(
                self.combined.as_mut().subrows_mut(k * columns, columns),
                Accum::Replace,
                self.combinations.transpose(),
                slopes.as_ref(),
                1.0,
                Par::Seq,
            );
        }
        matmul(
            self.gradients.as_mut(),
            Accum::Replace,
            self.combined.as_ref(),
            self.combined.transpose(),
            1.0,
            Par::Seq,
        );
    }

    /// K_ab = λ G + μ Gᵀ + μ tr(G) 1 with G = ∫ ∇ψ_a ∇ψ_bᵀ: the isotropic law on the gradients.
    fn apply_law(&mut self, law: &LinearElastic) {
        let scale = 1.0 / law.youngs_modulus();
        let (lame, shear) = (law.lame_modulus() * scale, law.shear_modulus() * scale);
        let columns = self.partition.free.len() + 1;
        for a in 0..columns {
            for b in 0..columns {
                let g = Matrix3::from_fn(|i, k| self.gradients[(i * columns + a, k * columns + b)]);
                self.stiffness[a * columns + b] = lame * g
                    + shear * g.transpose()
                    + Matrix3::from_diagonal_element(shear * g.trace());
            }
        }
    }

    /// Fills coefficients and stiffness; answers how.
    pub(super) fn solve(
        &mut self,
        solution: &mut Solution,
        gmres: Option<(&mut Gmres, f64)>,
    ) -> Solved {
        let free = self.partition.free.len();
        let columns = free + 1;
        for a in 0..free {
            for b in 0..columns {
                let block = &self.stiffness[a * columns + b];
                for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
                    if b < free {
                        self.reduced.matrix[(3 * a + i, 3 * b + k)] = block[(i, k)];
                    } else {
                        self.reduced.right[(3 * a + i, k)] = -block[(i, k)];
                    }
                }
            }
        }
        let solved = Solved::of(&mut self.reduced, gmres);
        self.recover(solution);
        solved
    }

    fn recover(&self, solution: &mut Solution) {
        let free = self.partition.free.len();
        let columns = free + 1;
        let found = |a: usize| Matrix3::from_fn(|i, k| self.reduced.right[(3 * a + i, k)]);
        solution.stiffness = self.stiffness[columns * columns - 1];
        for (node, coefficients) in solution.coefficients.iter_mut().enumerate() {
            *coefficients = Matrix3::from_diagonal_element(self.combinations[(node, free)]);
        }
        for a in 0..free {
            let found = found(a);
            solution.stiffness += self.stiffness[free * columns + a] * found;
            let part = self.combinations.col(a);
            for (coefficients, &part) in solution.coefficients.iter_mut().zip(part.iter()) {
                *coefficients += found * part;
            }
        }
    }
}
