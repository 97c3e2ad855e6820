//! What a virtual specimen gives to the five other axes of the sensor. Judges: closed forms of a bonded punch, and an
//! upright rig for a tilted one.

use palpate_files::Recording;
use palpate_measure::{Axes, Ended, Recorder, Rig, RigSample, RigSettings, Shape, VirtualSpecimen};
use palpate_servo::{ForceTorque, Vec3};

use crate::rig::{RADIUS, rig, soft, usual};

/// A direction tilted by an angle [degrees] toward x.
pub(crate) fn tilted(degrees: f64) -> Vec3 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Vec3::new(sine, 0.0, cosine)
}

pub(crate) fn plane(degrees: f64) -> VirtualSpecimen {
    soft().with_shape(Shape {
        normal: tilted(degrees),
        radius: None,
    })
}

/// The mean over the last fifth of a second of a stimulus.
fn last_of(rig: &mut Rig) -> (f64, ForceTorque) {
    assert_eq!(rig.approach(&mut |_| true).unwrap(), Ended::Complete);
    let mut samples: Vec<RigSample> = Vec::new();
    rig.press(&usual(), &mut |sample| {
        samples.push(*sample);
        true
    })
    .unwrap();
    let last = &samples[samples.len() - 200..];
    let force = last.iter().map(|s| s.force).sum::<f64>() / 200.0;
    let axes = last.iter().filter_map(|s| s.axes);
    let sum = axes.fold(ForceTorque::zero(), |sum, axes| sum + axes);
    (force, sum.map(|vector| vector / 200.0))
}

/// Two contacts found to 0.1 mm of 4 mm.
const CONTACT: f64 = 0.04;
/// A step of a torque [N m].
const TORQUE_STEP: f64 = 1e-3 / 256.0;

/// Judge: the upright rig, for nothing knows where up is.
#[test]
fn a_tilted_rig_on_a_tilted_plane_feels_what_an_upright_one_does() {
    let mut upright = rig(soft(), RigSettings::default(), 1);
    let (expected, axes) = last_of(&mut upright);
    assert!((axes.force.z - expected).abs() < 1e-12);
    let settings = RigSettings {
        indenter_axis: tilted(20.0),
        ..RigSettings::default()
    };
    let mut leaning = rig(plane(20.0), settings, 1);
    leaning.face(&tilted(20.0)).unwrap();
    let (force, axes) = last_of(&mut leaning);
    assert!(
        (force / expected - 1.0).abs() < CONTACT,
        "{force} {expected}"
    );
    // Two steps of the encoder sideways, at two thirds of the stiffness of 30 N/m, and steps of the sensor.
    assert!(axes.force.x.hypot(axes.force.y) < 2.0 / 1280.0, "{axes:?}");
    assert!(axes.torque.norm() < 2e-3 * 0.04, "{axes:?}");
}

/// Judge: pressed by D straight down on a plane tilted by θ, a bonded punch feels K D cos θ along the normal and
/// κ K D sin θ along the plane, which is K D (cos² θ + κ sin² θ) down and K D (κ − 1) sin θ cos θ beside; κ = 0.673
/// for ν = 0.45.
#[test]
fn a_plane_that_is_not_faced_pushes_the_tip_sideways() {
    let degrees = 15.0;
    let mut upright = rig(soft(), RigSettings::default(), 1);
    let (expected, _) = last_of(&mut upright);
    let mut rig = rig(plane(degrees), RigSettings::default(), 1);
    let (force, axes) = last_of(&mut rig);
    let nu = 0.45_f64;
    let normal = 4.0 * (3.0 - 4.0 * nu).ln() / (1.0 - 2.0 * nu);
    let ratio = 8.0 / (2.0 - nu) / normal;
    let (sine, cosine) = f64::to_radians(degrees).sin_cos();
    let down = expected * (cosine * cosine + ratio * sine * sine);
    let beside = expected * (1.0 - ratio) * sine * cosine;
    println!("{force} of {down}, {axes:?} of {beside}");
    assert!((force / down - 1.0).abs() < CONTACT);
    // Contact, and how far the tip is held from its course sideways (0.06 mm of 1 mm).
    assert!((axes.force.x / beside - 1.0).abs() < 0.15, "{axes:?}");
    assert!(axes.force.y.abs() < 2.0 / 1280.0, "{axes:?}");
    // The torque about the sensor is that force at 40 mm, and that of a face that is not parallel, ⅔ a² F sin θ / d.
    let lever = -0.04 * axes.force.x;
    let depth = 4e-3 * cosine;
    let rocking = 2.0 / 3.0 * RADIUS * RADIUS * sine / depth * expected;
    println!("{} of {lever} + {rocking}", axes.torque.y);
    assert!(
        (axes.torque.y - lever - rocking).abs() < 2.0 * TORQUE_STEP,
        "{axes:?}"
    );
}

/// The six columns are those of the samples, and the reader gives them back.
#[test]
fn a_recording_has_six_columns_and_says_of_what() {
    let mut rig = rig(plane(15.0), RigSettings::default(), 1);
    rig.approach(&mut |_| true).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("one.csv");
    let mut recorder = Recorder::begin(&file, &rig.describe(&usual(), 1), Axes::Six).unwrap();
    let mut samples = Vec::new();
    let ended = rig.press(&usual(), &mut |sample| {
        recorder.take(sample).unwrap();
        samples.push(sample.axes.unwrap().components());
        true
    });
    recorder.finish(&ended).unwrap();
    let read = Recording::read(&file).unwrap();
    assert_eq!(read.incomplete(), None);
    let axes = read.axes().unwrap();
    for (axis, column) in axes.columns.iter().enumerate() {
        assert!(
            column.iter().eq(samples.iter().map(|row| &row[axis])),
            "{axis}"
        );
    }
    // Upright and along z, the force is fz.
    assert_eq!(read.force_n(), axes.columns[2]);
    assert_eq!(
        read.header.force_sensor.as_deref(),
        Some("virtual ATI Nano17")
    );
    assert_eq!(read.header.approach_normal, Some([0.0, 0.0, 1.0]));
    assert_eq!(read.header.tip_distance_m, Some(0.04));
    let again = Recording::parse(&read.to_csv(), "again").unwrap();
    assert_eq!(again, read);
}
