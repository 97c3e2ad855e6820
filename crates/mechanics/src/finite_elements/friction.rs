//! Slip with Coulomb friction in Newton's method.
//!
//! A node that slips carries T = ρ N along the tangent of its surface, N = n · r the force of the supports along the normal
//! and ρ = ±μ ([`Sliding::force_ratio`](super::Sliding)). Its tangential equation T − ρ N = 0 has the tangent
//! K_t − ρ K_n, of which the second term is not symmetric. It has as many rows as nodes slip, so the factors stay those of
//! the symmetric part A and the consistent step comes from a small system (the identity of Woodbury):
//!
//! A x = b + E λ, λ = ρ δN(x)  ⟹  (1 − ρ δN(A⁻¹ E)) λ = ρ δN(A⁻¹ b)
//!
//! which generalised minimal residuals solve with some ten solutions more of the factored system. Passing N back from the
//! last iteration instead would keep the matrix symmetric as well, but converges linearly, at a rate that grows with μ.
//!
//! *How we know*: `tests::the_step_is_newtons` against differences of the residual.

use super::model::{FiniteElementModel, FiniteElementWorkspace};
use super::newton::{self, Failure};
use super::supports::{Sliding, Supports};
use crate::linear::gmres::{Krylov, solve_by_products};

/// Relative residual of the small system [-].
const SMALL: f64 = 1e-9;

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
            contact.force_ratio * normal_force_change(model, contact, workspace, step, &product)
        })
        .collect()
    };
    let first = forces(workspace, &without);
    let mut unit = vec![0.0; model.size()];
    let found = solve_by_products(&first, Krylov::SMALL, SMALL, &mut |loads, product| {
        unit.fill(0.0);
        for (contact, load) in slipping.iter().zip(loads) {
            unit[2 * contact.node + 1] = *load;
        }
        back(model, supports, workspace, &mut unit);
        let own = loads.iter().zip(forces(workspace, &unit));
        for (value, (load, force)) in product.iter_mut().zip(own) {
            *value += load - force;
        }
    });
    let (found, _) = found.map_err(|_| Failure::Singular)?;
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
    step: &[f64],
    product: &[f64],
) -> f64 {
    let place = newton::signed_distance(model, contact, &workspace.trial);
    let at = |values: &[f64]| {
        let first = 2 * contact.node;
        place.components([values[first], values[first + 1]])
    };
    let [_, moved] = at(step);
    let [_, tangential] = at(&workspace.residual);
    at(product)[0] + place.curvature * moved * tangential
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::mesh::ElementMesh;
    use super::super::model::Formulation;
    use super::super::rigid_tool::RigidShape;
    use super::super::supports::RigidSurface;
    use super::*;
    use crate::NeoHookean;

    /// The equations of free rows and, in pairs, distance and T − ρ N of nodes that slide.
    fn equations(
        model: &FiniteElementModel,
        supports: &Supports<'_>,
        unknowns: &[f64],
        workspace: &mut FiniteElementWorkspace,
    ) -> Vec<f64> {
        newton::assemble(model, supports, unknowns, workspace).unwrap();
        let mut equations = workspace.residual.clone();
        for (equation, prescribed) in equations.iter_mut().zip(&supports.prescribed) {
            if prescribed.is_some() {
                *equation = 0.0;
            }
        }
        for contact in &supports.sliding {
            let place = newton::signed_distance(model, contact, unknowns);
            let rows = 2 * contact.node..2 * contact.node + 2;
            let force = &workspace.residual[rows.clone()];
            let [normal, tangential] = place.components([force[0], force[1]]);
            let pair = [place.distance, tangential - contact.force_ratio * normal];
            equations[rows].copy_from_slice(&pair);
        }
        equations
    }

    /// Judge: central differences of the equations along the step, J x = −g. They are exact to the square of their
    /// length, which falls by four from one to the next.
    #[test]
    fn the_step_is_newtons() {
        let lines = [0.0, 0.3, 0.7, 1.0];
        let mesh = ElementMesh::grid(&lines, &lines, |r, z| [r, z + 0.1 * r * r - 1.1]);
        let law = Arc::new(NeoHookean::compressible(1.0, 4.0).unwrap());
        let model = FiniteElementModel::new(mesh, law, Formulation::Displacement).unwrap();
        let nodes = &model.mesh().nodes;
        let at = |r: f64, z: f64| {
            let near =
                |x: &crate::Vec3| (x.x - r).abs() + (x.y - (z + 0.1 * r * r - 1.1)).abs() < 1e-9;
            nodes.iter().position(near).unwrap()
        };
        let axis = model.mesh().nodes_where(|x| x.x == 0.0);
        let bottom = [0.0, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0].map(|r| at(r, 0.0));
        let mut supports = Supports::none(&model).fix(&model, axis, 0, 0.0);
        supports = supports.fix(&model, bottom, 1, 0.0);
        let sphere = RigidSurface::Revolved {
            shape: RigidShape::Sphere { radius: 2.0 },
            height: 1.95,
        };
        let cone = RigidSurface::Revolved {
            shape: RigidShape::Cone {
                half_angle: 1.2,
                apex_radius: 0.0,
            },
            height: -0.3,
        };
        let plane = RigidSurface::Plane { height: -0.08 };
        let cylinder = RigidSurface::Cylinder { radius: 0.95 };
        let slides = [
            (at(0.15, 1.0), sphere, 0.4),
            (at(0.3, 1.0), sphere, -0.7),
            (at(0.5, 1.0), plane, 0.3),
            (at(0.7, 1.0), cone, 0.5),
            (at(0.85, 1.0), sphere, 0.0),
            (at(1.0, 0.5), cylinder, 1.5),
        ];
        supports.sliding = slides
            .map(|(node, surface, force_ratio)| Sliding {
                node,
                surface,
                force_ratio,
            })
            .to_vec();
        supports.check(&model).unwrap();
        let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
        let start: Vec<f64> = (0..model.size())
            .map(|i| match supports.prescribed[i] {
                Some(prescribed) => prescribed,
                None => 0.01 * (1.7 * i as f64).sin(),
            })
            .collect();
        let before = equations(&model, &supports, &start, &mut workspace);
        newton::prescribe(&model, &supports, &start, &mut workspace);
        newton::solve(&model, &supports, &mut workspace).unwrap();
        let step = workspace.step.clone();
        let size = before.iter().map(|g| g * g).sum::<f64>().sqrt();
        let off = |length: f64| {
            let [up, down] = [length, -length].map(|by| {
                let moved: Vec<f64> = start.iter().zip(&step).map(|(x, dx)| x + by * dx).collect();
                equations(&model, &supports, &moved, &mut workspace)
            });
            let each = up.iter().zip(&down).zip(&before);
            each.map(|((up, down), before)| ((up - down) / (2.0 * length) + before).powi(2))
                .sum::<f64>()
                .sqrt()
                / size
        };
        let errors = [4e-2, 2e-2, 1e-2].map(off);
        println!("{errors:?}");
        assert!(errors[2] < 1e-4, "{errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.9..2.1).contains(&order), "{errors:?}");
        }
    }
}
