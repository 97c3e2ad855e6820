use std::path::PathBuf;
use std::time::Duration;

use crate::OpenError;
use crate::haply::HaplyAddress;

/// Where to look for services and libraries of devices. A scene cannot say it: scenes come from untrusted sources, and
/// a library is a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Places {
    /// The Haply Inverse Service.
    pub haply: HaplyAddress,
    /// The library of OpenHaptics; none for its usual names.
    pub openhaptics: Option<PathBuf>,
    /// The library of Force Dimension; none for its usual names.
    pub force_dimension: Option<PathBuf>,
    /// Timeout for an answer of a service.
    pub timeout: Duration,
    /// Whether a dead-man's switch is required: a button, but not the first one. Forces are on only while it is
    /// pressed.
    pub dead_man: bool,
}

/// With the delay of the system, a silent device is a fault within 25 ms.
pub(crate) const TIMEOUT: Duration = Duration::from_millis(20);

impl Default for Places {
    /// The usual places, and 20 ms.
    fn default() -> Self {
        Self {
            haply: HaplyAddress::default(),
            openhaptics: None,
            force_dimension: None,
            timeout: TIMEOUT,
            dead_man: false,
        }
    }
}

impl Places {
    /// The usual places, unless the environment variables `PALPATE_HAPLY`, `PALPATE_OPENHAPTICS`,
    /// `PALPATE_FORCE_DIMENSION` and `PALPATE_DEAD_MAN` say otherwise.
    ///
    /// # Errors
    /// When the first is no address, or the last neither 0 nor 1.
    pub fn from_environment() -> Result<Self, OpenError> {
        let path = |name| std::env::var_os(name).map(PathBuf::from);
        let haply = match std::env::var_os("PALPATE_HAPLY") {
            Some(address) => address.to_string_lossy().parse()?,
            None => HaplyAddress::default(),
        };
        Ok(Self {
            haply,
            openhaptics: path("PALPATE_OPENHAPTICS"),
            force_dimension: path("PALPATE_FORCE_DIMENSION"),
            timeout: TIMEOUT,
            dead_man: dead_man()?,
        })
    }
}

fn dead_man() -> Result<bool, OpenError> {
    match std::env::var_os("PALPATE_DEAD_MAN") {
        None => Ok(false),
        Some(value) if value == "0" => Ok(false),
        Some(value) if value == "1" => Ok(true),
        Some(value) => Err(OpenError::NoSwitch {
            found: value.to_string_lossy().into_owned(),
        }),
    }
}
