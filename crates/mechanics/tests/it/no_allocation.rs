//! A step allocates nothing: everything that it needs is in the workspace.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_geometry::Organ;
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_spheres::{Assembly, FiniteSphereSettings, Form, Solver};
use palpate_mechanics::surface_response::{
    MovedTriangle, PatchContact, PatchWorkspace, Reciprocity, TipField, TouchId,
};

use crate::boundary_response::Held;
use crate::contacts::{RADIUS, Random, bare_contact, model};
use crate::every_law::{deformation, every_law};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

#[test]
fn a_step_allocates_nothing() {
    let settings = FiniteSphereSettings::default();
    let gmres = Solver::Gmres { tolerance: 1e-8 };
    for (name, settings) in [
        ("weak, direct", settings),
        (
            "strong, direct",
            FiniteSphereSettings {
                form: Form::Strong,
                ..settings
            },
        ),
        (
            "reused",
            FiniteSphereSettings {
                assembly: Assembly::Reused,
                ..settings
            },
        ),
        (
            "weak, gmres",
            FiniteSphereSettings {
                solver: gmres,
                ..settings
            },
        ),
        (
            "strong, gmres",
            FiniteSphereSettings {
                form: Form::Strong,
                solver: gmres,
                ..settings
            },
        ),
        (
            "93, weak, direct",
            FiniteSphereSettings {
                particles: 93,
                ..settings
            },
        ),
    ] {
        let model = model(settings, 0.45, Friction::Bonded);
        let mut workspace = model.workspace();
        let mut random = Random(1);
        let tip = 1e-3 * random.vector();
        reset_violation_count();
        let mut counts = Vec::new();
        for _ in 0..10 {
            let curvature = random.curvature(model.spacing(2e-3), 0.5);
            let contact = bare_contact(curvature, 2e-3, RADIUS);
            let points = [0; 8].map(|_| 1e-2 * random.vector());
            let before = violation_count();
            let sum: Vec3 = assert_no_alloc(|| {
                let response = model.respond(&contact, &mut workspace);
                points
                    .iter()
                    .map(|x| model.displacement(&contact, &response, &mut workspace, &tip, x))
                    .sum()
            });
            assert!(sum.norm().is_finite());
            counts.push(violation_count() - before);
        }
        println!("{name}: allocations per step {counts:?}");
        assert!(counts[1..].iter().all(|&n| n == 0), "{name}: {counts:?}");
    }
}

#[test]
fn a_law_allocates_nothing() {
    for law in every_law() {
        let f = deformation(&mut Random(2));
        let before = violation_count();
        let sum = assert_no_alloc(|| {
            law.energy(&f)
                + law.stress(&f).norm()
                + law.tangent(&f).norm()
                + law.law.sensitivities(0, &f).1
        });
        assert!(sum.is_finite());
        assert_eq!(violation_count(), before, "{}", law.name);
    }
}

#[test]
fn contact_on_a_response_allocates_nothing() {
    let solid = Held::organ(Organ::Kidney, 200, 0.45);
    let response = solid.response::<f32>(&solid.free);
    let field = TipField::new(&response, &solid.surface, 2e-3).unwrap();
    let contact = PatchContact {
        friction: Friction::Bonded,
        reciprocity: Reciprocity::Imposed,
        youngs_modulus: 1e4,
    };
    let moved = [3, 5, 70].map(|number| MovedTriangle {
        triangle: TouchId(number),
        displacement: 1e-3 * Vec3::z(),
    });
    let mut workspace = PatchWorkspace::new(moved.len());
    let mut moves = vec![0.0_f32; 3 * response.parts().triangles];
    let before = violation_count();
    let sum = assert_no_alloc(|| {
        let forces = response.press(&moved, &contact, &mut workspace).unwrap();
        response.add_field(moved[0].triangle, &forces[0], &mut moves);
        let tips = [solid.free[0], solid.free[90]]
            .map(|id| field.at(&solid.surface, id, &[0.2, 0.3, 0.5]));
        let between = response.between(&tips[0], &tips[1]) + tips[0].structural_compliance();
        response.add_field_of_tip(&tips[0], &forces[1], &mut moves);
        between.norm() + f64::from(moves[0])
    });
    assert!(sum.is_finite());
    assert_eq!(violation_count(), before);
}

/// That the counter counts at all.
#[test]
fn an_allocation_would_be_seen() {
    let before = violation_count();
    let length = assert_no_alloc(|| vec![1u8; 1000].len());
    assert_eq!(length, 1000);
    assert!(violation_count() > before);
}
