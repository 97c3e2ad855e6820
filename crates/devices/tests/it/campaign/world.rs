//! A hand in contact, a device under it, and what can go wrong with both.

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use palpate_device_stand_ins::{
    HaplyStandIn, HaplyStandInSettings, Mechanics, Misbehaviour, StandInClock, StandInLibrary,
};
use palpate_devices::{Kind, Places};
use palpate_servo::{
    Capabilities, Command, Controller, Device, DeviceState, Disabled, Fault, Trajectory, Vec3,
    VirtualDevice, Waypoint,
};

use super::{Driver, Trouble};
use crate::hands::wall;

/// When the hand is in contact for good [s].
pub(crate) const CONTACT: f64 = 0.8;

/// A hand that rests until it is armed, presses into the wall, and goes up and down there: 0.5 to 1.1 N.
pub(crate) fn hand() -> VirtualDevice {
    let place = |time, height: f64| Waypoint::new(time, Vec3::new(0.02, height, -0.01));
    let mut way = vec![place(0.0, 2e-3), place(0.56, 2e-3), place(0.76, -4e-3)];
    for step in 1..1000 {
        let since = f64::from(step) * 0.01;
        let swing = (std::f64::consts::TAU * 2.0 * since).sin();
        way.push(place(0.76 + since, -4e-3 + 1.5e-3 * swing));
    }
    VirtualDevice::new(Trajectory::waypoints(way).unwrap())
}

/// The wall, until its model or its program fails.
pub(crate) struct Law {
    fails: Arc<AtomicU8>,
    time: f64,
    killed: Option<f64>,
}

/// How long a model's answer is used [s]: two periods of 5 ms and a tick.
const USED: f64 = 0.011;

impl Controller for Law {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        self.time = state.time;
        let fails = self.fails.load(Ordering::Acquire);
        assert!(fails != Trouble::Panic as u8, "a defect");
        if fails == Trouble::ForceNotANumber as u8 {
            return Vec3::repeat(f64::NAN);
        }
        if fails == Trouble::ModelKilled as u8 {
            self.killed.get_or_insert(state.time);
        }
        wall(state, dt)
    }

    fn overdue(&self) -> Option<f64> {
        // Its last answer was one that had just come.
        Some(self.killed.map_or(0.0, |when| self.time - when) - USED)
    }
}

/// What stands for the device of a driver.
enum StandIn {
    Virtual(Faulty),
    Service(HaplyStandIn),
    Library(StandInLibrary),
}

/// A driver with what stands for its device.
pub(crate) struct World {
    driver: Driver,
    stand_in: StandIn,
    places: Places,
    fails: Arc<AtomicU8>,
}

impl World {
    /// With a hand whose time is that of the loop, or of the wall.
    pub(crate) fn new(driver: Driver, mechanics: Box<dyn Mechanics>, clock: StandInClock) -> Self {
        let mut places = Places::default();
        let library = |kind| StandInLibrary::build(kind).unwrap();
        let stand_in = match driver {
            Driver::Virtual => StandIn::Virtual(Faulty::new(mechanics)),
            Driver::Haply => {
                let settings = HaplyStandInSettings {
                    clock,
                    ..HaplyStandInSettings::default()
                };
                let service = HaplyStandIn::start(vec![mechanics], settings).unwrap();
                places.haply = service.address().clone();
                StandIn::Service(service)
            }
            Driver::OpenHaptics => {
                let library = library(Kind::OpenHaptics);
                places.openhaptics = Some(library.path().to_owned());
                library.carry(mechanics, clock, 0);
                StandIn::Library(library)
            }
            Driver::ForceDimension => {
                let library = library(Kind::ForceDimension);
                places.force_dimension = Some(library.path().to_owned());
                library.set("stand_in_watchdog", i32::from(clock == StandInClock::Wall));
                library.carry(mechanics, clock, 0);
                StandIn::Library(library)
            }
        };
        Self {
            driver,
            stand_in,
            places,
            fails: Arc::new(AtomicU8::new(u8::MAX)),
        }
    }

    /// The device; a machine that is busy elsewhere has `timeout`.
    pub(crate) fn open(&self, timeout: Duration) -> Box<dyn Device> {
        let places = Places {
            timeout,
            ..self.places.clone()
        };
        match (&self.stand_in, self.driver) {
            (StandIn::Virtual(faulty), _) => Box::new(faulty.clone()),
            (_, Driver::Haply) => Kind::Haply.open(0, &places).unwrap(),
            (_, Driver::OpenHaptics) => Kind::OpenHaptics.open(0, &places).unwrap(),
            _ => Kind::ForceDimension.open(0, &places).unwrap(),
        }
    }

