//! The whole organ at large deformation.

use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::Simulation;

use crate::scenes::{Hand, Random, Setting, nearest};

const LIVER: Setting<'_> = Setting {
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
fn press(simulation: &Simulation, (point, normal): (&Vec3, &Vec3), depth: f64) -> Vec3 {
    let mut hand = Hand::new(simulation);
    let steps = (depth / 0.25e-3).ceil() as usize;
    let mut force = Vec3::zeros();
    for step in 0..steps + 10 {
        let part = (step as f64 / steps as f64).min(1.0);
        force = hand.at(&(point - normal * (part * depth)));
    }
    force
}

#[test]
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
        for _ in 0..12 {
            let (point, normal) = nearest(&bent, &tree, &random.place(&bent).0);
            let [found, expected] =
                [&bent, &linear].map(|simulation| press(simulation, (&point, &normal), 0.5e-3));
            println!(
                "{poissons_ratio} {shape} {contact}: {:.3} {:.3}, ratio {:.3}",
                1e3 * found.norm(),
                1e3 * expected.norm(),
                found.norm() / expected.norm()
            );
        }
    }
}

#[test]
fn lab_hemisphere() {
    for nodes in [700, 1500, 3000, 5000] {
        let model = format!("nodes = {nodes}");
        let setting = Setting {
            organ: "builtin = \"hemisphere\"\ntriangles = 1000",
            radius: 3e-3,
            model: &model,
            ..LIVER
        };
        let simulation = setting.simulation();
        let mut forces = Vec::new();
        for direction in [
            Vec3::z(),
            Vec3::new(0.3, 0.1, 1.0),
            Vec3::new(-0.5, 0.4, 1.0),
            Vec3::new(0.2, -0.6, 1.0),
        ] {
            let normal = direction.normalize();
            forces.push(1e3 * press(&simulation, (&(normal * 0.05), &normal), 1e-3).norm());
        }
        println!("{nodes}: {forces:.2?} of 78.75");
        let begun = std::time::Instant::now();
        let mut hand = Hand::new(&simulation);
        for step in 0..200 {
            hand.at(&Vec3::new(0.0, 0.0, 0.05 - 1e-5 * step as f64));
        }
        println!("{:.2} ms a step", 5.0 * begun.elapsed().as_secs_f64());
    }
    for (nodes, nu) in [(1500, 0.3), (4000, 0.3), (1500, 0.45), (4000, 0.45)] {
        let model = format!("nodes = {nodes}");
        let setting = Setting {
            poissons_ratio: nu,
            model: &model,
            ..LIVER
        };
        let bent = setting.simulation();
        let linear = Setting {
            kind: "hybrid",
            organ: "builtin = \"liver\"\ntriangles = 3000",
            model: "",
            ..setting
        }
        .simulation();
        let tree = AabbTree::new(bent.surface().mesh());
        let mut random = Random(5);
        for _ in 0..6 {
            let (point, normal) = nearest(&bent, &tree, &random.place(&bent).0);
            let [found, expected] =
                [&bent, &linear].map(|simulation| press(simulation, (&point, &normal), 0.5e-3));
            println!(
                "{nodes} {nu}: {:.3} {:.3}, ratio {:.3}",
                1e3 * found.norm(),
                1e3 * expected.norm(),
                found.norm() / expected.norm()
            );
        }
    }
}
