//! The rig on a device that is there, over tissue that is not: the device displays the tissue's force on the tip
//! besides what drives it.
//!
//! Height is up at the device, its y, from where the handle is at first.
//!
//! *How we know*: `real_device::…` in the tests.
//!
//! *Limits*: no driver reads a force sensor, so nothing real can be measured; the force in a recording is that of the
//! virtual tissue at the place of the real handle, with the steps and the noise of the sensor that is not there.

use std::time::Duration;

use palpate_servo::{
    Clock, Command, Controller, Device, DeviceSpec, DeviceState, Fault, Vec3, latest,
};

use super::Rig;
use crate::{Error, Indenter, Reference, RigSettings, VirtualSpecimen};

impl Rig {
    /// A rig whose indenter `device` carries, over a specimen that is not there.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn on(
        device: Box<dyn Device>,
        specimen: VirtualSpecimen,
        settings: RigSettings,
        (clock, seed): (Clock, u64),
    ) -> Result<Self, Error> {
        let of_specimen = (specimen.header.clone(), specimen.breath_held());
        let (feel, felt) = latest::channel(&0.0);
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        let pressed = Pressed {
            indenter,
            specimen,
            feel,
        };
        let driven = (
            Box::new(Upright::new(device)) as Box<dyn Device>,
            Box::new(pressed) as Box<dyn Controller>,
        );
        let (header, breath_held) = of_specimen;
        let of_specimen = (header, breath_held, felt);
        let mut rig = Self::new(driven, of_specimen, reference, settings, (clock, seed))?;
        rig.is_real = true;
        Ok(rig)
    }
}

/// What drives the indenter, and the tissue that presses against it.
struct Pressed {
    indenter: Indenter,
    specimen: VirtualSpecimen,
    feel: latest::Sender<f64>,
}

impl Controller for Pressed {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let force = self.specimen.force(state.time, state.position.z, dt);
        self.feel.send(force);
        self.indenter.update(state, dt) + Vec3::z() * force
    }

    fn age(&self) -> Option<f64> {
        self.indenter.age()
    }

    fn overdue(&self) -> Option<f64> {
        self.indenter.overdue()
    }
}

/// A device with the axes of the rig: x right, y away from the user, z up, zero where its handle was at first.
struct Upright {
    device: Box<dyn Device>,
    spec: DeviceSpec,
    first: Option<Vec3>,
}

impl Upright {
    fn new(device: Box<dyn Device>) -> Self {
        // Where its walls are is not known before the handle is; the rig's own limits keep it near its zero.
        let spec = DeviceSpec {
            workspace: None,
            ..device.spec().clone()
        };
        Self {
            device,
            spec,
            first: None,
        }
    }
}

impl Device for Upright {
    fn spec(&self) -> &DeviceSpec {
        &self.spec
    }

    fn exchange(&mut self, command: &Command, patience: Duration) -> Result<DeviceState, Fault> {
        let [x, y, z] = command.force.into();
        let force = Vec3::new(x, z, -y);
        let command = Command { force, ..*command };
        let state = self.device.exchange(&command, patience)?;
        let first = *self.first.get_or_insert(state.position);
        let turned = |vector: Vec3| Vec3::new(vector.x, -vector.z, vector.y);
        Ok(DeviceState {
            position: turned(state.position - first),
            velocity: state.velocity.map(turned),
            displayed: state.displayed.map(turned),
            orientation: None,
            ..state
        })
    }

    fn stop(&mut self) {
        self.device.stop();
    }
}
