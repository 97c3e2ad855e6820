use std::fmt;

use palpate_servo::Device;

use crate::haply::{self, HaplyDevice};
use crate::{Found, OpenError, Places};

/// A kind of devices, with one driver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Those of the Haply Inverse Service.
    Haply,
    /// Those of OpenHaptics.
    OpenHaptics,
    /// Those of Force Dimension.
    ForceDimension,
}

impl Kind {
    /// All that there are.
    pub const ALL: [Self; 3] = [Self::Haply, Self::OpenHaptics, Self::ForceDimension];

    /// Its word, as a scene has it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Haply => "haply",
            Self::OpenHaptics => "openhaptics",
            Self::ForceDimension => "force_dimension",
        }
    }

    /// The devices of this kind that are there.
    ///
    /// # Errors
    /// When what they are reached by is not there.
    pub fn list(self, places: &Places) -> Result<Vec<Found>, OpenError> {
        match self {
            Self::Haply => haply::list(&places.haply),
            kind => Err(OpenError::NoDriver { kind }),
        }
    }

    /// Opens device `number` of this kind, from zero on.
    ///
    /// # Errors
    /// When it is not there.
    pub fn open(self, number: usize, places: &Places) -> Result<Box<dyn Device>, OpenError> {
        match self {
            Self::Haply => Ok(Box::new(HaplyDevice::open(&places.haply, number)?)),
            kind => Err(OpenError::NoDriver { kind }),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
