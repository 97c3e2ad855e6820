//! Approach along the normal of a surface. Judge: the shape of the virtual specimen.

use palpate_measure::{Ended, Error, Phase, RigSample, RigSettings, Shape};
use palpate_servo::Vec3;

use crate::rig::{rig, soft, usual};
use crate::six_axes::{plane, tilted};

/// Contacts are found to 0.05 mm, which over 10 mm is 0.4 degrees for each slope.
const FOUND: f64 = 0.8;

fn angle(one: &Vec3, other: &Vec3) -> f64 {
    one.dot(other).min(1.0).acos().to_degrees()
}

#[test]
fn a_measured_normal_is_that_of_a_plane() {
    let mut rig = rig(plane(12.0), RigSettings::default(), 1);
    assert_eq!(rig.measure_normal(&mut |_| true).unwrap(), Ended::Complete);
    let off = angle(&rig.normal(), &tilted(12.0));
    println!("{off} degrees off");
    assert!(off < FOUND, "{off}");
}

/// A ball of 50 mm, 10 mm beside its top, has a normal of asin(10/50) there, but that the place lies above it: judged
/// from the ball's middle. Pressed along what was measured, almost nothing is felt sideways; pressed straight down, a
/// good part is.
#[test]
fn a_curved_surface_is_approached_along_its_normal() {
    let radius = 0.05;
    let ball = soft().with_shape(Shape {
        normal: Vec3::z(),
        radius: Some(radius),
    });
    let place = Vec3::new(0.010, 0.0, 0.0);
    let pressed = |measures: bool| {
        let mut rig = rig(ball.clone(), RigSettings::default(), 1);
        rig.go_to(&place, &mut |_| true).unwrap();
        if measures {
            assert_eq!(rig.measure_normal(&mut |_| true).unwrap(), Ended::Complete);
        }
        rig.approach(&mut |_| true).unwrap();
        let mut last: Vec<RigSample> = Vec::new();
        rig.press(&usual(), &mut |sample| {
            last.push(*sample);
            true
        })
        .unwrap();
        let deep = &last[last.len() - 200..];
        let sideways = deep.iter().map(|sample| {
            let force = sample.axes.unwrap().force;
            force - rig.normal() * force.dot(&rig.normal())
        });
        let sideways = sideways.sum::<Vec3>().norm() / 200.0;
        let force = deep.iter().map(|sample| sample.force).sum::<f64>() / 200.0;
        // At the contact, from the ball's middle.
        let begun = last
            .iter()
            .find(|sample| sample.depth.unwrap() > -1e-4)
            .unwrap();
        let there = begun.position - Vec3::new(0.0, 0.0, -0.005 - radius);
        (sideways / force, rig.normal(), there.normalize())
    };
    let (straight, ..) = pressed(false);
    let (along, normal, true_normal) = pressed(true);
    let off = angle(&normal, &true_normal);
    println!(
        "{straight} of the force sideways, {along} along the normal, which is {off} degrees off"
    );
    // The chord of the ball over ±5 mm adds 0.1 degrees.
    assert!(off < FOUND + 0.1, "{off}");
    // (1 − κ) sin θ cos θ / (cos² θ + κ sin² θ) for 11.5 degrees is 0.065.
    assert!((straight - 0.065).abs() < 0.02, "{straight}");
    assert!(along < 0.02, "{along}");
}

/// Before anything moves, and without a place to go back from.
#[test]
fn a_normal_that_cannot_be_measured_is_a_sentence() {
    let settings = RigSettings {
        lateral_limit: 0.004,
        ..RigSettings::default()
    };
    let mut narrow = rig(soft(), settings, 1);
    let refused = narrow.measure_normal(&mut |_| panic!("it moved"));
    assert!(
        matches!(refused, Err(Error::OutOfReach { .. })),
        "{refused:?}"
    );
    let mut steep = rig(plane(41.0), RigSettings::default(), 1);
    let refused = steep.measure_normal(&mut |_| true);
    assert!(
        matches!(refused, Err(Error::TooSteep { .. })),
        "{refused:?}"
    );
    for wrong in [-Vec3::z(), Vec3::zeros(), Vec3::x(), Vec3::z() * f64::NAN] {
        assert_eq!(steep.face(&wrong), Err(Error::NotUpward));
    }
}

/// A stop ends it at the first place and leaves the direction as it was.
#[test]
fn a_stopped_measurement_keeps_the_direction() {
    let mut rig = rig(plane(12.0), RigSettings::default(), 1);
    let ended = rig.measure_normal(&mut |sample| sample.phase != Phase::Approaching);
    assert_eq!(ended.unwrap(), Ended::Stopped);
    assert_eq!(rig.normal(), Vec3::z());
}
