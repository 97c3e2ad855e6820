//! An organ at large deformation beside neighbours that bend.

use palpate_files::Scene;
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_simulate::{Simulation, read_neighbour};

use crate::grip::{grasping, pose};
use crate::nonlinear::{LIVER, STRONG, displaced, holding};
use crate::scenes::{Hand, Setting};

/// What stands beside the esophagus.
#[derive(Clone, Copy)]
enum Beside {
    Rigid,
    /// With this modulus [Pa].
    Soft(f64),
    Nothing,
}

/// Half a ball of 15 mm, 5 mm beside the esophagus and 15 mm above the place that is pulled.
fn scene(beside: Beside, friction: f64) -> Scene {
    let setting = Setting {
        organ: "builtin = \"esophagus\"",
        contact: "stick",
        ..LIVER
    };
    let kind = match beside {
        Beside::Rigid => "collides = true\n".to_owned(),
        Beside::Soft(modulus) => format!(
            "nodes = 500\n[neighbour.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = {modulus:?}\n\
             poissons_ratio = 0.45\n"
        ),
        Beside::Nothing => String::new(),
    };
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n[model]\nkind = \"nonlinear\"\n\
         [[neighbour]]\nbuiltin = \"hemisphere\"\nscale = 0.3\nturn_deg = [-90, 0, 0]\nat_m = [0.0, -0.0275, 0.015]\n\
         friction = {friction:?}\n{kind}"
    );
    let beside = Scene::parse(&text, "scene.toml").unwrap();
    Scene {
        neighbours: beside.neighbours,
        ..grasping(&setting, STRONG, 1)
    }
}

/// How it went: the force at the end of the pull [N], its work and that of the first part [J], how far the ball moved [m], how deep what is seen of the tube lies in it at
/// most, and what is left once the tube is let go.
struct Pulled {
    force: Vec3,
    work: f64,
    early: f64,
    ball: f64,
    deepest: f64,
    left: f64,
}

/// How far the esophagus is pulled aside [m], the first part of it, and what a period adds.
const ASIDE: f64 = 0.02;
const EARLY: f64 = 0.012;
const STEP: f64 = 2.5e-4;

/// The esophagus is pulled aside, past the ball, in steps of this length [m], held for a moment, and let go.
fn pull(beside: Beside, friction: f64, length: f64) -> Pulled {
    let scene = scene(beside, friction);
    let simulation = Simulation::new(&scene).unwrap();
    let (ball, _) = read_neighbour(&scene.neighbours[0]).unwrap();
    let count = match beside {
        Beside::Soft(_) => ball.mesh().vertices().len(),
        Beside::Rigid | Beside::Nothing => 0,
    };
    // The shaft appears within the ball, and passes through it.
    let (mut hands, point, turned) = holding(&simulation, &Vec3::new(0.0, -0.0075, 0.0));
    let mut pulled = Pulled {
        force: Vec3::zeros(),
        work: 0.0,
        early: 0.0,
        ball: 0.0,
        deepest: 0.0,
        left: 0.0,
    };
    let mut before = 0.0;
    for step in 0..=(1.25 * ASIDE / length) as u32 {
        let way = (length * f64::from(step)).min(ASIDE);
        hands.go(&[pose(&(point - Vec3::y() * way), &turned, 1.0)]);
        let force = hands.state.tools[0].force;
        let work = 0.5 * (pulled.force + force).y * (way - before);
        pulled.work += work;
        if way <= EARLY {
            pulled.early += work;
        }
        (pulled.force, before) = (force, way);
    }
    let seen = hands.state.deformed.vertices();
    let (tube, bent) = seen.split_at(seen.len() - count);
    let there = ball.mesh().vertices().iter().zip(bent);
    pulled.ball = there
        .map(|(rest, now)| (now - rest).norm())
        .fold(0.0, f64::max);
    let mut moved = ball.mesh().clone();
    for (number, now) in bent.iter().enumerate() {
        moved.move_vertex(palpate_geometry::NodeId(number as u32), *now);
    }
    let moved = Surface::new(moved).unwrap();
    let boxes = AabbTree::new(moved.mesh());
    let depths = tube
        .iter()
        .map(|place| -moved.signed_distance(&boxes, place).1);
    pulled.deepest = depths.fold(0.0, f64::max);
    for _ in 0..80 {
        hands.go(&[pose(&(point - Vec3::y() * ASIDE), &turned, 0.0)]);
    }
    pulled.left = displaced(&hands, &simulation);
    pulled
}

