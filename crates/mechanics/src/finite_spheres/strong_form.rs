//! Point collocation, the source's own form: the field equations at the inner particles (3-5), the
//! prescribed displacements (3-6), and no traction at the surface particles (3-7).
//!
//! With lengths in h and stress in E the rows are of like size. The force is not K_aa U + K_ab U_b
//! (3-14), which is no force where φ_J(x_I) is not the identity, but the virtual work of the stress,
//! F_k = ∫ σ(u) : (e_k ⊗ ∇ψ) dV, with ψ = 1 on the first shell and 0 on the last.
//!
//! *Limits*: second derivatives of functions with a linear basis are not consistent (∇²|x|² is not 6,
//! at any spacing); the form works for the shells of this module and their support, is measured, not
//! proven, and its answer to a tangential displacement is not used. At ν = 0.3 its force errs by tens of
//! percent where the curvature is not the calibrating hemisphere's; over steep saddles it has poles.

use nalgebra::Matrix3;

use super::layout::{CapShape, Layout, Role};
use super::quadrature::Quadrature;
use super::shape_function::ShapeFunctions;
use super::solution::{Solution, Solved};
use crate::linear::dense::DenseSystem;
use crate::linear::gmres::Gmres;
use crate::{LinearElastic, Vec3};

/// Radius of a sphere in mean distances to its six nearest neighbours, for two shells and for more.
/// Outside a narrow band around these the force changes sign; twenty particles have no such band.
const SUPPORT: [f64; 2] = [1.65, 2.3];

pub(super) struct StrongForm {
    layout: Layout,
    functions: ShapeFunctions,
    system: DenseSystem,
    /// Row J: the force along i for U_J along k [E h].
    force_rows: Vec<Matrix3<f64>>,
}

/// Lamé's moduli of the tissue over E.
#[derive(Debug, Clone, Copy)]
struct Moduli {
    /// λ over E [-].
    lame: f64,
    /// μ over E [-].
    shear: f64,
}

impl StrongForm {
    pub(super) fn new(layout: &Layout) -> Self {
        let count = layout.places.len();
        Self {
            layout: layout.clone(),
            functions: ShapeFunctions::with_capacity(count),
            system: DenseSystem::new(3 * count, 3),
            force_rows: vec![Matrix3::zeros(); count],
        }
    }

    pub(super) fn support(&self) -> f64 {
        SUPPORT[usize::from(self.layout.shells > 2)]
    }

    pub(super) fn assemble(
        &mut self,
        solution: &Solution,
        quadrature: &Quadrature,
        cap: CapShape,
        law: &LinearElastic,
    ) {
        let scale = 1.0 / law.youngs_modulus();
        let moduli = Moduli {
            lame: law.lame_modulus() * scale,
            shear: law.shear_modulus() * scale,
        };
        self.system.clear();
        for node in 0..solution.particles.positions.len() {
            let here = solution.particles.positions[node];
            match self.layout.roles[node] {
                Role::Tool | Role::Fixed => {
                    self.functions.evaluate_values(&solution.particles, &here);
                    self.write_rows(node, |functions, a| {
                        Matrix3::from_diagonal_element(functions.values[a])
                    });
                }
                Role::Surface => {
                    let normal = cap.surface_normal(&here);
                    self.functions.evaluate(&solution.particles, &here);
                    self.write_rows(node, |functions, a| {
                        traction(&functions.gradients[a], &normal, moduli)
                    });
                }
                Role::Interior => {
                    self.functions.evaluate_second(&solution.particles, &here);
                    self.write_rows(node, |functions, a| {
                        divergence_of_stress(&functions.hessians[a], moduli)
                    });
                }
            }
        }
        for k in 0..3 {
            self.system.right[(k, k)] = 1.0;
        }
        self.sum_force_rows(solution, quadrature, cap, moduli);
    }

    fn write_rows(&mut self, node: usize, block: impl Fn(&ShapeFunctions, usize) -> Matrix3<f64>) {
        for (a, &j) in self.functions.particles.iter().enumerate() {
            let block = block(&self.functions, a);
            for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
                self.system.matrix[(3 * node + i, 3 * j as usize + k)] = block[(i, k)];
            }
        }
    }

    fn sum_force_rows(
        &mut self,
        solution: &Solution,
        quadrature: &Quadrature,
        cap: CapShape,
        moduli: Moduli,
    ) {
        self.force_rows.fill(Matrix3::zeros());
        let outermost = self.layout.shells as f64;
        for point in quadrature.points(cap) {
            let distance = point.position.norm();
            if distance < 1.0 {
                continue;
            }
            // ψ = (1/r − 1/R)/(1 − 1/R), as displacement falls off.
            let slope = -1.0 / (distance.powi(3) * (1.0 - 1.0 / outermost));
            let direction = point.position * (slope * point.weight);
            self.functions
                .evaluate(&solution.particles, &point.position);
            for (&j, gradient) in self
                .functions
                .particles
                .iter()
                .zip(&self.functions.gradients)
            {
                self.force_rows[j as usize] += traction(gradient, &direction, moduli);
            }
        }
    }

    /// Fills coefficients and stiffness; answers how.
    pub(super) fn solve(
        &mut self,
        solution: &mut Solution,
        gmres: Option<(&mut Gmres, f64)>,
    ) -> Solved {
        let solved = Solved::of(&mut self.system, gmres);
        solution.stiffness = Matrix3::zeros();
        for (node, row) in self.force_rows.iter().enumerate() {
            let found = Matrix3::from_fn(|i, k| self.system.right[(3 * node + i, k)]);
            solution.coefficients[node] = found;
            solution.stiffness += row * found;
        }
        solved
    }
}

/// Column k: σ(u) n for u = φ e_k, with ∇φ given.
fn traction(gradient: &Vec3, normal: &Vec3, moduli: Moduli) -> Matrix3<f64> {
    let Moduli { lame, shear } = moduli;
    lame * normal * gradient.transpose()
        + shear * gradient * normal.transpose()
        + Matrix3::from_diagonal_element(shear * gradient.dot(normal))
}

/// Column k: ∇·σ(u) for u = φ e_k, with the Hessian of φ given.
fn divergence_of_stress(hessian: &Matrix3<f64>, moduli: Moduli) -> Matrix3<f64> {
    let Moduli { lame, shear } = moduli;
    (lame + shear) * hessian + Matrix3::from_diagonal_element(shear * hessian.trace())
}
