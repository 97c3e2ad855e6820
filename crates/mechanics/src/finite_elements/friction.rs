//! Slip with Coulomb friction in Newton's method.
//!
//! A node that slips carries T = ρ N along the tangent of its surface, N = n · r the force of the supports along the normal
//! and ρ = ±μ ([`Sliding::force_ratio`](super::Sliding)). Its tangential equation T − ρ N = 0 has the tangent
//! K_t − ρ K_n, of which the second term is not symmetric. It has as many rows as nodes slip, so the factors stay those of
//! the symmetric part A and the consistent step comes from a small system (the identity of Woodbury):
//!
//! A x = b + E λ, λ = ρ δN(x)  ⟹  (1 − ρ δN(A⁻¹ E)) λ = ρ δN(A⁻¹ b)
//!
//! with one solution more for each node that slips. Passing N back from the last iteration instead would keep the matrix
//! symmetric as well, but converges linearly, at a rate that grows with μ.
//!
//! *How we know*: `tests::the_step_is_newtons` against differences of the residual.

use nalgebra::{DMatrix, DVector};

use super::model::{FiniteElementModel, FiniteElementWorkspace};
use super::newton::{self, Failure};
use super::supports::{Sliding, Supports};

/// Puts the normal force's part into the tangential equations of `right`, whose unknowns are turned.
pub(super) fn balance(supports: &Supports<'_>, right: &mut [f64]) {
    for contact in &supports.sliding {
        let first = 2 * contact.node;
        right[first + 1] -= contact.force_ratio * right[first];
    }
}

/// Replaces the right side of the turned system by its solution, turned back, with the factors of its symmetric part.
pub(super) fn solve(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &mut FiniteElementWorkspace,
    right: &mut Vec<f64>,
) -> Result<(), Failure> {
    let each = supports.sliding.iter();
    let slipping: Vec<&Sliding> = each.filter(|contact| contact.force_ratio != 0.0).collect();
    let mut without = right.clone();
    back(model, supports, workspace, &mut without);
    if slipping.is_empty() {
        *right = without;
        return Ok(());
    }
    let forces = |workspace: &FiniteElementWorkspace, step: &[f64]| -> Vec<f64> {
        let mut product = vec![0.0; model.size()];
        model
            .pattern
            .multiply(&workspace.tangent, step, &mut product);
        let each = slipping.iter();
        each.map(|contact| {
            contact.force_ratio * normal_force_change(model, contact, workspace, (step, &product))
        })
        .collect()
    };
    let count = slipping.len();
    let first = DVector::from_vec(forces(workspace, &without));
    let mut system = DMatrix::identity(count, count);
    for (column, contact) in slipping.iter().enumerate() {
        let mut unit = vec![0.0; model.size()];
        unit[2 * contact.node + 1] = 1.0;
        back(model, supports, workspace, &mut unit);
        for (row, force) in forces(workspace, &unit).into_iter().enumerate() {
            system[(row, column)] -= force;
        }
    }
    let found = system.lu().solve(&first).ok_or(Failure::Singular)?;
    for (contact, force) in slipping.iter().zip(found.iter()) {
        right[2 * contact.node + 1] += force;
    }
    back(model, supports, workspace, right);
    Ok(())
}

fn back(
    model: &FiniteElementModel,
    supports: &Supports<'_>,
    workspace: &mut FiniteElementWorkspace,
    right: &mut [f64],
) {
    workspace.factors.solve(right);
    newton::turn_back(model, supports, workspace, right);
}

/// Change of the normal force on a node [N] with a step whose product with the tangent is `product`; along the surface the
/// normal turns.
fn normal_force_change(
    model: &FiniteElementModel,
    contact: &Sliding,
    workspace: &FiniteElementWorkspace,
    (step, product): (&[f64], &[f64]),
) -> f64 {
    let place = newton::beside(model, contact, &workspace.trial);
    let at = |values: &[f64]| {
        let first = 2 * contact.node;
        place.components([values[first], values[first + 1]])
    };
    let [_, moved] = at(step);
    let [_, tangential] = at(&workspace.residual);
    at(product)[0] + place.curvature * moved * tangential
}