/// Judge: energy. What is elastic and free of friction takes less work the softer it is: less than a stiffer ball, and more
/// than none; friction takes more, by 8 and 15 %, and at any pace the same, to 2 %: 0.4 % was found with steps a quarter as long. A ball of a hundred times the tube's modulus takes as much as the rigid one but for 10 %:
/// 8 % were found, which fall with the tube's elements (beside 400 nodes 4.4, 3.3 and 1.4 % with 1,500, 3,000 and 5,000). What
/// is seen of tube and ball lies beside the surfaces that touch by 6²/(8 · 7.5) and 3²/(8 · 15) mm.
#[test]
#[ignore = "long"]
fn a_pulled_tube_pushes_a_neighbour_that_bends() {
    let show = |name: &str, pulled: &Pulled| {
        println!(
            "{name}: {:.3} N, {:.3} mJ, ball moved {:.2} mm, {:.2} mm deep, {:.1e} m left",
            pulled.force.y,
            1e3 * pulled.work,
            1e3 * pulled.ball,
            1e3 * pulled.deepest,
            pulled.left
        );
    };
    let free = pull(Beside::Nothing, 0.0, STEP);
    let rigid = pull(Beside::Rigid, 0.0, STEP);
    let stiff = pull(Beside::Soft(1e6), 0.0, STEP);
    let firm = pull(Beside::Soft(3e4), 0.0, STEP);
    let soft = pull(Beside::Soft(3e3), 0.0, STEP);
    let firm_rubbed = pull(Beside::Soft(3e4), 0.3, STEP);
    let rubbed = pull(Beside::Soft(3e3), 0.3, STEP);
    let slowly = pull(Beside::Soft(3e3), 0.3, 0.25 * STEP);
    for (name, pulled) in [
        ("free", &free),
        ("rigid", &rigid),
        ("stiff", &stiff),
        ("firm", &firm),
        ("soft", &soft),
        ("firm, rubbed", &firm_rubbed),
        ("soft, rubbed", &rubbed),
        ("soft, rubbed, slowly", &slowly),
    ] {
        show(name, pulled);
    }
    let falls = [&stiff, &firm, &soft, &free].map(|pulled| pulled.work);
    for pair in falls.windows(2) {
        assert!(pair[0] > 1.01 * pair[1], "{falls:?}");
    }
    assert!((stiff.work / rigid.work - 1.0).abs() < 0.1, "{falls:?}");
    assert!(soft.ball > 5e-4, "{}", soft.ball);
    assert!(rubbed.work > 1.02 * soft.work, "{}", rubbed.work);
    assert!(rubbed.early > 1.005 * soft.early, "{}", rubbed.early);
    assert!(firm_rubbed.work > 1.02 * firm.work, "{}", firm_rubbed.work);
    assert!((slowly.work / rubbed.work - 1.0).abs() < 0.02);
    for pulled in [&stiff, &firm, &soft, &firm_rubbed, &rubbed] {
        assert!(pulled.deepest < 0.68e-3, "{}", pulled.deepest);
        assert!(pulled.left < 1e-4, "{}", pulled.left);
    }
}

/// The force at the end of a press of 2 mm down from `at` [m].
fn press(text: &str, at: Vec3) -> Vec3 {
    let simulation = Simulation::new(&Scene::parse(text, "scene.toml").unwrap()).unwrap();
    let mut hand = Hand::new(&simulation);
    let mut force = Vec3::zeros();
    for step in 0..=30 {
        let depth = 1e-4 * f64::from(step.min(20));
        force = hand.at(&(at - Vec3::z() * depth));
    }
    force
}

/// Judge: the same body and tissue as the organ of a scene of its own, pressed at the same place: 3 %, for another place
/// has another filling, as `nonlinear::a_press_does_not_depend_on_the_number_of_nodes`.
#[test]
fn a_tip_presses_a_neighbour_as_an_organ() {
    let tool = "[[tool]]\nname = \"probe\"\nkind = \"probe\"\ntip = { shape = \"flat\", radius_m = 0.003 }\n";
    let tissue = "law = \"linear\"\nyoungs_modulus_pa = 20000.0\npoissons_ratio = 0.4\n";
    let body = "builtin = \"hemisphere\"\n";
    let alone = format!(
        "format = 1\n[organ]\n{body}[organ.tissue]\n{tissue}[model]\nkind = \"nonlinear\"\nnodes = 700\n{tool}"
    );
    let beside = format!(
        "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n[[neighbour]]\n{body}nodes = 700\n\
         at_m = [0.3, 0.0, 0.0]\n[neighbour.tissue]\n{tissue}[model]\nkind = \"nonlinear\"\nnodes = 300\n{tool}"
    );
    let expected = press(&alone, Vec3::z() * 0.05);
    let found = press(&beside, Vec3::new(0.3, 0.0, 0.05));
    println!("{expected:?} {found:?}");
    assert!(expected.z > 0.05, "{expected}");
    assert!(
        (found - expected).norm() < 0.03 * expected.norm(),
        "{found}"
    );
}

