use palpate_servo::{Command, Device, DeviceState, NoDevice, Vec3, VirtualDevice};

/// A handle that is simulated under a stand-in. It is no [`Device`]: nothing guards its force, and no hand is there.
pub trait Mechanics: Send {
    /// Moves on to `time` [s] under the last force, and takes `force` [N] from then on.
    fn advance(&mut self, time: f64, force: &Vec3) -> DeviceState;
}

impl Mechanics for VirtualDevice {
    fn advance(&mut self, time: f64, force: &Vec3) -> DeviceState {
        Self::advance(self, time, force)
    }
}

impl Mechanics for NoDevice {
    fn advance(&mut self, time: f64, _force: &Vec3) -> DeviceState {
        let state = self.exchange(&Command::without_force(time));
        // It never fails.
        state.unwrap_or(DeviceState::at(time, Vec3::zeros()))
    }
}
