//! Tools that pass through the abdominal wall.

use std::sync::Arc;

use palpate_devices::Places;
use palpate_files::SessionRow;
use palpate_files::scene::DeviceKind;
use palpate_geometry::Vec3;
use palpate_servo::{Sample, ServoSettings, Trajectory, VirtualDevice};
use palpate_simulate::interactive::{
    Mount, SceneDevices, Station, VirtualInteraction, judge_samples,
};
use palpate_simulate::{Simulation, Trocar};

use crate::interactive::{POLE, advance};
use crate::scenes::{Random, Setting};

const PLACE: Vec3 = Vec3::new(0.03, -0.05, 0.2);

fn trocar() -> Trocar {
    Trocar {
        friction: 0.4,
        stiffness: 25.0,
        ..Trocar::new(PLACE, &Vec3::zeros())
    }
}

fn vector(random: &mut Random) -> Vec3 {
    Vec3::from_fn(|_, _| 2.0 * random.unit() - 1.0)
}

/// A hand outside, from 3 to 33 cm away.
fn hand(random: &mut Random) -> Vec3 {
    let away = vector(random).normalize() * (0.03 + 0.3 * random.unit());
    PLACE + away
}

/// Judge: the lever, by hand: 12 cm outside and 24 cm inside.
#[test]
fn the_tip_goes_against_the_hand() {
    let trocar = Trocar::new(PLACE, &Vec3::zeros());
    let hand = PLACE + Vec3::new(0.0, 0.0, 0.12);
    assert!((trocar.tip(&hand) - (PLACE - Vec3::z() * 0.24)).norm() < 1e-15);
    let left = trocar.velocity_of_tip(&hand, &-Vec3::x());
    assert!((left - Vec3::x() * 2.0).norm() < 1e-12, "{left}");
    let inward = trocar.velocity_of_tip(&hand, &-Vec3::z());
    assert!((inward + Vec3::z()).norm() < 1e-12, "{inward}");
    let felt = trocar.force_on_hand(&hand, &Vec3::new(0.5, 0.0, 1.0));
    assert!((felt - Vec3::new(-1.0, 0.0, 1.0)).norm() < 1e-12, "{felt}");
}

/// Judges: the work, and differences of the places.
#[test]
fn hand_and_tip_do_the_same_work() {
    let trocar = trocar();
    let mut random = Random(21);
    for _ in 0..10_000 {
        let (hand, velocity, force) = (hand(&mut random), vector(&mut random), vector(&mut random));
        let of_tip = trocar.velocity_of_tip(&hand, &velocity);
        let felt = trocar.force_on_hand(&hand, &force);
        let scale = force.norm() * of_tip.norm() + felt.norm() * velocity.norm();
        assert!((felt.dot(&velocity) - force.dot(&of_tip)).abs() < 1e-12 * scale);
        let ends = [1e-6, -1e-6].map(|by| trocar.tip(&(hand + velocity * by)));
        let slope = (ends[0] - ends[1]) / 2e-6;
        // Third differences of 1 µm in 3 cm, and rounding.
        assert!(
            (slope - of_tip).norm() < 1e-6 * (1.0 + of_tip.norm()),
            "{slope} {of_tip}"
        );
    }
}

#[test]
fn hand_and_tip_go_there_and_back() {
    let trocar = trocar();
    let mut random = Random(22);
    for _ in 0..10_000 {
        let (hand, force) = (hand(&mut random), vector(&mut random));
        let back = trocar.hand(&trocar.tip(&hand));
        assert!((back - hand).norm() < 1e-12, "{back} {hand}");
        let felt = trocar.force_on_hand(&hand, &force);
        let back = trocar.force_on_tip(&hand, &felt);
        // The lever's inverse is up to a hundred where the tip is nearly out.
        assert!((back - force).norm() < 1e-10, "{back} {force}");
    }
    // In the trocar itself everything stays a number.
    for hand in [PLACE, PLACE + Vec3::x() * 1e-12] {
        let all = [
            trocar.tip(&hand),
            trocar.velocity_of_tip(&hand, &Vec3::x()),
            trocar.wall_force(&hand, &Vec3::x()),
            trocar.hand(&PLACE),
        ];
        assert!(
            all.iter()
                .flat_map(|v| v.iter())
                .all(|value| value.is_finite())
        );
    }
}

/// Judge: energy. Friction takes it at every moment, a spring gives back what it took.
#[test]
fn the_wall_gives_no_energy() {
    let rubs = Trocar {
        stiffness: 0.0,
        ..trocar()
    };
    let springs = Trocar {
        friction: 0.0,
        ..trocar()
    };
    let mut random = Random(23);
    for _ in 0..10_000 {
        let (hand, velocity) = (hand(&mut random), 0.1 * vector(&mut random));
        let force = rubs.wall_force(&hand, &velocity);
        assert!(force.dot(&velocity) <= 0.0 && force.norm() <= 0.4 + 1e-12);
    }
    let fast = rubs.wall_force(&(PLACE + Vec3::z() * 0.1), &(Vec3::z() * 0.05));
    // All of it, against the motion.
    assert!((fast + Vec3::z() * 0.4).norm() < 1e-3, "{fast}");
    let way = |part: f64| {
        let turn = std::f64::consts::TAU * part;
        PLACE
            + Vec3::new(
                0.05 * turn.sin(),
                0.03 * (2.0 * turn).cos(),
                0.15 + 0.02 * turn.cos(),
            )
    };
    let (mut work, mut stored) = (0.0, 0.0_f64);
    for number in 0..4000 {
        let ends = [number, number + 1].map(|k| way(f64::from(k) / 4000.0));
        let force = springs.wall_force(&(0.5 * (ends[0] + ends[1])), &Vec3::zeros());
        work += force.dot(&(ends[1] - ends[0]));
        stored = stored.max(work.abs());
    }
    println!("{work:.1e} J of {stored:.1e} J");
    assert!(work.abs() < 1e-9 * stored, "{work} {stored}");
}

