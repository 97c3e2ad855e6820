//! Shafts of tools against an organ at large deformation.

use std::sync::Arc;

use nalgebra::UnitQuaternion;
use palpate_files::scene::TipContact;
use palpate_files::{Event, Pose, Scene, Session};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::interactive::affine_force;
use palpate_simulate::{Replay, Simulation, ToolState, read_neighbour};

use crate::grip::{Hands, grasping, pose};
use crate::nonlinear::{LIVER, STRONG, displaced};
use crate::scenes::{Random, Setting, nearest};

const RADIUS: f64 = 4e-3;

/// A cube of 100 mm that is held below, and a ball on a shaft of its width.
const CUBE: Setting<'_> = Setting {
    organ: "builtin = \"cube\"",
    shape: "sphere",
    radius: RADIUS,
    ..LIVER
};

/// A tool's +z along this direction.
fn along(direction: &Vec3) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(&Vec3::z(), direction).unwrap()
}

fn with_trocar(trocar: Option<Vec3>) -> Simulation {
    let mut scene = CUBE.scene();
    scene.tools[0].trocar_m = trocar.map(Into::into);
    Simulation::new(&scene).unwrap()
}

/// Whose tip and shaft slide beyond Coulomb's force.
pub(crate) fn with_friction(setting: &Setting<'_>, friction: f64) -> Simulation {
    let mut scene = setting.scene();
    scene.tools[0].tip.contact = TipContact::Stick;
    scene.tools[0].tip.friction = Some(friction);
    Simulation::new(&scene).unwrap()
}

/// Takes the tip down to `tip` [m] from 10 mm above in 40 steps, and lets it stand.
fn lay<'a>(simulation: &'a Simulation, tip: &Vec3, turned: &UnitQuaternion<f64>) -> Hands<'a> {
    let mut hands = Hands::new(simulation);
    for step in 0..50 {
        let above = 0.01 * (1.0 - f64::from(step) / 40.0).max(0.0);
        hands.go(&[pose(&(tip + Vec3::z() * above), turned, 0.0)]);
    }
    hands
}

fn tool<'a>(hands: &'a Hands<'_>) -> &'a ToolState {
    &hands.state.tools[0]
}

/// The top of the cube, with a tip beside it and a shaft of 300 mm that lies across its middle.
fn beside(depth: f64) -> Vec3 {
    let scene = CUBE.scene();
    let simulation = Simulation::new(&scene).unwrap();
    let (_, high) = simulation.surface().mesh().bounds();
    Vec3::new(-0.07, 0.0, high.z + RADIUS - depth)
}

/// Judge: symmetry. A shaft that lies across the middle of a cube is pushed up alone, and turned about its tip as by a force at
/// the cube's middle, 70 mm from the tip. Tolerance: the cube's elements are not symmetric. Judge of a trocar: the lever. With the trocar at the
/// end of the same shaft, the tip feels 23/30 of the force.
#[test]
fn a_shaft_across_a_cube_is_pushed_at_its_middle() {
    let tip = beside(4e-3);
    let turned = along(&Vec3::x());
    let free = with_trocar(None);
    let hands = lay(&free, &tip, &turned);
    let (force, torque) = (tool(&hands).force, tool(&hands).torque);
    println!("{force:?} N, {torque:?} N m");
    assert!(!tool(&hands).row.contact);
    assert!(force.z > 0.5, "{force}");
    assert!(force.xy().norm() < 0.03 * force.z, "{force}");
    assert!(torque.x.abs() < 1e-12, "{torque}");
    let arm = Vec3::new(-torque.y, torque.z, 0.0).norm() / force.norm();
    assert!((arm / 0.07 - 1.0).abs() < 0.03, "{arm}");
    let held = with_trocar(Some(tip + Vec3::x() * 0.3));
    // With a trocar the shaft turns about it: so it comes from above along an arc, and lies as the other at its end.
    let leant = lay(&held, &tip, &turned);
    let felt = tool(&leant).force;
    println!("{felt:?} N at the tip");
    assert!((felt.z / force.z - 23.0 / 30.0).abs() < 0.03, "{felt}");
    assert_eq!(tool(&leant).torque, Vec3::zeros());
}

