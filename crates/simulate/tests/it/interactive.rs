//! The model beside its servo loops: what is recorded, felt and seen.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use assert_no_alloc::{assert_no_alloc, reset_violation_count, violation_count};
use nalgebra::{Quaternion, Unit};
use palpate_devices::Places;
use palpate_files::motion::ToolMotion;
use palpate_files::scene::DeviceKind;
use palpate_files::session::Event;
use palpate_files::{Pose, SessionRow};
use palpate_geometry::Vec3;
use palpate_servo::{Fault, Pointer, Sample, ServoSettings, Trajectory, VirtualDevice, Waypoint};
use palpate_simulate::interactive::{
    CUTS, DevicePlacement, ExtrapolationError, Interaction, PlacedDevice, SceneDevices,
    VirtualInteraction, measure_extrapolation_error,
};
use palpate_simulate::{
    EnhancedSurface, Error, Simulation, SimulationState, SimulationWorkspace, step,
};

use crate::scenes::{Random, Setting, motion, played};

pub(crate) const POLE: Vec3 = Vec3::new(0.0, 0.0, 0.05);

/// A hand that goes in and out of the hemisphere's pole, 3 mm ± 4 mm deep, and a little to the side.
pub(crate) fn palpating(frequency: f64) -> VirtualDevice {
    VirtualDevice::new(Trajectory::Sine {
        center: POLE - Vec3::z() * 3e-3,
        amplitude: Vec3::new(2e-4, -1e-4, -4e-3),
        frequency,
    })
}

/// A stiff hand that plays `motion`, whose first row is the beginning of time.
pub(crate) fn playing(motion: &ToolMotion) -> PlacedDevice {
    let first = motion.first_time_s();
    let places = motion.rows().iter().map(|row| Waypoint {
        orientation: row
            .pose
            .orientation
            .map(|[x, y, z, w]| Unit::new_normalize(Quaternion::new(w, x, y, z))),
        grip: row.pose.grip,
        buttons: if row.pose.cut { CUTS } else { 0 },
        ..Waypoint::new(row.time_s - first, Vec3::from(row.pose.position_m))
    });
    let path = Trajectory::waypoints(places.collect()).unwrap();
    PlacedDevice::new(VirtualDevice::new(path))
}

pub(crate) fn simulation(model: &str, contact: &str, prony: &str) -> Arc<Simulation> {
    Arc::new(
        Setting {
            model,
            contact,
            prony,
            ..Setting::default()
        }
        .simulation(),
    )
}

fn virtual_interaction(simulation: &Arc<Simulation>, frequency: f64) -> VirtualInteraction {
    let devices = vec![Some(PlacedDevice::new(palpating(frequency)))];
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    VirtualInteraction::new(simulation.clone(), devices, settings).unwrap()
}

pub(crate) fn advance(interaction: &mut VirtualInteraction, ticks: usize) {
    (0..ticks).for_each(|_| interaction.advance().unwrap());
}

/// The forces [N] that plain steps give for times [s] and places of one tool.
fn stepped(simulation: &Simulation, course: &[(f64, [f64; 3])]) -> Vec<Vec3> {
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    // The first depth comes as a step.
    let mut before = course[0].0;
    let forces = course.iter().map(|&(time, position_m)| {
        let pose = Pose {
            position_m,
            orientation: None,
            grip: 0.0,
            cut: false,
        };
        let elapsed = time - before;
        before = time;
        step(
            simulation,
            time,
            elapsed,
            &[Some(pose)],
            &mut state,
            &mut workspace,
        );
        state.tools[0].force
    });
    forces.collect()
}

fn assert_rows_are_steps(simulation: &Simulation, rows: &[SessionRow]) {
    let course: Vec<_> = rows
        .iter()
        .map(|row| (row.time_s, row.position_m))
        .collect();
    let forces = stepped(simulation, &course);
    for (row, force) in rows.iter().zip(&forces) {
        assert_eq!(Vec3::from(row.force_n), *force, "{}", row.time_s);
    }
    assert!(forces.iter().any(|force| force.norm() > 0.01));
}

/// A session has the force of the place at the row's own time, whatever the hand-over does.
#[test]
fn rows_have_the_force_of_their_own_time() {
    let prony = "[{ g = 0.2866, tau_s = 1.537 }]";
    for hand_over in ["hold", "local_model"] {
        let model = format!("hand_over = \"{hand_over}\"\nforce_scale = 3.0");
        let simulation = simulation(&model, "stick", prony);
        let mut interaction = virtual_interaction(&simulation, 1.0);
        advance(&mut interaction, 2000);
        let rows: Vec<_> = interaction.rows().collect();
        assert_eq!(rows.len(), 400);
        assert_rows_are_steps(&simulation, &rows);
    }
}

