use std::sync::Arc;

use nalgebra::Rotation3;
use palpate_geometry::TetrahedronMesh;

use super::super::super::mesh::ElementMesh;
use super::super::super::model::{FiniteElementWorkspace, Formulation};
use super::super::super::solid::faces;
use super::super::shape::RigidShape;
use super::*;
use crate::NeoHookean;

/// Judge: central differences, of corners that stick and that slip.
#[test]
fn the_tangent_is_the_derivative_of_the_forces() {
    let mesh = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(1.0), [2; 3]).unwrap();
    let elements = ElementMesh::from_tetrahedra(&mesh);
    let sides = faces(&mesh);
    let top = |node: usize| mesh.vertices()[node].z > 0.99;
    let sides = sides.iter().map(|face| face.nodes);
    let surface = ContactSurface::new(sides, &elements.nodes, top);
    let law = Arc::new(NeoHookean::compressible(1.0, 4.0).unwrap());
    let model = FiniteElementModel::new(elements, law, Formulation::Mixed)
        .unwrap()
        .with_couplings(Vec::new(), surface.couplings())
        .unwrap();
    let tools = [RigidTool {
        shape: RigidShape::Sphere { radius: 1.0 },
        orientation: Rotation3::identity(),
        friction: FrictionLaw::Coulomb(0.02),
        path: vec![Vec3::new(0.4, 0.6, 2.01), Vec3::new(0.43, 0.6, 1.9)],
    }];
    let moved = |scale: f64, shift: f64| -> Vec<f64> {
        let each = 0..model.size();
        each.map(|i| scale * (1.7 * i as f64 + shift).sin())
            .collect()
    };
    let mut contacts = Contacts::new(&surface, &tools);
    let start = moved(0.002, 0.0);
    contacts.update_facing(&model, &start);
    contacts.close_increment(&model, &start);
    contacts = contacts.moved(1.0);
    contacts.augment(&model, &start);
    contacts.close_increment(&model, &start);
    for contact in contacts.contacts.iter_mut().step_by(2) {
        contact.pressure *= 0.01;
    }
    let unknowns = moved(0.004, 0.3);
    contacts.augment(&model, &unknowns);
    let mut workspace = FiniteElementWorkspace::new(&model).unwrap();
    let forces = |unknowns: &[f64]| {
        let mut out = vec![0.0; model.size()];
        contacts.add_forces(&model, unknowns, -1.0, &mut out);
        out
    };
    let (residual, tangent) = (&mut workspace.residual, &mut workspace.tangent);
    contacts.assemble(&model, &unknowns, residual, tangent);
    let acting = contacts.acting(&model, &unknowns);
    let slips: Vec<bool> = acting.map(|(_, _, forces)| forces.slips).collect();
    assert!(slips.contains(&true) && slips.contains(&false), "{slips:?}");
    let direction = moved(1.0, 1.1);
    let mut product = vec![0.0; model.size()];
    model.pattern.multiply(tangent, &direction, &mut product);
    let step = 1e-6;
    let [up, down] = [step, -step].map(|by| {
        let moved: Vec<f64> = unknowns
            .iter()
            .zip(&direction)
            .map(|(x, d)| x + by * d)
            .collect();
        forces(&moved)
    });
    let size = product.iter().map(|x| x * x).sum::<f64>().sqrt();
    let each = up.iter().zip(&down).zip(&product);
    let off = each.map(|((up, down), product)| ((up - down) / (2.0 * step) - product).powi(2));
    let off = off.sum::<f64>().sqrt();
    println!("{off} of {size}");
    assert!(off < 1e-7 * size, "{off} of {size}");
}
