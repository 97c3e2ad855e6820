//! Jaws whose hand goes far, or farther in a step than hands do.

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Jaws, ToolKind};
use palpate_files::{Event, Motion};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{FASTEST_HAND, Simulation};

use super::{HEMISPHERE, Hands, POLE, grasping, pose};
use crate::scenes::{Setting, YOUNGS_MODULUS, nearest, played};

/// The largest forces [N] on jaws that are pulled `far` [m] along `way`, as fast as a hand may be, and on a tip that
/// rests beside them, if it is there.
fn pulled(
    simulation: &Simulation,
    jaws_at: Vec3,
    upright: UnitQuaternion<f64>,
    tip_at: Option<Vec3>,
    way: Vec3,
    far: f64,
) -> [f64; 2] {
    let mut hands = Hands::new(simulation);
    let tip = tip_at.and_then(|at| pose(&at, &upright, 0.0));
    hands.go(&[pose(&jaws_at, &upright, 0.0), tip]);
    hands.go(&[pose(&jaws_at, &upright, 1.0), tip]);
    let step = 0.99 * FASTEST_HAND * simulation.step();
    let mut largest = [0.0_f64; 2];
    for number in 1..=(far / step).ceil() as u32 {
        let part = (f64::from(number) * step).min(far);
        hands.go(&[pose(&(jaws_at + way * part), &upright, 1.0), tip]);
        for (largest, own) in largest.iter_mut().zip(&hands.state.tools) {
            assert!(!own.row.events.contains(Event::NonFiniteForce));
            assert!(!own.row.events.contains(Event::NoEquilibrium));
            *largest = largest.max(own.force.norm());
        }
    }
    largest
}

/// Judges: the jaws alone, and the law of the tip, which is at most twenty times as stiff as on a half-space, at the
/// depth to which the jaws can carry the organ at most. On equations of tips and jaws by turns the force was infinite
/// beyond a metre beside a sphere.
#[test]
fn a_tip_beside_jaws_that_go_far_is_bounded() {
    let never_slips = Jaws {
        friction: 1e6,
        ..Jaws::GRASPER
    };
    for organ in ["hemisphere", "kidney"] {
        let builtin = format!("builtin = \"{organ}\"\ntriangles = 400");
        for (shape, contact) in [("sphere", "stick"), ("sphere", "slip"), ("flat", "stick")] {
            let setting = Setting {
                organ: &builtin,
                shape,
                contact,
                poissons_ratio: 0.45,
                ..HEMISPHERE
            };
            let simulation = Simulation::new(&grasping(&setting, never_slips, 2)).unwrap();
            let tree = AabbTree::new(simulation.surface().mesh());
            let (place, normal) = nearest(&simulation, &tree, &(POLE * 4.0));
            let upright = UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap();
            let across = normal.cross(&Vec3::new(0.3, 0.5, 0.8)).normalize();
            for beside in [0.0, 4e-3, 0.02] {
                let (second, outward) = nearest(&simulation, &tree, &(place + across * beside));
                let tip = second - outward * 1e-3;
                for way in [Vec3::x(), Vec3::z(), -Vec3::z()] {
                    let far = 3.0;
                    let alone = pulled(&simulation, place, upright, None, way, far)[0];
                    let [jaws, beside_jaws] =
                        pulled(&simulation, place, upright, Some(tip), way, far);
                    let (radius, depth) = (setting.radius, far + setting.radius);
                    let modulus = YOUNGS_MODULUS / (1.0 - 0.45_f64.powi(2));
                    // Hertz, which is stiffer than a flat tip there.
                    let most = 20.0 * 4.0 / 3.0 * modulus * radius.sqrt() * depth.powf(1.5);
                    assert!(
                        beside_jaws <= most && jaws <= 1.5 * (alone + beside_jaws),
                        "{organ} {shape} {contact} {beside} m beside, along {way:?}: {jaws} N on the jaws, {alone} N \
                         alone, {beside_jaws} N of {most} N on the tip"
                    );
                }
            }
        }
    }
}

/// Judge: the rule. Faster than hands are, a tool loses what it touches and holds, touches anew, and that is reported;
/// at the speed of hands nothing of it happens.
#[test]
fn a_jump_releases_and_is_reported() {
    for kind in ["local", "hybrid"] {
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
        let simulation = Simulation::new(&grasping(&setting, Jaws::GRASPER, 2)).unwrap();
        let upright = UnitQuaternion::identity();
        let beside = POLE + Vec3::new(0.01, 0.0, -2e-3);
        let mut hands = Hands::new(&simulation);
        let press = pose(&beside, &upright, 0.0);
        for grip in [0.0, 1.0] {
            hands.go(&[pose(&(POLE - Vec3::z() * 1e-3), &upright, grip), press]);
        }
        assert!(hands.tool().is_grasping());
        let away = POLE + Vec3::z() * 2.0;
        hands.go(&[pose(&away, &upright, 1.0), press]);
        let did = |event| hands.tool().row.events.contains(event);
        assert!(
            did(Event::Jump) && did(Event::Release) && did(Event::GripRelease),
            "{kind}"
        );
        assert!(!hands.tool().is_grasping() && hands.tool().force == Vec3::zeros());
        // The other is where it was.
        let other = &hands.state.tools[1];
        assert!(!other.row.events.contains(Event::Jump) && other.force.z > 0.0);
        let told = hands.state.warnings(&simulation);
        let told: Vec<_> = told
            .iter()
            .filter(|text| text.contains("event `jump`"))
            .collect();
        assert!(told.len() == 1 && told[0].contains("\"right\""), "{told:?}");
        // Back into the organ in a step: a contact that begins there, and jaws that are shut hold nothing.
        hands.go(&[pose(&(POLE - Vec3::z() * 1e-3), &upright, 1.0), press]);
        assert!(hands.did(Event::Jump) && hands.did(Event::Contact) && !hands.tool().is_grasping());
    }
}

/// The event and the sentence of a motion that a file holds: metres taken for millimetres.
#[test]
fn a_motion_that_jumps_says_so() {
    let mut scene = grasping(&HEMISPHERE, Jaws::GRASPER, 1);
    scene.tools[0].kind = ToolKind::Probe;
    scene.tools[0].jaws = None;
    let simulation = Simulation::new(&scene).unwrap();
    let at = |far: f64| {
        let text = format!(
            "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.0,0.0,0.049\n0.1,right,0.0,0.0,0.049\n\
             0.105,right,{far:?},0.0,0.049\n0.2,right,{far:?},0.0,0.049\n"
        );
        played(&simulation, &Motion::parse(&text, "motion.csv").unwrap())
    };
    for (far, jumps) in [
        (0.9 * FASTEST_HAND * 5e-3, 0),
        (1.1 * FASTEST_HAND * 5e-3, 1),
    ] {
        let (rows, summary) = at(far);
        let events = rows.iter().filter(|row| row.events.contains(Event::Jump));
        assert_eq!(events.count(), jumps);
        let told = summary
            .warnings
            .iter()
            .any(|text| text.contains("faster than 20 m/s"));
        assert_eq!(told, jumps == 1, "{:?}", summary.warnings);
    }
}
