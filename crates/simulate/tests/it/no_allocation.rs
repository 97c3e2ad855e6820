//! A step that allocates may wait for the allocator longer than it has time.

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use palpate_files::Scene;
use palpate_files::scene::Jaws;
use palpate_geometry::{AabbTree, Vec3};

use crate::grip::{Hands, grasping, pose};
use crate::layers;
use crate::nonlinear_shafts::with_friction;
use crate::scenes::{Hand, Setting, nearest};

#[global_allocator]
static COUNTING: AllocDisabler = AllocDisabler;

/// A thousand places along the surface, 0.1 mm apart, 1 mm deep.
pub(crate) fn track(simulation: &palpate_simulate::Simulation) -> Vec<Vec3> {
    let tree = AabbTree::new(simulation.surface().mesh());
    let (mut point, normal) = nearest(simulation, &tree, &Vec3::new(0.0, 0.0, 1.0));
    let mut along = normal.cross(&Vec3::y()).normalize();
    let mut track = Vec::new();
    for _ in 0..1001 {
        let (on, normal) = nearest(simulation, &tree, &point);
        track.push(on - normal * 1e-3);
        along = (along - normal * along.dot(&normal)).normalize();
        point = on + along * 1e-4;
    }
    track
}

#[test]
#[ignore = "long"]
fn a_sliding_step_allocates_nothing() {
    for (kind, contact, model) in [
        ("local", "slip", ""),
        ("local", "stick", ""),
        ("local", "slip", "assembly = \"reused\""),
        ("local", "slip", "form = \"strong\""),
        ("hybrid", "stick", "mechanical_triangles = 400"),
        ("nonlinear", "stick", "nodes = 400"),
        ("nonlinear", "slip", "nodes = 400"),
        (
            "nonlinear",
            "slip",
            "nodes = 400\n[[neighbour]]\nbuiltin = \"cube\"\ncollides = true\nfriction = 0.3",
        ),
        (
            "nonlinear",
            "slip",
            "nodes = 400\n[[neighbour]]\nbuiltin = \"hemisphere\"\nnodes = 300\nfriction = 0.3\n\
             builtin_tissue = \"pig-liver\"\nat_m = [0.0, 0.0, -0.04]",
        ),
        (
            "nonlinear",
            "slip",
            "nodes = 800\n[[organ.region]]\nball = { center_m = [-0.03, 0.0, 0.02], radius_m = 0.02 }\n\
             cavity = { constant_volume = true, pressure_pa = 300.0 }",
        ),
        (
            "hybrid",
            "slip",
            "mechanical_triangles = 400\nenhancement = { area = \"vertex\", levels = 3 }",
        ),
    ] {
        let simulation = Setting {
            organ: "builtin = \"liver\"",
            kind,
            model,
            contact,
            prony: "[{ g = 0.3, tau_s = 1.5 }]",
            ..Setting::default()
        }
        .simulation();
        let track = track(&simulation);
        let mut hand = Hand::new(&simulation);
        hand.at(&track[0]);
        reset_violation_count();
        let before = violation_count();
        let felt = assert_no_alloc(|| {
            let forces = track[1..].iter().map(|tip| hand.at(tip));
            forces.filter(|force| force.norm() > 0.0).count()
        });
        let allocations = violation_count() - before;
        println!("{contact} {model}: felt in {felt} of 1000 steps, {allocations} allocations");
        assert!(felt > 500, "{contact} {model}: felt in {felt}");
        assert_eq!(allocations, 0, "{contact} {model}");
    }
}

/// A shaft that is laid across a cube, pressed and lifted again, and drawn along its axis with friction.
#[test]
fn a_step_with_a_shaft_allocates_nothing() {
    let setting = Setting {
        organ: "builtin = \"cube\"",
        kind: "nonlinear",
        model: "nodes = 400",
        shape: "sphere",
        radius: 4e-3,
        ..Setting::default()
    };
    let simulation = with_friction(&setting, 0.3);
    let (_, high) = simulation.surface().mesh().bounds();
    let across = nalgebra::UnitQuaternion::rotation_between(&Vec3::z(), &Vec3::x());
    let at = |step: u32| {
        let depth = 1e-4 * f64::from(100 - step.abs_diff(100)) - 5e-3;
        let along = 1e-4 * f64::from(step);
        let tip = Vec3::new(-0.07 + along, 0.0, high.z + 4e-3 - depth);
        pose(&tip, &across.unwrap_or_default(), 0.0)
    };
    let mut hands = Hands::new(&simulation);
    hands.go(&[at(0)]);
    reset_violation_count();
    let before = violation_count();
    let felt = assert_no_alloc(|| {
        let forces = (1..200).map(|step| {
            hands.go(&[at(step)]);
            hands.state.tools[0].force.norm()
        });
        forces.filter(|force| *force > 0.0).count()
    });
    assert!(felt > 50, "{felt}");
    assert_eq!(violation_count() - before, 0);
}

