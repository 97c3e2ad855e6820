//! Finer integration and a stricter iteration give what the finest gives.

use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{FiniteSphereSettings, Form, Integration, Solver};

use crate::contacts::{RADIUS, Random, bare_contact, model, tries};

/// The three integrations are calibrated on the same half-space, so they can differ in what they make
/// of curvature only; that difference must fall.
#[test]
fn finer_integration_changes_the_force_less() {
    for nu in [0.3, 0.45] {
        let levels = [
            Integration::Coarse,
            Integration::Standard,
            Integration::Fine,
        ];
        let models = levels.map(|integration| {
            let settings = FiniteSphereSettings {
                integration,
                ..FiniteSphereSettings::default()
            };
            model(settings, nu, Friction::Frictionless)
        });
        let counts = [0, 1, 2].map(|k| models[k].integration_points());
        assert_eq!(counts, [128, 414, 960]);
        let mut random = Random(1);
        let mut worst = [0.0f64; 2];
        for _ in 0..tries(300) {
            // Radii of curvature down to 20 mm.
            let contact = bare_contact(random.curvature(0.02, 1.0), 2e-3, RADIUS);
            let forces = [0, 1, 2].map(|k| {
                let response = models[k].respond(&contact, &mut models[k].workspace());
                response.stiffness[(2, 2)]
            });
            for k in 0..2 {
                worst[k] = worst[k].max((forces[k] / forces[2] - 1.0).abs());
            }
        }
        println!("nu {nu}: off the 960 points by {worst:?}");
        assert!(worst[1] < 0.5 * worst[0], "nu {nu}: {worst:?}");
        // Well inside the 5 % that are promised of the force.
        assert!(worst[1] < 0.02, "nu {nu}: {worst:?}");
    }
}

/// The force of the iteration is off by no more than the condition of the scaled matrix times the
/// residual that is asked for, and falls with it.
#[test]
fn a_smaller_residual_gives_a_better_force() {
    let contact = bare_contact([20.0, 3.0, 8.0].into(), 2e-3, RADIUS);
    for form in [Form::Weak, Form::Strong] {
        let with = |solver| {
            let settings = FiniteSphereSettings {
                form,
                solver,
                ..FiniteSphereSettings::default()
            };
            // What is calibrated is solved by the same iteration; only the contact shall differ.
            let model = model(settings, 0.45, Friction::Frictionless);
            let mut workspace = model.workspace();
            let response = model.respond(&contact, &mut workspace);
            (response.stiffness[(2, 2)], workspace.iterations())
        };
        let (exact, _) = with(Solver::Direct);
        let table: Vec<(f64, f64, usize)> = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10]
            .into_iter()
            .map(|tolerance| {
                let (found, iterations) = with(Solver::Gmres { tolerance });
                (tolerance, (found / exact - 1.0).abs(), iterations)
            })
            .collect();
        println!("{form:?}: residual, error of the force, iterations: {table:?}");
        for row in &table {
            assert!(row.1 < 1e3 * row.0, "{form:?}: {table:?}");
        }
        assert!(
            table.windows(2).all(|pair| pair[1].2 > pair[0].2),
            "{table:?}"
        );
        assert!(
            table[4].1 < 1e-2 * table[0].1 || table[4].1 < 1e-9,
            "{table:?}"
        );
    }
}
