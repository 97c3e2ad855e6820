//! Tools that pass through the abdominal wall.

use std::sync::Arc;

use palpate_devices::Places;
use palpate_files::SessionRow;
use palpate_files::scene::DeviceKind;
use palpate_geometry::Vec3;
use palpate_servo::{Fault, Sample, ServoSettings, Stage, Trajectory, VirtualDevice};
use palpate_simulate::interactive::{
    DevicePlacement, ModelCommand, PlacedDevice, SceneDevices, VirtualInteraction,
    measure_extrapolation_error,
};
use palpate_simulate::{ShaftFriction, Simulation, Trocar};

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
            trocar.wall_force(&hand, &mut ShaftFriction::default(), 1e-3),
            trocar.hand(&PLACE),
        ];
        assert!(
            all.iter()
                .flat_map(|v| v.iter())
                .all(|value| value.is_finite())
        );
    }
}

/// Judge: energy. Friction gives back no more than its bristles store, a spring what it took.
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
    let mut friction = ShaftFriction::default();
    let place = |distance: f64| PLACE + Vec3::z() * distance;
    let (mut at, mut speed, mut taken, mut least) = (0.1, 0.0, 0.0, 0.0_f64);
    let mut last = rubs.wall_force(&place(at), &mut friction, 1e-3);
    for _ in 0..100_000 {
        // A hand that wanders, at most some centimetres per second.
        speed += 2e-3 * (2.0 * random.unit() - 1.0) - 0.02 * speed - 0.05 * (at - 0.1);
        at += 1e-3 * speed;
        let force = rubs.wall_force(&place(at), &mut friction, 1e-3);
        assert!(force.norm() <= 0.4 + 1e-12, "{force}");
        taken -= 0.5 * (last + force).z * 1e-3 * speed;
        least = least.min(taken);
        assert!(taken + 1e-12 >= 0.4 * friction.stored(), "{taken}");
        last = force;
    }
    println!("friction took {taken:.2e} J");
    // All of it, against a motion over many bends.
    let mut slides = ShaftFriction::default();
    let forces = (0..100).map(|tick| 0.1 + 5e-5 * f64::from(tick));
    let forces: Vec<Vec3> = forces
        .map(|distance| rubs.wall_force(&place(distance), &mut slides, 1e-3))
        .collect();
    assert!(
        (forces[99] + Vec3::z() * 0.4).norm() < 0.4 * 0.01,
        "{}",
        forces[99]
    );
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
        let force = springs.wall_force(
            &(0.5 * (ends[0] + ends[1])),
            &mut ShaftFriction::default(),
            1e-3,
        );
        work += force.dot(&(ends[1] - ends[0]));
        stored = stored.max(work.abs());
    }
    println!("{work:.1e} J of {stored:.1e} J");
    assert!(work.abs() < 1e-9 * stored, "{work} {stored}");
}

/// The bend [-] after ways to and fro of an amplitude of `ways` bends, so slow that nothing is damped. Closed form: the
/// loop closes where z = 1 − (1 + z) exp(−2 A/r), which is tanh(A/r).
#[test]
fn bristles_bend_as_dahl_has_it() {
    for ways in [0.05, 0.4, 1.0, 3.0] {
        let mut friction = ShaftFriction::default();
        let mut end = 1.0;
        let mut part = 0.0;
        for _ in 0..400 {
            end = -end;
            // In steps of any length: an exponential is exact.
            friction.part(0.1 + 1e-3 * ways * 0.3 * end, 1e9);
            part = friction.part(0.1 + 1e-3 * ways * end, 1e9) * end;
        }
        let exact = f64::tanh(ways);
        // Four hundred ways forget the beginning to exp(−800 A/r) or rounding of the places.
        assert!((part + exact).abs() < 1e-9, "{ways}: {part} {exact}");
    }
}

/// A hand that trembles by 0.1 mm at 8 to 12 Hz, alone and while it goes 2 mm to and fro: place [m] and velocity [m/s].
fn trembling(time: f64, goes: f64) -> [f64; 2] {
    let wave = |size: f64, hertz: f64| {
        let omega = std::f64::consts::TAU * hertz;
        let phase = omega * time;
        [size * phase.sin(), size * omega * phase.cos()]
    };
    let waves = [
        wave(0.4e-4, 8.0),
        wave(0.35e-4, 10.0),
        wave(0.25e-4, 12.0),
        wave(goes, 0.4),
    ];
    [0, 1].map(|which| waves.iter().map(|wave| wave[which]).sum())
}

