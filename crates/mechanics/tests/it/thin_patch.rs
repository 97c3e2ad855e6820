//! A patch on a solid that is thin there.

use palpate_mechanics::contact::Friction;
use std::sync::Arc;

use palpate_geometry::{Organ, Surface, TriangleMesh};
use palpate_mechanics::finite_elements::solid::{Body, MovedPatch, SolidProblem};
use palpate_mechanics::{LinearElastic, Vec3};

use crate::solid::{MODULUS, at, plane};

/// A kidney pressed flat, touched at its foremost point, which the first filling does not reach. Judge: small triangles
/// of its surface within the sphere, counted; each triangle in 400, so that their border is known to a hundredth.
/// Tolerance: 5 %, at which a filling is taken, and that hundredth.
#[test]
#[ignore = "long"]
fn a_patch_on_a_thin_edge_has_its_area() {
    let round = Organ::Kidney.surface_mesh(5_000).unwrap();
    let flat = round
        .vertices()
        .iter()
        .map(|v| v.component_mul(&Vec3::new(1.0, 1.0, 0.12)));
    let surface =
        Surface::new(TriangleMesh::new(flat.collect(), round.triangles().to_vec()).unwrap())
            .unwrap();
    let mesh = surface.mesh();
    let foremost = mesh.vertices().iter().max_by(|a, b| a.x.total_cmp(&b.x));
    let (center, radius) = (*foremost.unwrap(), 0.002);
    let counted: f64 = mesh
        .triangle_ids()
        .map(|id| {
            let [a, b, c] = mesh.positions(id);
            let small = (b - a).cross(&(c - a)).norm() / 2.0 / 400.0;
            let at = |i: f64, j: f64| a + ((b - a) * i + (c - a) * j) / 20.0;
            let rows = (0..20).flat_map(|i| (0..20 - i).map(move |j| (f64::from(i), f64::from(j))));
            let inside = rows.flat_map(|(i, j)| {
                let third = 1.0 / 3.0;
                let upper = (i + j < 19.0 - 0.5).then(|| at(i + 2.0 * third, j + 2.0 * third));
                [Some(at(i + third, j + third)), upper]
            });
            let inside = inside.flatten().filter(|p| (p - center).norm() < radius);
            small * inside.count() as f64
        })
        .sum();
    let (low, high) = mesh.bounds();
    let problem = SolidProblem {
        patch: Some(MovedPatch {
            center,
            radius,
            displacement: -1e-4 * Vec3::x(),
            friction: Friction::Frictionless,
        }),
        ..SolidProblem::new(
            Body::Surface(surface.clone()),
            plane(low + 0.3 * (high - low), Vec3::x()),
            Arc::new(LinearElastic::new(MODULUS, 0.45).unwrap()),
        )
    };
    let answer = at(&problem, 0);
    println!(
        "{} m2, counted {counted}, {} unknowns",
        answer.patch_area, answer.unknowns
    );
    assert!(
        (answer.patch_area / counted - 1.0).abs() < 0.06,
        "{}",
        answer.patch_area / counted
    );
    let thin = answer
        .warnings
        .iter()
        .find(|warning| warning.contains("thin at the patch"));
    assert_eq!(thin, None);
}
