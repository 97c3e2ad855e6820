use crate::{DeviceState, Stage, Vec3};

/// A sample of a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Number of the tick, from zero; missed ones have numbers too.
    pub tick: u64,
    /// The state of the device; the loop adds the velocity if the device measures none.
    pub state: DeviceState,
    /// The force that the device received at this tick and has until the next [N].
    pub applied: Vec3,
    /// The force that the controller commands for this state [N].
    pub commanded: Vec3,
    /// The part of it that does not depend on the model's answers [N].
    pub added: Vec3,
    /// The force after the limits, which is sent with the next tick [N].
    pub output: Vec3,
    /// The additional force that compensates the device's own weight, spring and mass [N].
    pub compensation: Vec3,
    /// The age of the model's answer behind it [s].
    pub age: Option<f64>,
    /// The stage of arming.
    pub stage: Stage,
}
