//! The rig on a device that is carried by its own mechanics. The judge is the rig whose tissue touches the virtual
//! machine itself.

use std::sync::{Arc, Mutex};

use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, Mechanics, Misbehaviour};
use palpate_devices::haply::HaplyDevice;
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass, VirtualPhantom};
use palpate_measure::{Ended, Error, Rig, RigSample, RigSettings};
use palpate_servo::{Capabilities, Clock, Command, Device, DeviceState, Disabled, Fault, Vec3};

use crate::rig::{rig, soft, usual};

/// A virtual PHANTOM on a table, whose zero is elsewhere than where its handle rests.
struct OnTable(VirtualPhantom);

const SOMEWHERE: Vec3 = Vec3::new(0.03, -0.02, 0.05);

impl OnTable {
    fn new(imperfections: Imperfections) -> Self {
        let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
        Self(VirtualPhantom::with_axes(
            machine,
            &Vec3::zeros(),
            imperfections,
        ))
    }
}

impl Device for OnTable {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.0.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        let state = self.0.exchange(command)?;
        Ok(DeviceState {
            position: state.position + SOMEWHERE,
            ..state
        })
    }

    fn disable(&mut self) -> Disabled {
        self.0.disable()
    }
}

impl Mechanics for OnTable {
    fn advance(&mut self, time: f64, force: &Vec3) -> DeviceState {
        let state = self.0.advance(time, force);
        DeviceState {
            position: state.position + SOMEWHERE,
            ..state
        }
    }
}

fn pressed(mut rig: Rig) -> Result<Vec<RigSample>, Error> {
    assert_eq!(rig.approach(&mut |_| true)?, Ended::Complete);
    let mut samples = Vec::new();
    rig.press(&usual(), &mut |sample| {
        samples.push(*sample);
        true
    })?;
    Ok(samples)
}

fn on_table(imperfections: Imperfections) -> Rig {
    let device = Box::new(OnTable::new(imperfections));
    Rig::on(
        device,
        soft(),
        RigSettings::default(),
        Clock::virtual_time(),
        7,
    )
    .unwrap()
}

/// Tissue that touches the machine is felt at once, displayed tissue two ticks later: at the ramp's 8 mm/s that is
/// 16 µm. On top come a step of the encoder (30 µm) and of the sensor (0.8 mN), and the contact, which each finds to
/// 0.02 mm.
#[test]
fn displayed_tissue_is_recorded_as_touched_tissue() {
    let touched = pressed(rig(soft(), RigSettings::default(), 7)).unwrap();
    let displayed = pressed(on_table(Imperfections::premium())).unwrap();
    assert_eq!(touched.len(), displayed.len());
    let peak = touched
        .iter()
        .map(|sample| sample.force)
        .fold(0.0, f64::max);
    let apart = touched
        .iter()
        .zip(&displayed)
        .map(|(one, other)| (one.force - other.force).abs());
    let apart = apart.fold(0.0, f64::max);
    println!("{apart} N apart of {peak} N");
    // 4 mm carry the peak.
    assert!(
        apart < peak * (0.016 + 0.030 + 0.040) / 4.0 + 2.0 / 1280.0,
        "{apart} of {peak}"
    );
}

/// Up at the device is up for the rig, and nothing else moves.
#[test]
fn a_loss_ends_it_with_its_name() {
    let lost = Imperfections {
        disconnect_time: 3.0,
        ..Imperfections::premium()
    };
    let error = on_table(lost).approach(&mut |_| true).unwrap_err();
    assert_eq!(error, Error::from(Fault::Silent));
}

/// Through a driver and the stand-in of its service, the same machine is driven the same way: forces are written to a
/// millionth of a newton, which a step of its amplifier (4 mN) or encoder may turn into one more or less at times.
#[test]
fn a_driver_drives_the_same_machine() {
    let direct = pressed(on_table(Imperfections::premium())).unwrap();
    let (service, rig) = by_service();
    let found = pressed(rig).unwrap();
    assert_eq!(found.len(), direct.len());
    let apart = |of: fn(&RigSample) -> f64| {
        let both = found.iter().zip(&direct);
        let apart = both.map(|(one, other)| (of(one) - of(other)).abs());
        apart.fold(0.0, f64::max)
    };
    let [force, height] = [apart(|sample| sample.force), apart(|sample| sample.height)];
    println!("{force} N and {height} m apart");
    assert!(height < 2.5 * 30e-6, "{height}");
    // A tissue of 30 N/m over that way, and a step of the sensor.
    assert!(force < 2.5 * 30e-6 * 60.0 + 1.5 / 1280.0, "{force}");
    assert!(service.force(0).norm() < 3.0);
}

#[test]
fn a_fault_of_a_service_ends_it_with_its_name() {
    let (service, mut rig) = by_service();
    let mut ticks = 0;
    let error = rig.approach(&mut |_| {
        ticks += 1;
        if ticks == 1000 {
            service.misbehave(Some(Misbehaviour::DevicesMissing));
        }
        true
    });
    assert_eq!(error.unwrap_err(), Error::from(Fault::Vanished));
    assert_eq!(ticks, 1000);
}

fn by_service() -> (HaplyStandIn, Rig) {
    let device = Box::new(OnTable::new(Imperfections::premium()));
    let service = HaplyStandIn::start(vec![device], HaplyStandInSettings::default()).unwrap();
    let device = HaplyDevice::open(service.address(), 0).unwrap();
    // A machine that is busy elsewhere is no fault here.
    let device = device.with_timeout(std::time::Duration::from_secs(5));
    let clock = Clock::virtual_time();
    let rig = Rig::on(Box::new(device), soft(), RigSettings::default(), clock, 7).unwrap();
    (service, rig)
}

/// A device whose workspace ends where its handle rests, and the force that it gets.
struct AtItsEnd {
    device: OnTable,
    capabilities: Capabilities,
    force: Arc<Mutex<Vec3>>,
}

impl Device for AtItsEnd {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.device.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        *self.force.lock().unwrap() = command.force();
        Device::exchange(&mut self.device, command)
    }

    fn disable(&mut self) -> Disabled {
        self.device.disable()
    }
}

/// The walls of a device stay, in the device's axes: half of their force in the middle of the wall, pushing inward, on a
/// machine whose rest is there.
#[test]
fn a_rig_keeps_the_walls_of_its_device() {
    let device = OnTable::new(Imperfections::none());
    let below = SOMEWHERE - Vec3::new(0.1, 0.005, 0.1);
    let force = Arc::new(Mutex::new(Vec3::zeros()));
    let device = AtItsEnd {
        capabilities: Capabilities {
            workspace: Some([below, below + Vec3::repeat(0.2)]),
            ..device.capabilities().clone()
        },
        device,
        force: force.clone(),
    };
    let clock = Clock::virtual_time();
    let mut rig = Rig::on(Box::new(device), soft(), RigSettings::default(), clock, 7).unwrap();
    let mut highest: f64 = 0.0;
    for _ in 0..700 {
        rig.tick_without_force(&mut |sample| {
            highest = highest.max(sample.height);
            true
        })
        .unwrap();
        let force = *force.lock().unwrap();
        // Along the device's up, and inward.
        assert!(
            force.y >= 0.0 && force.x == 0.0 && force.z == 0.0,
            "{force}"
        );
    }
    assert!(highest > 1e-3, "{highest}");
}