/// The energy of friction over its force [m]: the work of the hand at 1 kHz is what is stored and what is lost. Judge: the
/// differential equations of the bristles, integrated in steps of a microsecond with the velocity of the hand; the law
/// loses (f/r) (|ẋ| z²/r + T ż² + T ż |ẋ| z/r) while it is below f. To 1 %.
#[test]
fn what_friction_takes_is_what_it_loses() {
    // r [m], T [s] and a second times five, in which all waves are whole.
    let (bend, damping, ends) = (1e-3, 3e-3, 5.0);
    for goes in [0.0, 2e-3] {
        let mut friction = ShaftFriction::default();
        let (mut last, mut at) = (friction.part(0.1, 1e-3), 0.0);
        let mut work = 0.0;
        for tick in 1..=5000 {
            let [next, _] = trembling(1e-3 * f64::from(tick), goes);
            let part = friction.part(0.1 + next, 1e-3);
            work -= 0.5 * (last + part) * (next - at);
            (last, at) = (part, next);
        }
        let (mut z, mut lost, mut largest, step) = (0.0_f64, 0.0, 0.0_f64, 1e-6);
        for number in 0..(ends / step) as u32 {
            let [_, speed] = trembling((f64::from(number) + 0.5) * step, goes);
            let bending = |z: f64| speed - speed.abs() * z / bend;
            let middle = z + 0.5 * step * bending(z);
            let rate = bending(middle);
            let slips = speed.abs() * middle / bend;
            let law = slips * middle + damping * rate * rate + damping * rate * slips;
            lost += step * law / bend;
            largest = largest.max((middle + damping * rate).abs() / bend);
            z += step * rate;
        }
        let stored = friction.stored();
        println!("{goes} m: work {work:.4e} m, stored {stored:.1e} m, lost {lost:.4e} m");
        assert!(lost > 0.0 && ((work - stored) / lost - 1.0).abs() < 0.01);
        assert!(largest < 1.0, "{largest}");
    }
}

/// A hand of 0.18 kg in a loop at 1 kHz whose force is a tick late, held as people hold a tool, from `start` [m] on, in
/// friction of 1 N by a `law` of the distance [m]: how far it moves about its place [m] in the last second of three, and
/// how often its friction turns about then.
fn held(tremor: f64, start: f64, mut law: impl FnMut(f64) -> f64) -> (f64, usize) {
    let (mass, stiffness, damping) = (0.18, 300.0, 1.0);
    let (mut at, mut speed, mut force, mut turns, mut most) = (start, 0.0, 0.0_f64, 0, 0.0_f64);
    for tick in 0..3000 {
        let time = 1e-3 * f64::from(tick);
        // Of 0.1 mm.
        let wanted = tremor / 1e-4 * trembling(time, 0.0)[0];
        let next = law(0.1 + at);
        for _ in 0..20 {
            let pull = stiffness * (wanted - at) - damping * speed;
            speed += 5e-5 * (pull + force) / mass;
            at += 5e-5 * speed;
        }
        if tick >= 2000 {
            turns += usize::from(next * force < 0.0);
            most = most.max(at.abs());
        }
        force = next;
    }
    (most, turns)
}

