//! When jaws take hold and let go, and what is told of it.

use palpate_files::scene::{Jaws, ToolKind};
use palpate_files::{Event, Motion, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::Simulation;
use palpate_simulate::interactive::affine_force;

use super::{HEMISPHERE, Hands, POLE, grasping};
use crate::scenes::{Setting, played};

/// Judge: the force before. The elastic force of linear tissue goes on to the patch as it is.
#[test]
fn taking_hold_makes_no_jump() {
    for kind in ["hybrid", "local"] {
        let model = if kind == "local" {
            ""
        } else {
            HEMISPHERE.model
        };
        let setting = Setting {
            kind,
            model,
            ..HEMISPHERE
        };
        let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 1)).unwrap();
        let mut hands = Hands::new(&simulation);
        let mut pressed = Vec3::zeros();
        for step in 0..=20 {
            pressed = hands.at(&(POLE - Vec3::z() * (1e-4 * f64::from(step))), 0.0);
        }
        assert!(pressed.z > 0.0);
        let shown = hands.state.deformed.clone();
        let held = hands.at(&(POLE - Vec3::z() * 2e-3), 0.9);
        assert!(
            hands.tool().is_grasping() && !hands.did(Event::Contact) && !hands.did(Event::Release)
        );
        assert!(
            (held - pressed).norm() < 1e-9 * pressed.norm(),
            "{kind}: {held} {pressed}"
        );
        let again = hands.at(&(POLE - Vec3::z() * 2e-3), 0.9);
        assert!(
            (again - pressed).norm() < 1e-9 * pressed.norm(),
            "{kind}: {again} {pressed}"
        );
        let moved = shown.vertices().iter().zip(hands.state.deformed.vertices());
        let most = moved.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{kind}: {pressed:?} N, the shown surface moves by {most:.1e} m");
        // A part of the dimple's depth: the patch is wider than the tip.
        assert!(most < 1e-3, "{kind}: {most}");
    }
}

/// Judge: the organ at rest.
#[test]
fn what_is_let_go_is_at_rest() {
    for kind in ["hybrid", "local"] {
        let model = if kind == "local" {
            ""
        } else {
            HEMISPHERE.model
        };
        let setting = Setting {
            kind,
            model,
            ..HEMISPHERE
        };
        let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 1)).unwrap();
        let mut hands = Hands::new(&simulation);
        hands.at(&POLE, 0.0);
        hands.at(&POLE, 1.0);
        assert!(hands.tool().is_grasping() && hands.did(Event::Grip) && hands.did(Event::Contact));
        // The tip did not touch before: nothing is felt.
        assert!(hands.tool().force.norm() < 1e-12);
        let up = POLE + Vec3::z() * 2e-3;
        let force = hands.at(&up, 1.0);
        assert!(
            force.z < -0.01 && hands.tool().row.contact,
            "{kind}: {force}"
        );
        assert!(hands.tool().grip_force == Jaws::GRASPER.force_n);
        assert_eq!(hands.tool().row.grip_force_n, Jaws::GRASPER.force_n);
        assert!(!hands.is_at_rest());
        // A trembling hand lets nothing go.
        hands.at(&up, 0.45);
        assert!(hands.tool().is_grasping());
        let force = hands.at(&up, 0.3);
        assert!(hands.did(Event::GripRelease) && hands.did(Event::Release));
        assert!(!hands.tool().is_grasping() && force == Vec3::zeros());
        assert!(hands.is_at_rest(), "{kind}");
        assert_eq!(hands.tool().row.grip_force_n, 0.0);
    }
}

