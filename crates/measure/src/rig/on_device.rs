//! The rig on a device that is there: over tissue that is not, whose force the device displays on the tip besides what
//! drives it, or over real tissue with a force sensor.
//!
//! Height is up at the device, its y, from where the handle is at first.
//!
//! *How we know*: `real_device::…` and `real_sensor::…` in the tests.
//!
//! *Limits*: over virtual tissue the force in a recording is that of the tissue at the place of the real handle, with the
//! steps and the noise of a virtual sensor.

use std::sync::Arc;
use std::time::Duration;

use palpate_files::recording::RecordingHeader;
use palpate_servo::{
    Clock, Command, Controller, Device, DeviceSpec, DeviceState, Fault, ForceTorque, Vec3, latest,
};

use super::{Parts, Rig};
use crate::sensing::{MountedSensor, Source};
use crate::{Error, Indenter, Reference, RigSettings, VirtualForceSensor, VirtualSpecimen};

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
        settings.check_direction()?;
        let mut specimen = specimen;
        specimen.indenter_axis = settings.indenter_axis.normalize();
        let (header, breath_held) = (specimen.header.clone(), specimen.breath_held());
        let (feel, felt) = latest::channel(&ForceTorque::zero());
        let (indenter, reference) = Indenter::new(settings.gains, Reference::at_rest());
        let pressed = Pressed {
            indenter,
            specimen,
            feel,
        };
        let rig = Self::new(Parts {
            device: Box::new(Upright::new(device)),
            controller: Box::new(pressed),
            reference,
            sensor: Source::Virtual {
                sensor: VirtualForceSensor::nano17(seed),
                felt,
                tip_distance: settings.tip_distance,
            },
            header,
            breath_held,
            settings,
            clock,
        })?;
        Ok(Self {
            is_real: true,
            ..rig
        })
    }

    /// A rig whose indenter `device` carries over tissue that is there, with a sensor between them. `header` says what
    /// recordings say of specimen and indenter. Nothing may touch the indenter for the first half second, in which the
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
        let rig = Self::new(Parts {
            device: Box::new(Upright::new(device)),
            controller: Box::new(indenter),
            reference,
            sensor: Source::Real(sensor),
            header,
            // Who holds a real breath is told by the window.
            breath_held: Arc::default(),
            settings,
            clock,
        })?;
        Ok(Self {
            is_real: true,
            ..rig
        })
    }
}

/// What drives the indenter, and the tissue that presses against it.
struct Pressed {
    indenter: Indenter,
    specimen: VirtualSpecimen,
    feel: latest::Sender<ForceTorque>,
}

impl Controller for Pressed {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let on_tip = self.specimen.touch(state.time, &state.position, dt);
        self.feel.send(on_tip);
        self.indenter.update(state, dt) + on_tip.force
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