/// Judge: the same body as the first organ of a scene of its own, with the same layer and ball, to the same 3 %; and without
/// them the force is another.
#[test]
#[ignore = "long"]
fn a_further_organ_has_its_own_layers_and_inclusions() {
    let tool =
        "[[tool]]\ntip = { shape = \"flat\", radius_m = 0.003, contact = { coulomb = 0.5 } }\n";
    let tissue = |modulus: f64| {
        format!(
            "tissue = {{ law = \"linear\", youngs_modulus_pa = {modulus:?}, poissons_ratio = 0.4 }}\n"
        )
    };
    let soft = tissue(8000.0);
    let regions = |x: f64| {
        format!(
            "[[organ.region]]\nname = \"skin\"\nlayer = {{ thickness_m = 0.004 }}\n{}\
             [[organ.region]]\nname = \"lump\"\nball = {{ center_m = [{x:?}, 0.0, 0.03], radius_m = 0.01 }}\n{}",
            tissue(20_000.0),
            tissue(80_000.0)
        )
    };
    let alone = format!(
        "format = 1\n[[organ]]\nbuiltin = \"hemisphere\"\n{soft}{}[model]\nkind = \"nonlinear\"\nnodes = 700\n{tool}",
        regions(0.0)
    );
    let beside = |x: f64, regions: &str| {
        format!(
            "format = 1\n[[organ]]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n\
             [[organ]]\nbuiltin = \"hemisphere\"\n{soft}nodes = 700\nat_m = [{x:?}, 0.0, 0.0]\n{regions}\
             [model]\nkind = \"nonlinear\"\nnodes = 300\n{tool}"
        )
    };
    let expected = press(&alone, Vec3::z() * 0.05);
    // Rounding makes another mesh of it at each place, whose force is up to 3 % off the mean.
    let places = [0.28, 0.3, 0.31];
    let at = |x: f64| Vec3::new(x, 0.0, 0.05);
    let found = places.map(|x| press(&beside(x, &regions(x)), at(x)));
    let found = found.iter().sum::<Vec3>() / places.len() as f64;
    let plain = press(&beside(0.3, ""), at(0.3));
    println!("{expected:?} {found:?} {plain:?}");
    assert!(
        (found - expected).norm() < 0.03 * expected.norm(),
        "{found}"
    );
    assert!(plain.z < 0.7 * found.z, "{plain}");
}

/// Judge: the sentences. A neighbour that bends needs the nonlinear model, and has to be held.
#[test]
fn neighbours_that_cannot_bend_are_refused() {
    let text = |kind: &str, more: &str| {
        format!(
            "format = 1\n[organ]\nbuiltin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n[model]\nkind = \"{kind}\"\n\
             nodes = 300\n[[neighbour]]\nbuiltin = \"cube\"\nat_m = [0.3, 0.0, 0.0]\n{more}"
        )
    };
    let refused = |kind: &str, more: &str| match Scene::parse(&text(kind, more), "scene.toml") {
        Err(error) => error.to_string(),
        Ok(scene) => Simulation::new(&scene).unwrap_err().to_string(),
    };
    let tissue = "builtin_tissue = \"pig-liver\"\n";
    let sphere = "[[neighbour.anchor.spheres]]\ncenter_m = [0.0, 0.0, 1.0]\nradius_m = 0.01\n";
    for (kind, more, says) in [
        ("local", tissue.to_owned(), "nonlinear"),
        ("hybrid", tissue.to_owned(), "nonlinear"),
        (
            "nonlinear",
            format!("{tissue}collides = true\n"),
            "collides",
        ),
        ("nonlinear", "nodes = 300\n".to_owned(), "nodes"),
        ("nonlinear", format!("{tissue}{sphere}"), "number 1"),
    ] {
        let sentence = refused(kind, &more);
        println!("{sentence}");
        assert!(sentence.contains(says), "{sentence}");
    }
    let auto = Scene::parse(&text("auto", tissue), "scene.toml").unwrap();
    assert_eq!(auto.model.kind.word(), "nonlinear");
}