    pub(crate) fn law(&self) -> Law {
        Law {
            fails: self.fails.clone(),
            time: 0.0,
            killed: None,
        }
    }

    pub(crate) fn library(&self) -> Option<&StandInLibrary> {
        match &self.stand_in {
            StandIn::Library(library) => Some(library),
            _ => None,
        }
    }

    /// What the device displays [N].
    pub(crate) fn displayed(&self) -> Vec3 {
        match &self.stand_in {
            StandIn::Virtual(faulty) => faulty.shared.lock().unwrap().displayed,
            StandIn::Service(service) => service.force(0),
            StandIn::Library(library) => library.force(0),
        }
    }

    /// From now on `trouble` is there.
    pub(crate) fn befall(&self, trouble: Trouble) {
        if let Trouble::ForceNotANumber | Trouble::Panic | Trouble::ModelKilled = trouble {
            self.fails.store(trouble as u8, Ordering::Release);
            return;
        }
        match &self.stand_in {
            StandIn::Virtual(faulty) => {
                faulty.shared.lock().unwrap().trouble = Some(trouble);
            }
            StandIn::Service(service) => service.misbehave(Some(match trouble {
                Trouble::Late => Misbehaviour::Stalls(Duration::from_millis(40)),
                Trouble::Doubled => Misbehaviour::Repeats(20),
                Trouble::NotANumber => Misbehaviour::Coordinate("NaN"),
                Trouble::Lost => Misbehaviour::Disconnects,
                Trouble::TakesOff => Misbehaviour::NoPower,
                _ => Misbehaviour::NoReply,
            })),
            StandIn::Library(library) => {
                let (switch, value) = match (trouble, self.driver) {
                    (Trouble::Silence, Driver::OpenHaptics) => ("stand_in_stalls", 1),
                    (Trouble::Late, Driver::OpenHaptics) => ("stand_in_late_ms", 40),
                    (Trouble::Silence | Trouble::Late, _) => ("stand_in_stalls", 40),
                    (Trouble::Doubled, _) => ("stand_in_at_once", 1),
                    (Trouble::Hung, _) => ("stand_in_hangs", 1),
                    (Trouble::NotANumber, _) => ("stand_in_nan", 1),
                    (Trouble::Lost, Driver::OpenHaptics) => ("stand_in_error", 0x302),
                    (Trouble::Lost, _) => ("stand_in_connected", 0),
                    (_, Driver::OpenHaptics) => ("stand_in_error", 0x200),
                    _ => ("stand_in_cause", 1),
                };
                library.set(switch, value);
            }
        }
    }

    /// Calls that hang return, so that threads end.
    pub(crate) fn release(&self) {
        if let Some(library) = self.library() {
            library.set("stand_in_hangs", 0);
            library.set("stand_in_stalls", 0);
        }
    }
}

/// A device of ours that can fail, and keeps its force when nobody tells it otherwise.
#[derive(Clone)]
struct Faulty {
    capabilities: Capabilities,
    shared: Arc<Mutex<Shared>>,
}

struct Shared {
    mechanics: Box<dyn Mechanics>,
    displayed: Vec3,
    trouble: Option<Trouble>,
}

impl Faulty {
    fn new(mechanics: Box<dyn Mechanics>) -> Self {
        Self {
            capabilities: Capabilities::premium("faulty"),
            shared: Arc::new(Mutex::new(Shared {
                mechanics,
                displayed: Vec3::zeros(),
                trouble: None,
            })),
        }
    }
}

impl Device for Faulty {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        let trouble = self.shared.lock().unwrap().trouble;
        match trouble {
            Some(Trouble::Silence) => return Err(Fault::Silent),
            Some(Trouble::Lost) => return Err(Fault::Vanished),
            // Once.
            Some(Trouble::Late) => {
                self.shared.lock().unwrap().trouble = None;
                std::thread::sleep(Duration::from_millis(40));
            }
            _ => {}
        }
        let mut shared = self.shared.lock().unwrap();
        let mut state = shared.mechanics.advance(command.time, &command.force());
        let takes_off = trouble == Some(Trouble::TakesOff);
        shared.displayed = if takes_off {
            Vec3::zeros()
        } else {
            command.force()
        };
        state.fault = takes_off.then_some(Fault::Safety { what: "its button" });
        if trouble == Some(Trouble::NotANumber) {
            state.position.y = f64::NAN;
        }
        Ok(state)
    }

    fn disable(&mut self) -> Disabled {
        self.shared.lock().unwrap().displayed = Vec3::zeros();
        Disabled::NoForce
    }
}
