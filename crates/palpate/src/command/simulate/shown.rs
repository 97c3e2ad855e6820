//! Simulation without a window: devices move the tools, and servers publish it, until Ctrl-C.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use palpate_files::Scene;
use palpate_files::scene::DeviceKind;
use palpate_servo::{ServoSettings, lock_memory};
use palpate_simulate::Resources;
use palpate_simulate::interactive::{Environment, Interaction, PreparedModel, SceneDevices};

use crate::failure::Failure;
use crate::progress::Reader;
use crate::{interrupt, output, preparation};

/// Polling interval for the end.
const LOOK: Duration = Duration::from_millis(50);

/// Runs `scene` until the user presses Ctrl-C.
pub(super) fn run(scene: Scene, resources: Resources) -> Result<(), Failure> {
    let moves = |device: DeviceKind| device.is_haptic() || device == DeviceKind::Virtual;
    if !scene.tools.iter().any(|tool| moves(tool.device)) {
        return Err(Failure::input(
            "no tool of the scene is moved without a window; set a `device` to a haptic one or to \"virtual\"",
        ));
    }
    SceneDevices::check(&scene, &resources.devices)?;
    let simulation = Arc::new(preparation::simulation(&scene, &resources, Reader::Person)?);
    output::warnings(simulation.warnings());
    let names = simulation.clone();
    let devices = SceneDevices::open(&scene, &simulation, &resources.devices)?;
    let environment = Environment {
        publishers: &resources.publishers,
        is_ended: interrupt::is_requested,
    };
    let prepared = PreparedModel::new(simulation);
    let settings = ServoSettings::default();
    // The first call starts listening for signals.
    let _ = interrupt::is_requested();
    let memory = lock_memory();
    let mut touch = Interaction::start_in(&environment, prepared, devices.devices, settings)?;
    for publisher in environment.publishers {
        output::line(format!("shown at {}, Ctrl-C ends it", publisher.address()))?;
    }
    // No user can rearm the devices here: a fault is reported and stays.
    let mut reported = None;
    while touch.is_running() && !interrupt::is_requested() {
        let fault = touch
            .quality()
            .loops
            .iter()
            .flatten()
            .find_map(|own| own.fault);
        if let Some(fault) = fault.filter(|fault| reported != Some(*fault)) {
            output::warnings(&[fault.to_string()]);
        }
        reported = fault;
        thread::sleep(LOOK);
    }
    let ended = touch.is_running();
    let quality = touch.stop()?;
    output::warnings(&quality.warnings(memory));
    output::warnings(&touch.snapshot().warnings(names.tools()));
    match quality.loops.iter().flatten().find_map(|own| own.fault) {
        Some(fault) if !ended => Err(Failure::failed(fault)),
        _ => Ok(()),
    }
}
