//! What must hold for every contact.

use nalgebra::{Rotation3, Vector3};
use palpate_geometry::{Organ, Surface};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{
    Assembly, FiniteSphereModel, FiniteSphereSettings, Form, Solver,
};
use palpate_mechanics::{Limit, LinearElastic, Vec3};

use crate::contacts::{
    MODULUS, RADIUS, Random, bare_contact, contact_near, model, organ, shaken_hemisphere, tries,
};

const DEFAULT: fn() -> FiniteSphereSettings = FiniteSphereSettings::default;

/// Organ and tip turned together: the same stiffness in the contact's frame.
#[test]
fn turning_organ_and_tip_changes_nothing() {
    let model = model(DEFAULT(), 0.45, Friction::Bonded);
    let mut random = Random(1);
    for surface in [organ(Organ::Kidney, 2_000), shaken_hemisphere(23, 61)] {
        for _ in 0..tries(60) {
            let vertices = surface.mesh().vertices();
            let near =
                vertices[(random.unit() * vertices.len() as f64) as usize] + 1e-3 * random.vector();
            let turn = Rotation3::new(3.0 * random.vector());
            let turned = Surface::new(surface.mesh().map_vertices(|v| turn * v).unwrap()).unwrap();
            let [still, moved] =
                [(&surface, near), (&turned, turn * near)].map(|(surface, near)| {
                    let contact = contact_near(surface, &model, &near, 2e-3);
                    model.respond(&contact, &mut model.workspace()).stiffness
                });
            // Rounding, amplified by the fits of normals and curvatures.
            assert!(
                (moved - still).norm() < 1e-6 * still.norm(),
                "{still} {moved}"
            );
        }
    }
}

/// All lengths times s: the stiffness times s. The modulus times two: exactly twice.
#[test]
fn stiffness_scales_with_length_and_modulus() {
    let nu = 0.45;
    let model = model(DEFAULT(), nu, Friction::Bonded);
    let doubled = LinearElastic::new(2.0 * MODULUS, nu).unwrap();
    let stiffer = FiniteSphereModel::new(DEFAULT(), &doubled, Friction::Bonded).unwrap();
    let surface = organ(Organ::Liver, 2_000);
    let mut random = Random(2);
    for _ in 0..tries(60) {
        let vertices = surface.mesh().vertices();
        let near = vertices[(random.unit() * vertices.len() as f64) as usize];
        let contact = contact_near(&surface, &model, &near, 2e-3);
        let once = model.respond(&contact, &mut model.workspace()).stiffness;
        let twice = stiffer
            .respond(&contact, &mut stiffer.workspace())
            .stiffness;
        assert_eq!(2.0 * once, twice);
        let s = 0.2 + 5.0 * random.unit();
        let scaled = Surface::new(surface.mesh().map_vertices(|v| s * v).unwrap()).unwrap();
        let contact = contact_near(&scaled, &model, &(s * near), s * 2e-3);
        let larger = model.respond(&contact, &mut model.workspace()).stiffness;
        // Rounding.
        assert!(
            (larger - s * once).norm() < 1e-9 * larger.norm(),
            "{s}: {once} {larger}"
        );
    }
}

/// The same contacts give the same bits, also when the workspace is lost on the way.
#[test]
fn the_same_contacts_give_the_same_bits() {
    let gmres = Solver::Gmres { tolerance: 1e-6 };
    for settings in [
        DEFAULT(),
        FiniteSphereSettings {
            form: Form::Strong,
            ..DEFAULT()
        },
        FiniteSphereSettings {
            solver: gmres,
            ..DEFAULT()
        },
        FiniteSphereSettings {
            assembly: Assembly::Reused,
            ..DEFAULT()
        },
    ] {
        let run = |lose_at: usize| {
            let model = model(settings, 0.45, Friction::Bonded);
            let mut workspace = model.workspace();
            let mut random = Random(3);
            let mut bits = Vec::new();
            for step in 0..12 {
                if step == lose_at {
                    workspace = model.workspace();
                }
                let curvature = random.curvature(model.spacing(2e-3), 0.5);
                let contact = bare_contact(curvature, 2e-3, RADIUS);
                let response = model.respond(&contact, &mut workspace);
                bits.extend(response.stiffness.iter().map(|v| v.to_bits()));
                let (tip, x) = (1e-3 * random.vector(), 5e-3 * random.vector());
                let moved = model.displacement(&contact, &response, &mut workspace, &tip, &x);
                bits.extend(moved.iter().map(|v| v.to_bits()));
            }
            bits
        };
        let once = run(usize::MAX);
        assert_eq!(once, run(usize::MAX), "{settings:?}");
        assert_eq!(once, run(5), "{settings:?}, workspace lost");
    }
}