fn scene(trocar: [f64; 3]) -> palpate_files::Scene {
    let mut scene = Setting {
        shape: "sphere",
        radius: 3e-3,
        ..Setting::default()
    }
    .scene();
    scene.tools[0].trocar_m = Some(trocar);
    scene
}

#[test]
fn a_trocar_in_the_organ_is_refused() {
    let error = Simulation::new(&scene([0.0, 0.01, 0.03])).unwrap_err();
    assert!(error.is_input());
    let message = error.to_string();
    println!("{message}");
    for words in ["\"right\"", "inside the organ", "mm below", "`trocar_m`"] {
        assert!(message.contains(words), "{message}");
    }
    assert!(Simulation::new(&scene([0.0, 0.01, 0.06])).is_ok());
}

fn interaction(simulation: &Arc<Simulation>, station: Station) -> VirtualInteraction {
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    VirtualInteraction::new(simulation.clone(), vec![Some(station)], settings).unwrap()
}

/// Judges: the same tip moved directly, and steps at every tick. The hand that is felt is the tip's, by the
/// lever, and the wall's.
#[test]
fn a_hand_feels_through_its_trocar() {
    let mut scene = scene([0.02, -0.1, 0.2]);
    scene.tools[0].trocar_friction_n = 0.1;
    scene.tools[0].trocar_stiffness_n_per_m = 2.0;
    let simulation = Arc::new(Simulation::new(&scene).unwrap());
    let trocar = simulation.tools()[0].fulcrum.unwrap();
    let mount = Mount {
        trocar: Some(trocar),
        ..Mount::default()
    };
    // The tip is the centre of a ball of 3 mm.
    let ends = [0.0, -6e-3].map(|deep| trocar.hand(&(POLE + Vec3::z() * (4e-3 + deep))));
    let mut station = Station::new(VirtualDevice::new(Trajectory::Sine {
        center: 0.5 * (ends[0] + ends[1]),
        amplitude: 0.5 * (ends[1] - ends[0]),
        frequency: 0.5,
    }));
    station.mount = mount;
    let mut hands = interaction(&simulation, station);
    advance(&mut hands, 4000);
    let rows: Vec<SessionRow> = hands.rows().collect();
    let deepest = rows.iter().map(|row| row.depth_m).fold(0.0, f64::max);
    // 3 mm of radius below a tip that goes to 2 mm under the pole.
    assert!((deepest - 5e-3).abs() < 1e-4, "{deepest}");
    let samples: Vec<Sample> = hands.samples(0).collect();
    let mut pressed = 0;
    for sample in &samples {
        let hand = sample.state.position;
        let away = hand - trocar.place;
        assert!(away.norm() > 0.05);
        let velocity = sample.state.velocity.unwrap_or_else(Vec3::zeros);
        let wall = trocar.wall_force(&hand, &velocity);
        let of_tip = mount.force_on_tip((&hand, &velocity), &sample.wanted);
        let back = trocar.force_on_hand(&hand, &of_tip) + wall;
        assert!((back - sample.wanted).norm() < 1e-12);
        pressed += usize::from(of_tip.norm() > 0.01);
    }
    let error = judge_samples(&simulation, 0, &mount, &samples);
    println!("{error:?}, {pressed} ticks pressed");
    assert!(pressed > 1000 && error.peak > 0.05);
    // As without a trocar: of a hand-over by the local stiffness, mostly where contact begins.
    assert!(error.rms < 0.02 * error.peak, "{error:?}");
}

/// A virtual device of a scene moves its tool through the trocar; a mouse moves the tip itself.
#[test]
fn devices_of_a_scene_know_their_trocar() {
    let mut scene = scene([0.02, -0.1, 0.2]);
    scene.tools[0].device = DeviceKind::Virtual;
    let simulation = Arc::new(Simulation::new(&scene).unwrap());
    let mut devices = SceneDevices::open(&scene, &simulation, &Places::default()).unwrap();
    let station = devices.stations.remove(0).unwrap();
    assert_eq!(station.mount.trocar, simulation.tools()[0].fulcrum);
    let mut hands = interaction(&simulation, station);
    advance(&mut hands, 2000);
    let deepest = hands.rows().map(|row| row.depth_m).fold(0.0, f64::max);
    // What is scripted.
    assert!((deepest - 4e-3).abs() < 1e-4, "{deepest}");
    scene.tools[0].device = DeviceKind::Mouse;
    let devices = SceneDevices::open(&scene, &simulation, &Places::default()).unwrap();
    assert_eq!(devices.stations[0].as_ref().unwrap().mount.trocar, None);
}
