use std::time::Duration;

use super::{Command, Device, DeviceSpec, DeviceState};
use crate::{Fault, Vec3};

/// Nobody: a handle that rests in one place and feels nothing.
#[derive(Debug, Clone)]
pub struct NoDevice {
    spec: DeviceSpec,
    position: Vec3,
}

impl NoDevice {
    /// At rest at `position` [m].
    pub fn new(position: Vec3) -> Self {
        let spec = DeviceSpec::without_force("none");
        Self { spec, position }
    }
}

impl Device for NoDevice {
    fn spec(&self) -> &DeviceSpec {
        &self.spec
    }

    fn exchange(&mut self, command: &Command, _patience: Duration) -> Result<DeviceState, Fault> {
        Ok(DeviceState::at(command.time, self.position))
    }

    fn stop(&mut self) {}
}