/// What is felt at 1 kHz against plain steps at 1 kHz, from the second second on.
fn felt_error(simulation: &Arc<Simulation>, frequency: f64) -> ExtrapolationError {
    let mut interaction = virtual_interaction(simulation, frequency);
    advance(&mut interaction, 3000);
    let samples: Vec<Sample> = interaction.samples(0).collect();
    measure_extrapolation_error(simulation, 0, &DevicePlacement::default(), &samples)
}

/// Judge: the same model at every tick. The flat tip's organ is a spring while it touches, so that only
/// making and losing contact, the tissue's relaxation within two steps and the place of the contact are
/// left of the local model's error.
#[test]
fn a_local_model_is_nearest_to_the_model_at_every_tick() {
    for (contact, prony) in [("slip", "[]"), ("stick", "[{ g = 0.3, tau_s = 0.5 }]")] {
        let errors = ["hold", "linear", "local_model"].map(|hand_over| {
            let model = format!("hand_over = \"{hand_over}\"\nassembly = \"reused\"");
            let found = felt_error(&simulation(&model, contact, prony), 2.0);
            assert!(found.compared > 1000);
            let peak = found.peak;
            let [rms, max] = [found.rms, found.max].map(|error| 100.0 * error / peak);
            println!("{contact} {hand_over}: rms {rms:.3} %, largest {max:.2} % of {peak:.4} N");
            rms
        });
        let [hold, linear, local] = errors;
        assert!(
            hold > 5.0 * linear && linear > local,
            "{contact}: {errors:?}"
        );
    }
}

/// A motion played by a scripted hand through model, loop and hand-over is the motion played: forces are
/// the same at the same times.
#[test]
fn a_scripted_hand_plays_a_motion() {
    let simulation = simulation("", "stick", "[{ g = 0.3, tau_s = 1.5 }]");
    let rows = [
        (2.0, (POLE + Vec3::z() * 1e-3).into()),
        (2.5, (POLE - Vec3::z() * 3e-3).into()),
        (3.0, (POLE + Vec3::x() * 1e-3 - Vec3::z() * 2e-3).into()),
    ];
    let motion = motion(&rows);
    let (played, _) = played(&simulation, &motion);
    let device = playing(motion.tool("right").unwrap());
    let devices = vec![Some(device)];
    let settings = ServoSettings::default();
    let mut interaction = VirtualInteraction::new(simulation, devices, settings).unwrap();
    advance(&mut interaction, 1001);
    let found: Vec<_> = interaction.rows().collect();
    assert_eq!((found.len(), played.len()), (201, 201));
    for (found, played) in found.iter().zip(&played) {
        let [found, played] = [found, played].map(|row| Vec3::from(row.force_n));
        // Rounding of times that begin at zero or at two.
        assert!((found - played).norm() < 1e-12, "{found} {played}");
    }
}

#[test]
fn the_same_hand_gives_the_same_bytes() {
    let simulation = simulation("", "stick", "[]");
    let run = || {
        let mut interaction = virtual_interaction(&simulation, 2.0);
        advance(&mut interaction, 1500);
        let rows: Vec<_> = interaction.rows().collect();
        let samples: Vec<_> = interaction.samples(0).collect();
        let vertices = interaction.snapshot().vertices.clone();
        format!("{rows:?}{samples:?}{vertices:?}")
    };
    assert!(run() == run());
}

/// Ticks, steps, hand-over and snapshots, in and out of contact; what the snapshot of a whole organ tells is
/// enough for finer triangles.
#[test]
fn neither_tick_nor_step_allocates() {
    let local = simulation("", "slip", "[{ g = 0.3, tau_s = 1.5 }]");
    let whole = Setting {
        organ: "builtin = \"hemisphere\"\ntriangles = 400",
        kind: "hybrid",
        model: "enhancement = { area = \"vertex\", levels = 3 }",
        ..Setting::default()
    };
    for simulation in [local, Arc::new(whole.simulation())] {
        let mut interaction = virtual_interaction(&simulation, 2.0);
        reset_violation_count();
        assert_no_alloc(|| advance(&mut interaction, 10_000));
        assert_eq!(violation_count(), 0);
        let snapshot = interaction.snapshot();
        let wanted = simulation.enhancement().copied().unwrap_or_default();
        let seen = EnhancedSurface::new(&simulation, wanted).unwrap();
        assert_eq!(seen.is_some(), snapshot.organ_field.is_some());
        if let (Some(mut seen), Some(whole)) = (seen, &snapshot.organ_field) {
            assert!(seen.follow(whole) && seen.new_vertices().count() > 100);
        }
    }
}

