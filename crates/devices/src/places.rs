use std::path::PathBuf;
use std::time::Duration;

use crate::OpenError;
use crate::haply::HaplyAddress;

/// Where services and libraries of devices are looked for. A scene does not say it, for scenes come from anywhere,
/// and a library is a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Places {
    /// The Haply Inverse Service.
    pub haply: HaplyAddress,
    /// The library of OpenHaptics; none for its usual names.
    pub openhaptics: Option<PathBuf>,
    /// The library of Force Dimension; none for its usual names.
    pub force_dimension: Option<PathBuf>,
    /// How long an answer of a service may take.
    pub timeout: Duration,
    /// Whether a button has to be held for forces, one but the first: all of the force while it is, none else.
    pub dead_man: bool,
}

/// With what the system adds, a silent device is a fault within 25 ms.
pub(crate) const TIMEOUT: Duration = Duration::from_millis(20);

impl Default for Places {
    /// The usual ones, and 20 ms.
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
    /// The usual ones, but for what the variables `PALPATE_HAPLY`, `PALPATE_OPENHAPTICS`, `PALPATE_FORCE_DIMENSION` and
    /// `PALPATE_DEAD_MAN` of the environment say.
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
