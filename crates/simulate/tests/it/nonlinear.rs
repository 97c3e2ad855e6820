//! The whole organ at large deformation.

use palpate_mechanics::contact::Friction;
use std::sync::Arc;

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Jaws, Region, RegionPlane};
use palpate_files::{Event, Scene};
use palpate_geometry::{AabbTree, Organ, Surface, Vec3};
use palpate_mechanics::NeoHookean;
use palpate_mechanics::finite_elements::solid::{Body, MovedPatch, SolidProblem, solve_at};
use palpate_simulate::{Simulation, draw_variant};

use crate::grip::{Hands, grasping, pose};
use crate::scenes::{Hand, Random, Setting, YOUNGS_MODULUS, nearest};

pub(crate) const LIVER: Setting<'_> = Setting {
    organ: "builtin = \"liver\"\ntriangles = 1200",
    kind: "nonlinear",
    model: "",
    poissons_ratio: 0.45,
    shape: "flat",
    radius: 4e-3,
    contact: "slip",
    prony: "[]",
};

/// The force at the end of a press to `depth` [m] at `point`, in steps of a quarter of a millimetre and a few more.
fn press(simulation: &Simulation, point: &Vec3, normal: &Vec3, depth: f64) -> Vec3 {
    let mut hand = Hand::new(simulation);
    let steps = (depth / 0.25e-3).ceil() as usize;
    let mut force = Vec3::zeros();
    for step in 0..steps + 10 {
        let part = (step as f64 / steps as f64).min(1.0);
        force = hand.at(&(point - normal * (part * depth)));
    }
    force
}

/// Judge: the linear global model, by boundary elements of its own. Half a millimetre is an eighth of the tip's radius.
/// Tolerance: at the median 4 %, for which the two differ in how a load lies on a curved surface; at one place, on the
/// anchor's edge, 10 %, where neither resolves the tip.
#[test]
#[ignore = "long"]
fn small_presses_are_those_of_the_linear_organ() {
    for (poissons_ratio, shape, contact) in [
        (0.3, "flat", "slip"),
        (0.45, "flat", "stick"),
        (0.45, "sphere", "slip"),
        (0.49, "flat", "slip"),
    ] {
        let setting = Setting {
            poissons_ratio,
            shape,
            contact,
            ..LIVER
        };
        let bent = setting.simulation();
        let linear = Setting {
            kind: "hybrid",
            ..setting
        }
        .simulation();
        let tree = AabbTree::new(bent.surface().mesh());
        let mut random = Random(5);
        let mut ratios: Vec<f64> = (0..9)
            .map(|_| {
                let (point, normal) = nearest(&bent, &tree, &random.place(&bent).0);
                let force = |simulation| press(simulation, &point, &normal, 0.5e-3).norm();
                force(&bent) / force(&linear)
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        println!("{poissons_ratio} {shape} {contact}: {ratios:.3?}");
        assert!((ratios[4] - 1.0).abs() < 0.04, "{ratios:?}");
        assert!(ratios[0] > 0.9 && ratios[8] < 1.1, "{ratios:?}");
    }
}

/// Judge: axisymmetric finite elements, as in `hybrid::a_hemisphere_is_that_of_finite_elements`; the same on every
/// fineness. Tolerance 3 %: 1.3 to 1.8 % were found.
#[test]
#[ignore = "long"]
fn a_press_does_not_depend_on_the_number_of_nodes() {
    for nodes in [700, 1500, 3000] {
        let simulation = Setting {
            organ: "builtin = \"hemisphere\"\ntriangles = 1000",
            radius: 3e-3,
            model: &format!("nodes = {nodes}"),
            ..LIVER
        }
        .simulation();
        let normal = Vec3::z();
        let force = press(&simulation, &(normal * 0.05), &normal, 1e-3);
        println!("{nodes} nodes: {} N, finite elements 0.07875 N", force.z);
        assert!((force.z / 0.078_752 - 1.0).abs() < 0.03, "{force}");
    }
}

/// Where a tip that holds an organ is [m], and how it is turned.
pub(crate) type Held = (Vec3, UnitQuaternion<f64>);

/// Graspers that hold the organ at the places nearest to `at`, upright on it; with where their tips are.
pub(crate) fn all_holding<'a>(simulation: &'a Simulation, at: &[Vec3]) -> (Hands<'a>, Vec<Held>) {
    let tree = AabbTree::new(simulation.surface().mesh());
    let places = at.iter().map(|at| nearest(simulation, &tree, at));
    let places = places.map(|(point, normal)| {
        let turned = UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap_or_default();
        (point, normal, turned)
    });
    let places: Vec<_> = places.collect();
    let mut hands = Hands::new(simulation);
    let mut go = |height: f64, grip: f64| {
        let poses = places.iter();
        let poses =
            poses.map(|(point, normal, turned)| pose(&(point + normal * height), turned, grip));
        hands.go(&poses.collect::<Vec<_>>());
    };
    for step in 0..=10 {
        go(1e-3 - 1e-4 * f64::from(step), 0.0);
    }
    for step in 0..=10 {
        go(0.0, 0.1 * f64::from(step));
    }
    assert!(hands.state.tools.iter().all(|tool| tool.is_grasping()));
    let tips = places.into_iter().map(|(point, _, turned)| (point, turned));
    (hands, tips.collect())
}

/// One of them.
pub(crate) fn holding<'a>(
    simulation: &'a Simulation,
    at: &Vec3,
) -> (Hands<'a>, Vec3, UnitQuaternion<f64>) {
    let (hands, tips) = all_holding(simulation, &[*at]);
    (hands, tips[0].0, tips[0].1)
}

