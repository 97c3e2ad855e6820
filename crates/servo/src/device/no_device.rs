use super::{Capabilities, Command, Device, DeviceState, Disabled};
use crate::{Fault, Vec3};

/// No device: a handle at rest in one position that displays no force.
#[derive(Debug, Clone)]
pub struct NoDevice {
    capabilities: Capabilities,
    position: Vec3,
}

impl NoDevice {
    /// At rest at `position` [m].
    pub fn new(position: Vec3) -> Self {
        let capabilities = Capabilities::without_force("none");
        Self {
            capabilities,
            position,
        }
    }
}

impl Device for NoDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        Ok(DeviceState::at(command.time, self.position))
    }

    fn disable(&mut self) -> Disabled {
        Disabled::NoForce
    }
}
