use crate::{DeviceState, Vec3};

/// A controller: it computes the force at every tick.
pub trait Controller: Send {
    /// The force on the hand [N] at `state`, `dt` [s] after the last one. It must not allocate or wait.
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3;

    /// The part of the last force that does not depend on the model's answers, such as the friction of a shaft [N].
    fn added(&self) -> Vec3 {
        Vec3::zeros()
    }

    /// Age of the answer behind the last force [s]; none for a controller without a model.
    fn age(&self) -> Option<f64> {
        None
    }

    /// How far that age exceeds the time of use [s]: the force then fades, and the loop takes it off. None for a force
    /// that does not age.
    fn overdue(&self) -> Option<f64> {
        None
    }
}

impl<F: FnMut(&DeviceState, f64) -> Vec3 + Send> Controller for F {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        self(state, dt)
    }
}