pub(crate) const STRONG: Jaws = Jaws {
    force_n: 100.0,
    ..Jaws::GRASPER
};

fn graspers(setting: &Setting<'_>, tools: usize) -> Simulation {
    Simulation::new(&grasping(setting, STRONG, tools)).unwrap()
}

/// Largest displacement of the surface that is seen [m].
pub(crate) fn displaced(hands: &Hands<'_>, simulation: &Simulation) -> f64 {
    let rest = simulation.surface().mesh().vertices();
    let moved = hands.state.deformed.vertices().iter().zip(rest);
    moved
        .map(|(now, rest)| (now - rest).norm())
        .fold(0.0, f64::max)
}

/// Judge: finite elements of the same hemisphere (`palpate solve`), whose patch of the jaws' area is bonded and moved as far,
/// with another law, which is the same where volume is kept. Half a radius of the patch, and three quarters: beyond, the
/// jaws' own law, which is linear, is too stiff (by 19 % at two radii). Tolerance 10 %, of which the coarsest mesh of the
/// judge has 3, and 12 % aside, where 11.5 % were found; with 6,000 nodes the force along the way is 7 % too large, with 1,500 9 %.
#[test]
#[ignore = "slow: two minutes"]
fn a_pulled_hemisphere_is_that_of_finite_elements() {
    let setting = Setting {
        organ: "builtin = \"hemisphere\"\ntriangles = 2000",
        contact: "stick",
        ..LIVER
    };
    let simulation = graspers(&setting, 1);
    let radius = (Jaws::GRASPER.length_m * Jaws::GRASPER.width_m / std::f64::consts::PI).sqrt();
    let surface = Surface::new(Organ::Hemisphere.surface_mesh(2000).unwrap()).unwrap();
    for (way, most) in [
        (Vec3::new(0.0, 0.0, 2e-3), 0.1),
        (Vec3::new(3e-3, 0.0, 0.0), 0.12),
    ] {
        let (mut hands, tip, turned) = holding(&simulation, &Vec3::new(0.0, 0.0, 1.0));
        for step in 0..=40 {
            let part = (f64::from(step) / 30.0).min(1.0);
            hands.go(&[pose(&(tip + way * part), &turned, 1.0)]);
        }
        let found = -hands.state.tools[0].force;
        let shear = YOUNGS_MODULUS / 2.9;
        let bulk = YOUNGS_MODULUS / (3.0 * 0.1);
        let problem = SolidProblem {
            patch: Some(MovedPatch {
                center: Vec3::new(0.0, 0.0, 0.05),
                radius,
                displacement: way,
                friction: Friction::Bonded,
            }),
            ..SolidProblem::new(
                Body::Surface(surface.clone()),
                Region {
                    planes: vec![RegionPlane {
                        point_m: [0.0, 0.0, 1e-4],
                        normal: [0.0, 0.0, 1.0],
                    }],
                    ..Region::default()
                },
                Arc::new(NeoHookean::compressible(0.5 * shear, bulk).unwrap()),
            )
        };
        let expected = solve_at(&problem, 0, &mut |_| {}).unwrap().force;
        println!("{way:?}: {found:?} N, finite elements {expected:?} N");
        let error = (found - expected).norm() / expected.norm();
        assert!(error < most, "{error}");
    }
}