/// Judge: Coulomb's law. A shaft on a cube that is drawn along its axis meets less friction than μ N, then μ N, but for 3 %: the
/// cube bulges. It is so the other way too, and the hand's work on the way there and back is what friction takes.
#[test]
#[ignore = "long"]
fn a_shaft_drawn_along_itself_slides_at_coulombs_force() {
    let (friction, by) = (0.2, 1e-4);
    let simulation = with_friction(&CUBE, friction);
    let (tip, turned) = (beside(4e-3), along(&Vec3::x()));
    let mut hands = lay(&simulation, &tip, &turned);
    let (mut at, mut work, mut last) = (0.0, 0.0, tool(&hands).force);
    assert!(last.x.abs() < 0.1 * friction * last.z, "{last}");
    for (direction, steps) in [(1.0, 60), (-1.0, 120)] {
        for step in 1..=steps {
            at += direction * by;
            hands.go(&[pose(&(tip + Vec3::x() * at), &turned, 0.0)]);
            let now = tool(&hands).force;
            work -= 0.5 * (last + now).x * direction * by;
            last = now;
            let part = -direction * now.x / (friction * now.z);
            assert!(part < 1.03, "{part}");
            assert!(step > 1 || part.abs() < 1.0 - 1e-6 || direction < 0.0);
            if step == steps {
                println!("{part:.4} of the cone at {at} m, {now:?} N, {work} J");
                assert!(part > 0.97, "{part}");
            }
        }
    }
    assert!(work > 0.0, "{work}");
}

/// Judge: the next step's own answer, where a shaft sticks: a tenth of a millimetre along it.
#[test]
fn the_stiffness_of_a_shaft_that_sticks_is_that_of_its_force() {
    let simulation = with_friction(&CUBE, 2.0);
    let (tip, turned) = (beside(4e-3), along(&Vec3::x()));
    let mut hands = lay(&simulation, &tip, &turned);
    let before = affine_force(&simulation.tools()[0], tool(&hands), 0.0);
    let further = Vec3::x() * 1e-4;
    for _ in 0..10 {
        hands.go(&[pose(&(tip + further), &turned, 0.0)]);
    }
    let grown = tool(&hands).force - before.force;
    let foreseen = before.gradient * further;
    println!("{grown:?} N, foreseen {foreseen:?}");
    assert!((foreseen - grown).norm() < 0.15 * grown.norm());
}

/// Judge: rows of the session say what the tool's state does.
#[test]
fn rows_have_the_torque() {
    let free = with_trocar(None);
    let hands = lay(&free, &beside(4e-3), &along(&Vec3::x()));
    let own = tool(&hands);
    assert_eq!(Vec3::from(own.row.torque_nm), own.torque);
    assert_eq!(Vec3::from(own.row.force_n), own.force);
}

/// Judge: what a servo between two steps extrapolates to, against the next step's own answer. Half a millimetre further the force
/// has grown by as much as its stiffness says, within 15 %: more of the shaft touches then.
#[test]
fn the_stiffness_of_a_shaft_is_that_of_its_force() {
    let free = with_trocar(None);
    let turned = along(&Vec3::x());
    let tip = beside(4e-3);
    let mut hands = lay(&free, &tip, &turned);
    let before = affine_force(&free.tools()[0], tool(&hands), 0.0);
    let further = Vec3::z() * -0.5e-3;
    for _ in 0..10 {
        hands.go(&[pose(&(tip + further), &turned, 0.0)]);
    }
    let after = tool(&hands).force;
    let foreseen = before.force + before.gradient * further;
    println!("{:?} then {after:?}, foreseen {foreseen:?}", before.force);
    let (grown, said) = (after.z - before.force.z, foreseen.z - before.force.z);
    assert!((said / grown - 1.0).abs() < 0.15, "{said} {grown}");
}

/// Judge: energy. A shaft that is laid on a cube, moved around and lifted in small steps is given no more work than was done, but
/// for 1 % of what was stored, and the cube is at rest afterwards.
#[test]
#[ignore = "long"]
fn a_shaft_gains_no_energy_and_leaves_rest() {
    let simulation = with_trocar(None);
    let turned = along(&Vec3::x());
    let middle = beside(3e-3);
    let mut hands = Hands::new(&simulation);
    let mut random = Random(3);
    let above = middle + Vec3::z() * 0.01;
    let mut goals = vec![(middle, 80)];
    goals.extend((0..40).map(|_| {
        let by = Vec3::from_fn(|axis, _| [4e-3, 1e-2, 4e-3][axis] * (random.unit() - 0.5));
        (middle + by, 10)
    }));
    goals.push((above, 80));
    let (mut tip, mut force) = (above, Vec3::zeros());
    let (mut work, mut stored) = (0.0_f64, 0.0_f64);
    for (goal, steps) in goals {
        let way = (goal - tip) / f64::from(steps);
        for _ in 0..steps {
            tip += way;
            hands.go(&[pose(&tip, &turned, 0.0)]);
            let now = tool(&hands).force;
            work -= 0.5 * (force + now).dot(&way);
            force = now;
            stored = stored.max(work);
        }
    }
    println!("{work:.2e} J in all, {stored:.2e} J at most");
    assert!(work > -0.01 * stored, "{work} {stored}");
    assert_eq!(force, Vec3::zeros());
    let left = displaced(&hands, &simulation);
    assert!(left < 1e-6, "{left}");
}