#[test]
fn a_snapshot_shows_what_the_model_has_done() {
    let simulation = simulation("force_scale = 2.0", "slip", "[]");
    let mut interaction = virtual_interaction(&simulation, 1.0);
    advance(&mut interaction, 2256);
    let quality = interaction.quality();
    let snapshot = interaction.snapshot();
    // A step at 2.250 s, a quarter into a cycle: as deep as it goes.
    assert_eq!(snapshot.time, 2.25);
    let tool = snapshot.tools[0];
    let contact = tool.contact.unwrap();
    // The flat triangles of the default mesh lie up to 30 µm inside of the sphere.
    assert!((contact.depth - 7e-3).abs() < 3e-5, "{contact:?}");
    assert!((contact.normal - Vec3::z()).norm() < 0.01);
    // At rest there, so the hand-over is exact to the travel of 5 ms: (ω t)²/2 of 4 mm.
    let ratio = tool.rendered_force.z / tool.force.z;
    assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
    let rest = simulation.surface().mesh().vertices();
    let moved = rest.iter().zip(&snapshot.vertices).filter(|(rest, seen)| {
        let seen = Vec3::from(seen.map(f64::from));
        // A micrometre; single precision has 4 nm at 50 mm.
        (seen - **rest).norm() > 1e-6
    });
    // The corners of the touched triangle at least.
    assert!(moved.count() >= 3);
    let rows: Vec<_> = interaction.rows().collect();
    let events: Vec<_> = rows.iter().flat_map(|row| row.events.iter()).collect();
    assert_eq!(
        events[..3],
        [Event::Contact, Event::Release, Event::Contact]
    );
    assert_eq!(quality.model.steps, 452);
    let report = quality.loops[0].unwrap();
    assert_eq!((report.ticks, report.faults), (2256, 0));
    // Answers are one period old when they arrive and two when the next one comes.
    assert!(
        report.age.p50 >= 5e-3 && report.age.max <= 9.1e-3,
        "{report:?}"
    );
}

/// Real threads; nothing is asserted of time but that it passes.
#[test]
fn threads_give_the_same_forces_as_steps() {
    let simulation = simulation("", "stick", "[{ g = 0.3, tau_s = 1.5 }]");
    let device = palpating(4.0);
    let stops = device.disable_count();
    let devices = vec![Some(PlacedDevice::new(device))];
    let mut interaction =
        Interaction::start(simulation.clone(), devices, ServoSettings::default()).unwrap();
    let mut rows = Vec::new();
    while rows.len() < 100 {
        assert!(interaction.is_running());
        rows.extend(interaction.rows());
        std::thread::sleep(Duration::from_millis(5));
    }
    let quality = interaction.stop().unwrap();
    rows.extend(interaction.rows());
    println!("{quality:?}");
    assert!(stops.load(Ordering::Relaxed) > 0);
    assert_rows_are_steps(&simulation, &rows);
    assert!(interaction.snapshot().report.steps >= 100);
    assert!(interaction.samples(0).count() > 100);
}

/// A window that is closed while the mouse is in the organ; a hand that comes, leaves and comes back.
#[test]
fn a_hand_may_leave_in_contact() {
    let simulation = simulation("", "slip", "[]");
    let (pointer, mut hand) = Pointer::new();
    let devices = vec![Some(PlacedDevice::new(pointer))];
    let mut interaction =
        VirtualInteraction::new(simulation.clone(), devices, ServoSettings::default()).unwrap();
    advance(&mut interaction, 100);
    assert_eq!(interaction.rows().count(), 0);
    hand.move_to(POLE - Vec3::z() * 2e-3);
    advance(&mut interaction, 1000);
    assert!(interaction.snapshot().tools[0].rendered_force.z > 0.01);
    hand.leave();
    advance(&mut interaction, 20);
    let tool = interaction.snapshot().tools[0];
    assert!(tool.pose.is_none() && tool.contact.is_none());
    assert_eq!(
        (tool.force, tool.rendered_force),
        (Vec3::zeros(), Vec3::zeros())
    );
    hand.move_to(POLE - Vec3::z() * 2e-3);
    advance(&mut interaction, 1000);
    assert!(interaction.snapshot().tools[0].rendered_force.z > 0.01);
    let (pointer, mut hand) = Pointer::new();
    hand.move_to(POLE - Vec3::z() * 2e-3);
    let devices = vec![Some(PlacedDevice::new(pointer))];
    drop(Interaction::start(simulation, devices, ServoSettings::default()).unwrap());
    drop(hand);
}

