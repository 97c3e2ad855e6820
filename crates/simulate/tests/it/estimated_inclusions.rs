//! Estimated inclusions are up to a state: judged by a model that was made with them.

use palpate_files::scene::{EstimatedInclusion, InclusionShape};
use palpate_geometry::Vec3;
use palpate_simulate::{Error, SimulationState};

use crate::scenes::{Hand, Setting};

const BALL: &str = "builtin = \"hemisphere\"\n\
                    inclusion = [{ ball = { center_m = [0, 0, 0.040], radius_m = 0.004 }, stiffness_ratio = 8 }]";

/// The force after a press of 1 mm on the pole [N].
fn pressed(hand: &mut Hand<'_>, top: f64) -> Vec3 {
    let depths = (0..=10).map(|step| 1e-4 * f64::from(step));
    let forces = depths.map(|depth| hand.at(&Vec3::new(0.0, 0.0, top - depth)));
    forces.last().unwrap()
}

#[test]
fn a_state_with_other_inclusions_is_that_of_a_model_with_them() {
    let plain = Setting::default().simulation();
    let setting = Setting {
        organ: BALL,
        ..Setting::default()
    };
    let (scene, made) = (setting.scene(), setting.simulation());
    let top = plain.surface().mesh().bounds().1.z;
    let expected = pressed(&mut Hand::new(&made), top);
    let without = pressed(&mut Hand::new(&plain), top);
    assert!(
        expected.norm() > 1.01 * without.norm(),
        "{expected} {without}"
    );
    let mut hand = Hand::new(&plain);
    hand.state
        .set_estimated_inclusions(&plain, &scene.organ.estimated_inclusions)
        .unwrap();
    assert_eq!(pressed(&mut hand, top), expected);
    // What begins anew is the same organ.
    hand.state.reset(&plain);
    assert_eq!(pressed(&mut hand, top), expected);
}

#[test]
fn an_inclusion_outside_is_refused() {
    let plain = Setting::default().simulation();
    let outside = EstimatedInclusion {
        name: "tumour".to_owned(),
        shape: InclusionShape::Ball {
            center_m: [0.0, 0.0, 1.0],
            radius_m: 0.004,
        },
        stiffness_ratio: 8.0,
    };
    let refused = SimulationState::new(&plain).set_estimated_inclusions(&plain, &[outside]);
    assert!(matches!(refused, Err(Error::EstimatedOutside { name, .. }) if name == "tumour"));
}
