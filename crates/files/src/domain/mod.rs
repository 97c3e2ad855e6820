//! Domains of numbers: outside its domain a number is refused, and outside its usual range it gives a warning. Each
//! key and each column of a document names one [`Domain`]; those of the physical quantities are in `quantities`.

mod quantities;

use std::ops::Bound::{self, Excluded, Included, Unbounded};

use crate::units::{Match, UNITS, Unit};

/// The numbers that a key or a column may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// The quantity, with its article: `"a modulus"`.
    what: &'static str,
    /// Suffix of the unit of the bounds; empty for a plain number.
    unit: &'static str,
    bounds: [Bound<f64>; 2],
    /// Usual numbers; others are possible, and seldom meant. Zero is usual where it is allowed.
    usual: Option<[f64; 2]>,
    /// A remark on the bounds, in brackets.
    remark: &'static str,
}

impl Domain {
    /// Any finite number.
    pub const FINITE: Self = Self::number("a finite number", [Unbounded, Unbounded]);
    /// A finite number above zero.
    pub const POSITIVE: Self = Self::number("a number", [Excluded(0.0), Unbounded]);
    /// Zero or a finite number above it.
    pub const NOT_NEGATIVE: Self = Self::number("a number", [Included(0.0), Unbounded]);
    /// From zero to one, both included.
    pub const FRACTION: Self = Self::number("a number", [Included(0.0), Included(1.0)]);

    /// Plain numbers within `bounds`.
    pub const fn number(what: &'static str, bounds: [Bound<f64>; 2]) -> Self {
        Self::quantity(what, "", bounds)
    }

    /// A quantity within `bounds` [the unit with this suffix]; `what` it is begins with its article.
    pub const fn quantity(what: &'static str, unit: &'static str, bounds: [Bound<f64>; 2]) -> Self {
        Self {
            what,
            unit,
            bounds,
            usual: None,
            remark: "",
        }
    }

    /// The same, with a warning for numbers outside `least` to `most` [unit of the bounds].
    pub const fn usually(self, least: f64, most: f64) -> Self {
        Self {
            usual: Some([least, most]),
            ..self
        }
    }

    /// The same, with a `remark` on its bounds.
    pub const fn with_remark(self, remark: &'static str) -> Self {
        Self { remark, ..self }
    }

    /// The least and the greatest number [unit of the bounds].
    pub fn bounds(&self) -> [Bound<f64>; 2] {
        self.bounds
    }

    /// Whether `value` may be used: finite and inside.
    pub fn contains(&self, value: f64) -> bool {
        let [least, most] = self.bounds;
        value.is_finite() && std::ops::RangeBounds::contains(&(least, most), &value)
    }

    /// Whether `value` is usual.
    pub(crate) fn is_usual(&self, value: f64) -> bool {
        self.usual
            .is_none_or(|[least, most]| value == 0.0 || (least..=most).contains(&value))
    }

    /// The numbers that may be used, as the end of the sentence "give ...".
    pub fn expected(&self) -> String {
        let end = |bound| self.print(bound);
        let numbers = match self.bounds {
            [Unbounded, Unbounded] => String::new(),
            [Included(least), Included(most)] if least == -most => {
                format!(" of at most {} in size", end(most))
            }
            [Included(least), Included(most)] => format!(" from {} to {}", end(least), end(most)),
            [Included(least), Excluded(most)] => {
                format!(" from {} to below {}", end(least), end(most))
            }
            [Excluded(least), Included(most)] => {
                format!(" above {}, up to {}", end(least), end(most))
            }
            [Excluded(least), Excluded(most)] => {
                format!(" above {} and below {}", end(least), end(most))
            }
            [Included(least), Unbounded] => format!(" of {} or more", end(least)),
            [Excluded(least), Unbounded] => format!(" above {}", end(least)),
            [Unbounded, Included(most)] => format!(" up to {}", end(most)),
            [Unbounded, Excluded(most)] => format!(" below {}", end(most)),
        };
        let remark = match self.remark {
            "" => String::new(),
            remark => format!(" ({remark})"),
        };
        format!("{}{numbers}{remark}", self.what)
    }