/// A minute of dragging a mouse over an organ, in and out, sixty moves a second.
#[test]
#[ignore = "long"]
fn a_dragged_mouse_meets_only_numbers() {
    for (organ, contact) in [("kidney", "stick"), ("liver", "slip"), ("stomach", "stick")] {
        let setting = Setting {
            organ: &format!("builtin = \"{organ}\""),
            model: "assembly = \"reused\"\nforce_scale = 20.0",
            contact,
            prony: "[{ g = 0.3, tau_s = 1.5 }]",
            ..Setting::default()
        };
        let simulation = Arc::new(setting.simulation());
        let (pointer, mut hand) = Pointer::new();
        let devices = vec![Some(PlacedDevice::new(pointer))];
        let mut interaction =
            VirtualInteraction::new(simulation.clone(), devices, ServoSettings::default()).unwrap();
        let mut random = Random(7);
        let mut felt = 0;
        for drag in 0..60 {
            let (from, normal, along) = random.place(&simulation);
            for event in 0..60 {
                let part = f64::from(event) / 60.0;
                let depth = 8e-3 * (6.0 * part).sin();
                hand.move_to(from + along * (0.05 * part) - normal * depth);
                advance(&mut interaction, 17);
                let samples: Vec<_> = interaction.samples(0).collect();
                for sample in &samples {
                    assert!(
                        sample.commanded.iter().all(|c| c.is_finite()),
                        "{organ} {drag}"
                    );
                    assert!(sample.output.norm() <= 3.0);
                    felt += u32::from(sample.output != Vec3::zeros());
                }
                assert_eq!(
                    interaction
                        .rows()
                        .filter(|row| row.force_n[0].is_nan())
                        .count(),
                    0
                );
            }
            if drag % 3 == 0 {
                hand.leave();
            }
        }
        println!("{organ}: felt in {felt} ticks, {:?}", interaction.quality());
        let report = interaction.quality().loops[0].unwrap();
        assert!(felt > 5000 && report.faults == 0, "{organ}: {report:?}");
    }
}

/// The words of a scene: a mouse has a hand, a virtual device palpates by itself, the rest is not there.
#[test]
fn a_scene_names_its_devices() {
    let open = |device: &str, organ: &str, shape: &str| {
        let organ = format!("builtin = \"{organ}\"");
        let setting = Setting {
            organ: &organ,
            shape,
            ..Setting::default()
        };
        let mut scene = setting.scene();
        scene.tools[0].device = DeviceKind::from_word(device).unwrap();
        let simulation = Arc::new(Simulation::new(&scene).unwrap());
        let devices = SceneDevices::open(&scene, &simulation, &Places::default());
        devices.map(|devices| (devices, simulation))
    };
    let (mouse, _) = open("mouse", "kidney", "flat").unwrap();
    assert!(mouse.devices[0].is_some() && mouse.pointers[0].is_some());
    let (none, _) = open("none", "kidney", "flat").unwrap();
    assert!(none.devices[0].is_none() && none.pointers[0].is_none());
    for (organ, shape) in [("liver", "flat"), ("esophagus", "sphere")] {
        let (devices, simulation) = open("virtual", organ, shape).unwrap();
        let settings = ServoSettings::default();
        let mut interaction =
            VirtualInteraction::new(simulation, devices.devices, settings).unwrap();
        advance(&mut interaction, 501);
        let tool = interaction.snapshot().tools[0];
        // A quarter of two seconds: as deep as it goes, less where the highest point is a ridge.
        let depth = tool.contact.unwrap().depth;
        assert!(depth > 3e-3 && depth < 4.1e-3, "{organ}: {depth}");
        assert!(tool.force.z > 0.0);
        advance(&mut interaction, 1000);
        assert!(interaction.snapshot().tools[0].contact.is_none(), "{organ}");
    }
}

#[test]
fn a_station_for_each_tool_and_settings_in_range() {
    let simulation = simulation("", "slip", "[]");
    let none = Interaction::start(simulation.clone(), Vec::new(), ServoSettings::default());
    assert_eq!(
        none.err().unwrap().to_string(),
        "the scene has 1 tools, but 0 devices were given; give one, or none, for each"
    );
    let settings = ServoSettings {
        period: -1.0,
        ..ServoSettings::default()
    };
    let devices = vec![Some(PlacedDevice::new(palpating(1.0)))];
    let wrong = Interaction::start(simulation.clone(), devices, settings);
    assert!(matches!(
        wrong.err(),
        Some(Error::Servo(Fault::Setting { .. }))
    ));
    // No device at all: the organ lies there.
    let mut alone = Interaction::start(simulation, vec![None], ServoSettings::default()).unwrap();
    assert_eq!(alone.stop().unwrap().loops, [None]);
}
