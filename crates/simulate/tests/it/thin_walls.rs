//! Finite elements condensed to the surface, where they carry the whole organ.

use palpate_mechanics::contact::Friction;
use std::fs;
use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_geometry::{AabbTree, Vec3};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::finite_elements::solid::{Body, MovedPatch, SolidProblem, solve};
use palpate_mechanics::finite_elements::tube::{Ends, Tube, TubeProblem, TubePunch, indent};
use palpate_simulate::{Resources, Simulation, fixed_region};

use crate::scenes::{Hand, Setting, YOUNGS_MODULUS, nearest};
use crate::slides::{Count, slides};

const CUBE: Setting<'_> = Setting {
    organ: "builtin = \"cube\"\ntriangles = 300",
    kind: "hybrid",
    model: "response = \"finite_elements\"",
    poissons_ratio: 0.45,
    shape: "flat",
    radius: 3e-3,
    contact: "slip",
    prony: "[]",
};

/// One that can be touched around the middle only.
const ESOPHAGUS: &str = "builtin = \"esophagus\"\ntriangles = 4000\n\
    touchable = { spheres = [{ center_m = [0.0, 0.0, 0.0], radius_m = 0.012 }] }";

fn prepared(setting: &Setting<'_>, resources: &Resources) -> Simulation {
    let go = &mut |_| ControlFlow::Continue(());
    Simulation::prepare(&setting.scene(), resources, go).unwrap()
}

/// Force along z at a depth of 1 mm in the middle of the cube's top.
fn force_on_top(simulation: &Simulation) -> f64 {
    let (low, high) = simulation.surface().mesh().bounds();
    let middle = 0.5 * (low + high);
    Hand::new(simulation)
        .at(&Vec3::new(middle.x, middle.y, high.z - 1e-3))
        .z
}

/// Judge: boundary elements, on a body without walls. Tolerance: 2 %, as a tip on a hemisphere.
#[test]
fn a_thick_body_feels_the_same_both_ways() {
    let by_finite = CUBE.simulation();
    let boundary = Setting { model: "", ..CUBE };
    let by_boundary = boundary.simulation();
    let method = |simulation: &Simulation| simulation.response().unwrap().method;
    assert_eq!(method(&by_finite), "condensed finite elements");
    assert_eq!(method(&by_boundary), "boundary elements");
    let [finite, boundary] = [&by_finite, &by_boundary].map(force_on_top);
    println!("{finite} N, boundary elements {boundary} N");
    assert!(
        (finite / boundary - 1.0).abs() < 0.02,
        "{finite} {boundary}"
    );
}