    /// The warning about an unusual number: `given` under the name `key`, which `unit` converts to the expected unit.
    /// None for a usual one.
    pub(crate) fn warning(&self, key: &str, given: f64, unit: Match) -> Option<String> {
        let value = unit.convert(given);
        let [least, most] = self.usual?;
        if self.is_usual(value) {
            return None;
        }
        let usual = match least == -most {
            true => format!("at most {} in size", self.print(most)),
            false => format!("from {} to {}", self.print(least), self.print(most)),
        };
        let meant = self.meant(key, given);
        Some(format!("{} is usually {usual}{meant}", self.what))
    }

    /// The question whether another unit was meant; empty when none makes the number usual.
    pub(crate) fn meant(&self, key: &str, given: f64) -> String {
        let in_other_unit = || {
            // An entry of a list has the unit of the list.
            let key = match key.strip_suffix(']').and_then(|key| key.rsplit_once('[')) {
                Some((list, _)) => list,
                None => key,
            };
            let (base, unit) = crate::units::split(key)?;
            let base = base.rsplit('.').next()?;
            let wanted = Unit::named(self.unit)?;
            let others = unit
                .alternatives()
                .filter(|other| **other != *unit && self.usual.is_some())
                .filter(|other| {
                    let value = other.convert(given, wanted);
                    self.contains(value) && value != 0.0 && self.is_usual(value)
                });
            // A factor of a thousand is the most common mistake.
            let from_thousand = |other: &&Unit| {
                let factor = unit.convert(1.0, other).log10().abs();
                ((factor - 3.0).abs() * 1e3).round() as i64
            };
            let other = others.min_by_key(from_thousand)?;
            Some(format!(
                "; did you mean {given} {} (`{base}_{}`)?",
                other.spelling, other.suffix
            ))
        };
        in_other_unit().unwrap_or_default()
    }

    /// A number of the bounds with its unit, in the size of the unit that needs the fewest digits: six of them at most.
    fn print(&self, value: f64) -> String {
        let shortened = |value: f64| format!("{value:.5e}").parse().unwrap_or(value);
        let Some(unit) = Unit::named(self.unit) else {
            return shortened(value).to_string();
        };
        if value == 0.0 {
            return "0".to_owned();
        }
        let is_thousand = |other: &Unit| {
            let power = unit.convert(1.0, other).log10();
            (power / 3.0 - (power / 3.0).round()).abs() < 1e-9
        };
        let sizes = UNITS
            .iter()
            .filter(|other| other.si == unit.si && is_thousand(other));
        let printed = sizes.map(|other| (unit.convert(value, other), other));
        let (number, unit) = printed
            .filter(|(number, _)| number.abs() >= 1.0)
            .min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))
            .unwrap_or((value, unit));
        format!("{} {}", shortened(number), unit.spelling)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::matches;

    const LENGTH: Domain =
        Domain::quantity("a length", "m", [Excluded(0.0), Included(10.0)]).usually(1e-4, 0.5);

    #[test]
    fn bounds_are_printed_with_units() {
        assert_eq!(LENGTH.expected(), "a length above 0, up to 10 m");
        assert_eq!(Domain::POSITIVE.expected(), "a number above 0");
        assert_eq!(Domain::FRACTION.expected(), "a number from 0 to 1");
        assert_eq!(Domain::FINITE.expected(), "a finite number");
        let third = Domain::number("a part", [Included(0.0), Included(1.0 / 3.0)]);
        assert_eq!(third.expected(), "a part from 0 to 0.333333");
        assert!(!LENGTH.contains(0.0) && LENGTH.contains(10.0) && !LENGTH.contains(f64::INFINITY));
    }

    #[test]
    fn a_unit_that_was_meant_is_named() {
        let unit = |given: &str| matches(given, "radius_m").unwrap();
        let warning = |key: &str, given| LENGTH.warning(key, given, unit(key));
        assert_eq!(warning("radius_m", 0.01), None);
        assert_eq!(
            warning("radius_m", 3.0).as_deref(),
            Some("a length is usually from 100 um to 500 mm; did you mean 3 mm (`radius_mm`)?")
        );
        // Metres under the name of millimetres.
        let sentence = warning("radius_mm", 0.01).unwrap();
        assert!(
            sentence.ends_with("did you mean 0.01 m (`radius_m`)?"),
            "{sentence}"
        );
        // No unit makes it a length of an organ.
        assert!(
            !LENGTH
                .warning("radius_m", 1e-12, unit("radius_m"))
                .unwrap()
                .contains("mean")
        );
    }
}
