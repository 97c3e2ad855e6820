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
    /// How long an answer of a device may take.
    pub patience: Duration,
}

/// With what the system adds, a silent device is a fault within 25 ms.
pub(crate) const PATIENCE: Duration = Duration::from_millis(20);

impl Default for Places {
    /// The usual ones, and 20 ms.
    fn default() -> Self {
        Self {
            haply: HaplyAddress::default(),
            openhaptics: None,
            force_dimension: None,
            patience: PATIENCE,
        }
    }
}

impl Places {
    /// The usual ones, but for what the variables `PALPATE_HAPLY`, `PALPATE_OPENHAPTICS` and
    /// `PALPATE_FORCE_DIMENSION` of the environment say.
    ///
    /// # Errors
    /// When the first is no address.
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
            patience: PATIENCE,
        })
    }
}