/// Each method has a file of its own, and what is read feels as what was solved.
#[test]
fn a_response_is_kept_with_its_method() {
    let folder = tempfile::tempdir().unwrap();
    let resources = Resources {
        responses: Some(folder.path().to_owned()),
        ..Resources::default()
    };
    let solved = prepared(&CUBE, &resources);
    let read = prepared(&CUBE, &resources);
    assert!(!solved.response().unwrap().was_cached && read.response().unwrap().was_cached);
    assert_eq!(
        force_on_top(&solved).to_bits(),
        force_on_top(&read).to_bits()
    );
    let boundary = Setting { model: "", ..CUBE };
    assert!(
        !prepared(&boundary, &resources)
            .response()
            .unwrap()
            .was_cached
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

/// Where tetrahedra cannot be had, boundary elements are taken, and it is said.
#[test]
fn without_tetrahedra_boundary_elements_are_taken() {
    let esophagus = Setting {
        organ: "builtin = \"esophagus\"\ntriangles = 600",
        model: "",
        ..CUBE
    };
    // Enough for 600 triangles, not for the tetrahedra of the wall.
    let resources = Resources {
        responses: None,
        memory: 100_000_000,
        ..Resources::default()
    };
    let simulation = prepared(&esophagus, &resources);
    assert_eq!(simulation.response().unwrap().method, "boundary elements");
    for words in ["finite elements have none", "too stiff where they bend"] {
        let told = simulation
            .warnings()
            .iter()
            .any(|warning| warning.contains(words));
        assert!(told, "{words}: {:?}", simulation.warnings());
    }
}

/// Judge: quadratic tetrahedra on the same surface, refined to the edge of a patch of the tip's size that
/// slides, to some percent; printed beside them a straight tube of this wall between the same anchors, which
/// has no wider ends and is softer for that. Tolerance: 10 %, what is asked for. Quick form, on a straight tube:
/// `condensed::a_wall_bends_as_it_should` of the mechanics.
#[test]
#[ignore = "slow: minutes"]
fn the_esophagus_is_that_of_finite_elements() {
    let scene = Setting {
        organ: ESOPHAGUS,
        model: "",
        radius: 2e-3,
        ..CUBE
    }
    .scene();
    let simulation = Simulation::new(&scene).unwrap();
    let origin = simulation.response().unwrap();
    assert_eq!(origin.method, "condensed finite elements");
    assert!(
        simulation.warnings().is_empty(),
        "{:?}",
        simulation.warnings()
    );
    let tree = AabbTree::new(simulation.surface().mesh());
    let (point, normal) = nearest(&simulation, &tree, &Vec3::new(0.0, 0.02, 0.0));
    let law = Arc::new(LinearElastic::new(YOUNGS_MODULUS, 0.45).unwrap());
    let solid = SolidProblem {
        patch: Some(MovedPatch {
            center: point,
            radius: 2e-3,
            displacement: -1e-3 * normal,
            friction: Friction::Frictionless,
        }),
        ..SolidProblem::new(
            Body::Surface(simulation.surface().clone()),
            fixed_region(&scene.organ.shape, None),
            law.clone(),
        )
    };
    let solid = solve(&solid, 0.03, &mut |_| ()).unwrap();
    let expected = solid.answer.force_along;
    let mut hand = Hand::new(&simulation);
    let forces: Vec<f64> = (1..=10)
        .map(|step| hand.at(&(point - normal * (1e-4 * f64::from(step)))).norm())
        .collect();
    println!(
        "{:.4e} N at 1 mm; tetrahedra {expected:.4e} N (error {:.3}); straight tube {:.4e} N",
        forces[9],
        solid.error,
        1e-3 * straight_tube(law)
    );
    assert!(
        (forces[9] / expected - 1.0).abs() < 0.1,
        "{forces:?} {expected}"
    );
}

/// Force per depth of a punch of 2 mm on a straight tube as long as the esophagus is between its anchors
/// [N/m].
fn straight_tube(law: Arc<LinearElastic>) -> f64 {
    let problem = TubeProblem {
        tube: Tube {
            length: 0.052,
            inner_radius: 5e-3,
            outer_radius: 7.5e-3,
        },
        law,
        ends: Ends::Fixed,
    };
    let punch = TubePunch {
        radius: 2e-3,
        face: Friction::Frictionless,
        pressure: 0.0,
        depths: vec![1e-3, 1.2e-3],
    };
    let found = indent(&problem, &punch, 1.0, &mut |_| {}).unwrap();
    // Between two depths, as the whole face touches only then.
    (found.answer.forces[1] - found.answer.forces[0]) / 0.2e-3
}

/// Judge: what a hand does not feel as a click (see `slides`); the triangles are those of
/// `hybrid::organs_under_random_pokes_and_slides`.
#[test]
#[ignore = "slow: a minute"]
fn slides_on_a_thin_wall_are_smooth() {
    thin_wall_slides(1200, 600, 40);
}

/// Quick form of the test above: four slides on a coarser wall.
#[test]
#[ignore = "long"]
fn some_slides_on_a_thin_wall_are_smooth() {
    thin_wall_slides(600, 300, 4);
}

/// `number` slides on an esophagus of so many triangles, seen and solved.
fn thin_wall_slides(triangles: usize, mechanical: usize, number: usize) {
    let simulation = Setting {
        organ: &format!("builtin = \"esophagus\"\ntriangles = {triangles}"),
        model: &format!("mechanical_triangles = {mechanical}"),
        radius: 1.5e-3,
        ..CUBE
    }
    .simulation();
    assert_eq!(
        simulation.response().unwrap().method,
        "condensed finite elements"
    );
    let mut count = Count::default();
    slides(&simulation, number, &mut count);
    println!("{count}");
    count.assert_sound("esophagus");
}

/// A closed tube as OBJ: `radius`, `wall`, `length` and edges in m, its axis along x.
fn tube_as_obj(radius: f64, wall: f64, length: f64, edge: f64) -> String {
    let steps = (length / edge).round() as usize;
    let columns = (std::f64::consts::TAU * radius / edge).round() as usize;
    let along = |k: usize| length * (k as f64 / steps as f64 - 0.5);
    let mut rows: Vec<[f64; 2]> = (0..=steps).map(|k| [along(k), radius]).collect();
    rows.push([along(steps), radius - 0.5 * wall]);
    rows.extend((0..=steps).rev().map(|k| [along(k), radius - wall]));
    rows.push([along(0), radius - 0.5 * wall]);
    let mut text = String::new();
    for [x, r] in &rows {
        for k in 0..columns {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / columns as f64).sin_cos();
            text += &format!("v {x} {} {}\n", r * sine, r * cosine);
        }
    }
    for row in 0..rows.len() {
        for k in 0..columns {
            let number = |row: usize, k: usize| 1 + row % rows.len() * columns + k % columns;
            let (here, aside) = (number(row, k), number(row, k + 1));
            let (further, both) = (number(row + 1, k), number(row + 1, k + 1));
            text += &format!("f {here} {further} {both}\nf {here} {both} {aside}\n");
        }
    }
    text
}

/// The first filling of this tube has edges as long as its wall is thick, and holes; the stiffness of what was made
/// coarser of it was not positive.
#[test]
fn a_thin_tube_has_a_filling_without_holes() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("tube.obj");
    fs::write(&mesh, tube_as_obj(0.01, 0.002, 0.08, 0.0012)).unwrap();
    let ends = "anchor.planes = [{ point_m = [-0.0399, 0.0, 0.0], normal = [1.0, 0.0, 0.0] }, \
                { point_m = [0.0399, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }]";
    let organ = format!(
        "mesh = {:?}\nmesh_unit = \"m\"\n{ends}",
        mesh.to_str().unwrap()
    );
    let setting = Setting {
        organ: &organ,
        kind: "nonlinear",
        model: "",
        radius: 0.01,
        shape: "sphere",
        ..CUBE
    };
    let simulation = setting.simulation();
    let force = Hand::new(&simulation).at(&Vec3::new(0.0, 0.0, 0.018)).z;
    assert!(force > 0.0, "{force}");
}