/// Jaws that were shut before, that are not there, and those of other tools.
#[test]
fn only_jaws_that_shut_take_hold() {
    let holds = |scene: &Scene, grips: &[f64]| {
        let simulation = Simulation::new(scene).unwrap();
        let mut hands = Hands::new(&simulation);
        for &grip in grips {
            hands.at(&(POLE - Vec3::z() * 5e-4), grip);
        }
        hands.tool().is_grasping()
    };
    let scene = grasping(&HEMISPHERE, Jaws::GRASPER, 1);
    assert!(holds(&scene, &[0.0, 1.0]));
    assert!(!holds(&scene, &[1.0, 1.0]));
    assert!(holds(&scene, &[1.0, 0.0, 1.0]));
    assert!(!holds(&scene, &[0.0, 0.55]));
    assert!(holds(&scene, &[0.0, 0.65, 0.45]));
    assert!(!holds(&scene, &[0.0, 0.65, 0.35]));
    let mut scissors = scene;
    scissors.tools[0].kind = ToolKind::Scissors;
    scissors.tools[0].jaws = Some(Jaws::SCISSORS);
    assert!(!holds(&scissors, &[0.0, 1.0]));
    let far = POLE + Vec3::z() * 0.02;
    let scene = grasping(&HEMISPHERE, Jaws::GRASPER, 1);
    let simulation = Simulation::new(&scene).unwrap();
    let mut hands = Hands::new(&simulation);
    hands.at(&far, 0.0);
    hands.at(&far, 1.0);
    assert!(!hands.tool().is_grasping() && !hands.did(Event::Grip));
}

/// Judge: the next step. What jaws hold is a spring until it slips, and it pulls.
#[test]
fn what_is_held_is_handed_over() {
    for kind in ["hybrid", "local"] {
        let model = if kind == "local" {
            ""
        } else {
            HEMISPHERE.model
        };
        let setting = Setting {
            kind,
            model,
            ..HEMISPHERE
        };
        let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 1)).unwrap();
        let mut hands = Hands::new(&simulation);
        hands.at(&POLE, 0.0);
        hands.at(&POLE, 1.0);
        let answer = affine_force(&simulation.tools()[0], hands.tool(), 0.0);
        let tip = POLE + Vec3::new(3e-4, -2e-4, 1e-3);
        let predicted = answer.at(&tip);
        let found = hands.at(&tip, 1.0);
        assert!(found.z < -0.01);
        // Rounding.
        assert!(
            (found - predicted).norm() < 1e-9 * found.norm(),
            "{kind}: {found} {predicted}"
        );
    }
}

/// A motion with a grip, as a session tells it.
#[test]
fn a_session_tells_of_the_grip() {
    let simulation = Simulation::new(&grasping(&HEMISPHERE, Jaws::GRASPER, 1)).unwrap();
    let text = "# format = 1\ntime_s,tool,x_m,y_m,z_m,grip\n0,right,0,0,0.052,0\n\
                0.5,right,0,0,0.049,0\n1,right,0,0,0.049,1\n1.5,right,0,0,0.053,1\n\
                2,right,0,0,0.053,0\n";
    let motion = Motion::parse(text, "motion.csv").unwrap();
    let (rows, summary) = played(&simulation, &motion);
    let at = |event| -> Vec<f64> {
        let rows = rows.iter().filter(|row| row.events.contains(event));
        rows.map(|row| row.time_s).collect()
    };
    // Shut beyond 0.6 of the way, open below 0.4.
    assert_eq!(
        (at(Event::Grip).len(), at(Event::GripRelease).len()),
        (1, 1)
    );
    assert!((at(Event::Grip)[0] - 0.8).abs() < 0.01);
    assert!((at(Event::GripRelease)[0] - 1.8).abs() < 0.01);
    assert_eq!((at(Event::Contact).len(), at(Event::Release).len()), (1, 1));
    assert_eq!(summary.contacts, 1);
    for row in &rows {
        let held = (0.805..1.795).contains(&row.time_s);
        let free = !(0.795..1.805).contains(&row.time_s);
        assert!(!held || row.grip_force_n > 0.0, "{row:?}");
        assert!(
            !free || row.grip_force_n == 0.0 && row.force_n[2] >= 0.0,
            "{row:?}"
        );
    }
    assert!(rows.iter().any(|row| row.force_n[2] < -0.05));
}