/// Nothing of the surface that is seen lies in a shaft that pushes a tube aside by 15 mm, at 50 mm/s, deeper than a sixth of its
/// radius: what the surface bulges between the points that bear. Judge of the force in motion: the same, held.
#[test]
fn a_tube_does_not_pass_through_a_shaft() {
    let setting = Setting {
        organ: "builtin = \"esophagus\"",
        shape: "sphere",
        radius: 5e-3,
        ..LIVER
    };
    let simulation = setting.simulation();
    let (_, high) = simulation.surface().mesh().bounds();
    let turned = along(&Vec3::x());
    let mut hands = Hands::new(&simulation);
    let mut deepest = 0.0_f64;
    for step in 0..=60 {
        let way = 0.25e-3 * f64::from(step);
        let tip = Vec3::new(-0.05, high.y + 5e-3 - way, 0.0);
        hands.go(&[pose(&tip, &turned, 0.0)]);
        for vertex in hands.state.deformed.vertices() {
            let off = vertex - tip;
            deepest = deepest.max(5e-3 - off.yz().norm());
        }
    }
    let moving = tool(&hands).force;
    for _ in 0..30 {
        hands.go(&[pose(&Vec3::new(-0.05, high.y - 10e-3, 0.0), &turned, 0.0)]);
    }
    let force = tool(&hands).force;
    println!("{:.2} mm deep, {moving:?}, held {force:?} N", 1e3 * deepest);
    assert!(deepest < 5e-3 / 6.0, "{deepest}");
    assert!(
        (moving / force.norm() - force.normalize()).norm() < 0.05,
        "{moving} {force}"
    );
    assert!(displaced(&hands, &simulation) > 0.01);
}

/// Judge: the rows themselves. A shaft whose direction is not known meets nothing, and meets nothing when the session is played
/// again, although rows have an orientation; one that is known pushes again, to the last bit.
#[test]
#[ignore = "long"]
fn sessions_say_whether_a_shaft_was_known() {
    let simulation = Arc::new(with_trocar(None));
    for turned in [None, Some(along(&Vec3::x()))] {
        let mut hands = Hands::new(&simulation);
        let tip = beside(4e-3);
        let mut rows = Vec::new();
        for step in 0..60 {
            let above = 0.01 * (1.0 - f64::from(step) / 40.0).max(0.0);
            let pose = pose(&(tip + Vec3::z() * above), &turned.unwrap_or_default(), 0.0);
            hands.go(&[pose.map(|pose| Pose {
                orientation: pose.orientation.filter(|_| turned.is_some()),
                ..pose
            })]);
            rows.push(tool(&hands).row);
        }
        assert_eq!(rows[59].force_n[2] > 0.5, turned.is_some());
        let told = rows[0].events.contains(Event::ShaftUnknown);
        assert_eq!(told, turned.is_none());
        let session = Session {
            header: simulation.session_header(),
            tools: vec!["right".to_owned()],
            rows: rows.clone(),
            has_torques: true,
            incomplete: None,
        };
        let mut replay = Replay::new(Arc::clone(&simulation), &session).unwrap();
        for row in &rows {
            assert!(replay.advance());
            let again = &replay.state().tools[0].row;
            assert_eq!(
                (again.force_n, again.torque_nm),
                (row.force_n, row.torque_nm)
            );
            assert_eq!(again.events, row.events);
        }
    }
}

#[test]
fn a_few_gestures_with_shafts_leave_an_organ_at_rest() {
    at_rest_after(1);
}

#[test]
#[ignore = "slow: 24 gestures, minutes"]
fn random_gestures_with_shafts_leave_an_organ_at_rest() {
    at_rest_after(4);
}

