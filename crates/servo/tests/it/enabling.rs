//! When a loop enables its device and disables it.

use std::sync::{Arc, Mutex};

use palpate_servo::{
    Capabilities, Command, Device, DeviceState, Disabled, Fault, Sample, ServoLoop, ServoReader,
    ServoSettings, Stage, Vec3,
};

const PERIOD: f64 = 1e-3;

/// What a device was told, but for zero forces.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Told {
    Enabled,
    Disabled,
    Force,
}

/// A device at rest that takes its forces off by itself when it is pushed, as one with a safety of its own, and displays
/// none until it is enabled again.
struct Safe {
    capabilities: Capabilities,
    told: Arc<Mutex<Vec<Told>>>,
    /// Ticks at which it takes its forces off.
    trips_at: u64,
    /// Whether it can be enabled after that.
    yields: bool,
    exchanges: u64,
    is_off: bool,
}

impl Safe {
    fn new(trips_at: u64) -> (Self, Arc<Mutex<Vec<Told>>>) {
        let told = Arc::<Mutex<Vec<Told>>>::default();
        let safe = Self {
            capabilities: Capabilities::premium("safe"),
            told: told.clone(),
            trips_at,
            yields: true,
            exchanges: 0,
            is_off: false,
        };
        (safe, told)
    }
}

impl Device for Safe {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.told.lock().unwrap().push(Told::Enabled);
        if self.exchanges > self.trips_at && !self.yields {
            return Err(Fault::Device { code: 7 });
        }
        self.is_off = false;
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        self.exchanges += 1;
        self.is_off |= self.exchanges == self.trips_at;
        if command.force() != Vec3::zeros() {
            self.told.lock().unwrap().push(Told::Force);
        }
        let off = Fault::Safety { what: "its button" };
        Ok(DeviceState {
            ready: !self.is_off,
            fault: self.is_off.then_some(off),
            ..DeviceState::at(command.time, Vec3::zeros())
        })
    }

    fn disable(&mut self) -> Disabled {
        self.told.lock().unwrap().push(Told::Disabled);
        Disabled::Unknown
    }
}

struct Driven {
    servo: ServoLoop,
    reader: ServoReader,
    tick: u64,
}

impl Driven {
    fn new(device: Safe) -> Self {
        let settings = ServoSettings::default();
        let push = |_: &DeviceState, _: f64| Vec3::x() * 0.1;
        let (servo, reader) = ServoLoop::new(Box::new(device), Box::new(push), settings).unwrap();
        Self {
            servo,
            reader,
            tick: 0,
        }
    }

    fn after(&mut self, ticks: u64) -> Sample {
        let mut last = None;
        for _ in 0..ticks {
            last = Some(self.servo.tick(self.tick as f64 * PERIOD, 0.0).unwrap());
            self.tick += 1;
        }
        last.unwrap()
    }
}

fn since(told: &Mutex<Vec<Told>>, seen: usize) -> Vec<Told> {
    told.lock().unwrap()[seen..].to_vec()
}

/// A device that took its forces off by itself displays them again when a person armed, which it does not without being
/// told so.
#[test]
fn arming_enables_a_device_that_took_its_forces_off() {
    let (device, told) = Safe::new(700);
    let mut driven = Driven::new(device);
    driven.after(699);
    assert_eq!(told.lock().unwrap()[0], Told::Enabled);
    let before = told.lock().unwrap().len();
    let off = driven.after(1);
    let fault = Fault::Safety { what: "its button" };
    assert_eq!(off.stage, Stage::Faulted(fault));
    // Its last force, and that it is disabled in the tick in which that is known.
    assert_eq!(since(&told, before), [Told::Force, Told::Disabled]);
    assert_eq!(driven.servo.report().disabled, Some(Disabled::Unknown));
    driven.after(500);
    assert_eq!(since(&told, before + 2), []);
    driven.reader.supervisor.arm();
    let on = driven.after(600);
    assert_eq!(on.stage, Stage::Live);
    let after = since(&told, before + 2);
    assert_eq!(after[0], Told::Enabled);
    assert!(after.len() > 50 && after[1..].iter().all(|told| *told == Told::Force));
}

#[test]
fn a_device_that_refuses_to_be_enabled_is_a_fault_until_somebody_arms() {
    let (mut device, told) = Safe::new(700);
    device.yields = false;
    let mut driven = Driven::new(device);
    driven.after(800);
    let before = told.lock().unwrap().len();
    driven.reader.supervisor.arm();
    let refused = driven.after(300);
    assert_eq!(refused.stage, Stage::Faulted(Fault::Device { code: 7 }));
    assert_eq!(since(&told, before), [Told::Enabled]);
    driven.reader.supervisor.arm();
    driven.after(300);
    assert_eq!(since(&told, before), [Told::Enabled; 2]);
}

#[test]
fn the_end_of_a_session_disables_the_device_and_a_pause_does_not() {
    let (device, told) = Safe::new(u64::MAX);
    let mut driven = Driven::new(device);
    driven.after(700);
    let before = told.lock().unwrap().len();
    driven.reader.supervisor.pause();
    driven.after(100);
    assert_eq!(since(&told, before), []);
    driven.reader.supervisor.switch_off();
    driven.after(100);
    assert_eq!(since(&told, before), [Told::Disabled]);
    driven.reader.supervisor.arm();
    driven.after(1);
    assert_eq!(since(&told, before), [Told::Disabled, Told::Enabled]);
    drop(driven);
    let whole = [Told::Disabled, Told::Enabled, Told::Disabled];
    assert_eq!(since(&told, before), whole);
}