/// A stiffness that is not symmetric and positive would give energy for nothing.
#[test]
fn stiffness_is_symmetric_and_positive() {
    let mut random = Random(4);
    for _ in 0..tries(100) {
        let nu = 0.499 * random.unit();
        for form in [Form::Weak, Form::Strong] {
            let settings = FiniteSphereSettings { form, ..DEFAULT() };
            let model = model(settings, nu, Friction::Bonded);
            let mut workspace = model.workspace();
            for _ in 0..10 {
                // From flat to far beyond what a cap can be, on small and large organs.
                let steepest = 3.0 * random.unit();
                let curvature = random.curvature(model.spacing(2e-3), steepest);
                let contact = bare_contact(curvature, 2e-3, 0.01 + 0.1 * random.unit());
                let stiffness = model.respond(&contact, &mut workspace).stiffness;
                let off = (stiffness - stiffness.transpose()).norm();
                // Rounding.
                assert!(
                    off < 1e-10 * stiffness.norm(),
                    "{form:?} {nu} {contact:?}: {stiffness}"
                );
                let least = stiffness.symmetric_eigenvalues().min();
                assert!(least > 0.0, "{form:?} {nu} {contact:?}: {stiffness}");
            }
        }
    }
}

/// A contact that slides over changing curvature: halving the steps halves the largest change, so there
/// is no leap in the force. Not so the strong form, which has poles over saddles and ridges.
#[test]
fn stiffness_is_continuous_in_curvature() {
    for settings in [
        DEFAULT(),
        FiniteSphereSettings {
            assembly: Assembly::Reused,
            ..DEFAULT()
        },
    ] {
        let model = model(settings, 0.45, Friction::Bonded);
        let mut workspace = model.workspace();
        let spacing = model.spacing(2e-3);
        let mut largest_change = |steps: usize| {
            let mut last = None;
            let mut largest: f64 = 0.0;
            for step in 0..=steps {
                let along = 2.0 * step as f64 / steps as f64 - 1.0;
                // From a hollow over a saddle to a ridge, into the range where caps are made gentler.
                let curvature =
                    Vector3::new(0.9 * along, 0.2 * (3.0 * along).sin(), 0.3 * along.abs());
                let contact = bare_contact(curvature / spacing, 2e-3, RADIUS);
                let stiffness = model.respond(&contact, &mut workspace).stiffness;
                if let Some(last) = last {
                    let change: nalgebra::Matrix3<f64> = stiffness - last;
                    largest = largest.max(change.norm() / stiffness.norm());
                }
                last = Some(stiffness);
            }
            largest
        };
        let changes = [200, 400, 800].map(&mut largest_change);
        println!(
            "{:?}, {:?}: largest relative changes {changes:?}",
            settings.form, settings.assembly
        );
        for pair in changes.windows(2) {
            assert!(pair[1] < 0.6 * pair[0], "{settings:?}: {changes:?}");
        }
    }
}

