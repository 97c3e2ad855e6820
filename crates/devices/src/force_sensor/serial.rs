//! Lines of text on a serial line, one for each reading.
//!
//! The fields of a line stand in the order of the protocol's `columns`, between its `separator`; each is a number in
//! decimal, in counts. Empty lines and lines that begin with `#` are passed over, as is the first, which may be half of
//! one. A line ends with a line feed, with or without a carriage return.

use std::path::Path;

use palpate_servo::{ForceSensor, ForceTorque, SensorFault};

use super::SensorLimits;
use crate::OpenError;

/// The meaning of a field of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// An axis, by its place in fx, fy, fz, tx, ty, tz.
    Axis(usize),
    /// A number that grows by one from line to line.
    Sequence,
    /// Something else.
    Skipped,
}

/// The separator of two fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// One character.
    Character(char),
    /// White space, however much.
    Space,
}

/// The format of a line.
#[derive(Debug, Clone, PartialEq)]
pub struct LineFormat {
    /// Bits per second.
    pub baud: u32,
    /// Its fields, in their order.
    pub fields: Vec<Field>,
    /// Their separator.
    pub separator: Separator,
    /// Counts per newton [1/N].
    pub per_newton: f64,
    /// Counts per newton metre [1/(N m)]; none for a sensor of one axis.
    pub per_newton_metre: Option<f64>,
}

/// The content of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    reading: ForceTorque,
    sequence: Option<u32>,
}

impl LineFormat {
    fn read(&self, line: &[u8]) -> Result<Line, SensorFault> {
        let bad = |what| SensorFault::BadReading { what };
        let line = std::str::from_utf8(line).map_err(|_| bad("a line that is no text"))?;
        match self.separator {
            Separator::Character(character) => self.of_fields(line.split(character)),
            Separator::Space => self.of_fields(line.split_ascii_whitespace()),
        }
    }

    fn of_fields<'t>(&self, mut texts: impl Iterator<Item = &'t str>) -> Result<Line, SensorFault> {
        let bad = |what| SensorFault::BadReading { what };
        let (mut axes, mut sequence) = ([0.0; 6], None);
        let torque = self.per_newton_metre.unwrap_or(1.0);
        for field in &self.fields {
            let text = texts
                .next()
                .ok_or(bad("a line with too few fields"))?
                .trim();
            match *field {
                Field::Axis(axis) => {
                    let number: f64 = text.parse().map_err(|_| bad("a field that is no number"))?;
                    let counts = if axis < 3 { self.per_newton } else { torque };
                    axes[axis] = number / counts;
                }
                Field::Sequence => {
                    let number: u64 = text
                        .parse()
                        .map_err(|_| bad("a sequence that is no number"))?;
                    // Its lowest bits determine the number of lost lines.
                    sequence = Some((number & u64::from(u32::MAX)) as u32);
                }
                Field::Skipped => {}
            }
        }
        match texts.next() {
            Some(_) => Err(bad("a line with too many fields")),
            None => Ok(Line {
                reading: ForceTorque::from_components(axes),
                sequence,
            }),
        }
    }
}

#[cfg(not(unix))]
pub(super) fn open(
    path: &Path,
    _: &LineFormat,
    _: SensorLimits,
) -> Result<Box<dyn ForceSensor>, OpenError> {
    Err(OpenError::NoSensor {
        place: path.display().to_string(),
        cause: std::io::ErrorKind::Unsupported.into(),
    })
}

#[cfg(unix)]
pub(super) fn open(
    path: &Path,
    format: &LineFormat,
    limits: SensorLimits,
) -> Result<Box<dyn ForceSensor>, OpenError> {
    Ok(Box::new(SerialLine::open(path, format, limits)?))
}

#[cfg(unix)]
pub use unix::SerialLine;

#[cfg(unix)]
mod unix {
    use std::os::fd::OwnedFd;
    use std::path::Path;

    use palpate_servo::{ForceSensor, ForceSensorSpec, ForceTorque, SensorFault};
    use rustix::fs::{Mode, OFlags};
    use rustix::io::Errno;
    use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

    use super::super::SensorLimits;
    use super::super::freshness::{Freshness, Sequence};
    use super::LineFormat;
    use crate::OpenError;

    /// The longest line [byte].
    const LONGEST: usize = 256;
    /// Largest number of bytes per call: a millisecond of the fastest line has 400.
    const AT_ONCE: usize = 16 * LONGEST;

    /// A sensor on a serial line.
    #[derive(Debug)]
    pub struct SerialLine {
        line: OwnedFd,
        format: LineFormat,
        spec: ForceSensorSpec,
        sequence: Sequence,
        freshness: Freshness,
        last: ForceTorque,
        begun: [u8; LONGEST],
        length: usize,
        /// Whether the current line may be incomplete at its start.
        is_first: bool,
    }

