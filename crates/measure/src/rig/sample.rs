use palpate_servo::{ForceTorque, SensorFault, Vec3};

/// What the rig does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// It waits where it is, or goes to where it begins.
    Waiting,
    /// It is moved by hand.
    Jogging,
    /// It looks for tissue.
    Approaching,
    /// It presses a stimulus.
    Pressing,
    /// It leaves the tissue.
    Withdrawing,
    /// It exerts no force, after a fault.
    Limp,
}

/// What is seen at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSample {
    /// On the rig's clock [s].
    pub time: f64,
    /// What it does.
    pub phase: Phase,
    /// Height of the tip along the normal as the encoders say [m].
    pub height: f64,
    /// How deep that is from first contact [m]; none before there was one.
    pub depth: Option<f64>,
    /// What the sensor shows along the normal [N], positive on the tissue.
    pub force: f64,
    /// The tip in the rig's axes as the encoders say [m].
    pub position: Vec3,
    /// The direction out of the tissue along which it approaches, in the rig's axes [-].
    pub normal: Vec3,
    /// What the sensor shows in the indenter's axes, about the sensor's origin; none for a sensor of one axis.
    pub axes: Option<ForceTorque>,
    /// Why force and axes are those of an earlier tick.
    pub sensor_fault: Option<SensorFault>,
    /// How long the breath has been held [s]; none while it is drawn.
    pub breath: Option<f64>,
    /// How long everything has waited for the processor so far [s].
    pub waited: f64,
}

impl RigSample {
    /// The size of all that the sensor shows as a force [N].
    pub fn largest_force(&self) -> f64 {
        let whole = self.axes.map_or(0.0, |axes| axes.force.norm());
        whole.max(self.force.abs())
    }
}

/// How a stimulus ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// With its last sample.
    Whole,
    /// Before, as whoever listened said; the indenter is withdrawn.
    Stopped,
    /// Before, because what was asked for is known well enough; the indenter is withdrawn.
    Enough,
}

/// Whoever listens to samples; false to stop. A rig that withdraws goes on with that.
pub type Listener<'a> = &'a mut dyn FnMut(&RigSample) -> bool;
