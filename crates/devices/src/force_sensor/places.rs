use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use super::NET_FT_PORT;
use crate::OpenError;

/// Where to look for force sensors.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SensorPlaces {
    /// The ATI Net F/T; none unless stated.
    pub net_ft: Option<NetFtAddress>,
    /// The library of NI-DAQmx; none for the usual names.
    pub nidaqmx: Option<PathBuf>,
    /// The serial line; none unless stated.
    pub serial: Option<PathBuf>,
}

/// A machine and a port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NetFtAddress {
    /// The machine.
    pub host: String,
    /// The port.
    pub port: u16,
}

impl SensorPlaces {
    /// The variable for the ATI Net F/T.
    pub const NET_FT: &str = "PALPATE_NET_FT";
    /// The variable for the library of NI-DAQmx.
    pub const NIDAQMX: &str = "PALPATE_NIDAQMX";
    /// The variable for the serial line.
    pub const SERIAL: &str = "PALPATE_FORCE_SERIAL";

    /// The places from the environment variables.
    ///
    /// # Errors
    /// When the address is invalid.
    pub fn from_environment() -> Result<Self, OpenError> {
        let path = |name| std::env::var_os(name).map(PathBuf::from);
        let net_ft = std::env::var_os(Self::NET_FT);
        let net_ft = net_ft.map(|text| text.to_string_lossy().parse());
        Ok(Self {
            net_ft: net_ft.transpose()?,
            nidaqmx: path(Self::NIDAQMX),
            serial: path(Self::SERIAL),
        })
    }
}

impl FromStr for NetFtAddress {
    type Err = OpenError;

    fn from_str(text: &str) -> Result<Self, OpenError> {
        let no_address = || OpenError::NoSensorAddress {
            found: text.to_owned(),
        };
        let (host, port) = match text.rsplit_once(':') {
            Some((host, port)) => (host, port.parse().map_err(|_| no_address())?),
            None => (text, NET_FT_PORT),
        };
        let is_name = |letter: char| letter.is_ascii_alphanumeric() || "-.".contains(letter);
        if host.is_empty() || !host.chars().all(is_name) {
            return Err(no_address());
        }
        Ok(Self {
            host: host.to_owned(),
            port,
        })
    }
}

impl fmt::Display for NetFtAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.host, self.port)
    }
}
