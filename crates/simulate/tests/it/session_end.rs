//! Every end of a session is no force. Judge: zero on the virtual clock within 5 ms of the order, at every tick after it,
//! until a person arms again.

use std::io::{BufRead, BufReader};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use palpate_files::{Claim, Overwrite, Scene, Session};
use palpate_servo::supervisor::REPORT_TIMEOUT;
use palpate_servo::{
    Capabilities, Command, Device, DeviceState, Disabled, Fault, Sample, ServoSettings, Stage,
    StopReason, Supervisor, Trajectory, Vec3, VirtualDevice, Waypoint,
};
use palpate_simulate::interactive::{
    Environment, Interaction, ModelCommand, PlacedDevice, PreparedModel, VirtualInteraction,
};
use palpate_simulate::{SessionFolder, Simulation};

use crate::interactive::{POLE, advance, palpating, simulation};

/// The button of the device that stops.
const STOPS: u32 = 2;

/// A hand that presses 2 mm deep from half a second on, and presses the button from `pressed` to `released` [s].
fn pressing(pressed: f64, released: f64) -> VirtualDevice {
    let at = |time: f64, z: f64, buttons| Waypoint {
        buttons,
        ..Waypoint::new(time, POLE + Vec3::z() * z)
    };
    let way = vec![
        at(0.0, 2e-3, 0),
        at(0.6, 2e-3, 0),
        at(1.0, -2e-3, 0),
        at(pressed, -2e-3, STOPS),
        at(released, -2e-3, 0),
    ];
    VirtualDevice::new(Trajectory::waypoints(way).unwrap())
}

fn pressed_touch() -> VirtualInteraction {
    pressed_until(1.5)
}

/// The same with a button that is pressed at a time [s].
fn pressed_until(button: f64) -> VirtualInteraction {
    let device = pressing(button, button + 0.1);
    let capabilities = Capabilities {
        stop_buttons: STOPS,
        ..device.capabilities().clone()
    };
    let device = PlacedDevice::new(device.with_capabilities(capabilities));
    let simulation = simulation("", "slip", "[]");
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    let mut hands = VirtualInteraction::new(simulation, vec![Some(device)], settings).unwrap();
    advance(&mut hands, 1400);
    let last = hands.samples(0).last().unwrap();
    assert!(last.output.norm() > 0.01, "{last:?}");
    hands
}

/// Ticks after which nothing is held or sent any more; later there must be nothing either.
fn ticks_to_zero(samples: &[Sample]) -> usize {
    let is_zero = |sample: &Sample| sample.applied.norm() == 0.0 && sample.output.norm() == 0.0;
    let last = samples.iter().rposition(|sample| !is_zero(sample));
    last.map_or(0, |last| last + 1)
}

#[test]
fn every_order_to_stop_is_zero_force_within_5_ms_until_somebody_arms() {
    type Stop = fn(&mut VirtualInteraction);
    let stops: [(&str, Stop, Option<Fault>); 6] = [
        (
            "space bar or button in the window",
            |hands| hands.supervisor().trip(),
            Some(Fault::EmergencyStop),
        ),
        (
            "Ctrl-C or SIGTERM",
            |hands| hands.supervisor().trip_with_reason(StopReason::Signal),
            Some(Fault::Interrupted),
        ),
        (
            "device that hangs",
            |hands| hands.supervisor().trip_with_reason(StopReason::HungDevice),
            Some(Fault::Hung { limit: 0.1 }),
        ),
        (
            "disk that is full",
            |hands| hands.supervisor().trip_with_reason(StopReason::Unrecorded),
            Some(Fault::Unrecorded),
        ),
        ("pause", |hands| hands.send(ModelCommand::Pause), None),
        ("end", |hands| hands.supervisor().switch_off(), None),
    ];
    for (name, stop, fault) in stops {
        let mut hands = pressed_touch();
        stop(&mut hands);
        advance(&mut hands, 90);
        let samples: Vec<Sample> = hands.samples(0).collect();
        let ticks = ticks_to_zero(&samples);
        println!("{name}: zero after {ticks} ticks");
        assert!(ticks <= 5, "{name}: {ticks}");
        let found = match samples[89].stage {
            Stage::Faulted(fault) => Some(fault),
            _ => None,
        };
        assert_eq!(found, fault, "{name}");
    }
}

/// The button is pressed at tick 1400 and something, and released 100 ms later: the stop is latched.
#[test]
fn the_stop_button_of_a_device_is_zero_force_within_5_ms() {
    let mut hands = pressed_touch();
    advance(&mut hands, 1600);
    let samples: Vec<Sample> = hands.samples(0).collect();
    let pressed = samples
        .iter()
        .position(|sample| sample.state.buttons & STOPS != 0)
        .unwrap();
    let ticks = ticks_to_zero(&samples) - pressed;
    println!("zero {ticks} ticks after the button");
    assert!(ticks <= 5, "{ticks}");
    assert_eq!(
        samples.last().unwrap().stage,
        Stage::Faulted(Fault::DeviceButton)
    );
}

/// A window that does not report any more is a fault after the time that is promised.
#[test]
fn a_lost_window_is_zero_force_within_its_silence() {
    let mut hands = pressed_until(9.0);
    let time = hands.time();
    hands.supervisor().report(time);
    let ticks = (REPORT_TIMEOUT * 1e3) as usize;
    advance(&mut hands, ticks + 10);
    let samples: Vec<Sample> = hands.samples(0).collect();
    assert!(ticks_to_zero(&samples) <= ticks + 5);
    let silent = Fault::ProgramSilent {
        limit: REPORT_TIMEOUT,
    };
    assert_eq!(samples.last().unwrap().stage, Stage::Faulted(silent));
}

