//! The local model against closed forms of the hemisphere, and its variants against one another.

use nalgebra::Vector3;
use palpate_geometry::{AabbTree, Organ, Surface};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use palpate_mechanics::finite_spheres::{
    Assembly, EXTERIOR_CONSTANTS, FiniteSphereModel, FiniteSphereSettings, Form, Integration,
    LocalContact, Placement, Solver, Surroundings, first_direction,
};

use crate::contacts::{
    RADIUS, Random, bare_contact, contact_near, model, organ, shaken_hemisphere, tissue, tries,
};

const DEFAULT: fn() -> FiniteSphereSettings = FiniteSphereSettings::default;

fn normal_stiffness(model: &FiniteSphereModel, contact: &LocalContact) -> f64 {
    model.respond(contact, &mut model.workspace()).stiffness[(2, 2)]
}

/// Judge: finite elements, condensed into F = K d/(1 − k_o a/R) for a flat tip on a hemisphere held at
/// its base, K being the half-space's. The bound of 5 % is what is promised of the source's 34
/// particles; three unrelated meshes and places away from the pole show that it is not the mesh.
#[test]
#[ignore = "long"]
fn hemisphere_meets_its_closed_form() {
    let meshes = [
        ("built-in, 1000", organ(Organ::Hemisphere, 1_000)),
        ("built-in, 9000", organ(Organ::Hemisphere, 9_000)),
        ("shaken parallels", shaken_hemisphere(23, 61)),
    ];
    let places = [
        Vec3::z(),
        Vec3::new(0.13, 0.07, 1.0),
        Vec3::new(-0.2, 0.31, 1.0),
    ];
    let mut worst: f64 = 0.0;
    for row in EXTERIOR_CONSTANTS {
        for bond in [Friction::Frictionless, Friction::Bonded] {
            let model = model(DEFAULT(), row.poissons_ratio, bond);
            for radius in [2e-3, 3e-3] {
                let half_space = half_space_stiffness(&tissue(row.poissons_ratio), radius, bond);
                let exact = half_space / (1.0 - row.organ_size * radius / RADIUS);
                for (name, surface) in &meshes {
                    for place in places {
                        let near = place.normalize() * RADIUS;
                        let contact = contact_near(surface, &model, &near, radius);
                        let off = normal_stiffness(&model, &contact) / exact - 1.0;
                        println!(
                            "nu {}, {bond:?}, a {radius}, {name}: {:+.2} %",
                            row.poissons_ratio,
                            100.0 * off
                        );
                        worst = worst.max(off.abs());
                    }
                }
            }
        }
    }
    println!("largest deviation {:.2} %", 100.0 * worst);
    assert!(worst < 0.05, "{worst}");
}

/// Judge: the half-space, which the model is calibrated on: exact but for rounding for the normal force,
/// and for the tangential one but for the shells' unequal stiffness along the two tangents.
#[test]
fn flat_contact_is_the_half_space() {
    for form in [Form::Weak, Form::Strong] {
        for nu in [0.0, 0.3, 0.4, 0.45, 0.49] {
            for bond in [Friction::Frictionless, Friction::Bonded] {
                let model = model(FiniteSphereSettings { form, ..DEFAULT() }, nu, bond);
                let contact = bare_contact(Vector3::zeros(), 2e-3, f64::INFINITY);
                let found = model.respond(&contact, &mut model.workspace()).stiffness;
                let normal = half_space_stiffness(&tissue(nu), 2e-3, bond);
                let off = found[(2, 2)] / normal - 1.0;
                // Rounding through two small systems.
                assert!(off.abs() < 1e-12, "{form:?} {nu} {bond:?}: {off}");
                if bond == Friction::Frictionless {
                    assert_eq!(found[(0, 0)], 0.0);
                    continue;
                }
                let tangential = half_space_tangential_stiffness(&tissue(nu), 2e-3);
                let off = [0, 1].map(|k| found[(k, k)] / tangential - 1.0);
                println!("{form:?}, nu {nu}: tangential {off:?}");
                // Ten and six in a ring are not round; a few thousandths are measured.
                assert!(off.iter().all(|o| o.abs() < 5e-3), "{form:?} {nu}: {off:?}");
            }
        }
    }
}

