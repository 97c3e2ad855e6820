//! Energy, residual and tangent of deformed bodies, compared with one another.
//!
//! Judge: central differences, whose error falls with the square of the step.

use std::sync::Arc;

use super::cavity::Cavity;
use super::element::ElementKind;
use super::mesh::ElementMesh;
use super::model::{FiniteElementModel, FiniteElementWorkspace, Formulation};
use super::newton;
use super::supports::Supports;
use crate::{Exponential, Law, LinearElastic, MooneyRivlin, NeoHookean, Vec3};

/// Two elements of a kind, with their nodes shaken.
fn body(kind: ElementKind) -> ElementMesh {
    let mut random = Random(3);
    let mut mesh = match kind {
        ElementKind::Quad9 => {
            ElementMesh::grid(&[0.0, 0.4, 1.0], &[0.0, 1.0], |r, z| [r + 0.1 * z, z])
        }
        _ => {
            let nodes = (0..kind.nodes())
                .map(|node| Vec3::from(kind.node_coordinates(node)))
                .collect();
            let elements = (0..kind.nodes() as u32).collect();
            ElementMesh {
                kind,
                nodes,
                elements,
            }
        }
    };
    for node in &mut mesh.nodes {
        if node.x > 0.0 || kind != ElementKind::Quad9 {
            let shake = Vec3::from_fn(|_, _| 0.03 * random.sign());
            *node += if kind == ElementKind::Quad9 {
                Vec3::new(shake.x, shake.y, 0.0)
            } else {
                shake
            };
        }
    }
    mesh
}

/// A wall of one side, of any nodes: what it encloses is a polynomial of their places whichever they are.
fn wall(kind: ElementKind) -> Cavity {
    let nodes = match kind {
        ElementKind::Quad9 => 3,
        ElementKind::Hex27 => 9,
        ElementKind::Tet10 => 6,
    };
    Cavity {
        sides: vec![(0..nodes).collect()],
    }
}

struct Random(u64);

impl Random {
    /// Even in [-1, 1), by Knuth's constants.
    fn sign(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Law, formulation.
fn cases() -> Vec<(Arc<dyn Law>, Formulation)> {
    use Formulation::{Displacement, Mixed};
    let neo = || NeoHookean::compressible(1.0, 4.0).unwrap();
    vec![
        (
            Arc::new(LinearElastic::new(3.0, 0.3).unwrap()),
            Displacement,
        ),
        (Arc::new(LinearElastic::new(3.0, 0.499).unwrap()), Mixed),
        (Arc::new(neo()), Displacement),
        (Arc::new(neo()), Mixed),
        (Arc::new(NeoHookean::incompressible(1.0).unwrap()), Mixed),
        (
            Arc::new(MooneyRivlin::incompressible(0.7, 0.3).unwrap()),
            Mixed,
        ),
        (
            Arc::new(Exponential::compressible(2.0, 1.5, 9.0).unwrap()),
            Displacement,
        ),
        (
            Arc::new(Exponential::incompressible(2.0, 1.5).unwrap()),
            Mixed,
        ),
    ]
}

/// Residual and K · direction.
fn evaluate(
    model: &FiniteElementModel,
    at: &[f64],
    direction: &[f64],
    workspace: &mut FiniteElementWorkspace,
) -> (Vec<f64>, Vec<f64>, f64) {
    newton::assemble(model, &Supports::none(model), at, workspace).unwrap();
    let mut product = vec![0.0; at.len()];
    model
        .pattern
        .multiply(&workspace.tangent, direction, &mut product);
    (workspace.residual.clone(), product, workspace.energy)
}

fn moved(at: &[f64], direction: &[f64], by: f64) -> Vec<f64> {
    at.iter().zip(direction).map(|(x, d)| x + by * d).collect()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Errors of the differences for falling steps: order two, or nothing but rounding.
fn falls_with_the_square(name: &str, size: f64, errors: [f64; 3]) {
    let rounding = 1e-9 * size;
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(
            (1.8..2.2).contains(&order) || pair[1] < rounding,
            "{name}: {errors:?} of {size}"
        );
    }
    assert!(errors[2] < 1e-3 * size, "{name}: {errors:?} of {size}");
}

#[test]
fn tangent_is_the_derivative_of_the_residual() {
    for kind in [ElementKind::Quad9, ElementKind::Hex27, ElementKind::Tet10] {
        for (law, formulation) in cases() {
            let name = format!("{kind:?} {law:?} {formulation:?}");
            let model = FiniteElementModel::new(body(kind), law, formulation).unwrap();
            let model = model.with_fluids(vec![wall(kind)]).unwrap();
            let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
            let mut random = Random(5);
            let count = model.displacements();
            let at: Vec<f64> = (0..model.size())
                .map(|i| random.sign() * if i < count { 0.02 } else { 1.0 })
                .collect();
            let mut direction: Vec<f64> = at.iter().map(|_| random.sign()).collect();
            // Nodes of the axis stay on it, or the hoop terms divide by nothing.
            for (node, place) in model.mesh.nodes.iter().enumerate() {
                if kind == ElementKind::Quad9 && place.x == 0.0 {
                    direction[2 * node] = 0.0;
                }
            }
            // The pressure's own block carries a further −ε/μ, which the residual lacks.
            let (_, product, _) = evaluate(&model, &at, &direction, &mut workspace);
            let steps = [4e-3, 2e-3, 1e-3];
            let errors = steps.map(|step| {
                let [up, down] = [step, -step].map(|by| {
                    evaluate(
                        &model,
                        &moved(&at, &direction, by),
                        &direction,
                        &mut workspace,
                    )
                    .0
                });
                let off: Vec<f64> = (0..at.len())
                    .map(|i| (up[i] - down[i]) / (2.0 * step) - product[i])
                    .collect();
                norm(&off[..count])
            });
            falls_with_the_square(&name, norm(&product[..count]), errors);
        }
    }
}

#[test]
fn residual_is_the_derivative_of_the_energy() {
    for kind in [ElementKind::Quad9, ElementKind::Hex27, ElementKind::Tet10] {
        for (law, formulation) in cases() {
            if formulation == Formulation::Mixed {
                // Its stationary functional is another.
                continue;
            }
            let name = format!("{kind:?} {law:?}");
            let model = FiniteElementModel::new(body(kind), law, formulation).unwrap();
            let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
            let mut random = Random(7);
            let at: Vec<f64> = (0..model.size()).map(|_| 0.02 * random.sign()).collect();
            let direction: Vec<f64> = at.iter().map(|_| random.sign()).collect();
            let (residual, _, _) = evaluate(&model, &at, &direction, &mut workspace);
            let work: f64 = residual.iter().zip(&direction).map(|(r, d)| r * d).sum();
            let errors = [4e-3, 2e-3, 1e-3].map(|step| {
                let [up, down] = [step, -step].map(|by| {
                    evaluate(
                        &model,
                        &moved(&at, &direction, by),
                        &direction,
                        &mut workspace,
                    )
                    .2
                });
                ((up - down) / (2.0 * step) - work).abs()
            });
            falls_with_the_square(&name, norm(&residual) * norm(&direction), errors);
        }
    }
}