/// What a device was told last, as bits of its size, and when; it hangs while it is told to.
#[derive(Clone, Default)]
struct Seen {
    force: Arc<AtomicU64>,
    hangs: Arc<AtomicBool>,
}

struct Spied(VirtualDevice, Seen);

impl Device for Spied {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.0.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        while self.1.hangs.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
        }
        self.1
            .force
            .store(command.force().norm().to_bits(), Ordering::Relaxed);
        self.0.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.1.force.store(0, Ordering::Relaxed);
        self.0.disable()
    }
}

impl Seen {
    fn force(&self) -> f64 {
        f64::from_bits(self.force.load(Ordering::Relaxed))
    }

    /// Waits until a force is displayed, arming as often as a loaded machine takes it off.
    fn wait_for_force(&self, supervisor: &Supervisor) {
        let begun = Instant::now();
        while self.force() < 0.01 {
            assert!(
                begun.elapsed() < Duration::from_secs(60),
                "there is no force"
            );
            supervisor.arm();
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

fn live(
    simulation: Arc<Simulation>,
    device: VirtualDevice,
    is_ended: fn() -> bool,
) -> (Interaction, Seen) {
    let seen = Seen::default();
    let device = PlacedDevice::new(Spied(device, seen.clone()));
    let environment = Environment {
        is_ended,
        ..Environment::default()
    };
    let prepared = PreparedModel::new(simulation);
    let settings = ServoSettings::default();
    let touch = Interaction::start_in(&environment, prepared, vec![Some(device)], settings);
    (touch.unwrap(), seen)
}

/// On the machine's clock: the device has zero when the program shall end, whatever the window does. The time is that of
/// the threads on this machine, so that it is bounded loosely and printed.
#[test]
fn a_signal_takes_the_force_off_without_the_window() {
    static ENDED: AtomicBool = AtomicBool::new(false);
    let simulation = simulation("", "slip", "[]");
    let (mut touch, seen) = live(simulation, palpating(0.2), || ENDED.load(Ordering::Relaxed));
    seen.wait_for_force(touch.supervisor());
    let asked = Instant::now();
    ENDED.store(true, Ordering::Relaxed);
    while seen.force() > 0.0 {
        assert!(asked.elapsed() < Duration::from_secs(1));
        std::thread::sleep(Duration::from_micros(100));
    }
    println!("zero after {:?}", asked.elapsed());
    touch.stop().unwrap();
}

/// A device that hangs is named, all forces are off, and the session ends although its loop does not.
#[test]
fn a_device_that_hangs_in_a_call_is_named_and_left_behind() {
    let simulation = simulation("", "slip", "[]");
    let (mut touch, seen) = live(simulation, palpating(0.2), || false);
    seen.wait_for_force(touch.supervisor());
    seen.hangs.store(true, Ordering::Relaxed);
    let begun = Instant::now();
    let warning = loop {
        match touch.hung_device() {
            Some(warning) => break warning,
            None => std::thread::sleep(Duration::from_millis(1)),
        }
        assert!(begun.elapsed() < Duration::from_secs(5), "nobody notices");
    };
    println!("{warning}, after {:?}", begun.elapsed());
    assert!(
        warning.contains("virtual") && warning.contains("cut its power"),
        "{warning}"
    );
    let stopped = touch.stop();
    assert!(stopped.is_err());
    seen.hangs.store(false, Ordering::Relaxed);
}

/// A disk that is full while a pressed organ is recorded: no force, the cause is named, and the rows are whole in memory.
#[cfg(unix)]
#[test]
fn a_full_disk_is_zero_force_and_the_recording_is_whole() {
    const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\ntriangles = 800\n\
         [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
         [[tool]]\nname = \"right\"\nkind = \"probe\"\ndevice = \"mouse\"\n";
    let scene = Scene::parse(SCENE, "disk.toml").unwrap();
    let simulation = Arc::new(Simulation::new(&scene).unwrap());
    let (mut touch, seen) = live(simulation.clone(), palpating(0.2), || false);
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let writer = |path: &std::path::Path| {
        let claim = Claim::of_folder(path, Overwrite::Allowed).unwrap();
        SessionFolder::create(claim, &scene, &simulation).unwrap()
    };
    // A pipe whose reader leaves: from then on every write fails, as on a disk that is full.
    std::fs::create_dir(at("full")).unwrap();
    let pipe = at("full/session.csv.part");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    let is_full = Arc::new(AtomicBool::new(false));
    let fills = is_full.clone();
    let reader = std::thread::spawn(move || {
        let lines = BufReader::new(std::fs::File::open(pipe).unwrap()).lines();
        lines.take_while(|_| !fills.load(Ordering::Relaxed)).count()
    });
    let full = writer(&at("full"));
    touch.record(full);
    seen.wait_for_force(touch.supervisor());
    is_full.store(true, Ordering::Relaxed);
    reader.join().unwrap();
    let begun = Instant::now();
    while touch.recording_failure().is_none() || seen.force() > 0.0 {
        assert!(
            begun.elapsed() < Duration::from_secs(5),
            "{:?}",
            touch.recording_failure()
        );
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(touch.recording_failure().unwrap().is_complete);
    touch.record_elsewhere(writer(&at("other"))).unwrap();
    touch.end_recording().unwrap();
    let session = Session::read(at("other/session.csv")).unwrap();
    assert_eq!(session.incomplete, None);
    let steps: Vec<f64> = session.rows.iter().map(|row| row.time_s).collect();
    assert!(steps.len() > 10 && steps.is_sorted());
    touch.stop().unwrap();
}