/// Judge: the direct factors of the same equations.
#[test]
fn gmres_meets_the_factors() {
    let mut random = Random(1);
    for form in [Form::Weak, Form::Strong] {
        for nu in [0.3, 0.45] {
            let settings = |solver| FiniteSphereSettings {
                form,
                solver,
                ..DEFAULT()
            };
            let direct = model(settings(Solver::Direct), nu, Friction::Bonded);
            let iterated = model(
                settings(Solver::Gmres { tolerance: 1e-12 }),
                nu,
                Friction::Bonded,
            );
            let (mut one, mut other) = (direct.workspace(), iterated.workspace());
            let mut worst: f64 = 0.0;
            for _ in 0..tries(100) {
                let curvature = random.curvature(direct.spacing(2e-3), 0.5);
                let contact = bare_contact(curvature, 2e-3, RADIUS);
                let exact = direct.respond(&contact, &mut one).stiffness;
                let found = iterated.respond(&contact, &mut other).stiffness;
                worst = worst.max((found - exact).norm() / exact.norm());
                assert!(other.iterations() > 3 && one.iterations() == 0);
            }
            println!(
                "{form:?}, nu {nu}: {worst:.1e}, {} iterations",
                other.iterations()
            );
            // The residual is relative 1e-12; scaled rows leave a condition below 1e4.
            assert!(worst < 1e-8, "{form:?} {nu}: {worst}");
        }
    }
}

/// The two forms share only the particles and the calibration. On the hemisphere of 50 mm they agree as
/// well as its closed form is known, 5 %, and at ν = 0.45 within a tenth on every contact with radii down
/// to 20 mm. At ν = 0.3 the strong form answers to other curvatures as no solid does, by tens of percent;
/// that is printed here, not promised.
#[test]
fn weak_meets_strong() {
    let mut random = Random(2);
    for nu in [0.3, 0.45] {
        let [weak, strong] = [Form::Weak, Form::Strong].map(|form| {
            model(
                FiniteSphereSettings { form, ..DEFAULT() },
                nu,
                Friction::Frictionless,
            )
        });
        let off = |curvature: Vector3<f64>| {
            let contact = bare_contact(curvature, 2e-3, RADIUS);
            normal_stiffness(&strong, &contact) / normal_stiffness(&weak, &contact) - 1.0
        };
        let round = [-0.5, 0.0, 0.5, 1.0].map(|k| off(Vector3::new(k, 0.0, k) / RADIUS));
        println!("nu {nu}: strong off weak on round contacts by {round:.4?}");
        for limit in [10.0, 20.0, 50.0] {
            let worst = (0..tries(300))
                .map(|_| off(random.curvature(1.0, limit)).abs())
                .fold(0.0, f64::max);
            println!("nu {nu}: curvatures up to {limit} 1/m: {worst:.4}");
            assert!(nu < 0.45 || worst < 0.1, "nu {nu}, {limit} 1/m: {worst}");
        }
        assert!(round[3].abs() < 0.05, "nu {nu}: {round:?}");
    }
}

/// Judge: the same template solved for each contact. 3 % is the price that interpolation between
/// curvatures may have.
#[test]
fn reused_solutions_meet_assembled_ones() {
    let mut random = Random(3);
    for nu in [0.3, 0.45] {
        let [every, reused] = [Assembly::EveryStep, Assembly::Reused].map(|assembly| {
            model(
                FiniteSphereSettings {
                    assembly,
                    ..DEFAULT()
                },
                nu,
                Friction::Bonded,
            )
        });
        let (mut one, mut other) = (every.workspace(), reused.workspace());
        let (mut normal, mut tangential): (f64, f64) = (0.0, 0.0);
        for _ in 0..tries(2_000) {
            // Beyond 0.6 either model takes the cap as gentler.
            let contact = bare_contact(random.curvature(every.spacing(2e-3), 0.6), 2e-3, RADIUS);
            let exact = every.respond(&contact, &mut one).stiffness;
            let found = reused.respond(&contact, &mut other).stiffness;
            normal = normal.max((found[(2, 2)] / exact[(2, 2)] - 1.0).abs());
            let block = (found - exact).fixed_view::<2, 2>(0, 0).norm();
            tangential = tangential.max(block / exact.fixed_view::<2, 2>(0, 0).norm());
        }
        println!("nu {nu}: reused off by {normal:.4}, along {tangential:.4}");
        assert!(normal < 0.03, "nu {nu}: {normal}");
        assert!(tangential < 0.03, "nu {nu}: {tangential}");
    }
}

