use std::io;

use crate::Kind;

/// Why a device cannot be opened.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// No server listens at the address of the service.
    #[error(
        "no Haply Inverse Service answers at {address} ({cause}); start it, or say with PALPATE_HAPLY where it is"
    )]
    NoService {
        /// The address.
        address: String,
        /// The error of the system.
        cause: io::Error,
    },
    /// Another server listens there.
    #[error(
        "what answers at {address} is no Haply Inverse Service: {what}; say with PALPATE_HAPLY where that is"
    )]
    NotTheService {
        /// The address.
        address: String,
        /// Its behavior.
        what: String,
    },
    /// The service knows of no such device.
    #[error(
        "the Haply Inverse Service at {address} has {there} of its devices, and number {wanted} is asked for; plug one in"
    )]
    NoDevice {
        /// The address of the service.
        address: String,
        /// The number of devices that it has.
        there: usize,
        /// The requested device, counted from one.
        wanted: usize,
    },
    /// An address is invalid.
    #[error(
        "{found:?} is no address; write HOST:PORT, or HOST:PORT,PORT with that of the events, as in 127.0.0.1:10001,10020"
    )]
    NoAddress {
        /// The given text.
        found: String,
    },
    /// A switch is neither on nor off.
    #[error(
        "PALPATE_DEAD_MAN is {found:?}; set it to 1 for forces only while a button is held, or to 0"
    )]
    NoSwitch {
        /// The given text.
        found: String,
    },
    /// A dead-man's switch is required, and the device has no button for it.
    #[error(
        "{device} has no button besides the first that could be held for forces; take a grip with more, or unset PALPATE_DEAD_MAN"
    )]
    NoDeadMan {
        /// The device.
        device: String,
    },
    /// A library is missing.
    #[error("the library of `{kind}` is not there: no {names} can be loaded ({cause}); install its driver and its SDK, or say with {variable} where it is", variable = kind.variable())]
    NoLibrary {
        /// The kind of device.
        kind: Kind,
        /// The file names that were tried.
        names: String,
        /// The error of the system.
        cause: String,
    },
    /// A library is of another version, or another library.
    #[error("{library} is no library of `{kind}`, for it has no function {function}; install the version that docs/devices.md names, or say with {variable} where it is", variable = kind.variable())]
    NoFunction {
        /// The kind of device.
        kind: Kind,
        /// Its file.
        library: String,
        /// The missing function.
        function: &'static str,
    },
    /// A library opens no device.
    #[error(
        "the library of `{kind}` opens no device and reports {what}; plug it in, switch it on and close other programs that drive it"
    )]
    NotOpened {
        /// The kind of device.
        kind: Kind,
        /// The error of the library.
        what: String,
    },
    /// A library has fewer devices than requested.
    #[error(
        "the library of `{kind}` has {there} devices, and number {wanted} is asked for; plug one in"
    )]
    NoSuchDevice {
        /// The kind of device.
        kind: Kind,
        /// The number of devices that it has.
        there: usize,
        /// The requested device, counted from one.
        wanted: usize,
    },
    /// The location of a force sensor is not stated.
    #[error("the place of the force sensor is not set; set {variable}, as in {variable}={example}")]
    NoSensorPlace {
        /// The environment variable that states it.
        variable: &'static str,
        /// Its format.
        example: &'static str,
    },
    /// The address of a force sensor is invalid.
    #[error(
        "{found:?} is no address of a force sensor; write HOST or HOST:PORT in PALPATE_NET_FT, as in 192.168.1.1"
    )]
    NoSensorAddress {
        /// The given text.
        found: String,
    },
    /// A force sensor does not answer.
    #[error(
        "no force sensor answers at {place} ({cause}); connect it and switch it on, or say where it is"
    )]
    NoSensor {
        /// Its address.
        place: String,
        /// The error of the system.
        cause: io::Error,
    },
    /// The library of NI-DAQmx is missing.
    #[error(
        "the library of NI-DAQmx is not there: no {names} can be loaded ({cause}); install NI-DAQmx, or say with PALPATE_NIDAQMX where it is"
    )]
    NoSensorLibrary {
        /// The file names that were tried.
        names: String,
        /// The error of the system.
        cause: String,
    },
    /// The library is not NI-DAQmx.
    #[error(
        "{library} is no library of NI-DAQmx, for it has no function {function}; say with PALPATE_NIDAQMX where that is"
    )]
    NoSensorFunction {
        /// Its file.
        library: String,
        /// The missing function.
        function: &'static str,
    },
    /// The library of NI-DAQmx cannot read.
    #[error(
        "NI-DAQmx does not read the force sensor and reports {what} ({code}); compare `channels`, `rate_hz` and `range_v` with the device"
    )]
    SensorLibrary {
        /// The library's error code.
        code: i32,
        /// The library's error text.
        what: String,
    },
}

impl OpenError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::NoService { .. }
            | Self::NotTheService { .. }
            | Self::NoDevice { .. }
            | Self::NoDeadMan { .. }
            | Self::NoLibrary { .. }
            | Self::NoFunction { .. }
            | Self::NotOpened { .. }
            | Self::NoSuchDevice { .. }
            | Self::NoSensor { .. }
            | Self::NoSensorLibrary { .. }
            | Self::NoSensorFunction { .. }
            | Self::SensorLibrary { .. } => false,
            Self::NoAddress { .. }
            | Self::NoSwitch { .. }
            | Self::NoSensorPlace { .. }
            | Self::NoSensorAddress { .. } => true,
        }
    }
}