/// A tube that is pulled aside by 3 cm grows by no more than its tissue does, and goes back when it is let go. Judge: a bar
/// that is stretched as far as the tube's halves, of 30 mm, are at most: its volume grows by (1 − 2ν) ln λ. What bends
/// and what is held grows less. Nothing is left.
#[test]
fn a_pulled_tube_grows_as_its_tissue_does_and_goes_back() {
    let setting = Setting {
        organ: "builtin = \"esophagus\"",
        contact: "stick",
        ..LIVER
    };
    let simulation = graspers(&setting, 1);
    let (mut hands, tip, turned) = holding(&simulation, &Vec3::new(0.0, -0.0075, 0.0));
    let rest = simulation.surface().mesh().volume();
    let mut before = 0.0;
    for step in 0..=30 {
        let to = tip - Vec3::y() * (1e-3 * f64::from(step));
        hands.go(&[pose(&to, &turned, 1.0)]);
        let force = hands.state.tools[0].force.norm();
        assert!(step < 5 || force > before, "{step}: {force}");
        before = force;
    }
    let volume = hands.state.deformed.volume() / rest - 1.0;
    println!("{before} N, volume {volume}");
    let grows = (1.0 - 2.0 * setting.poissons_ratio) * 2.0_f64.sqrt().ln();
    assert!(volume > 0.0 && volume < grows, "{volume}");
    assert!(displaced(&hands, &simulation) > 0.028);
    for _ in 0..80 {
        hands.go(&[pose(&(tip - Vec3::y() * 0.03), &turned, 0.0)]);
    }
    assert_eq!(hands.state.tools[0].force, Vec3::zeros());
    let left = displaced(&hands, &simulation);
    assert!(left < 1e-6, "{left}");
}

/// The esophagus of the traction task, with softer layers, is pulled aside at 290 mm/s until the model has no answer. The force increases by no
/// more than half from step to step, then is zero, and an event says why; released, the organ comes to rest.
#[test]
#[ignore = "long"]
fn a_hand_that_pulls_without_end_feels_no_leap() {
    let text = include_str!("../../../../assets/tasks/traction.toml");
    let layer = "builtin_tissue = \"pig-esophagus\"\nperforation_force_n";
    let text = text.replace("perforation_force_n", layer);
    let mut scene = draw_variant(&Scene::parse(&text, "traction.toml").unwrap(), 0).unwrap();
    scene.neighbours.clear();
    let simulation = Simulation::new(&scene).unwrap();
    let mut hands = Hands::new(&simulation);
    let turned = UnitQuaternion::from_axis_angle(&Vec3::x_axis(), 2.678);
    let tip = Vec3::new(-0.001, -0.0062, 0.002);
    for step in 0..=80 {
        let above = 0.0048 * (1.0 - f64::from(step) / 40.0).max(0.0);
        let grip = (f64::from(step) / 40.0 - 1.0).clamp(0.0, 1.0);
        hands.go(&[pose(&(tip - Vec3::y() * above), &turned, grip), None]);
    }
    let (mut before, mut most, mut told) = (0.05, 0.0_f64, 0);
    for step in 0..=100 {
        let to = tip - Vec3::new(0.98e-3, 1.06e-3, 0.0) * f64::from(step);
        hands.go(&[pose(&to, &turned, 1.0), None]);
        let events = hands.state.tools[0].row.events;
        told += u32::from(events.contains(Event::NoEquilibrium));
        let force = hands.state.tools[0].force.norm();
        assert!(force < 1.5 * before + 0.05, "{step}: {before}, {force}");
        (before, most) = (force.max(0.05), most.max(force));
    }
    println!("{most} N at most");
    assert!(most > 0.5, "{most}");
    assert_eq!(told, 1);
    for _ in 0..400 {
        hands.go(&[pose(&(tip - Vec3::y()), &turned, 0.0), None]);
    }
    assert_eq!(hands.state.tools[0].force, Vec3::zeros());
    let left = displaced(&hands, &simulation);
    assert!(left < 1e-3, "{left}");
}

