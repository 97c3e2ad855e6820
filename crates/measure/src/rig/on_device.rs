//! The rig on a device that is there, over tissue that is not: the device displays the tissue's force on the tip
//! besides what drives it.
//!
//! Height is up at the device, its y, from where the handle is at first.
//!
//! *How we know*: `real_device::…` in the tests.
//!
//! *Limits*: no driver reads a force sensor, so nothing real can be measured; the force in a recording is that of the
//! virtual tissue at the place of the real handle, with the steps and the noise of the sensor that is not there.

use std::sync::{Arc, OnceLock};

use palpate_servo::{Clock, Controller, Device, DeviceState, Vec3, latest};

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
        let rest = Arc::<OnceLock<Vec3>>::default();
        let upright = Upright {
            pressed,
            rest: rest.clone(),
        };
        let driven = (device, Box::new(upright) as Box<dyn Controller>);
        let (header, breath_held) = of_specimen;
        let of_specimen = (header, breath_held, felt);
        let rig = Self::new(driven, of_specimen, reference, settings, (clock, seed))?;
        Ok(Self {
            is_real: true,
            rest,
            ..rig
        })
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

/// The axes of the rig: x right, y away from the user, z up, zero where the handle was at first. The loop, its guard and
/// its walls keep those of the device.
struct Upright {
    pressed: Pressed,
    /// Where the handle was at first, in the device's axes [m].
    rest: Arc<OnceLock<Vec3>>,
}

impl Controller for Upright {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let rest = *self.rest.get_or_init(|| state.position);
        let turned = |vector: Vec3| Vec3::new(vector.x, -vector.z, vector.y);
        let upright = DeviceState {
            position: turned(state.position - rest),
            velocity: state.velocity.map(turned),
            displayed: state.displayed.map(turned),
            orientation: None,
            ..*state
        };
        let [x, y, z] = self.pressed.update(&upright, dt).into();
        Vec3::new(x, z, -y)
    }

    fn age(&self) -> Option<f64> {
        self.pressed.age()
    }

    fn overdue(&self) -> Option<f64> {
        self.pressed.overdue()
    }
}
