//! What holds for every scene.

use std::fs;

use palpate_files::{Pose, SessionWriter};
use palpate_geometry::{LengthUnit, TriangleMesh, Vec3, WriteFormat};
use palpate_simulate::{
    Error, Flow, Simulation, SimulationState, SimulationWorkspace, play, shape, step, touch,
};

use crate::no_allocation::track;
use crate::scenes::{Hand, Random, Setting, motion};
use crate::slides::{Count, pokes_with_a_stuck_tip, slides};

fn session(simulation: &Simulation) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.csv");
    let mut writer =
        SessionWriter::create(&path, &simulation.session_header(), &["right".to_owned()]).unwrap();
    let rows: Vec<_> = track(simulation)
        .iter()
        .enumerate()
        .map(|(k, tip)| (0.01 * k as f64, (*tip).into()))
        .collect();
    play(simulation, &motion(&rows), |frame| -> Result<Flow, Error> {
        for row in frame.rows() {
            writer.write(row)?;
        }
        Ok(Flow::Continue)
    })
    .unwrap();
    writer.finish().unwrap();
    fs::read(path).unwrap()
}

const RELAXING: &str = "[{ g = 0.3, tau_s = 1.5 }]";

#[test]
fn the_same_motion_gives_the_same_bytes() {
    let setting = Setting {
        organ: "builtin = \"kidney\"",
        prony: RELAXING,
        ..Setting::default()
    };
    let first = session(&setting.simulation());
    assert!(first.len() > 100_000);
    // No `assert_eq`: it would print them.
    assert!(first == session(&setting.simulation()));
}

#[test]
fn a_lost_workspace_changes_no_bit() {
    for (kind, contact, model) in [
        ("local", "slip", ""),
        ("local", "stick", ""),
        ("local", "slip", "assembly = \"reused\""),
        ("local", "stick", "solver = \"gmres\""),
        ("hybrid", "stick", "mechanical_triangles = 400"),
    ] {
        let simulation = Setting {
            organ: "builtin = \"kidney\"",
            kind,
            model,
            contact,
            prony: RELAXING,
            ..Setting::default()
        }
        .simulation();
        let mut kept = Hand::new(&simulation);
        let mut lost = Hand::new(&simulation);
        let away = Vec3::new(0.0, 0.0, 1.0);
        for (k, tip) in track(&simulation).iter().take(200).enumerate() {
            // Now and then the tool has left, which must show too.
            let tip = if k % 14 == 0 { &away } else { tip };
            if k % 7 == 0 {
                lost.workspace = SimulationWorkspace::new(&simulation);
            }
            let (a, b) = (kept.at(tip), lost.at(tip));
            let bits = |v: Vec3| [v.x, v.y, v.z].map(f64::to_bits);
            assert_eq!(bits(a), bits(b), "{contact} {model}: step {k}");
            let shown = |hand: &Hand<'_>| hand.state.deformed.vertices().to_vec();
            assert!(shown(&kept) == shown(&lost), "{contact} {model}: step {k}");
        }
    }
}

/// Rounding, and the fifth digit of a condition number at most.
#[test]
fn a_turned_organ_answers_with_the_same_force() {
    let folder = tempfile::tempdir().unwrap();
    let turn = nalgebra::UnitQuaternion::from_euler_angles(0.7, -1.1, 2.3);
    let kidney = Setting {
        organ: "builtin = \"kidney\"\ntriangles = 3000",
        ..Setting::default()
    }
    .simulation();
    let read = |name: &str, mesh: &TriangleMesh, contact: &str| {
        let path = folder.path().join(name);
        fs::write(&path, WriteFormat::Ply.bytes(mesh, LengthUnit::Metre)).unwrap();
        let organ = format!("mesh = {:?}\nmesh_unit = \"m\"", path.to_str().unwrap());
        let setting = Setting {
            organ: &organ,
            contact,
            ..Setting::default()
        };
        setting.simulation()
    };
    let straight = kidney.surface().mesh();
    let turned = straight.map_vertices(|v| turn * v).unwrap();
    for contact in ["slip", "stick"] {
        let organs = [
            read("straight.ply", straight, contact),
            read("turned.ply", &turned, contact),
        ];
        let mut random = Random(5);
        let mut worst = 0.0_f64;
        for _ in 0..100 {
            let (point, normal, along) = random.place(&organs[0]);
            let mut hands = [Hand::new(&organs[0]), Hand::new(&organs[1])];
            for k in 0..10 {
                let tip = point - normal * 1e-3 + along * (1e-4 * f64::from(k));
                let force = hands[0].at(&tip);
                let other = hands[1].at(&(turn * tip));
                if force.norm() > 0.0 {
                    worst = worst.max((other.norm() / force.norm() - 1.0).abs());
                }
            }
        }
        println!("{contact}: a turned organ changes the force by {worst:.1e} at most");
        assert!(worst < 1e-6, "{contact}: {worst:.1e}");
    }
}

