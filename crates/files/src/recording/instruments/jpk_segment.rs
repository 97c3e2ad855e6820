//! One segment of a curve in a JPK file: its channels, decoded and converted.
//!
//! A channel holds whole numbers n, which its encoder makes into the values of its base, mostly volts, v = a + b n; or
//! floating-point numbers, which are these values. Each conversion makes the values of the one before it into its own,
//! linearly: volts to metres by the sensitivity of the optical lever, metres to newtons by the spring constant. Keys that several segments share are elsewhere, by a number: `channel.height.lcd-info.*=0`.

use super::InstrumentFile;
use super::properties::{Properties, number};
use super::zip::Archive;
use crate::Error;

/// Conversions, each on top of another, at most.
const MAX_CONVERSIONS: usize = 8;

/// A segment, such as an approach or a pause.
pub(super) struct Segment<'f> {
    pub(super) file: &'f InstrumentFile<'f>,
    pub(super) archive: &'f Archive<'f>,
    pub(super) shared: &'f Properties,
    pub(super) own: Properties,
    /// Its folder in the archive.
    pub(super) folder: String,
}

/// a + b x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Linear {
    pub(super) offset: f64,
    pub(super) multiplier: f64,
}

impl Linear {
    pub(super) const SAME: Self = Self {
        offset: 0.0,
        multiplier: 1.0,
    };

    /// The inverse conversion; none where this one makes all values one.
    pub(super) fn inverse(self) -> Option<Self> {
        let own = Self {
            offset: -self.offset / self.multiplier,
            multiplier: self.multiplier.recip(),
        };
        (own.offset.is_finite() && own.multiplier.is_finite()).then_some(own)
    }

    pub(super) fn of(self, values: &[f64]) -> Vec<f64> {
        let each = values.iter();
        each.map(|value| self.offset + self.multiplier * value)
            .collect()
    }

    /// This after `first`.
    fn after(self, first: Self) -> Self {
        Self {
            offset: self.offset + self.multiplier * first.offset,
            multiplier: self.multiplier * first.multiplier,
        }
    }
}