/// The source's placement follows the triangles, which shakes the particles by a tenth or two of their
/// spacing; random shaking of that size spreads the weak form's force by 2 to 6 % (standard
/// deviation).
#[test]
fn source_placement_meets_the_template() {
    let surface = organ(Organ::Liver, 6_000);
    let tree = AabbTree::new(surface.mesh());
    let radius = 2e-3;
    for nu in [0.3, 0.45] {
        let template = model(DEFAULT(), nu, Friction::Frictionless);
        let mut source = model(
            FiniteSphereSettings {
                placement: Placement::Source,
                ..DEFAULT()
            },
            nu,
            Friction::Frictionless,
        );
        source.precompute_placement(&surface, &tree, radius);
        let mut ratios = ratios_over(&surface, &template, &source, radius);
        ratios.sort_by(f64::total_cmp);
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let variance = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / ratios.len() as f64;
        let spread = variance.sqrt();
        println!(
            "nu {nu}: source over template {mean:.4} +- {spread:.4}, {:.4} to {:.4}",
            ratios[0],
            ratios[ratios.len() - 1]
        );
        assert!((mean - 1.0).abs() < 0.06, "nu {nu}: {mean}");
        assert!(spread < 0.06, "nu {nu}: {spread}");
    }
}

fn ratios_over(
    surface: &Surface,
    template: &FiniteSphereModel,
    source: &FiniteSphereModel,
    radius: f64,
) -> Vec<f64> {
    let field = palpate_geometry::PatchField::new(surface, 2.0 * template.spacing(radius));
    let volume = surface.mesh().volume();
    let (mut one, mut other) = (template.workspace(), source.workspace());
    let every_other = 6_000 / tries(3_000);
    surface
        .mesh()
        .triangle_ids()
        .step_by(every_other)
        .map(|triangle| {
            let patch = field.at(surface, triangle, &[1.0 / 3.0; 3]);
            let along = first_direction(surface, triangle);
            let first = (along - patch.normal * patch.normal.dot(&along)).normalize();
            let second = patch.normal.cross(&first);
            let in_frame = |a: &Vec3, b: &Vec3| a.dot(&(patch.curvature * b));
            let contact = LocalContact {
                point: surface.mesh().positions(triangle).iter().sum::<Vec3>() / 3.0,
                frame: nalgebra::Matrix3::from_columns(&[first, second, patch.normal]),
                curvature: Vector3::new(
                    in_frame(&first, &first),
                    in_frame(&first, &second),
                    in_frame(&second, &second),
                ),
                triangle,
                radius,
                surroundings: Surroundings::Hemisphere {
                    radius: (1.5 * volume / std::f64::consts::PI).cbrt(),
                },
                thickness: (1.5 * volume / std::f64::consts::PI).cbrt(),
            };
            source.respond(&contact, &mut other).stiffness[(2, 2)]
                / template.respond(&contact, &mut one).stiffness[(2, 2)]
        })
        .collect()
}

/// More particles and finer integration are calibrated on the same half-space; on a hemisphere they
/// must agree as far as the closed form is known.
#[test]
fn other_particle_numbers_meet_the_closed_form() {
    for row in EXTERIOR_CONSTANTS {
        for particles in [34, 60, 93, 150] {
            for integration in [Integration::Standard, Integration::Fine] {
                let settings = FiniteSphereSettings {
                    particles,
                    integration,
                    ..DEFAULT()
                };
                let model = model(settings, row.poissons_ratio, Friction::Frictionless);
                let contact = bare_contact(Vector3::new(1.0, 0.0, 1.0) / RADIUS, 2e-3, RADIUS);
                let half_space =
                    half_space_stiffness(&tissue(row.poissons_ratio), 2e-3, Friction::Frictionless);
                let exact = half_space / (1.0 - row.organ_size * 2e-3 / RADIUS);
                let off = normal_stiffness(&model, &contact) / exact - 1.0;
                println!(
                    "{particles}, {integration:?}, nu {}: {off:+.4}, alpha {:.3}",
                    row.poissons_ratio,
                    model.radius_in_spacings()
                );
                assert!(off.abs() < 0.05, "{particles}: {off}");
            }
        }
    }
}
