//! An organ at large deformation beside rigid neighbours.

use nalgebra::UnitQuaternion;
use palpate_files::Scene;
use palpate_files::scene::Jaws;
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_simulate::{Simulation, read_neighbour};

use crate::grip::{Hands, pose};
use crate::scenes::nearest;

/// A grasper on the esophagus beside a block of 20 mm, 5 mm away from it and 25 mm above the place that is pulled.
fn scene(collides: bool) -> Scene {
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"esophagus\"\n[organ.tissue]\nlaw = \"linear\"\n\
         youngs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n[model]\nkind = \"nonlinear\"\n\
         [[neighbour]]\nbuiltin = \"cube\"\nscale = 0.2\nat_m = [0.0, -0.0225, 0.025]\ncollides = {collides}\n\
         [[tool]]\nname = \"right\"\ntip = {{ shape = \"flat\", radius_m = 0.004, contact = \"stick\" }}\n"
    );
    let mut scene = Scene::parse(&text, "scene.toml").unwrap();
    scene.tools[0].jaws = Some(Jaws {
        force_n: 100.0,
        ..Jaws::GRASPER
    });
    scene
}

/// How deep the surface that is seen lies in the block at most [m], and the force on the tool [N].
struct Pulled {
    deepest: f64,
    force: Vec3,
    left: f64,
    moved: f64,
}

/// The esophagus is pulled aside by 20 mm, past the block, held for a moment, and let go.
fn pull(collides: bool) -> Pulled {
    let scene = scene(collides);
    let simulation = Simulation::new(&scene).unwrap();
    let (block, _) = read_neighbour(&scene.neighbours[0]).unwrap();
    let boxes = AabbTree::new(block.mesh());
    let tree = AabbTree::new(simulation.surface().mesh());
    let at = Vec3::new(0.0, -0.0075, 0.0);
    let (point, normal) = nearest(&simulation, &tree, &at);
    let turned = UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap_or_default();
    let mut hands = Hands::new(&simulation);
    for step in 0..=10 {
        let height = 1e-3 - 1e-4 * f64::from(step);
        hands.go(&[pose(&(point + normal * height), &turned, 0.0)]);
    }
    for step in 0..=10 {
        hands.go(&[pose(&point, &turned, 0.1 * f64::from(step))]);
    }
    assert!(hands.state.tools[0].holds());
    let mut pulled = Pulled {
        deepest: 0.0,
        force: Vec3::zeros(),
        left: 0.0,
        moved: 0.0,
    };
    for step in 0..=60 {
        let way = (5e-4 * f64::from(step)).min(0.02);
        hands.go(&[pose(&(point - Vec3::y() * way), &turned, 1.0)]);
        let deepest = deepest(&hands, (&block, &boxes));
        pulled.deepest = pulled.deepest.max(deepest);
    }
    pulled.force = hands.state.tools[0].force;
    pulled.moved = moved(&hands, &simulation);
    for _ in 0..80 {
        hands.go(&[pose(&(point - Vec3::y() * 0.02), &turned, 0.0)]);
    }
    pulled.left = moved(&hands, &simulation);
    pulled
}

fn deepest(hands: &Hands<'_>, (block, boxes): (&Surface, &AabbTree)) -> f64 {
    let vertices = hands.state.deformed.vertices().iter();
    let depths = vertices.map(|vertex| -block.signed_distance(boxes, vertex).1);
    depths.fold(0.0, f64::max)
}

fn moved(hands: &Hands<'_>, simulation: &Simulation) -> f64 {
    let vertices = hands.state.deformed.vertices().iter();
    let rest = simulation.surface().mesh().vertices();
    let moved = vertices.zip(rest).map(|(now, rest)| (now - rest).norm());
    moved.fold(0.0, f64::max)
}

/// Judge: the block itself. Without contact the tube goes through it; with contact what is seen lies in it no deeper than a
/// tenth of a millimetre and what a facet of the block's edge takes between two points of the tube's boundary (6 mm apart). The hand feels it.
#[test]
fn a_pulled_tube_stays_out_of_a_block() {
    let [free, stopped] = [false, true].map(pull);
    for pulled in [&free, &stopped] {
        println!(
            "{:.2} mm deep, {:.3} N, moved {:.1} mm, {:.1e} m left",
            1e3 * pulled.deepest,
            pulled.force.norm(),
            1e3 * pulled.moved,
            pulled.left
        );
    }
    assert!(free.deepest > 4e-3, "{}", free.deepest);
    assert!(stopped.deepest < 1e-3, "{}", stopped.deepest);
    assert!(stopped.force.y > 1.05 * free.force.y, "{}", stopped.force);
    assert!(stopped.left < 1e-6, "{}", stopped.left);
}
