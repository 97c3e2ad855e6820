use crate::{Domain, Error, Key, Keys};

/// What is in a cavity of a body, such as a gall bladder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CavityContent {
    /// A constant pressure [Pa], which is 0 where the cavity is empty.
    Pressure(f64),
    /// A fluid that keeps its volume.
    Fluid,
}

impl CavityContent {
    /// The keys of a cavity.
    pub(super) const KEYS: &'static [Key] = &[
        Key::number(
            "pressure_pa",
            Domain::PRESSURE_OR_SUCTION,
            "The pressure on its wall, which stays constant.",
        )
        .optional("2000.0", "it is empty"),
        Key::truth(
            "constant_volume",
            "Whether it is full of a fluid that keeps its volume; its pressure at rest is zero.",
        )
        .default("false"),
    ];

    /// What a table `cavity` says.
    ///
    /// # Errors
    /// When it has a pressure and keeps its volume.
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let pressure = keys.number("pressure_pa")?;
        match keys.truth("constant_volume")?.unwrap_or(false) {
            false => Ok(Self::Pressure(pressure.unwrap_or(0.0))),
            true => match pressure {
                None => Ok(Self::Fluid),
                Some(_) => Err(keys.given_twice("pressure_pa", "constant_volume")),
            },
        }
    }
}