/// The same for a contact that slides over a mesh.
#[test]
fn force_has_no_leaps_on_a_slide() {
    let model = model(DEFAULT(), 0.45, Friction::Frictionless);
    let surface = organ(Organ::Liver, 2_000);
    let tree = palpate_geometry::AabbTree::new(surface.mesh());
    let radius = 2e-3;
    let field = palpate_geometry::PatchField::new(&surface, 2.0 * model.spacing(radius));
    let mut workspace = model.workspace();
    let (low, high) = surface.mesh().bounds();
    let middle = 0.5 * (low + high);
    let mut last: Option<f64> = None;
    let (mut largest, mut steps) = (0.0f64, 0);
    for step in 0..600 {
        let x = middle.x + 1e-4 * f64::from(step - 300);
        let above = Vec3::new(x, middle.y, high.z + 0.01);
        let Some(hit) = tree.cast(surface.mesh(), &above, &-Vec3::z(), 1.0) else {
            continue;
        };
        let point = above - hit.distance * Vec3::z();
        let nearest = tree.nearest(surface.mesh(), &point);
        let patch = field.at(&surface, nearest.triangle, &nearest.on.barycentric);
        // The tangent is carried along, not taken from the triangle.
        let second = patch.normal.cross(&Vec3::x()).normalize();
        let first = second.cross(&patch.normal);
        let in_frame = |a: &Vec3, b: &Vec3| a.dot(&(patch.curvature * b));
        let curvature = Vector3::new(
            in_frame(&first, &first),
            in_frame(&first, &second),
            in_frame(&second, &second),
        );
        let contact = bare_contact(curvature, radius, 0.08);
        let stiffness = model.respond(&contact, &mut workspace).stiffness[(2, 2)];
        if let Some(last) = last {
            largest = largest.max((stiffness / last - 1.0).abs());
            steps += 1;
        }
        last = Some(stiffness);
    }
    println!(
        "largest change over 0.1 mm: {:.3} % in {steps} steps",
        100.0 * largest
    );
    assert!(steps > 400);
    // A curvature changes by itself over the patch's radius, 9 mm; its share of the force is a tenth.
    assert!(largest < 0.01, "{largest}");
}

/// Bounds of the local model say that they acted, and by how much; without reason they do not.
#[test]
fn bounds_of_the_local_model_are_told() {
    let model = model(FiniteSphereSettings::default(), 0.45, Friction::Bonded);
    let mut workspace = model.workspace();
    let mut limits = |curvature: f64, radius: f64, organ: f64| {
        let curvature = Vector3::new(curvature, 0.0, 0.0);
        let contact = bare_contact(curvature, radius, organ);
        model.respond(&contact, &mut workspace).limits
    };
    assert!(limits(20.0, 1e-3, 0.05).is_empty());
    // Half a tip's spacing to the centre of the curvature.
    let flattened = limits(125.0, 3e-3, 0.05).reached(Limit::Curvature).unwrap();
    assert_eq!(flattened.unbounded, 125.0);
    let used = 0.6 / model.spacing(3e-3);
    // Rounding.
    assert!((flattened.used / used - 1.0).abs() < 1e-12, "{flattened:?}");
    // A tip as large as the organ.
    let large = limits(0.0, 0.04, 0.02);
    let [normal, along] =
        [Limit::LocalStiffness, Limit::LocalShearStiffness].map(|limit| large.reached(limit));
    println!("{normal:?} {along:?}");
    let normal = normal.unwrap();
    assert!(normal.used == 3.0 && normal.unbounded > 3.0);
}

/// Iterations that do not reach their tolerance leave the answer to the factors, to the bit, and say so.
#[test]
fn iterations_without_convergence_are_told_and_replaced() {
    for form in [Form::Weak, Form::Strong] {
        let direct = FiniteSphereSettings {
            form,
            ..FiniteSphereSettings::default()
        };
        // No residual is that small.
        let tolerance = 1e-30;
        let iterated = FiniteSphereSettings {
            solver: Solver::Gmres { tolerance },
            ..direct
        };
        let [direct, iterated] = [direct, iterated].map(|settings| {
            let model = model(settings, 0.3, Friction::Frictionless);
            let contact = bare_contact(Vector3::new(10.0, 0.0, 10.0), 1e-3, 0.05);
            model.respond(&contact, &mut model.workspace())
        });
        let reached = iterated.limits.reached(Limit::Residual).unwrap();
        assert!(reached.used == tolerance && reached.unbounded > tolerance);
        assert!(direct.limits.is_empty());
        assert_eq!(direct.stiffness, iterated.stiffness);
    }
}