fn few_or_all() -> usize {
    match std::env::var_os("PALPATE_FULL") {
        Some(_) => 2500,
        None => 60,
    }
}

/// What slides and pokes show; all organs are looked at before one is judged.
fn look_at(name: &str, organ: &str) -> [Count; 2] {
    let with = |model: &str, contact: &str| {
        let setting = Setting {
            organ,
            model,
            contact,
            ..Setting::default()
        };
        setting.simulation()
    };
    let mut found = Count::default();
    slides(
        &with("assembly = \"reused\"", "slip"),
        few_or_all(),
        &mut found,
    );
    slides(&with("assembly = \"every_step\"", "slip"), 25, &mut found);
    println!("{name}: {found}");
    let mut stuck = Count::default();
    pokes_with_a_stuck_tip(&with("", "stick"), 25, &mut stuck);
    println!("{name}, stuck: {stuck}");
    [found, stuck]
}

#[test]
#[ignore = "long"]
fn builtin_organs_under_random_pokes_and_slides() {
    let organs = ["esophagus", "liver"];
    let found = organs.map(|organ| look_at(organ, &format!("builtin = \"{organ}\"")));
    for (organ, counts) in organs.iter().zip(&found) {
        counts.iter().for_each(|count| count.assert_sound(organ));
    }
}

#[test]
#[ignore = "long"]
fn real_organs_under_random_pokes_and_slides() {
    let Some(folder) = crate::data::folder() else {
        return;
    };
    let meshes = [
        "vhm_liver_20000",
        "vhm_kidney_left_5146",
        "gca_stomach_oesophagus_10000",
        "bp3d_esophagus_21146",
    ];
    let found = meshes.map(|mesh| {
        let path = folder.join("meshes").join(format!("{mesh}.ply"));
        let organ = format!("mesh = {:?}\nmesh_unit = \"m\"", path.to_str().unwrap());
        look_at(mesh, &organ)
    });
    for (mesh, counts) in meshes.iter().zip(&found) {
        counts.iter().for_each(|count| count.assert_sound(mesh));
    }
}

/// Nothing that is only seen stands before a force: after `touch` the forces are those of the step, and the surface is
/// still that of the step before.
#[test]
fn forces_are_found_before_the_surface_follows() {
    for (kind, model) in [
        ("local", ""),
        ("hybrid", "mechanical_triangles = 400"),
        ("nonlinear", "nodes = 500"),
    ] {
        let simulation = Setting {
            organ: "builtin = \"kidney\"",
            kind,
            model,
            ..Setting::default()
        }
        .simulation();
        let mut workspace = SimulationWorkspace::new(&simulation);
        let mut whole = SimulationState::new(&simulation);
        let mut split = SimulationState::new(&simulation);
        let mut pressed = 0;
        for (number, tip) in track(&simulation).iter().take(40).enumerate() {
            let (time, elapsed) = (0.005 * number as f64, 0.005);
            let poses = [Some(Pose {
                position_m: (*tip).into(),
                orientation: None,
                grip: 0.0,
                cut: false,
            })];
            step(
                &simulation,
                time,
                elapsed,
                &poses,
                &mut whole,
                &mut workspace,
            );
            let seen = split.deformed.clone();
            touch(
                &simulation,
                time,
                elapsed,
                &poses,
                &mut split,
                &mut workspace,
            );
            let forces = [&whole, &split].map(|state| state.tools[0].force);
            assert_eq!(forces[0], forces[1], "{kind}");
            assert_eq!(whole.tools[0].stiffness, split.tools[0].stiffness, "{kind}");
            assert!(seen.vertices() == split.deformed.vertices(), "{kind}");
            shape(&simulation, time, &mut split, &mut workspace);
            assert_eq!(whole.tools[0].row, split.tools[0].row, "{kind}");
            assert!(whole.deformed.vertices() == split.deformed.vertices());
            pressed += usize::from(forces[0] != Vec3::zeros());
        }
        assert!(pressed > 10, "{kind}: {pressed}");
    }
}
