//! Homogeneous states of distorted meshes: the patch test, and large stretches.
//!
//! Judge: the law itself at one point, and closed forms.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::{Matrix3, Rotation3};
use palpate_mechanics::finite_elements::uniaxial::nominal_stress;
use palpate_mechanics::finite_elements::{ElementKind, Formulation, Supports};
use palpate_mechanics::{Exponential, Law, LinearElastic, MooneyRivlin, NeoHookean, Vec3};

use crate::bodies::{Body, KINDS, at_map, block, boundary, face};

/// Gradients that the kind can have: an axisymmetric body stretches alike in all radial directions.
fn gradient(kind: ElementKind, size: f64) -> Matrix3<f64> {
    let f = match kind {
        // r and z are the first two coordinates of the mesh.
        ElementKind::Quad9 => Matrix3::from_diagonal(&[0.3, -0.5, 0.3].into()),
        _ => Matrix3::new(0.3, 0.2, -0.1, 0.1, -0.4, 0.3, -0.2, 0.1, 0.2),
    };
    Matrix3::identity() + size * f
}

/// Volume of the block [m³].
fn volume(kind: ElementKind) -> f64 {
    if kind == ElementKind::Quad9 { PI } else { 1.0 }
}

/// Boundary nodes at an affine map: all others follow, the energy is that of the point, and the faces
/// feel its stress. Both formulations, at small strain and at large.
#[test]
fn patch_test() {
    let neo = NeoHookean::compressible(1.0, 3.0).unwrap();
    let laws: [(Arc<dyn Law>, f64); 4] = [
        (Arc::new(LinearElastic::new(3.0, 0.3).unwrap()), 1.0),
        (Arc::new(LinearElastic::new(3.0, 0.489).unwrap()), 1.0),
        (Arc::new(neo), 0.5),
        (
            Arc::new(Exponential::compressible(1.0, 1.0, 5.0).unwrap()),
            0.5,
        ),
    ];
    for kind in KINDS {
        for (law, size) in &laws {
            for formulation in [Formulation::Displacement, Formulation::Mixed] {
                let name = format!("{kind:?} {law:?} {formulation:?}");
                let f = gradient(kind, *size);
                let mut body = Body::new(block(kind, 2, 0.4), law.clone(), formulation);
                let held = boundary(body.model.mesh());
                body.solve(|model| at_map(model, &held, &f)).unwrap();
                // Newton's tolerance.
                let off = body.off(|x| f * x);
                assert!(off < 1e-7, "{name}: {off}");
                let energy = law.energy(&f) * volume(kind);
                let found = body.workspace.energy();
                assert!(
                    (found / energy - 1.0).abs() < 1e-7,
                    "{name}: {found}, {energy}"
                );
                let top = face(body.model.mesh(), 1, 1.0);
                let stress = law.stress(&f);
                let traction = body.force(&top, 1) / volume(kind);
                let off = (traction - stress[(1, 1)]).abs();
                assert!(off < 1e-6 * stress.norm(), "{name}: {traction}, {stress}");
            }
        }
    }
}

/// Incompressible and compressible bars, their sides free, from half to thrice the length.
#[test]
fn a_bar_is_stretched() {
    let laws: [Arc<dyn Law>; 5] = [
        Arc::new(NeoHookean::incompressible(1.0).unwrap()),
        Arc::new(NeoHookean::compressible(1.0, 5.0).unwrap()),
        Arc::new(MooneyRivlin::incompressible(0.6, 0.4).unwrap()),
        Arc::new(Exponential::incompressible(2.0, 0.3).unwrap()),
        Arc::new(LinearElastic::new(6.0, 0.45).unwrap()),
    ];
    for kind in KINDS {
        for law in &laws {
            let mut body = Body::new(block(kind, 2, 0.3), law.clone(), Formulation::Mixed);
            let low = [0, 1, 2].map(|axis| face(body.model.mesh(), axis, 0.0));
            let top = face(body.model.mesh(), 1, 1.0);
            let steps = [0.8, 0.6, 0.5, 0.8, 1.2, 1.6, 2.0, 2.5, 3.0];
            for stretch in steps {
                body.solve(|model| {
                    let mut supports = Supports::none(model)
                        .fix(model, low[1].iter().copied(), 1, 0.0)
                        .fix(model, low[0].iter().copied(), 0, 0.0)
                        .fix(model, top.iter().copied(), 1, stretch - 1.0);
                    if kind != ElementKind::Quad9 {
                        supports = supports.fix(model, low[2].iter().copied(), 2, 0.0);
                    }
                    supports
                })
                .unwrap();
                let found = body.force(&top, 1) / volume(kind);
                let exact = nominal_stress(law.as_ref(), stretch).unwrap();
                // Newton's tolerance, over the pressure's reach.
                let off = (found - exact).abs();
                assert!(
                    off < 1e-6 * (1.0 + exact.abs()),
                    "{kind:?} {law:?} {stretch}: {off}"
                );
            }
        }
    }
}

