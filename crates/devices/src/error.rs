use std::io;

use crate::Kind;

/// Why a device cannot be opened.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Nobody listens where the service should be.
    #[error(
        "no Haply Inverse Service answers at {address} ({cause}); start it, or say with PALPATE_HAPLY where it is"
    )]
    NoService {
        /// Where it was looked for.
        address: String,
        /// What the system said.
        cause: io::Error,
    },
    /// Somebody listens there, but does not speak as the service does.
    #[error(
        "what answers at {address} is no Haply Inverse Service: {what}; say with PALPATE_HAPLY where that is"
    )]
    NotTheService {
        /// Where it was looked for.
        address: String,
        /// What it did.
        what: String,
    },
    /// The service knows of no such device.
    #[error(
        "the Haply Inverse Service at {address} has {there} of its devices, and number {wanted} is asked for; plug one in"
    )]
    NoDevice {
        /// Where it is.
        address: String,
        /// How many devices it has.
        there: usize,
        /// Which one is asked for, from one on.
        wanted: usize,
    },
    /// An address is no address.
    #[error(
        "{found:?} is no address; write HOST:PORT, or HOST:PORT,PORT with that of the events, as in 127.0.0.1:10001,10020"
    )]
    NoAddress {
        /// What was given.
        found: String,
    },
    /// What shall be on or off is neither.
    #[error(
        "PALPATE_DEAD_MAN is {found:?}; set it to 1 for forces only while a button is held, or to 0"
    )]
    NoSwitch {
        /// What was given.
        found: String,
    },
    /// A button shall be held, and there is none for it.
    #[error(
        "{device} has no button besides the first that could be held for forces; take a grip with more, or unset PALPATE_DEAD_MAN"
    )]
    NoDeadMan {
        /// The device.
        device: String,
    },
    /// A library is not there.
    #[error("the library of `{kind}` is not there: no {names} can be loaded ({cause}); install its driver and its SDK, or say with {variable} where it is", variable = kind.variable())]
    NoLibrary {
        /// The kind of device.
        kind: Kind,
        /// What was looked for.
        names: String,
        /// What the system said.
        cause: String,
    },
    /// A library is of another version, or another library.
    #[error("{library} is no library of `{kind}`, for it has no function {function}; install the version that docs/devices.md names, or say with {variable} where it is", variable = kind.variable())]
    NoFunction {
        /// The kind of device.
        kind: Kind,
        /// Its file.
        library: String,
        /// What it has not.
        function: &'static str,
    },
    /// A library opens no device.
    #[error(
        "the library of `{kind}` opens no device and reports {what}; plug it in, switch it on and close other programs that drive it"
    )]
    NotOpened {
        /// The kind of device.
        kind: Kind,
        /// Why.
        what: String,
    },
    /// A library has fewer devices than are asked for.
    #[error(
        "the library of `{kind}` has {there} devices, and number {wanted} is asked for; plug one in"
    )]
    NoSuchDevice {
        /// The kind of device.
        kind: Kind,
        /// How many it has.
        there: usize,
        /// Which one is asked for, from one on.
        wanted: usize,
    },
    /// Nobody said where a force sensor is.
    #[error("the place of the force sensor is not set; set {variable}, as in {variable}={example}")]
    NoSensorPlace {
        /// The variable of the environment that says it.
        variable: &'static str,
        /// What it may be.
        example: &'static str,
    },
    /// The address of a force sensor is no address.
    #[error(
        "{found:?} is no address of a force sensor; write HOST or HOST:PORT in PALPATE_NET_FT, as in 192.168.1.1"
    )]
    NoSensorAddress {
        /// What was given.
        found: String,
    },
    /// A force sensor does not answer.
    #[error(
        "no force sensor answers at {place} ({cause}); connect it and switch it on, or say where it is"
    )]
    NoSensor {
        /// Where it was looked for.
        place: String,
        /// What the system said.
        cause: io::Error,
    },
    /// The library of NI-DAQmx is not there.
    #[error(
        "the library of NI-DAQmx is not there: no {names} can be loaded ({cause}); install NI-DAQmx, or say with PALPATE_NIDAQMX where it is"
    )]
    NoSensorLibrary {
        /// What was looked for.
        names: String,
        /// What the system said.
        cause: String,
    },
    /// The library of NI-DAQmx is another one.
    #[error(
        "{library} is no library of NI-DAQmx, for it has no function {function}; say with PALPATE_NIDAQMX where that is"
    )]
    NoSensorFunction {
        /// Its file.
        library: String,
        /// What it has not.
        function: &'static str,
    },
    /// The library of NI-DAQmx does not read.
    #[error(
        "NI-DAQmx does not read the force sensor and reports {what} ({code}); compare `channels`, `rate_hz` and `range_v` with the device"
    )]
    SensorLibrary {
        /// The library's own number for it.
        code: i32,
        /// What it said.
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
