//! States with a closed form that elements only approach: a pressed sphere, a bar under its weight, a
//! field that is made up. Each is solved on ever finer meshes, and the order of convergence asserted.

use std::sync::Arc;

use palpate_mechanics::finite_elements::{
    Cavity, ElementKind, ElementMesh, Formulation, Supports, equilibrate,
};
use palpate_mechanics::{LinearElastic, Vec3};

use crate::bodies::{Body, KINDS, block, boundary, face};

/// Orders between meshes that halve.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

/// Lamé's thick sphere under inner pressure: u = p a³/(b³ − a³) ((1 − 2ν) r + (1 + ν) b³/(2 r²))/E.
/// Displacements of quadratic elements have order three.
#[test]
fn a_sphere_under_pressure() {
    let (inner, outer, young, pressure) = (0.5_f64, 1.0_f64, 3.0, 0.1);
    let cases = [
        (0.3, Formulation::Displacement),
        (0.3, Formulation::Mixed),
        (0.499_99, Formulation::Mixed),
    ];
    for (nu, formulation) in cases {
        let exact = |r: f64| {
            pressure * inner.powi(3) / (outer.powi(3) - inner.powi(3)) / young
                * ((1.0 - 2.0 * nu) * r + 0.5 * (1.0 + nu) * outer.powi(3) / (r * r))
        };
        let errors: Vec<f64> = [2, 4, 8, 16]
            .into_iter()
            .map(|cells| {
                let part = |i: usize| i as f64 / cells as f64;
                let radii: Vec<f64> = (0..=cells)
                    .map(|i| inner + (outer - inner) * part(i))
                    .collect();
                let angles: Vec<f64> = (0..=cells).map(part).collect();
                let mesh = ElementMesh::grid(&radii, &angles, |r, part| {
                    let (sine, cosine) = (part * std::f64::consts::FRAC_PI_2).sin_cos();
                    [r * if part == 1.0 { 0.0 } else { cosine }, r * sine]
                });
                let law = Arc::new(LinearElastic::new(young, nu).unwrap());
                let wall = mesh.nodes_where(|x| x.norm() < inner + 1e-9);
                let sides = wall.windows(3).step_by(2);
                let cavity = Cavity {
                    sides: sides
                        .map(|s| s.iter().map(|&n| n as u32).collect())
                        .collect(),
                };
                let mut body = Body::new(mesh, law, formulation);
                let (axis, base) = (
                    face(body.model.mesh(), 0, 0.0),
                    face(body.model.mesh(), 1, 0.0),
                );
                let supports = Supports::none(&body.model)
                    .fix(&body.model, axis, 0, 0.0)
                    .fix(&body.model, base, 1, 0.0)
                    .press(&cavity, pressure);
                equilibrate(&body.model, &supports, &mut body.state, &mut body.workspace).unwrap();
                body.off(|x| x + exact(x.norm()) * x.normalize()) / exact(inner)
            })
            .collect();
        println!(
            "nu {nu}, {formulation:?}: {errors:?}, orders {:.2?}",
            orders(&errors)
        );
        // Nodes do better than the rest of an element; never worse than order three.
        assert!(
            orders(&errors)[1..].iter().all(|order| *order > 2.8),
            "{errors:?}"
        );
        assert!(errors[3] < 1e-5, "{errors:?}");
    }
}

/// A column under its weight, without lateral contraction: u = −γ (L z − z²/2)/E, which quadratic
/// elements have exactly, however distorted the inside of a hexahedron is not.
#[test]
fn a_column_under_its_weight() {
    let weight = 0.2;
    let law = Arc::new(LinearElastic::new(3.0, 0.0).unwrap());
    for kind in KINDS {
        for formulation in [Formulation::Displacement, Formulation::Mixed] {
            let mut body = Body::new(block(kind, 2, 0.0), law.clone(), formulation);
            let load = body.model.body_load(|_, _| -weight * Vec3::y());
            let (low, axis) = (
                face(body.model.mesh(), 1, 0.0),
                face(body.model.mesh(), 0, 0.0),
            );
            let mut supports = Supports::none(&body.model)
                .fix(&body.model, low.iter().copied(), 1, 0.0)
                .fix(&body.model, axis, 0, 0.0)
                .load(&load);
            if kind != ElementKind::Quad9 {
                let side = face(body.model.mesh(), 2, 0.0);
                supports = supports.fix(&body.model, side, 2, 0.0);
            }
            equilibrate(&body.model, &supports, &mut body.state, &mut body.workspace).unwrap();
            let off = body.off(|x| x - weight / 3.0 * (x.y - 0.5 * x.y * x.y) * Vec3::y());
            // Newton's tolerance.
            assert!(off < 1e-8, "{kind:?} {formulation:?}: {off}");
            let volume = if kind == ElementKind::Quad9 {
                std::f64::consts::PI
            } else {
                1.0
            };
            assert!((body.force(&low, 1) / (weight * volume) - 1.0).abs() < 1e-8);
        }
    }
}

/// u = s (r sin z, r² cos z), with the load per volume that holds it in place:
/// b_r = (2 λ + 3 μ) r sin z, b_z = −(6 μ + λ (2 − r²) − 2 μ r²) cos z, times s. Distorted meshes.
#[test]
fn a_field_that_is_made_up() {
    for (nu, formulation) in [
        (0.3, Formulation::Displacement),
        (0.3, Formulation::Mixed),
        (0.45, Formulation::Mixed),
    ] {
        let law = LinearElastic::new(3.0, nu).unwrap();
        let (lame, shear) = (law.lame_modulus(), law.shear_modulus());
        let exact = |x: &Vec3| 0.1 * Vec3::new(x.x * x.y.sin(), x.x.powi(2) * x.y.cos(), 0.0);
        let density = |x: &Vec3| {
            let (r, (sine, cosine)) = (x.x, x.y.sin_cos());
            let along = 6.0 * shear + lame * (2.0 - r * r) - 2.0 * shear * r * r;
            0.1 * Vec3::new((2.0 * lame + 3.0 * shear) * r * sine, -along * cosine, 0.0)
        };
        let errors: Vec<f64> = [2, 4, 8, 16]
            .into_iter()
            .map(|cells| {
                let mesh = bent(cells);
                let mut body = Body::new(mesh, Arc::new(law), formulation);
                let load = body.model.body_load(|_, place| density(place));
                let mut supports = Supports::none(&body.model).load(&load);
                for node in boundary_of(&body) {
                    let place = body.model.mesh().nodes[node];
                    let at = exact(&place);
                    for axis in 0..2 {
                        supports = supports.fix(&body.model, [node], axis, at[axis]);
                    }
                }
                equilibrate(&body.model, &supports, &mut body.state, &mut body.workspace).unwrap();
                body.off(|x| x + exact(x))
            })
            .collect();
        println!(
            "nu {nu}, {formulation:?}: {errors:?}, orders {:.2?}",
            orders(&errors)
        );
        assert!(
            orders(&errors)[1..].iter().all(|order| *order > 2.8),
            "{errors:?}"
        );
    }
}

/// The unit square with its lines bent.
fn bent(cells: usize) -> ElementMesh {
    let line: Vec<f64> = (0..=cells).map(|i| i as f64 / cells as f64).collect();
    let wave = |x: f64| (std::f64::consts::PI * x).sin();
    ElementMesh::grid(&line, &line, |r, z| {
        [
            r + 0.1 * wave(r) * wave(2.0 * z),
            z + 0.1 * wave(z) * wave(r),
        ]
    })
}

fn boundary_of(body: &Body) -> Vec<usize> {
    boundary(body.model.mesh())
}
