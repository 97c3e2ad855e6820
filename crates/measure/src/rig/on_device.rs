//! The rig on a real device: over virtual tissue, whose force the device displays on the tip in addition to the driving
//! force, or over real tissue with a force sensor.
//!
//! Height is up at the device, its y, from where the handle is at first.
//!
//! *How we know*: `real_device::…` and `real_sensor::…` in the tests.
//!
//! *Limits*: over virtual tissue the force in a recording is that of the tissue at the place of the real handle, with the
//! steps and the noise of a virtual sensor.

use std::sync::{Arc, OnceLock};

use palpate_files::recording::RecordingHeader;
use palpate_servo::{Clock, Controller, Device, DeviceState, ForceTorque, Vec3, latest};

use super::{Parts, Rig};
use crate::sensing::{MountedSensor, Source};
use crate::{Error, Indenter, Reference, RigSettings, VirtualSpecimen};

impl Rig {
    /// A rig whose indenter `device` carries, over a virtual specimen.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn on(
        device: Box<dyn Device>,
        specimen: VirtualSpecimen,
        settings: RigSettings,
        clock: Clock,
        seed: u64,
    ) -> Result<Self, Error> {
        settings.check_direction()?;
        let mut specimen = specimen;
        specimen.indenter_axis = settings.indenter_axis.normalize();
        let (header, breath_held) = (specimen.header.clone(), specimen.breath_held());
        let (load_sender, tip_load) = latest::channel(&ForceTorque::zero());
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        let pressed = Pressed {
            indenter,
            specimen,
            load_sender,
        };
        let (controller, rest) = Upright::new(pressed);
        let mut rig = Self::new(Parts {
            device,
            controller: Box::new(controller),
            reference,
            sensor: Source::of_virtual(tip_load, seed, &settings),
            header,
            breath_held,
            settings,
            clock,
        })?;
        (rig.is_real, rig.rest) = (true, rest);
        Ok(rig)
    }

    /// A rig whose indenter `device` carries over real tissue, with a sensor between them. `header` describes specimen
    /// and indenter for recordings. Nothing may touch the indenter for the first half second, in which the
    /// sensor's zero is taken.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn with_sensor(
        device: Box<dyn Device>,
        sensor: MountedSensor,
        header: RecordingHeader,
        settings: RigSettings,
        clock: Clock,
    ) -> Result<Self, Error> {
        settings.check_direction()?;
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        let (controller, rest) = Upright::new(indenter);
        let mut rig = Self::new(Parts {
            device,
            controller: Box::new(controller),
            reference,
            sensor: Source::Real(sensor),
            header,
            // The window asks a person to hold the breath.
            breath_held: Arc::default(),
            settings,
            clock,
        })?;
        (rig.is_real, rig.rest) = (true, rest);
        Ok(rig)
    }
}

/// What drives the indenter, and the tissue that presses against it.
struct Pressed {
    indenter: Indenter,
    specimen: VirtualSpecimen,
    load_sender: latest::Sender<ForceTorque>,
}

impl Controller for Pressed {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let on_tip = self.specimen.touch(state.time, &state.position, dt);
        self.load_sender.send(on_tip);
        self.indenter.update(state, dt) + on_tip.force
    }

    fn age(&self) -> Option<f64> {
        self.indenter.age()
    }

    fn overdue(&self) -> Option<f64> {
        self.indenter.overdue()
    }
}

/// The axes of the rig: x right, y away from the user, z up, zero where the handle was at first. The loop, its guard and
/// its walls keep those of the device.
struct Upright<Inner> {
    inner: Inner,
    /// Where the handle was at first, in the device's axes [m].
    rest: Arc<OnceLock<Vec3>>,
}

impl<Inner: Controller> Upright<Inner> {
    fn new(inner: Inner) -> (Self, Arc<OnceLock<Vec3>>) {
        let rest = Arc::<OnceLock<Vec3>>::default();
        let upright = Self {
            inner,
            rest: rest.clone(),
        };
        (upright, rest)
    }
}

/// A vector of the device in the axes of the rig.
pub(super) fn upright(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.x, -vector.z, vector.y)
}

impl<Inner: Controller> Controller for Upright<Inner> {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let rest = *self.rest.get_or_init(|| state.position);
        let turned = DeviceState {
            position: upright(&(state.position - rest)),
            velocity: state.velocity.map(|velocity| upright(&velocity)),
            displayed: state.displayed.map(|force| upright(&force)),
            orientation: None,
            ..*state
        };
        let [x, y, z] = self.inner.update(&turned, dt).into();
        Vec3::new(x, z, -y)
    }

    fn age(&self) -> Option<f64> {
        self.inner.age()
    }

    fn overdue(&self) -> Option<f64> {
        self.inner.overdue()
    }
}
