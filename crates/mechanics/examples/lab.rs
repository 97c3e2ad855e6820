//! Lab.
use palpate_geometry::*;
use palpate_mechanics::LinearElastic;
use palpate_mechanics::nonlinear::*;
fn main() {
    // A block 100 x 100 x 50 mm, bottom held; load at the middle of the top.
    let nu: f64 = std::env::args()
        .nth(1)
        .and_then(|x| x.parse().ok())
        .unwrap_or(0.45);
    let law = LinearElastic::new(1e4, nu).unwrap();
    let g = law.shear_modulus();
    for cells in [2, 4, 6] {
        let mesh = TetrahedronMesh::block(
            Vec3::new(-0.05, -0.05, -0.05),
            Vec3::new(0.05, 0.05, 0.0),
            [2 * cells, 2 * cells, cells],
        )
        .unwrap();
        let moduli =
            vec![Moduli::mooney_rivlin(0.5 * g, 0.0, nu).unwrap(); mesh.tetrahedra().len()];
        let model = NonlinearModel::new(
            &mesh,
            &moduli,
            |_, p| p.z < -0.0499,
            |_, p| p.z > -1e-9 && p.norm() < 0.04,
        )
        .unwrap();
        let state = NonlinearState::at_rest(&model, 1);
        let mut load = model.spread_load();
        let h = 0.05 / cells as f64;
        for radius in [0.01, 0.015, 0.02, 0.03] {
            for off in [0.0, 0.3, 0.5] {
                model.boundary().spread(
                    &Vec3::new(off * h, off * 0.5 * h, 0.0),
                    &Vec3::z(),
                    radius,
                    &mut load,
                );
                let c = model.compliance(&state, (&load.nodes, &load.nodes));
                let [t, n] = load.own_compliance(&law);
                let a = load.radius / 1.7;
                let tip = (1.0 - nu * nu) / (2.0 * a * 1e4);
                println!(
                    "{} nodes h {:.1} mm R {:.1} mm off {off}: {} loaded, ext n {:+.3} t {:+.3} of the tip's",
                    model.nodes().len(),
                    1e3 * h,
                    1e3 * load.radius,
                    load.nodes.len(),
                    (c[(2, 2)] - n) / tip,
                    (c[(0, 0)] - t) / tip
                );
            }
        }
    }
}