/// Judges: the frequency of the tremor, whose every period turns a force about twice, a hand that nobody shakes, and
/// the law of a measured velocity, which chatters in this very loop.
#[test]
fn a_hand_that_is_nearly_still_does_not_chatter() {
    let bristles = |tremor, start| {
        let mut friction = ShaftFriction::default();
        held(tremor, start, |distance| friction.part(distance, 1e-3))
    };
    // Over 10 ms, as the loop measures it.
    let mut last = [0.1; 11];
    let by_velocity = held(1e-4, 0.0, |distance| {
        last.rotate_left(1);
        last[10] = distance;
        -((last[10] - last[0]) / 0.01 / 0.01_f64).tanh()
    });
    let (moved, turns) = bristles(1e-4, 0.0);
    println!(
        "{:.1} um, {turns} turns in a second; by velocity {by_velocity:?}",
        1e6 * moved
    );
    assert!(turns <= 24 && moved <= 1e-4, "{turns} {moved}");
    assert!(by_velocity.1 > 2 * 24, "{by_velocity:?}");
    let (from, turns) = bristles(0.0, 1e-3);
    println!("without a tremor it stays at {:.1} um", 1e6 * from);
    assert!(turns == 0 && from < 1e-3);
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

fn interaction(simulation: &Arc<Simulation>, device: PlacedDevice) -> VirtualInteraction {
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    VirtualInteraction::new(simulation.clone(), vec![Some(device)], settings).unwrap()
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
    let placement = DevicePlacement {
        trocar: Some(trocar),
        ..DevicePlacement::default()
    };
    // The tip is the centre of a ball of 3 mm.
    let ends = [0.0, -6e-3].map(|deep| trocar.hand(&(POLE + Vec3::z() * (4e-3 + deep))));
    let mut device = PlacedDevice::new(VirtualDevice::new(Trajectory::Sine {
        center: 0.5 * (ends[0] + ends[1]),
        amplitude: 0.5 * (ends[1] - ends[0]),
        frequency: 0.5,
    }));
    device.placement = placement;
    let mut hands = interaction(&simulation, device);
    advance(&mut hands, 4000);
    let rows: Vec<SessionRow> = hands.rows().collect();
    let deepest = rows.iter().map(|row| row.depth_m).fold(0.0, f64::max);
    // 3 mm of radius below a tip that goes to 2 mm under the pole.
    assert!((deepest - 5e-3).abs() < 1e-4, "{deepest}");
    let samples: Vec<Sample> = hands.samples(0).collect();
    let mut pressed = 0;
    let mut friction = ShaftFriction::default();
    let mut before = 0.0;
    for sample in &samples {
        let hand = sample.state.position;
        let away = hand - trocar.place;
        assert!(away.norm() > 0.05);
        let dt = sample.state.time - before;
        before = sample.state.time;
        let wall = trocar.wall_force(&hand, &mut friction, dt);
        // The loop measures its gaps as differences of times.
        assert!(
            (wall - sample.added).norm() < 1e-9,
            "{wall} {}",
            sample.added
        );
        let of_tip = placement.force_on_tip(&hand, &(sample.commanded - sample.added));
        let back = trocar.force_on_hand(&hand, &of_tip) + wall;
        assert!((back - sample.commanded).norm() < 1e-9);
        pressed += usize::from(of_tip.norm() > 0.01);
    }
    let error = measure_extrapolation_error(&simulation, 0, &placement, &samples);
    println!("{error:?}, {pressed} ticks pressed");
    assert!(pressed > 1000 && error.peak > 0.05);
    // As without a trocar: of a hand-over by the local stiffness, mostly where contact begins.
    assert!(error.rms < 0.02 * error.peak, "{error:?}");
}

/// A hand through a trocar whose wall rubs and springs, over the organ.
fn rubbed() -> VirtualInteraction {
    let mut scene = scene([0.02, -0.1, 0.2]);
    scene.tools[0].trocar_friction_n = 0.2;
    scene.tools[0].trocar_stiffness_n_per_m = 2.0;
    let simulation = Arc::new(Simulation::new(&scene).unwrap());
    let trocar = simulation.tools()[0].fulcrum.unwrap();
    let place = trocar.hand(&(POLE + Vec3::z() * 0.02));
    let mut device = PlacedDevice::new(VirtualDevice::new(Trajectory::Sine {
        center: place,
        amplitude: Vec3::repeat(3e-3),
        frequency: 0.5,
    }));
    device.placement.trocar = Some(trocar);
    interaction(&simulation, device)
}

/// Judge: zero, at every tick that begins after the order.
#[test]
fn a_pause_and_an_emergency_stop_leave_nothing_of_the_wall() {
    let mut hands = rubbed();
    let felt = |hands: &mut VirtualInteraction, ticks| {
        advance(hands, ticks);
        let samples: Vec<Sample> = hands.samples(0).collect();
        assert_eq!(samples.len(), ticks);
        let last = samples[ticks - 1];
        let forces = samples
            .iter()
            .flat_map(|sample| [sample.applied, sample.output]);
        (
            forces.map(|force| force.norm()).fold(0.0, f64::max),
            last.stage,
        )
    };
    assert!(felt(&mut hands, 1500).0 > 0.1);
    hands.send(ModelCommand::Pause);
    assert_eq!(felt(&mut hands, 300), (0.0, Stage::Off));
    hands.send(ModelCommand::Resume);
    let (most, stage) = felt(&mut hands, 1500);
    assert!(most > 0.1 && stage == Stage::Live, "{most} {stage:?}");
    hands.supervisor().trip();
    let stopped = (0.0, Stage::Faulted(Fault::EmergencyStop));
    assert_eq!(felt(&mut hands, 300), stopped);
    // Going on is no arming.
    hands.send(ModelCommand::Resume);
    assert_eq!(felt(&mut hands, 300), stopped);
    hands.supervisor().arm();
    assert!(felt(&mut hands, 1500).0 > 0.1);
}

/// A virtual device of a scene moves its tool through the trocar; a mouse moves the tip itself.
#[test]
fn devices_of_a_scene_know_their_trocar() {
    let mut scene = scene([0.02, -0.1, 0.2]);
    scene.tools[0].device = DeviceKind::Virtual;
    let simulation = Arc::new(Simulation::new(&scene).unwrap());
    let mut devices = SceneDevices::open(&scene, &simulation, &Places::default()).unwrap();
    let device = devices.devices.remove(0).unwrap();
    assert_eq!(device.placement.trocar, simulation.tools()[0].fulcrum);
    let mut hands = interaction(&simulation, device);
    advance(&mut hands, 2000);
    let deepest = hands.rows().map(|row| row.depth_m).fold(0.0, f64::max);
    // What is scripted.
    assert!((deepest - 4e-3).abs() < 1e-4, "{deepest}");
    scene.tools[0].device = DeviceKind::Mouse;
    let devices = SceneDevices::open(&scene, &simulation, &Places::default()).unwrap();
    assert_eq!(devices.devices[0].as_ref().unwrap().placement.trocar, None);
}
