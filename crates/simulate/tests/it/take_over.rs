//! A new beginning and another model in a touch that goes on. Judges: a touch that begins with that model, to the bit, and
//! the count of allocations.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use assert_no_alloc::{assert_no_alloc, reset_violation_count, violation_count};
use palpate_files::SessionRow;
use palpate_files::session::Event;
use palpate_geometry::Vec3;
use palpate_servo::{ForceState, ServoSettings, Stage, Trajectory, VirtualDevice};
use palpate_simulate::Simulation;
use palpate_simulate::interactive::{
    ModelCommand, PlacedDevice, PreparedModel, VirtualInteraction,
};

use crate::interactive::{advance, palpating};
use crate::scenes::Setting;

fn simulation(kind: &'static str) -> Arc<Simulation> {
    let setting = Setting {
        organ: "builtin = \"liver\"",
        kind,
        model: if kind == "hybrid" {
            "mechanical_triangles = 400"
        } else {
            ""
        },
        ..Setting::default()
    };
    Arc::new(setting.simulation())
}

/// A hand that goes 4 mm into the organ where it is highest and 4 mm out of it, once in a second.
fn palpating_liver(simulation: &Simulation) -> VirtualDevice {
    let vertices = simulation.surface().mesh().vertices();
    let highest = vertices.iter().max_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
    VirtualDevice::new(Trajectory::Sine {
        center: *highest,
        amplitude: Vec3::z() * -4e-3,
        frequency: 1.0,
    })
}

fn touch(
    simulation: &Arc<Simulation>,
    device: VirtualDevice,
) -> (VirtualInteraction, Arc<AtomicU32>) {
    let stops = device.disable_count();
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    let devices = vec![Some(PlacedDevice::new(device))];
    (
        VirtualInteraction::new(simulation.clone(), devices, settings).unwrap(),
        stops,
    )
}

/// Orders to begin anew, between steps in contact; each row says so.
#[test]
#[ignore = "long"]
fn a_new_beginning_allocates_nothing() {
    for kind in ["local", "hybrid"] {
        let (mut hands, _) = touch(&simulation(kind), palpating(1.0));
        advance(&mut hands, 1000);
        hands.rows().count();
        reset_violation_count();
        assert_no_alloc(|| {
            for _ in 0..10 {
                hands.send(ModelCommand::Reset);
                (0..100).for_each(|_| hands.advance().unwrap());
            }
        });
        assert_eq!(violation_count(), 0, "{kind}");
        let began = hands
            .rows()
            .filter(|row| row.events.contains(Event::Restart));
        assert_eq!(began.count(), 10, "{kind}");
    }
}

/// The device is neither stopped nor opened again, forces are off and come back, and from then on the rows are those of
/// the other model.
#[test]
#[ignore = "long"]
fn another_model_takes_over_while_the_device_stays_open() {
    let (local, other) = (simulation("local"), simulation("hybrid"));
    let (mut hands, stops) = touch(&local, palpating_liver(&local));
    advance(&mut hands, 1250);
    let before = hands.samples(0).last().unwrap();
    assert_eq!(before.stage, Stage::Live);
    hands.rows().count();
    hands
        .replace_model(PreparedModel::new(other.clone()))
        .unwrap();
    let prepared = violation_count();
    assert_no_alloc(|| (0..750).for_each(|_| hands.advance().unwrap()));
    assert_eq!(violation_count(), prepared);
    advance(&mut hands, 2000);
    assert_eq!(stops.load(Ordering::Relaxed), 0);
    assert_eq!(hands.supervisor().state(), ForceState::Running);
    let samples: Vec<_> = hands.samples(0).collect();
    assert!(samples.iter().any(|sample| sample.stage == Stage::Off));
    assert!(
        samples[2000..]
            .iter()
            .any(|sample| sample.output.norm() > 0.0)
    );
    let rows: Vec<SessionRow> = hands.rows().collect();
    let began = rows
        .iter()
        .position(|row| row.events.contains(Event::Restart))
        .unwrap();
    // Two steps until the loop has seen it.
    assert!(began <= 3, "{began}");
    // Without relaxation a step has no memory: each place has the force of the other model, as in a touch that began
    // with it, wherever both were in contact long enough to have followed the surface.
    let (mut fresh, _) = touch(&other, palpating_liver(&other));
    advance(&mut fresh, 4000);
    let fresh: Vec<SessionRow> = fresh.rows().collect();
    let peak = |rows: &[SessionRow], from: f64| {
        let late = rows.iter().filter(|row| row.time_s > from);
        late.map(|row| row.force_n[2]).fold(0.0, f64::max)
    };
    // Two whole cycles later; the hand is the same, and a period has 200 steps.
    let (found, expected) = (peak(&rows, 2.0), peak(&fresh, 2.0));
    assert!(
        expected > 0.0 && (found / expected - 1.0).abs() < 1e-6,
        "{found} {expected}"
    );
}

/// A pause that a person asked for stays one.
#[test]
#[ignore = "long"]
fn a_pause_outlasts_another_model() {
    let (mut hands, _) = touch(&simulation("local"), palpating(1.0));
    advance(&mut hands, 1200);
    hands.send(ModelCommand::Pause);
    advance(&mut hands, 20);
    hands
        .replace_model(PreparedModel::new(simulation("hybrid")))
        .unwrap();
    advance(&mut hands, 200);
    assert_eq!(hands.supervisor().state(), ForceState::Paused);
}

/// A hand that is deep in the organ when another model takes over has no force until it comes out: the first force would
/// be a jump. Judge: the limit at arming, 0.3 N.
#[test]
#[ignore = "long"]
fn a_hand_deep_in_another_model_has_no_force_until_it_comes_out() {
    let local = simulation("local");
    let (mut hands, _) = touch(&local, palpating(1.0));
    advance(&mut hands, 1250);
    hands
        .replace_model(PreparedModel::new(simulation("hybrid")))
        .unwrap();
    hands.samples(0).count();
    advance(&mut hands, 2000);
    let samples: Vec<_> = hands.samples(0).skip(10).collect();
    let smallest = samples
        .iter()
        .map(|sample| sample.commanded.norm())
        .fold(f64::INFINITY, f64::min);
    assert!(smallest > 0.3, "{smallest}");
    assert!(samples.iter().all(|sample| sample.output.norm() == 0.0));
    assert_eq!(hands.supervisor().state(), ForceState::Armed);
}