/// Two graspers that take hold, pull, slip and let go, and take hold again.
#[test]
#[ignore = "long"]
fn a_step_with_two_grips_allocates_nothing() {
    for kind in ["hybrid", "local", "nonlinear"] {
        let setting = Setting {
            organ: "builtin = \"kidney\"",
            kind,
            model: "mechanical_triangles = 400",
            contact: "stick",
            prony: "[{ g = 0.3, tau_s = 1.5 }]",
            ..Setting::default()
        };
        let jaws = Jaws {
            force_n: 0.2,
            ..Jaws::GRASPER
        };
        let scene = grasping(&setting, jaws, 2);
        let simulation = palpate_simulate::Simulation::new(&scene).unwrap();
        let tree = AabbTree::new(simulation.surface().mesh());
        let (first, normal) = nearest(&simulation, &tree, &Vec3::new(0.0, 0.0, 1.0));
        let aside = normal.cross(&Vec3::y()).normalize() * 0.04;
        let (second, outward) = nearest(&simulation, &tree, &(first + aside));
        let poses = |number: usize| {
            let number = number % 100;
            let part = number as f64 / 99.0;
            let grip = if (0.1..0.95).contains(&part) {
                0.9
            } else {
                0.1
            };
            let at = |point: Vec3, normal: Vec3| {
                let turned = nalgebra::UnitQuaternion::rotation_between(&Vec3::z(), &normal);
                let tip = point + normal * (0.02 * part - 4e-3);
                pose(&tip, &turned.unwrap_or_default(), grip)
            };
            [at(first, normal), at(second, outward)]
        };
        let mut hands = Hands::new(&simulation);
        hands.go(&poses(0));
        reset_violation_count();
        let before = violation_count();
        let held = assert_no_alloc(|| {
            let steps = (1..400).map(|number| {
                hands.go(&poses(number));
                hands.state.tools.iter().all(|tool| tool.is_grasping())
            });
            steps.filter(|both| *both).count()
        });
        let allocations = violation_count() - before;
        println!("{kind}: both held in {held} of 399 steps, {allocations} allocations");
        // Not to the end: it slips out.
        assert!(held > 100 && held < 330, "{kind}: {held}");
        assert_eq!(allocations, 0, "{kind}");
    }
}

/// A blade that opens the surface, and one that goes along in the opening and cuts the layers below it, or scratches, and a reset.
/// Cuts have room for as many triangles as the strokes make.
#[test]
#[ignore = "long"]
fn a_step_that_cuts_layers_allocates_nothing() {
    for model in [
        "",
        "[organ.touchable]\nspheres = [{ center_m = [0.0, 0.0, 0.05], radius_m = 0.03 }]\n\
         [model]\nkind = \"hybrid\"\nmechanical_triangles = 400\nresponse = \"boundary_elements\"\n",
        "[model]\nkind = \"nonlinear\"\nnodes = 400\n",
    ] {
        let scene = Scene::parse(&layers::text("scissors", model), "layers.toml").unwrap();
        let simulation = palpate_simulate::Simulation::new(&scene).unwrap();
        let mut hand = layers::Hand::new(&simulation);
        for (depth, layer) in [
            (0.0009, None),
            (0.0011, Some(1)),
            (0.0021, Some(2)),
            (0.0031, Some(3)),
        ] {
            reset_violation_count();
            let before = violation_count();
            // The nonlinear model takes a tenth of a second to follow.
            let events = assert_no_alloc(|| {
                let events = hand.cut_path(depth);
                hand.wait(60);
                events
            });
            let allocations = violation_count() - before;
            println!("{depth} m deep: {events}, {allocations} allocations");
            assert_eq!(events.deepest_opened(), layer);
            assert_eq!(allocations, 0, "{depth}");
        }
        reset_violation_count();
        assert_no_alloc(|| hand.state.reset(&simulation));
        assert_eq!(violation_count(), 0);
    }
}