/// Whatever a tool with a shaft does, at up to a metre a second: every force is a number, and the organ is at rest
/// afterwards. So many `times`, of six gestures each.
fn at_rest_after(times: usize) {
    let setting = Setting {
        organ: "builtin = \"liver\"\ntriangles = 800",
        model: "nodes = 700",
        radius: 2.5e-3,
        ..LIVER
    };
    let simulation = setting.simulation();
    let tree = AabbTree::new(simulation.surface().mesh());
    let mut random = Random(11);
    for _ in 0..times {
        let mut hands = Hands::new(&simulation);
        let any = |random: &mut Random| {
            let (point, normal) = nearest(&simulation, &tree, &random.place(&simulation).0);
            let tip = point + normal * (0.04 * random.unit() - 0.01);
            let direction = Vec3::from_fn(|_, _| random.unit() - 0.5);
            (tip, along(&direction))
        };
        let (mut tip, mut turned) = any(&mut random);
        for _ in 0..6 {
            let (goal, turn) = any(&mut random);
            let speed = 0.2 + 0.8 * random.unit();
            let count = ((goal - tip).norm() / (speed * simulation.step())).ceil();
            for step in 1..=count.max(1.0) as usize {
                let part = step as f64 / count.max(1.0);
                let now = turned.try_slerp(&turn, part, 1e-9).unwrap_or(turn);
                hands.go(&[pose(&(tip + (goal - tip) * part), &now, 0.0)]);
                let own = tool(&hands);
                assert!(own.force.iter().chain(&own.torque).all(|x| x.is_finite()));
                let far = displaced(&hands, &simulation);
                assert!(far < 0.2, "{far}");
            }
            (tip, turned) = (goal, turn);
        }
        for _ in 0..200 {
            hands.go(&[None]);
        }
        let left = displaced(&hands, &simulation);
        assert!(left < 1e-6, "{left}");
    }
}

/// A grasper that holds a tube and pulls it aside, its shaft upright, pushes a body out of its way that stands 5 mm beside the tube: nothing of
/// what is seen of that lies in the shaft deeper than a quarter of its radius.
#[test]
fn jaws_that_hold_push_another_body_aside() {
    let setting = Setting {
        organ: "builtin = \"esophagus\"",
        ..LIVER
    };
    let text = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n[model]\n\
                kind = \"nonlinear\"\n[[neighbour]]\nbuiltin = \"hemisphere\"\nscale = 0.3\nturn_deg = [-90, 0, 0]\n\
                at_m = [0.0, -0.0275, 0.005]\nnodes = 500\n[neighbour.tissue]\nlaw = \"linear\"\n\
                youngs_modulus_pa = 3000.0\npoissons_ratio = 0.45\n";
    let beside = Scene::parse(text, "scene.toml").unwrap();
    let scene = Scene {
        neighbours: beside.neighbours,
        ..grasping(&setting, STRONG, 1)
    };
    let simulation = Simulation::new(&scene).unwrap();
    let (ball, _) = read_neighbour(&scene.neighbours[0]).unwrap();
    let tree = AabbTree::new(simulation.surface().mesh());
    let (point, _) = nearest(&simulation, &tree, &Vec3::new(0.0, -0.0075, 0.0));
    let upright = UnitQuaternion::identity();
    let mut hands = Hands::new(&simulation);
    for step in 0..=20 {
        let beside = 1e-4 * (10.0 - f64::from(step)).max(0.0);
        let grip = (0.1 * f64::from(step) - 1.0).max(0.0);
        hands.go(&[pose(&(point - Vec3::y() * beside), &upright, grip)]);
    }
    assert!(tool(&hands).is_grasping());
    let first = simulation.surface().mesh().vertices().len() - ball.mesh().vertices().len();
    let (mut deepest, mut moved) = (0.0_f64, 0.0_f64);
    for step in 0..=80 {
        let way = (2.5e-4 * f64::from(step)).min(7e-3);
        let tip = point - Vec3::y() * way;
        hands.go(&[pose(&tip, &upright, 1.0)]);
        let seen = &hands.state.deformed.vertices()[first..];
        for (rest, now) in ball.mesh().vertices().iter().zip(seen) {
            moved = moved.max((now - rest).norm());
            let off = now - tip;
            let beyond = (off.z - RADIUS).min(0.0);
            deepest = deepest.max(RADIUS - off.xy().norm().hypot(beyond));
        }
    }
    println!("{:.2} mm deep, moved {:.1} mm", 1e3 * deepest, 1e3 * moved);
    assert!(deepest < 0.25 * RADIUS, "{deepest}");
    assert!(moved > 4e-3, "{moved}");
}
