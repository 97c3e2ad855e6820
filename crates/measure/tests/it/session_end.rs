//! Every end of a rig's session on a device that is there is no force. Judge: what the device was told last.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use palpate_measure::live::{ConsoleEvent, LiveRig};
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass, VirtualPhantom};
use palpate_measure::{Rig, RigSettings};
use palpate_servo::supervisor::REPORT_TIMEOUT;
use palpate_servo::{Capabilities, Clock, Command, Device, DeviceState, Disabled, Fault, Vec3};

use crate::rig::soft;

/// A handle that its own weight pulls down, so that the indenter always needs a force.
struct Heavy {
    device: VirtualPhantom,
    force: Arc<AtomicU64>,
    hangs: Arc<AtomicBool>,
}

impl Device for Heavy {
    fn capabilities(&self) -> &Capabilities {
        self.device.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.device.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        while self.hangs.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
        }
        self.force
            .store(command.force().norm().to_bits(), Ordering::Relaxed);
        self.device.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.force.store(0, Ordering::Relaxed);
        self.device.disable()
    }
}

struct Pressed {
    live: LiveRig,
    force: Arc<AtomicU64>,
    hangs: Arc<AtomicBool>,
}

impl Pressed {
    fn new(is_ended: fn() -> bool) -> Self {
        let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
        let weight = |_: f64, _: &Vec3, _: &Vec3| Vec3::y() * -0.3;
        let device = VirtualPhantom::with_axes(machine, &Vec3::zeros(), Imperfections::none());
        let (force, hangs) = (Arc::<AtomicU64>::default(), Arc::<AtomicBool>::default());
        let device = Heavy {
            device: device.with_contact(Box::new(weight)),
            force: force.clone(),
            hangs: hangs.clone(),
        };
        let clock = Clock::real();
        let rig = Rig::on(Box::new(device), soft(), RigSettings::default(), clock, 1).unwrap();
        let live = LiveRig::start_until(rig, is_ended).unwrap();
        let pressed = Self { live, force, hangs };
        pressed.wait(|force| force > 0.05);
        pressed
    }

    fn force(&self) -> f64 {
        f64::from_bits(self.force.load(Ordering::Relaxed))
    }

    /// Waits until the force is as wanted; a machine that is busy elsewhere takes forces off, and they are armed again.
    fn wait(&self, mut is_wanted: impl FnMut(f64) -> bool) {
        let begun = Instant::now();
        while !is_wanted(self.force()) {
            assert!(begun.elapsed() < Duration::from_secs(30));
            self.live.console.arm();
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// The time until the device has zero [s], at most a second on a machine that is busy elsewhere.
fn zero_after(force: &AtomicU64) -> Duration {
    let begun = Instant::now();
    while f64::from_bits(force.load(Ordering::Relaxed)) > 0.0 {
        assert!(begun.elapsed() < Duration::from_secs(1));
        std::thread::sleep(Duration::from_micros(100));
    }
    begun.elapsed()
}

#[test]
fn an_emergency_stop_a_signal_and_a_lost_window_leave_no_force() {
    static ENDED: AtomicBool = AtomicBool::new(false);
    let pressed = Pressed::new(|| ENDED.load(Ordering::Relaxed));
    pressed.live.console.emergency_stop();
    println!(
        "emergency stop: zero after {:?}",
        zero_after(&pressed.force)
    );
    pressed.wait(|force| force > 0.05);
    ENDED.store(true, Ordering::Relaxed);
    println!("signal: zero after {:?}", zero_after(&pressed.force));
    ENDED.store(false, Ordering::Relaxed);
    // A signal that ended is armed again only here, so that there is a force when the window is lost.
    pressed.wait(|force| force > 0.05);
    let force = pressed.force.clone();
    let dropped = Instant::now();
    drop(pressed);
    println!("lost window: zero and ended after {:?}", dropped.elapsed());
    assert_eq!(f64::from_bits(force.load(Ordering::Relaxed)), 0.0);
}

/// Who operates a rig and says no more is lost, be it a window or a program without one.
#[test]
fn a_silent_window_of_the_rig_leaves_no_force() {
    let pressed = Pressed::new(|| false);
    let silent = Fault::ProgramSilent {
        limit: REPORT_TIMEOUT,
    };
    let begun = Instant::now();
    // A machine that is busy elsewhere takes forces off before.
    loop {
        pressed.wait(|force| {
            pressed.live.report_alive();
            force > 0.05
        });
        let since = Instant::now();
        while pressed.force() > 0.0 {
            std::thread::sleep(Duration::from_millis(1));
        }
        println!("zero after {:?}", since.elapsed());
        let why = std::iter::from_fn(|| {
            let news = pressed
                .live
                .console_events
                .recv_timeout(Duration::from_millis(100));
            news.ok()
        });
        if why.filter_map(fault_of).last() == Some(silent) {
            return;
        }
        assert!(begun.elapsed() < Duration::from_secs(60));
    }
}

fn fault_of(news: ConsoleEvent) -> Option<Fault> {
    match news {
        ConsoleEvent::Faulted(fault) => Some(fault),
        _ => None,
    }
}

#[test]
fn a_device_of_the_rig_that_hangs_is_named_and_left_behind() {
    let pressed = Pressed::new(|| false);
    pressed.hangs.store(true, Ordering::Relaxed);
    let begun = Instant::now();
    while pressed.live.hung_device().is_none() {
        assert!(begun.elapsed() < Duration::from_secs(5));
        std::thread::sleep(Duration::from_millis(1));
    }
    let warning = pressed.live.hung_device().unwrap();
    println!("{warning}, after {:?}", begun.elapsed());
    assert!(warning.contains("device of the rig") && warning.contains("cut its power"));
    let hangs = pressed.hangs.clone();
    // It ends although its thread does not.
    drop(pressed);
    hangs.store(false, Ordering::Relaxed);
}
