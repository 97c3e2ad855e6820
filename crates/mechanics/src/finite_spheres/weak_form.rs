//! Galerkin's condition on the moving-least-squares functions, with the prescribed displacements as
//! constraints u(x_I) = Σ φ_J(x_I) U_J.
//!
//! Splitting the particles into prescribed (p) and free (f) ones, the constraints D_p U_p + D_f U_f = g
//! are solved for U_p, which leaves a positive definite system in U_f alone. It is what Lagrange
//! multipliers on the same rows give, at a thirtieth of the size; the force on the tool is the
//! multiplier of its row, (3-12) to (3-14) with the functions' values in place of the identity.

use nalgebra::Matrix3;

use super::layout::CapShape;
use super::quadrature::Quadrature;
use super::shape_function::ShapeFunctions;
use super::solution::{Partition, Solution};
use crate::LinearElastic;
use crate::linear::dense::DenseSystem;
use crate::linear::gmres::Gmres;

/// Radius of a sphere in mean distances to its six nearest neighbours.
pub(super) const SUPPORT: f64 = 1.6;

pub(super) struct WeakForm {
    partition: Partition,
    functions: ShapeFunctions,
    /// ∫ ∇φ_I ∇φ_Jᵀ dV [h], row by row; the upper half while it is summed.
    gradients: Vec<Matrix3<f64>>,
    /// K [E h] in the same order.
    stiffness: Vec<Matrix3<f64>>,
    constraints: DenseSystem,
    /// K M: particles × (free + tool).
    product: Vec<Matrix3<f64>>,
    reduced: DenseSystem,
    /// Mᵀ K M: (free + tool)².
    condensed: Vec<Matrix3<f64>>,
}

impl WeakForm {
    pub(super) fn new(partition: Partition) -> Self {
        let (held, free) = (partition.prescribed.len(), partition.free.len());
        let count = held + free;
        Self {
            functions: ShapeFunctions::with_capacity(count),
            gradients: vec![Matrix3::zeros(); count * count],
            stiffness: vec![Matrix3::zeros(); count * count],
            constraints: DenseSystem::new(held, free + 1),
            product: vec![Matrix3::zeros(); count * (free + 1)],
            reduced: DenseSystem::new(3 * free, 3),
            condensed: vec![Matrix3::zeros(); (free + 1) * (free + 1)],
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
        self.sum_gradients(solution, quadrature, cap);
        self.stiffness_from_gradients(law);
        self.eliminate_prescribed(solution);
        self.condense();
    }

    fn sum_gradients(&mut self, solution: &Solution, quadrature: &Quadrature, cap: CapShape) {
        let count = solution.particles.positions.len();
        self.gradients.fill(Matrix3::zeros());
        for point in quadrature.points(cap) {
            self.functions
                .evaluate(&solution.particles, &point.position);
            let (particles, gradients) = (&self.functions.particles, &self.functions.gradients);
            for (a, &i) in particles.iter().enumerate() {
                let weighted = gradients[a] * point.weight;
                let row = &mut self.gradients[i as usize * count..][..count];
                for (&j, gradient) in particles[a..].iter().zip(&gradients[a..]) {
                    row[j as usize] += weighted * gradient.transpose();
                }
            }
        }
    }

    /// K_IJ = λ G + μ Gᵀ + μ tr(G) 1 with G = ∫ ∇φ_I ∇φ_Jᵀ: the isotropic law on the gradients.
    fn stiffness_from_gradients(&mut self, law: &LinearElastic) {
        let scale = 1.0 / law.youngs_modulus();
        let (lame, shear) = (law.lame_modulus() * scale, law.shear_modulus() * scale);
        let count = self.partition.prescribed.len() + self.partition.free.len();
        for i in 0..count {
            for j in i..count {
                let g = self.gradients[i * count + j];
                let block = lame * g
                    + shear * g.transpose()
                    + Matrix3::from_diagonal_element(shear * g.trace());
                self.stiffness[i * count + j] = block;
                self.stiffness[j * count + i] = block.transpose();
            }
        }
    }

    /// U_p = T U_f + q u_tool: the columns of `constraints.right` become T and q.
    fn eliminate_prescribed(&mut self, solution: &Solution) {
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
    }

    /// Mᵀ K M with M = [T q; 1 0].
    fn condense(&mut self) {
        let free = self.partition.free.len();
        let count = self.partition.prescribed.len() + free;
        let columns = free + 1;
        for i in 0..count {
            let from = &self.stiffness[i * count..(i + 1) * count];
            let row = &mut self.product[i * columns..(i + 1) * columns];
            for (column, sum) in row.iter_mut().enumerate() {
                *sum = match self.partition.free.get(column) {
                    Some(&node) => from[node],
                    None => Matrix3::zeros(),
                };
                let factors = self.constraints.right.col(column);
                for (&node, &factor) in self.partition.prescribed.iter().zip(factors.iter()) {
                    *sum += from[node] * factor;
                }
            }
        }
        for a in 0..columns {
            let factors = self.constraints.right.col(a);
            for b in 0..columns {
                let mut sum = match self.partition.free.get(a) {
                    Some(&node) => self.product[node * columns + b],
                    None => Matrix3::zeros(),
                };
                for (&node, &factor) in self.partition.prescribed.iter().zip(factors.iter()) {
                    sum += self.product[node * columns + b] * factor;
                }
                self.condensed[a * columns + b] = sum;
            }
        }
    }

    /// Fills coefficients and stiffness; answers the iterations (zero for the direct solution).
    pub(super) fn solve(
        &mut self,
        solution: &mut Solution,
        gmres: Option<(&mut Gmres, f64)>,
    ) -> usize {
        let free = self.partition.free.len();
        let columns = free + 1;
        for a in 0..free {
            for b in 0..columns {
                let block = &self.condensed[a * columns + b];
                for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
                    if b < free {
                        self.reduced.matrix[(3 * a + i, 3 * b + k)] = block[(i, k)];
                    } else {
                        self.reduced.right[(3 * a + i, k)] = -block[(i, k)];
                    }
                }
            }
        }
        let iterations = match gmres {
            Some((gmres, tolerance)) => gmres.solve(&mut self.reduced, tolerance),
            None => {
                self.reduced.solve();
                0
            }
        };
        self.recover(solution);
        iterations
    }

    fn recover(&self, solution: &mut Solution) {
        let free = self.partition.free.len();
        let columns = free + 1;
        let found = |a: usize| Matrix3::from_fn(|i, k| self.reduced.right[(3 * a + i, k)]);
        solution.stiffness = self.condensed[columns * columns - 1];
        for a in 0..free {
            solution.stiffness += self.condensed[free * columns + a] * found(a);
        }
        for (a, &node) in self.partition.free.iter().enumerate() {
            solution.coefficients[node] = found(a);
        }
        for (row, &node) in self.partition.prescribed.iter().enumerate() {
            let mut sum = Matrix3::identity() * self.constraints.right[(row, free)];
            for a in 0..free {
                sum += found(a) * self.constraints.right[(row, a)];
            }
            solution.coefficients[node] = sum;
        }
    }
}