/// Judge: symmetry. Two graspers stretch a tube along its axis: what one feels the other feels against it, but for the
/// ends that are held and the tube's bend. Tolerance: a fifth.
#[test]
fn two_hands_feel_one_another() {
    let setting = Setting {
        organ: "builtin = \"cube\"",
        contact: "stick",
        ..LIVER
    };
    let simulation = graspers(&setting, 2);
    let (low, high) = simulation.surface().mesh().bounds();
    let tree = AabbTree::new(simulation.surface().mesh());
    let top = 0.5 * (low.z + high.z);
    let sides = [low.x - 1.0, high.x + 1.0].map(|x| {
        let (point, normal) = nearest(&simulation, &tree, &Vec3::new(x, 0.0, top));
        let turned = UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap_or_default();
        (point, normal, turned)
    });
    let mut hands = Hands::new(&simulation);
    let mut go = |height: f64, grip: f64| {
        let poses =
            sides.map(|(point, normal, turned)| pose(&(point + normal * height), &turned, grip));
        hands.go(&poses);
    };
    for step in 0..=10 {
        go(1e-3 - 1e-4 * f64::from(step), 0.0);
    }
    for step in 0..=10 {
        go(0.0, 0.1 * f64::from(step));
    }
    for step in 0..=60 {
        go((2e-4 * f64::from(step)).min(1e-2), 1.0);
    }
    let forces = [0, 1].map(|tool| hands.state.tools[tool].force);
    println!("{forces:?}");
    assert!(forces[0].x > 0.05 && forces[1].x < -0.05, "{forces:?}");
    let unequal = (forces[0].x + forces[1].x).abs() / forces[0].x;
    assert!(unequal < 0.02, "{unequal}");
}

/// A tip that sticks and is dragged takes what surrounds it along: a place beside it, two radii away, goes a good part of the
/// way. And no hole is torn: neighbours stay neighbours.
#[test]
fn a_dragged_tip_takes_its_surroundings_along() {
    let setting = Setting {
        organ: "builtin = \"hemisphere\"\ntriangles = 2000",
        contact: "stick",
        ..LIVER
    };
    let simulation = setting.simulation();
    let mut hand = Hand::new(&simulation);
    let top = Vec3::new(0.0, 0.0, 0.05);
    // Deep enough to be below the organ at the end as well.
    let depth = 4e-3;
    for step in 0..=40 {
        hand.at(&(top - Vec3::z() * (depth * f64::from(step) / 40.0)));
    }
    let way = 0.01;
    for step in 0..=100 {
        hand.at(&(top - Vec3::z() * depth + Vec3::x() * (way * f64::from(step) / 100.0)));
    }
    let rest = simulation.surface().mesh();
    let moved = |node: palpate_geometry::NodeId| {
        hand.state.deformed.vertices()[node.index()] - rest.vertices()[node.index()]
    };
    let mut torn = 0.0_f64;
    let mut beside = Vec::new();
    for triangle in rest.triangle_ids() {
        let [a, b, _] = rest.corners(triangle);
        let edge = (rest.vertices()[a.index()] - rest.vertices()[b.index()]).norm();
        torn = torn.max((moved(a) - moved(b)).norm() / edge);
        let apart = (rest.vertices()[a.index()] - top).norm();
        if (1.5..2.5).contains(&(apart / 4e-3)) {
            beside.push(moved(a).x / way);
        }
    }
    let mean = beside.iter().sum::<f64>() / beside.len() as f64;
    println!("beside it {mean:.2} of the way, steepest change {torn:.2}");
    assert!(mean > 0.2 && mean < 1.0, "{mean}");
    // A sheared half-space has 4/π of the way over a radius at the tip's edge; triangles are 3 mm wide.
    assert!(torn < 8.0, "{torn}");
}

