use std::fmt;

use palpate_servo::Device;

use crate::force_dimension::{self, ForceDimensionDevice};
use crate::haply::{self, HaplyDevice};
use crate::open_haptics::{self, OpenHapticsDevice};
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
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Haply, Self::OpenHaptics, Self::ForceDimension];

    /// Its name in a scene.
    pub fn word(self) -> &'static str {
        match self {
            Self::Haply => "haply",
            Self::OpenHaptics => "openhaptics",
            Self::ForceDimension => "force_dimension",
        }
    }

    /// The environment variable that says where to look for it.
    pub fn variable(self) -> &'static str {
        match self {
            Self::Haply => "PALPATE_HAPLY",
            Self::OpenHaptics => "PALPATE_OPENHAPTICS",
            Self::ForceDimension => "PALPATE_FORCE_DIMENSION",
        }
    }

    /// The connected devices of this kind.
    ///
    /// # Errors
    /// When their service or library is missing.
    pub fn list(self, places: &Places) -> Result<Vec<Found>, OpenError> {
        match self {
            Self::Haply => haply::list(&places.haply),
            Self::OpenHaptics => open_haptics::list(places.openhaptics.as_deref()),
            Self::ForceDimension => force_dimension::list(places.force_dimension.as_deref()),
        }
    }

    /// Opens device `number` of this kind, counted from zero. Only a servo loop can command it, since its guard makes
    /// every force ([`palpate_servo::Command`]).
    ///
    /// # Errors
    /// When it is not there.
    pub fn open(self, number: usize, places: &Places) -> Result<Box<dyn Device>, OpenError> {
        match self {
            Self::Haply => {
                let device = HaplyDevice::open(&places.haply, number)?;
                let device = device.with_timeout(places.timeout);
                match places.dead_man {
                    true => Ok(Box::new(device.with_dead_man()?)),
                    false => Ok(Box::new(device)),
                }
            }
            Self::OpenHaptics if number > 0 => Err(OpenError::NoSuchDevice {
                kind: self,
                there: 1,
                wanted: number + 1,
            }),
            Self::OpenHaptics => {
                let named = places.openhaptics.as_deref();
                let device = OpenHapticsDevice::open(named)?;
                match places.dead_man {
                    true => Ok(Box::new(device.with_dead_man())),
                    false => Ok(Box::new(device)),
                }
            }
            Self::ForceDimension => {
                let named = places.force_dimension.as_deref();
                let device = ForceDimensionDevice::open(named, number)?;
                match places.dead_man {
                    true => Ok(Box::new(device.with_dead_man())),
                    false => Ok(Box::new(device)),
                }
            }
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
