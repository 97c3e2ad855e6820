use crate::{ReadFault, UnknownUnit};

/// Smallest and largest extents that an organ can have [m].
const PLAUSIBLE_M: std::ops::RangeInclusive<f64> = 0.005..=0.6;

/// The unit that the coordinates of a file are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthUnit {
    /// `m`
    Metre,
    /// `cm`
    Centimetre,
    /// `mm`
    Millimetre,
    /// `um`
    Micrometre,
    /// `in`
    Inch,
}

impl LengthUnit {
    /// Length of one unit [m].
    pub fn in_metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 1e-2,
            Self::Millimetre => 1e-3,
            Self::Micrometre => 1e-6,
            Self::Inch => 0.0254,
        }
    }

    /// As it is written: `m`, `cm`, `mm`, `um`, `in`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Micrometre => "um",
            Self::Inch => "in",
        }
    }
}

impl std::str::FromStr for LengthUnit {
    type Err = UnknownUnit;

    fn from_str(word: &str) -> Result<Self, UnknownUnit> {
        [
            Self::Metre,
            Self::Centimetre,
            Self::Millimetre,
            Self::Micrometre,
            Self::Inch,
        ]
        .into_iter()
        .find(|unit| unit.symbol() == word)
        .ok_or_else(|| UnknownUnit {
            found: word.to_owned(),
        })
    }
}

/// Whether an organ, or a piece of one, can have this largest extent [m]: 5 mm to 0.6 m.
pub fn is_plausible_extent(extent_m: f64) -> bool {
    PLAUSIBLE_M.contains(&extent_m)
}

/// A warning about an organ of this largest extent [m].
pub fn extent_warning(extent_m: f64) -> Option<String> {
    (!is_plausible_extent(extent_m)).then(|| {
        format!(
            "the largest extent is {} m, where an organ has {} to {} m; check mesh_unit",
            rounded(extent_m),
            PLAUSIBLE_M.start(),
            PLAUSIBLE_M.end()
        )
    })
}

/// The unit of a file that does not state it, for a mesh of this largest extent [file unit]: metres
/// when that is plausible. Millimetres are never guessed, since a wrong guess changes every force.
///
/// # Errors
/// When metres are not plausible.
pub fn unit_by_extent(extent: f64) -> Result<LengthUnit, ReadFault> {
    if is_plausible_extent(extent) {
        Ok(LengthUnit::Metre)
    } else {
        Err(ReadFault::unit_needed(extent))
    }
}

/// To four digits: a message is not the place for the noise of single precision.
pub(super) fn rounded(length: f64) -> f64 {
    format!("{length:.3e}").parse().unwrap_or(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_as_they_are_written() {
        for word in ["m", "cm", "mm", "um"] {
            assert_eq!(word.parse::<LengthUnit>().unwrap().symbol(), word);
        }
        let message = "inch".parse::<LengthUnit>().unwrap_err().to_string();
        assert!(message.contains("`inch`") && message.contains("\"mm\""));
    }

    #[test]
    fn metres_are_taken_only_when_plausible() {
        assert_eq!(unit_by_extent(0.12).unwrap(), LengthUnit::Metre);
        let message = unit_by_extent(120.0).unwrap_err().to_string();
        assert!(message.contains("0.12 m in millimetres") && message.contains("mesh_unit"));
        assert!(extent_warning(75.0).unwrap().contains("75 m"));
        assert_eq!(extent_warning(0.1), None);
    }
}
