use crate::{DeviceState, Vec3};

/// What decides the force at every tick.
pub trait Controller: Send {
    /// The force on the hand [N] at `state`, `dt` [s] after the last one. It must not allocate or wait.
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3;

    /// The part of the last force that is not made of what others answer, such as the friction of a shaft [N].
    fn added(&self) -> Vec3 {
        Vec3::zeros()
    }

    /// How old what the last force was made of is [s]; none for a controller that hears nobody else.
    fn age(&self) -> Option<f64> {
        None
    }

    /// How far that is beyond the time for which it is used [s]: the force fades then, and the loop takes it
    /// off. None for what does not age.
    fn overdue(&self) -> Option<f64> {
        None
    }
}

impl<F: FnMut(&DeviceState, f64) -> Vec3 + Send> Controller for F {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        self(state, dt)
    }
}
