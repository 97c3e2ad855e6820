//! Force and torque sensors that users own, each behind [`palpate_servo::ForceSensor`].
//!
//! ```text
//!  Rig ─read▶ NetFt ────── UDP, packets of 36 bytes ──▶ ATI Net F/T
//!             SerialLine ─ lines of text ─────────────▶ serial line
//!             NiDaq ────── a thread that reads ───────▶ libnidaqmx
//! ```
//!
//! A driver never waits: it takes the readings that have arrived, limits their age, and converts every error to a named
//! [`SensorFault`](palpate_servo::SensorFault). Only a [`SensorFormat`] says what a reading means, and only
//! [`SensorPlaces`] says where the sensor is.
//!
//! *How we know*: `force_sensors::…` with a server on the loopback, a pseudo-terminal and a stand-in library.
//!
//! *Limits*: written from documents. **Nothing here was tried on hardware.**

mod freshness;
mod net_ft;
mod ni_daq;
mod places;
mod serial;

use palpate_servo::{ForceSensor, ForceTorque};

use crate::OpenError;

pub use net_ft::{NET_FT_PORT, NetFt, PACKET};
pub use ni_daq::NiDaq;
pub use places::{NetFtAddress, SensorPlaces};
#[cfg(unix)]
pub use serial::SerialLine;
pub use serial::{Field, LineFormat, Separator};

/// The meaning of the readings of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorFormat {
    /// Voltages of strain gauges at NI-DAQmx.
    NiDaq(Box<Gauges>),
    /// Counts of an ATI Net F/T.
    NetFt(Counts),
    /// Lines of text.
    Serial(LineFormat),
}

/// Six voltages.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauges {
    /// The channels, as NI-DAQmx names them.
    pub channels: String,
    /// How often they are sampled [Hz].
    pub rate: f64,
    /// The largest voltage in the measuring range [V].
    pub range: f64,
    /// fx, fy, fz [N] and tx, ty, tz [N m] per volt of each channel; row by row.
    pub matrix: [[f64; 6]; 6],
}

/// The scale of counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// [1/N]
    pub per_newton: f64,
    /// [1/(N m)]
    pub per_newton_metre: f64,
}

/// The requirements on a sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorLimits {
    /// The largest force and torque on each of its axes.
    pub range: ForceTorque,
    /// Timeout for a reading [s].
    pub timeout: f64,
}

impl Default for SensorLimits {
    /// Those of an ATI Nano17 with its calibration SI-12-0.12, and 20 ms.
    fn default() -> Self {
        Self {
            range: ForceTorque::from_components([12.0, 12.0, 17.0, 0.12, 0.12, 0.12]),
            timeout: 0.020,
        }
    }
}

/// Opens the sensor that sends readings of `format`.
///
/// # Errors
/// When it is missing, or its address is not stated.
pub fn open_force_sensor(
    format: &SensorFormat,
    limits: SensorLimits,
    places: &SensorPlaces,
) -> Result<Box<dyn ForceSensor>, OpenError> {
    match format {
        SensorFormat::NiDaq(gauges) => {
            let sensor = NiDaq::open(gauges, limits, places.nidaqmx.as_deref())?;
            Ok(Box::new(sensor))
        }
        SensorFormat::NetFt(counts) => {
            let address = places.net_ft.as_ref().ok_or(OpenError::NoSensorPlace {
                variable: SensorPlaces::NET_FT,
                example: "192.168.1.1",
            })?;
            Ok(Box::new(NetFt::open(address, *counts, limits)?))
        }
        SensorFormat::Serial(line) => {
            let path = places.serial.as_ref().ok_or(OpenError::NoSensorPlace {
                variable: SensorPlaces::SERIAL,
                example: "/dev/ttyUSB0",
            })?;
            serial::open(path, line, limits)
        }
    }
}