impl Segment<'_> {
    pub(super) fn has_channel(&self, name: &str) -> bool {
        self.own
            .get(&format!("channel.{name}.data.file.name"))
            .is_some()
    }

    /// Its duration [s].
    pub(super) fn duration(&self) -> Option<f64> {
        self.header("duration")
            .and_then(number)
            .filter(|duration| *duration > 0.0)
    }

    /// The motion of the cantilever, such as `extend`, `pause` or `retract`.
    pub(super) fn style(&self) -> &str {
        self.header("settings.style").unwrap_or("segment")
    }

    /// Where on the specimen, x and y [m].
    pub(super) fn position(&self) -> Option<[f64; 2]> {
        let maps = "force-segment-header.environment.xy-scanner-position-map.xy-scanner.";
        let shared = "environment.xy-scanner-position-map.xy-scanners.active-xy-scanner.name";
        let scanner = format!("{maps}{}.", self.header(shared)?);
        let of = |axis| {
            let ends = [format!("start-position.{axis}"), format!("position.{axis}")];
            ends.iter()
                .find_map(|end| number(self.own.between(&scanner, end)?))
        };
        Some([of("x")?, of("y")?])
    }

    /// A value of the header, its own or shared.
    fn header(&self, key: &str) -> Option<&str> {
        let own = self.own.get(&format!("force-segment-header.{key}"));
        own.or_else(|| {
            let index = self
                .own
                .get("force-segment-header.force-segment-header-info.*")?;
            self.shared
                .get(&format!("force-segment-header-info.{index}.{key}"))
        })
    }

    /// A value of a channel, its own or shared.
    fn of_channel(&self, name: &str, key: &str) -> Option<&str> {
        let own = |between: &str| self.own.get(&format!("channel.{name}{between}.{key}"));
        own("").or_else(|| own(".data")).or_else(|| {
            let index = self.own.get(&format!("channel.{name}.lcd-info.*"))?;
            self.shared.get(&format!("lcd-info.{index}.{key}"))
        })
    }

    fn scaling(&self, name: &str, of: &str) -> Option<Linear> {
        let end = |key| number(self.of_channel(name, &format!("{of}.scaling.{key}"))?);
        Some(Linear {
            offset: end("offset")?,
            multiplier: end("multiplier")?,
        })
    }

    /// The conversion from values of the base to those of a `conversion`, such as `distance`; none where it is not
    /// defined.
    pub(super) fn conversion(&self, name: &str, conversion: &str) -> Option<Linear> {
        let base = self.base(name)?;
        let mut all = Linear::SAME;
        let mut next = conversion;
        for _ in 0..MAX_CONVERSIONS {
            if next == base {
                return Some(all);
            }
            let (before, last) = self.last_step(name, next)?;
            all = all.after(last);
            next = before;
        }
        None
    }

    /// The unit of a channel's values before any conversion, such as `volts`.
    pub(super) fn base(&self, name: &str) -> Option<&str> {
        self.of_channel(name, "conversion-set.conversions.base")
    }

    /// The last step of a `conversion`: its source, and the function.
    pub(super) fn last_step(&self, name: &str, conversion: &str) -> Option<(&str, Linear)> {
        let own = format!("conversion-set.conversion.{conversion}");
        let before = self.of_channel(name, &format!("{own}.base-calibration-slot"))?;
        Some((before, self.scaling(name, &own)?))
    }

    /// The conversion of a channel that its file prefers.
    pub(super) fn preferred(&self, name: &str) -> Option<&str> {
        self.of_channel(name, "conversion-set.conversions.default")
            .or_else(|| self.base(name))
    }

    /// The unit of the values of a conversion, or of the base.
    pub(super) fn unit(&self, name: &str, conversion: &str) -> Option<&str> {
        let key = match self.base(name) == Some(conversion) {
            true => "unit".to_owned(),
            false => format!("conversion-set.conversion.{conversion}.scaling.unit"),
        };
        self.of_channel(name, &format!("{key}.unit"))
            .or_else(|| self.of_channel(name, &key))
    }

    /// The values of a channel as its base has them, mostly in volts.
    pub(super) fn values(&self, name: &str) -> Result<Vec<f64>, Error> {
        let part = |end: &str| format!("{}{end}", self.folder);
        let missing = |cause| {
            self.file
                .damaged(format!("the channel {name} of {}", part("")), cause)
        };
        let key = format!("channel.{name}.data.file.name");
        let file = self.own.get(&key).ok_or_else(|| missing("is not there"))?;
        let kind = self
            .of_channel(name, "encoder.type")
            .or_else(|| self.of_channel(name, "type"))
            .ok_or_else(|| missing("does not state its type"))?;
        let file = part(file);
        let bytes = self.archive.read(&file);
        let bytes = bytes.map_err(|cause| self.file.damaged(&*file, cause))?;
        let bytes = bytes.ok_or_else(|| self.file.damaged(file, "is not there"))?;
        let numbers = match kind {
            "signedshort" => whole(&bytes, |own| f64::from(i16::from_be_bytes(own))),
            "unsignedshort" => whole(&bytes, |own| f64::from(u16::from_be_bytes(own))),
            "signedinteger" => whole(&bytes, |own| f64::from(i32::from_be_bytes(own))),
            "signedlong" => whole(&bytes, |own| i64::from_be_bytes(own) as f64),
            "unsignedinteger" => whole(&bytes, |own| f64::from(u32::from_be_bytes(own))),
            "float-data" | "float" => whole(&bytes, |own| f64::from(f32::from_be_bytes(own))),
            "double-data" | "double" => whole(&bytes, f64::from_be_bytes),
            _ => {
                return Err(missing(
                    "is encoded in a way that is not read; export the curve as text from JPK's program, or name another height \
                     by --depth",
                ));
            }
        };
        match self.scaling(name, "encoder") {
            Some(encoder) => Ok(encoder.of(&numbers)),
            None if kind.starts_with(['f', 'd']) => Ok(numbers),
            None => Err(missing("does not state its encoder")),
        }
    }
}

/// Numbers of so many bytes each.
fn whole<const BYTES: usize>(bytes: &[u8], of: impl Fn([u8; BYTES]) -> f64) -> Vec<f64> {
    let (each, _) = bytes.as_chunks();
    each.iter().map(|own| of(*own)).collect()
}
