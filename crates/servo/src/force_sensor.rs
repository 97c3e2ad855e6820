//! Force sensors between a device and its end effector.
//!
//! A driver converts readings to newtons and newton metres, and every error to a named [`SensorFault`]. The rig knows
//! the sensor's zero and how its axes map to those of the indenter.

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

    /// Both rotated by `map`.
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

/// The properties of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceSensorSpec {
    /// Its name, for recordings.
    pub name: String,
    /// The largest force and torque on each of its own axes.
    pub range: ForceTorque,
    /// Whether it has all six axes; otherwise only its z axis.
    pub has_six_axes: bool,
}

/// A force sensor.
pub trait ForceSensor: Send {
    /// Its properties.
    fn spec(&self) -> &ForceSensorSpec;

    /// The newest reading, in the sensor's own axes and with its own zero. It neither waits nor allocates.
    ///
    /// # Errors
    /// When no reading arrived for too long, or a reading is invalid. A later call may succeed again.
    fn read(&mut self) -> Result<ForceTorque, SensorFault>;
}

/// Names of the six axes, in the order of [`ForceTorque::components`].
pub const AXIS_NAMES: [&str; 6] = ["fx", "fy", "fz", "tx", "ty", "tz"];

impl ForceSensorSpec {
    /// The `reading` if none of its axes is at the end of its range.
    ///
    /// # Errors
    /// When one is, or is not a finite number.
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

/// Why there is no reading. A plain value, so that the loop returns it without allocation.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SensorFault {
    /// No reading arrived.
    #[error(
        "the force sensor gave no reading for {age:.3} s, beyond {limit} s; check its power and its cable, and approach again"
    )]
    Silent {
        /// For how long [s].
        age: f64,
        /// The limit [s].
        limit: f64,
    },
    /// A reading is invalid.
    #[error("the force sensor sent {what}; compare its format with [sensor] of the protocol")]
    BadReading {
        /// What is wrong with it.
        what: &'static str,
    },
    /// An axis is at the end of its range.
    #[error(
        "the force sensor is saturated on {axis}; unload it and press less deep, or check range_n and range_n_m"
    )]
    Saturated {
        /// The axis.
        axis: &'static str,
    },
    /// Readings were lost.
    #[error(
        "{lost} readings of the force sensor were lost; give it a cable of its own, or lower its rate"
    )]
    Lost {
        /// Number of lost readings, out of about a thousand.
        lost: u32,
    },
    /// The sensor reports an error of its own.
    #[error("the force sensor reports its status {code:#010x}; look it up in its manual")]
    Status {
        /// The sensor's error code.
        code: u32,
    },
    /// The sensor's library reports an error.
    #[error(
        "the force sensor's library reports error {code}; look it up in its manual and start again"
    )]
    Library {
        /// The library's error code.
        code: i32,
    },
    /// The connection is lost.
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
