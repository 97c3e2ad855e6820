use crate::{Domain, Error, Key, Keys};

/// The content of a cavity of a body, such as a gall bladder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CavityContent {
    /// A constant pressure [Pa], which is 0 where the cavity is empty.
    Pressure(f64),
    /// An incompressible fluid, under a pressure [Pa] while nothing else loads the body.
    Fluid(f64),
}

impl CavityContent {
    /// The keys of a cavity.
    pub(super) const KEYS: &'static [Key] = &[
        Key::number(
            "pressure_pa",
            Domain::PRESSURE_OR_SUCTION,
            "The pressure on its wall, which stays constant; of a fluid that keeps its volume, its pressure before anything \
             else loads the body.",
        )
        .optional("2000.0", "none: the cavity is empty, or its fluid under no pressure"),
        Key::boolean(
            "constant_volume",
            "Whether it is full of a fluid that keeps its volume.",
        )
        .default("false"),
    ];

    /// Reads a table `cavity`.
    ///
    /// # Errors
    /// When a value is invalid.
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let pressure = keys.number("pressure_pa")?.unwrap_or(0.0);
        Ok(match keys.boolean("constant_volume")?.unwrap_or(false) {
            false => Self::Pressure(pressure),
            true => Self::Fluid(pressure),
        })
    }

    /// The pressure that loads the body by itself [Pa]; zero where there is none.
    pub fn own_pressure(&self) -> f64 {
        match *self {
            Self::Pressure(pressure) | Self::Fluid(pressure) => pressure,
        }
    }
}