/// Whatever two hands do, at up to a metre a second: every force is a number and small, what does not follow is told, and
/// the organ is at rest afterwards.
#[test]
#[ignore = "long"]
fn random_gestures_leave_an_organ_at_rest() {
    for (organ, contact, poissons_ratio) in [
        ("builtin = \"esophagus\"", "slip", 0.49),
        ("builtin = \"kidney\"\ntriangles = 800", "stick", 0.3),
    ] {
        gestures(
            &Setting {
                organ,
                contact,
                poissons_ratio,
                model: "nodes = 700",
                ..LIVER
            },
            4,
        );
    }
}

/// As `random_gestures_leave_an_organ_at_rest`, many more.
#[test]
#[ignore = "slow: 192 gestures of two hands on four organs, five minutes"]
fn many_random_gestures_leave_an_organ_at_rest() {
    for contact in ["slip", "stick"] {
        for poissons_ratio in [0.3, 0.45, 0.49] {
            for organ in ["esophagus", "liver", "kidney", "stomach"] {
                let setting = Setting {
                    organ: &format!("builtin = \"{organ}\"\ntriangles = 1200"),
                    contact,
                    poissons_ratio,
                    ..LIVER
                };
                gestures(&setting, 8);
            }
        }
    }
}

fn gestures(setting: &Setting<'_>, count: usize) {
    let simulation = Simulation::new(&grasping(setting, Jaws::GRASPER, 2)).unwrap();
    let tree = AabbTree::new(simulation.surface().mesh());
    let mut random = Random(7);
    let (mut largest, mut lost, mut steps) = (0.0_f64, 0, 0);
    for _ in 0..count {
        let mut hands = Hands::new(&simulation);
        let turned = UnitQuaternion::identity();
        let place = |random: &mut Random| {
            let (point, normal) = nearest(&simulation, &tree, &random.place(&simulation).0);
            point + normal * (0.03 * random.unit() - 0.01)
        };
        let mut tips = [place(&mut random), place(&mut random)];
        let mut grips = [0.0; 2];
        for _ in 0..8 {
            let goals = [place(&mut random), place(&mut random)];
            let (speed, part) = (0.2 + 0.8 * random.unit(), 0.2 + 0.8 * random.unit().powi(3));
            for grip in &mut grips {
                if random.unit() < 0.4 {
                    *grip = 1.0 - *grip;
                }
            }
            let starts = tips;
            let way = (goals[0] - starts[0])
                .norm()
                .max((goals[1] - starts[1]).norm())
                * part;
            let count = (way / (speed * simulation.step())).ceil().max(1.0);
            for step in 1..=count as usize {
                for (tip, (start, goal)) in tips.iter_mut().zip(starts.iter().zip(&goals)) {
                    *tip = start + (goal - start) * (part * step as f64 / count);
                }
                hands.go(&[
                    pose(&tips[0], &turned, grips[0]),
                    pose(&tips[1], &turned, grips[1]),
                ]);
                steps += 1;
                for tool in &hands.state.tools {
                    assert!(tool.force.iter().all(|component| component.is_finite()));
                    largest = largest.max(tool.force.norm());
                    lost += usize::from(tool.row.events.contains(Event::NoEquilibrium));
                }
                let far = displaced(&hands, &simulation);
                assert!(far.is_finite() && far < 1.0, "{far}");
            }
        }
        for _ in 0..200 {
            hands.go(&[None, None]);
        }
        let left = displaced(&hands, &simulation);
        assert!(left < 1e-6, "{left}");
    }
    println!("largest force {largest:.2} N, {lost} lost in {steps} steps");
}

/// What cannot be is refused with its key.
#[test]
fn a_scene_says_how_many_nodes() {
    let text = |nodes: &str| {
        format!(
            "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n[model]\nkind = \"nonlinear\"\nnodes = {nodes}\n[[tool]]\nname = \"right\"\n"
        )
    };
    let error = Scene::parse(&text("7"), "scene.toml").unwrap_err();
    assert!(error.to_string().contains("nodes"), "{error}");
    let scene = Scene::parse(&text("800"), "scene.toml").unwrap();
    assert_eq!(scene.model.nodes, Some(800));
}
