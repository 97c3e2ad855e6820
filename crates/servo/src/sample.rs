use crate::{DeviceState, Stage, Vec3};

/// What happened at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Number of the tick, from zero; missed ones have numbers too.
    pub tick: u64,
    /// What the device answered; its velocity is the loop's where the device measures none.
    pub state: DeviceState,
    /// The force that the device got at this tick and has until the next [N].
    pub held: Vec3,
    /// The force that the controller wants for this state [N].
    pub commanded: Vec3,
    /// The part of it that the controller adds to what others answer [N].
    pub added: Vec3,
    /// What the limits leave of it, which is sent with the next tick [N].
    pub sent: Vec3,
    /// What is sent besides against the device's own weight, spring and mass [N].
    pub compensation: Vec3,
    /// How old what it is made of is [s].
    pub age: Option<f64>,
    /// How far forces are on.
    pub stage: Stage,
}
