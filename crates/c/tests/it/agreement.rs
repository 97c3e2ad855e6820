//! The judge is the step in Rust: what comes through C is the same, to the last bit.

use palpate_c::*;
use palpate_files::session::Event;
use palpate_files::{Pose, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::interactive::affine_force;
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

use crate::calling::{CUBE_UNDER_A_HOOK, HEMISPHERE, Hand, KIDNEY, Model, NOBODY, Shape, at};

fn in_rust(pose: &ToolPose) -> Option<Pose> {
    (pose.is_there != 0).then_some(Pose {
        position_m: pose.position_m,
        orientation: (pose.has_orientation != 0).then_some(pose.orientation),
        grip: pose.grip,
        cut: pose.cut != 0,
    })
}

/// Plays `poses` both ways, 5 ms apart; what happened to any tool.
fn assert_same(scene: &str, poses: &[Vec<ToolPose>]) -> u32 {
    let model = Model::new(scene);
    let mut hand = Hand::new(&model);
    let simulation = Simulation::new(&Scene::parse(scene, "scene.toml").unwrap()).unwrap();
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);
    let (mut before, mut happened) = (0.0, 0);
    for poses in poses {
        let time = hand.time;
        let touches = hand.go(poses).to_vec();
        let given: Vec<_> = poses.iter().map(in_rust).collect();
        step(
            &simulation,
            time,
            time - before,
            &given,
            &mut state,
            &mut workspace,
        );
        before = time;
        for (touch, (tool, own)) in touches
            .iter()
            .zip(simulation.tools().iter().zip(&state.tools))
        {
            let near = affine_force(tool, own, time);
            assert_eq!(touch.force_n, <[f64; 3]>::from(own.force));
            assert_eq!(touch.with_pull_n, <[f64; 3]>::from(near.force));
            let rows = near.gradient.transpose();
            assert_eq!(touch.gradient_n_per_m, rows.as_slice());
            let point = own.contact.map_or(Vec3::zeros(), |contact| contact.point());
            assert_eq!(touch.point_m, <[f64; 3]>::from(point));
            assert_eq!(
                touch.contact != 0,
                own.contact.is_some() || own.is_grasping()
            );
            assert_eq!(touch.holds != 0, own.is_grasping());
            assert_eq!(touch.orientation, own.row.orientation);
            assert_eq!(touch.grip_force_n, own.grip_force);
            assert_eq!(touch.torque_nm, <[f64; 3]>::from(own.torque));
            for (_, event) in Event::WORDS {
                let bit = 1 << *event as u32;
                assert_eq!(touch.events & bit != 0, own.row.events.contains(*event));
            }
            happened |= touch.events;
        }
    }
    let Shape {
        vertices, corners, ..
    } = hand.shape();
    let cuts = state.cuts.as_ref().filter(|cuts| cuts.has_openings());
    let (places, mesh) = match cuts {
        Some(cuts) => (cuts.places(), cuts.mesh()),
        None => (state.deformed.vertices(), &state.deformed),
    };
    let places = places.iter().flat_map(|place| [place.x, place.y, place.z]);
    assert_eq!(vertices, places.collect::<Vec<_>>());
    let triangles = mesh.triangles().iter().flatten().map(|node| node.0);
    assert_eq!(corners, triangles.collect::<Vec<_>>());
    assert!(
        corners
            .iter()
            .all(|corner| 3 * *corner < vertices.len() as u32)
    );
    happened
}

#[test]
fn a_press_and_a_slide() {
    let turned = [0.0, 0.6, 0.0, 0.8];
    let slide = (0..200).map(|k| {
        let along = 1e-4 * f64::from(k);
        let mut pose = at([along, 0.0, 0.0515 - 0.02 * along.min(0.01) / 0.01 * 0.25]);
        if k > 100 {
            pose.orientation = turned;
            pose.has_orientation = 1;
        }
        vec![if k > 190 { NOBODY } else { pose }]
    });
    let happened = assert_same(HEMISPHERE, &slide.collect::<Vec<_>>());
    let expected = PALPATE_EVENT_CONTACT | PALPATE_EVENT_RELEASE;
    assert_eq!(happened & expected, expected, "{happened:b}");
}

#[test]
fn a_cut() {
    let cut = (0..=200).map(|k| {
        let pose = at([1e-4 * f64::from(k) - 0.01, 0.0, 0.049]);
        vec![ToolPose { cut: 1, ..pose }]
    });
    let happened = assert_same(CUBE_UNDER_A_HOOK, &cut.collect::<Vec<_>>());
    assert!(happened & PALPATE_EVENT_CUT != 0, "{happened:b}");
}

#[test]
fn a_whole_organ_between_two_tools() {
    let model = Model::new(KIDNEY);
    let top = model
        .surface()
        .vertices
        .chunks(3)
        .fold([f64::MIN; 3], |top, vertex| {
            if vertex[2] > top[2] {
                [vertex[0], vertex[1], vertex[2]]
            } else {
                top
            }
        });
    let [x, y, z] = top;
    let both = (0..120).map(|k| {
        let part = f64::from(k) / 119.0;
        let held = ToolPose {
            grip: if part > 0.2 { 0.9 } else { 0.0 },
            ..at([x, y, z - 4e-3 + 0.01 * part])
        };
        vec![held, at([x + 0.02, y, z - 6e-3 * part])]
    });
    let happened = assert_same(KIDNEY, &both.collect::<Vec<_>>());
    let expected = PALPATE_EVENT_CONTACT | PALPATE_EVENT_GRIP;
    assert_eq!(happened & expected, expected, "{happened:b}");
}
