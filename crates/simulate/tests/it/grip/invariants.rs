//! What holds whatever jaws do.

use nalgebra::UnitQuaternion;
use palpate_files::Event;
use palpate_files::scene::Jaws;
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{Simulation, SimulationWorkspace};

use super::{HEMISPHERE, Hands, POLE, grasping, pose};
use crate::scenes::{Random, Setting, nearest};

/// The largest force [N] on two tools that press, grip, pull and turn at random, `number` times; all numbers.
fn random_grips(simulation: &Simulation, number: usize) -> (f64, usize) {
    let tree = AabbTree::new(simulation.surface().mesh());
    let mut random = Random(7);
    let (mut largest, mut held) = (0.0_f64, 0);
    let mut hands = Hands::new(simulation);
    for _ in 0..number {
        let (first, normal) = nearest(simulation, &tree, &random.place(simulation).0);
        let aside = normal.cross(&Vec3::new(0.3, 0.5, 0.8)).normalize() * (0.015 * random.unit());
        let (second, outward) = nearest(simulation, &tree, &(first + aside));
        let places = [(first, normal), (second, outward)];
        let deep = [3e-3 * random.unit(), 3e-3 * random.unit()];
        let pull = [0, 1].map(|_| Vec3::from_fn(|_, _| 0.03 * (random.unit() - 0.5)));
        let roll = std::f64::consts::TAU * random.unit();
        for k in 0..40 {
            let part = f64::from(k) / 39.0;
            let poses = [0, 1].map(|tool| {
                let (point, normal) = places[tool];
                let upright = UnitQuaternion::rotation_between(&Vec3::z(), &normal)
                    .unwrap_or_else(UnitQuaternion::identity);
                let about = UnitQuaternion::from_axis_angle(&Vec3::z_axis(), roll + part);
                let into = normal * (deep[tool] * (4.0 * part).min(1.0));
                let tip = point - into + pull[tool] * (2.0 * part - 1.0).max(0.0);
                let grip = if part > 0.3 && part < 0.95 {
                    0.5 + part
                } else {
                    0.0
                };
                pose(&tip, &(upright * about), grip.min(1.0))
            });
            hands.go(&poses);
            for own in &hands.state.tools {
                let numbers = own.force.iter().all(|value| value.is_finite());
                assert!(numbers && own.grip_force.is_finite());
                largest = largest.max(own.force.norm());
                held += usize::from(own.row.events.contains(Event::Grip));
                // What slips is at the limit, along the faces.
                if own.is_grasping() && own.grip_force > 0.0 {
                    let [i, j, k, w] = own.row.orientation;
                    let turned =
                        UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, i, j, k));
                    let pull = turned.inverse() * own.force;
                    let limit = 2.0 * Jaws::GRASPER.friction * own.grip_force;
                    let along = if pull.z < 0.0 {
                        pull.yz().norm()
                    } else {
                        pull.y.abs()
                    };
                    assert!(
                        along <= 1.001 * limit,
                        "{along} {limit} {pull:?} {:?} step {k} grip {}",
                        own.row.events,
                        own.row.grip
                    );
                }
            }
            let vertices = hands.state.deformed.vertices().iter();
            let largest = vertices.map(|vertex| vertex.norm()).fold(0.0, f64::max);
            assert!(largest.is_finite() && largest < 1.0);
        }
    }
    (largest, held)
}

fn grips_are_sound(organ: &str, response: &str, number: usize) {
    let builtin = format!("builtin = \"{organ}\"\ntriangles = 1200");
    let setting = Setting {
        organ: &builtin,
        model: &format!("mechanical_triangles = 600\n{response}"),
        prony: "[{ g = 0.3, tau_s = 0.2 }]",
        poissons_ratio: 0.45,
        ..HEMISPHERE
    };
    let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 2)).unwrap();
    let (largest, held) = random_grips(&simulation, number);
    println!("{organ}: {held} grips in {number} pairs of tries, at most {largest:.2} N");
    // Pulled 15 mm with a patch of a few millimetres: some newtons of tissue of 10 kPa.
    assert!(held > number && largest < 20.0, "{held} {largest}");
}

#[test]
fn random_grips_are_sound() {
    for organ in ["esophagus", "liver", "kidney"] {
        grips_are_sound(organ, "response = \"boundary_elements\"", 12);
    }
}

/// Judge: Coulomb's law for the force along the jaws; the organ stays within a metre. Quick form:
/// `random_grips_are_sound`.
#[test]
#[ignore = "slow: 1,500 pairs of grips and finite elements of a thin wall, minutes"]
fn many_random_grips_are_sound() {
    for organ in ["esophagus", "liver", "kidney"] {
        grips_are_sound(organ, "", 500);
    }
}

/// What two graspers feel, step by step, that pull, slip and let go; the workspace is lost at `losing` steps.
fn pulled(simulation: &Simulation, losing: impl Fn(u32) -> bool) -> Vec<[u64; 3]> {
    let mut hands = Hands::new(simulation);
    let other = POLE + Vec3::new(0.01, 0.0, -1.5e-3);
    let upright = UnitQuaternion::identity();
    let mut felt = Vec::new();
    for number in 0..300 {
        if losing(number) {
            hands.workspace = SimulationWorkspace::new(simulation);
        }
        let part = 1e-4 * f64::from(number);
        let first = if number < 250 { 1.0 } else { 0.0 };
        let poses = [
            pose(
                &(POLE + Vec3::z() * part),
                &upright,
                if number < 10 { 0.0 } else { first },
            ),
            pose(
                &(other - Vec3::z() * (0.1 * part)),
                &upright,
                f64::from(u8::from(number > 50)),
            ),
        ];
        hands.go(&poses);
        for own in &hands.state.tools {
            felt.push([own.force.x, own.force.y, own.force.z].map(f64::to_bits));
        }
    }
    assert!(hands.state.tools[1].is_grasping() && !hands.state.tools[0].is_grasping());
    felt
}

#[test]
fn the_same_grips_feel_the_same_bits() {
    for kind in ["hybrid", "local"] {
        let model = if kind == "local" {
            ""
        } else {
            HEMISPHERE.model
        };
        let prony = "[{ g = 0.3, tau_s = 0.2 }]";
        let setting = Setting {
            kind,
            model,
            prony,
            ..HEMISPHERE
        };
        let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 2)).unwrap();
        let first = pulled(&simulation, |_| false);
        assert!(first == pulled(&simulation, |_| false), "{kind}");
        assert!(
            first == pulled(&simulation, |number| number % 7 == 0),
            "{kind}"
        );
    }
}