/// Two directions alike; the third is free.
#[test]
fn a_sheet_is_stretched_two_ways() {
    let (c10, c01) = (0.6, 0.4);
    let law = Arc::new(MooneyRivlin::incompressible(c10, c01).unwrap());
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        let mut body = Body::new(block(kind, 2, 0.3), law.clone(), Formulation::Mixed);
        let faces = |at: f64| [0, 1, 2].map(|axis| face(body.model.mesh(), axis, at));
        let (low, high) = (faces(0.0), faces(1.0));
        for stretch in [1.3, 1.6, 2.0, 2.5, 3.0_f64] {
            body.solve(|model| {
                let mut supports = Supports::none(model);
                for (axis, low) in low.iter().enumerate() {
                    supports = supports.fix(model, low.iter().copied(), axis, 0.0);
                }
                for (axis, high) in high.iter().enumerate().take(2) {
                    supports = supports.fix(model, high.iter().copied(), axis, stretch - 1.0);
                }
                supports
            })
            .unwrap();
            let exact = 2.0 * (stretch - stretch.powi(-5)) * (c10 + c01 * stretch.powi(2));
            for (axis, high) in high.iter().enumerate().take(2) {
                let found = body.force(high, axis);
                assert!(
                    (found / exact - 1.0).abs() < 1e-6,
                    "{kind:?} {stretch}: {found}"
                );
            }
        }
    }
}

/// τ = 2 (C10 + C01) k, whatever the pressure, which nothing determines here.
#[test]
fn a_block_is_sheared() {
    let law = Arc::new(MooneyRivlin::incompressible(0.6, 0.4).unwrap());
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        let mut body = Body::new(block(kind, 2, 0.3), law.clone(), Formulation::Mixed);
        let held = boundary(body.model.mesh());
        let top = face(body.model.mesh(), 1, 1.0);
        for amount in [0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0] {
            let f = Matrix3::identity() + amount * Vec3::x() * Vec3::y().transpose();
            body.solve(|model| at_map(model, &held, &f)).unwrap();
            assert!(body.off(|x| f * x) < 1e-7, "{kind:?} {amount}");
            let found = body.force(&top, 0);
            assert!(
                (found / (2.0 * amount) - 1.0).abs() < 1e-6,
                "{kind:?} {amount}: {found}"
            );
        }
    }
}

/// A turned block carries no force and no energy; a stretched and turned one the turned forces.
#[test]
fn forces_turn_with_the_body() {
    let law = Arc::new(MooneyRivlin::compressible(0.6, 0.4, 7.0).unwrap());
    let turn = *Rotation3::new(Vec3::new(0.9, -1.4, 0.5)).matrix();
    for kind in [ElementKind::Hex27, ElementKind::Tet10] {
        for formulation in [Formulation::Displacement, Formulation::Mixed] {
            let mut body = Body::new(block(kind, 2, 0.3), law.clone(), formulation);
            let held = boundary(body.model.mesh());
            let top = face(body.model.mesh(), 1, 1.0);
            for stretch in [Matrix3::identity(), gradient(kind, 0.4)] {
                let f = turn * stretch;
                // Begin there: halfway the turned boundary would fold the inside.
                for node in 0..body.model.mesh().nodes.len() {
                    let x = body.model.mesh().nodes[node];
                    let moved = f * x - x;
                    for axis in 0..3 {
                        body.state.unknowns[3 * node + axis] = moved[axis];
                    }
                }
                body.solve(|model| at_map(model, &held, &f)).unwrap();
                assert!(body.off(|x| f * x) < 1e-7);
                let force = Vec3::from_fn(|axis, _| body.force(&top, axis));
                let exact = turn * law.stress(&stretch) * Vec3::y();
                // Newton's tolerance on stresses of the order of one.
                assert!(
                    (force - exact).norm() < 1e-6,
                    "{kind:?} {formulation:?}: {force} {exact}"
                );
            }
        }
    }
}