    impl SerialLine {
        /// Opens the line at `path`.
        ///
        /// # Errors
        /// When it is no serial line, or does not support the speed.
        pub fn open(
            path: &Path,
            format: &LineFormat,
            limits: SensorLimits,
        ) -> Result<Self, OpenError> {
            let no_sensor = |cause: Errno| OpenError::NoSensor {
                place: path.display().to_string(),
                cause: cause.into(),
            };
            let line = opened(path, format.baud).map_err(no_sensor)?;
            Ok(Self {
                line,
                format: format.clone(),
                spec: ForceSensorSpec {
                    name: format!("force sensor on {}", path.display()),
                    range: limits.range,
                    has_six_axes: format.per_newton_metre.is_some(),
                },
                sequence: Sequence::default(),
                // The first line may be incomplete, and a sensor needs time to start.
                freshness: Freshness::new(limits.timeout),
                last: ForceTorque::zero(),
                begun: [0; LONGEST],
                length: 0,
                is_first: true,
            })
        }

        fn take(&mut self, bytes: &[u8]) -> Result<(), SensorFault> {
            // An error in one line is reported after all available lines, so that none is read twice.
            let mut taken = Ok(());
            for &byte in bytes {
                match byte {
                    b'\n' => taken = taken.and(self.end_line()),
                    _ if self.length < LONGEST => {
                        self.begun[self.length] = byte;
                        self.length += 1;
                    }
                    _ => {
                        self.length = 0;
                        self.is_first = true;
                        let what = "a line that is longer than 256 bytes";
                        taken = taken.and(Err(SensorFault::BadReading { what }));
                    }
                }
            }
            taken
        }

        fn end_line(&mut self) -> Result<(), SensorFault> {
            let line = self.begun[..self.length].trim_ascii();
            self.length = 0;
            if std::mem::take(&mut self.is_first) || line.is_empty() || line[0] == b'#' {
                return Ok(());
            }
            let line = self.format.read(line)?;
            if let Some(number) = line.sequence
                && !self.sequence.is_new(number)?
            {
                return Ok(());
            }
            self.last = line.reading;
            self.freshness.renew();
            Ok(())
        }
    }

    fn opened(path: &Path, baud: u32) -> Result<OwnedFd, Errno> {
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let line = rustix::fs::open(path, flags, Mode::empty())?;
        let mut settings = tcgetattr(&line)?;
        settings.make_raw();
        settings.set_speed(baud)?;
        tcsetattr(&line, OptionalActions::Flush, &settings)?;
        Ok(line)
    }

    impl ForceSensor for SerialLine {
        fn spec(&self) -> &ForceSensorSpec {
            &self.spec
        }

        fn read(&mut self) -> Result<ForceTorque, SensorFault> {
            let mut bytes = [0; AT_ONCE];
            match rustix::io::read(&self.line, &mut bytes) {
                // No data: some systems return none, also when the line was unplugged.
                Ok(0) | Err(Errno::AGAIN) => {}
                Ok(length) => self.take(&bytes[..length])?,
                Err(_) => return Err(SensorFault::Disconnected),
            }
            self.freshness
                .check()
                .inspect_err(|_| self.sequence.reset())?;
            Ok(self.last)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format() -> LineFormat {
        LineFormat {
            baud: 115_200,
            fields: vec![
                Field::Sequence,
                Field::Axis(2),
                Field::Skipped,
                Field::Axis(3),
            ],
            separator: Separator::Character(';'),
            per_newton: 1000.0,
            per_newton_metre: Some(1e5),
        }
    }

    #[test]
    fn a_line_is_read_as_it_is_described() {
        let line = format().read(b"4294967297; -250;ok; 1e2").unwrap();
        assert_eq!(line.sequence, Some(1));
        assert_eq!(line.reading.components(), [0.0, 0.0, -0.25, 1e-3, 0.0, 0.0]);
        let spaced = LineFormat {
            separator: Separator::Space,
            ..format()
        };
        let line = spaced.read(b"  3   7.5 x   0 ").unwrap();
        assert_eq!(line.reading.force.z, 0.0075);
    }

    #[test]
    fn a_line_that_is_not_as_described_is_a_fault() {
        for (line, what) in [
            (&b"1;2;3"[..], "a line with too few fields"),
            (b"1;2;3;4;5", "a line with too many fields"),
            (b"1;two;3;4", "a field that is no number"),
            (b"one;2;3;4", "a sequence that is no number"),
            (b"1;2;\xFF;4", "a line that is no text"),
        ] {
            assert_eq!(format().read(line), Err(SensorFault::BadReading { what }));
        }
    }
}
