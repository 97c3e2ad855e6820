use palpate_servo::{ForceTorque, SensorFault, Vec3};

/// The phase of the rig.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// It waits, or moves to its start.
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
    ForceOff,
}

/// The state of the rig at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSample {
    /// Time on the rig's clock [s].
    pub time: f64,
    /// Phase of the rig.
    pub phase: Phase,
    /// Height of the tip along the normal by the encoders [m].
    pub height: f64,
    /// Depth of the tip from first contact [m]; none before there was one.
    pub depth: Option<f64>,
    /// Force reading along the normal [N], positive on the tissue.
    pub force: f64,
    /// Position of the tip in the rig's axes by the encoders [m].
    pub position: Vec3,
    /// The direction out of the tissue along which it approaches, in the rig's axes [-].
    pub normal: Vec3,
    /// Reading of all axes in the indenter's frame, about the sensor's origin; none for a sensor of one axis.
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
    /// It ended with its last sample.
    Complete,
    /// The listener stopped it; the indenter is withdrawn.
    Stopped,
    /// It ended early because the parameters are known well enough; the indenter is withdrawn.
    Enough,
}

/// Callback for samples; false stops the motion, except a withdrawal.
pub type Listener<'a> = &'a mut dyn FnMut(&RigSample) -> bool;
