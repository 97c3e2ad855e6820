//! Force sensors between a device and what it carries.
//!
//! A driver turns readings into newtons and newton metres, and whatever goes wrong into a [`SensorFault`] with a name.
//! Which of the sensor's axes are those of the indenter, and what its zero is, the rig knows.

use crate::Vec3;

/// A force and a torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceTorque {
    /// [N]
    pub force: Vec3,
    /// [N m]
    pub torque: Vec3,
}

impl Default for ForceTorque {
    fn default() -> Self {
        Self::zero()
    }
}

impl ForceTorque {
    /// Neither.
    pub fn zero() -> Self {
        Self {
            force: Vec3::zeros(),
            torque: Vec3::zeros(),
        }
    }

    /// fx, fy, fz [N], tx, ty, tz [N m].
    pub fn components(&self) -> [f64; 6] {
        let ([fx, fy, fz], [tx, ty, tz]) = (self.force.into(), self.torque.into());
        [fx, fy, fz, tx, ty, tz]
    }

    /// Of fx, fy, fz [N], tx, ty, tz [N m].
    pub fn from_components([fx, fy, fz, tx, ty, tz]: [f64; 6]) -> Self {
        Self {
            force: Vec3::new(fx, fy, fz),
            torque: Vec3::new(tx, ty, tz),
        }
    }

    /// Both through `map`, a rotation.
    pub fn map(&self, map: impl Fn(&Vec3) -> Vec3) -> Self {
        Self {
            force: map(&self.force),
            torque: map(&self.torque),
        }
    }
}

impl std::ops::Add for ForceTorque {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            force: self.force + other.force,
            torque: self.torque + other.torque,
        }
    }
}

impl std::ops::Sub for ForceTorque {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            force: self.force - other.force,
            torque: self.torque - other.torque,
        }
    }
}

/// What is known of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceSensorSpec {
    /// Its name, for recordings.
    pub name: String,
    /// The largest force and torque on each of its own axes.
    pub range: ForceTorque,
    /// Whether it has all six axes; else it has its z alone.
    pub has_six_axes: bool,
}

/// A force sensor.
pub trait ForceSensor: Send {
    /// What is known of it.
    fn spec(&self) -> &ForceSensorSpec;

    /// The newest reading, in the sensor's own axes and with its own zero. It neither waits nor allocates.
    ///
    /// # Errors
    /// When nothing came for too long, or what came cannot be used. A later call may succeed again.
    fn read(&mut self) -> Result<ForceTorque, SensorFault>;
}

/// Names of the six axes, in the order of [`ForceTorque::components`].
pub const AXIS_NAMES: [&str; 6] = ["fx", "fy", "fz", "tx", "ty", "tz"];

impl ForceSensorSpec {
    /// The `reading` when none of its axes is at the end of its range.
    ///
    /// # Errors
    /// When one is, or is no number.
    pub fn check(&self, reading: ForceTorque) -> Result<ForceTorque, SensorFault> {
        let both = reading
            .components()
            .into_iter()
            .zip(self.range.components());
        for (axis, (found, range)) in AXIS_NAMES.into_iter().zip(both) {
            if !found.is_finite() {
                let what = "a number that is not finite";
                return Err(SensorFault::BadReading { what });
            }
            if found.abs() >= range {
                return Err(SensorFault::Saturated { axis });
            }
        }
        Ok(reading)
    }
}

/// Why there is no force. A plain value, so that it leaves the loop without allocation.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SensorFault {
    /// Nothing came.
    #[error(
        "the force sensor gave no reading for {age:.3} s, beyond {limit} s; check its power and its cable, and approach again"
    )]
    Silent {
        /// How long nothing came [s].
        age: f64,
        /// How long that may be [s].
        limit: f64,
    },
    /// What came cannot be understood.
    #[error("the force sensor sent {what}; compare its format with [sensor] of the protocol")]
    BadReading {
        /// What was wrong with it.
        what: &'static str,
    },
    /// An axis is at the end of its range.
    #[error(
        "the force sensor is saturated on {axis}; unload it and press less deep, or check range_n and range_n_m"
    )]
    Saturated {
        /// Which axis.
        axis: &'static str,
    },
    /// Readings did not arrive.
    #[error(
        "{lost} readings of the force sensor were lost; give it a cable of its own, or lower its rate"
    )]
    Lost {
        /// How many, within about a thousand.
        lost: u32,
    },
    /// The sensor reports an error of its own.
    #[error("the force sensor reports its status {code:#010x}; look it up in its manual")]
    Status {
        /// Its own number for it.
        code: u32,
    },
    /// The sensor's library reports an error.
    #[error(
        "the force sensor's library reports error {code}; look it up in its manual and start again"
    )]
    Library {
        /// The library's own number for it.
        code: i32,
    },
    /// The connection is gone.
    #[error("the connection to the force sensor is gone; plug it in and start again")]
    Disconnected,
}

impl SensorFault {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Silent { .. }
            | Self::BadReading { .. }
            | Self::Saturated { .. }
            | Self::Lost { .. }
            | Self::Status { .. }
            | Self::Library { .. }
            | Self::Disconnected => false,
        }
    }
}
