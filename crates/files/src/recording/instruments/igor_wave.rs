//! Igor binary waves of versions 1, 2, 3 and 5 [WaveMetrics 2014]: numbers in columns, one after another, below headers whose
//! checksum must fit. Versions before 5 have one column.
//!
//! *Limits*: real numbers of 32 or 64 bits; units of up to three letters.

use super::{InstrumentFile, MAX_SAMPLES};
use crate::Error;

/// Dimensions of a wave, and the length of a label [bytes].
const DIMENSIONS: usize = 4;
const LABEL: usize = 32;
/// A unit [bytes].
const UNIT: usize = 4;
/// Columns of a wave at most.
const MAX_COLUMNS: usize = 64;

/// Whether a file is a wave: its version, in either order of bytes.
pub(super) fn is_wave(bytes: &[u8]) -> bool {
    matches!(bytes, [1 | 2 | 3 | 5, 0, ..] | [0, 1 | 2 | 3 | 5, ..])
}

/// Positions of the parts of a wave in its file [bytes].
struct Layout {
    version: i16,
    /// The end of the headers, which the checksum covers.
    headers: usize,
    numbers: usize,
    kind: usize,
    name: usize,
    most_of_name: usize,
    unit: usize,
    row_unit: usize,
    rows: usize,
    step: usize,
}

impl Layout {
    fn of(version: i16) -> Self {
        match version {
            5 => Self {
                version,
                headers: 384,
                numbers: 384,
                kind: 64 + 16,
                name: 64 + 28,
                most_of_name: 32,
                unit: 64 + 148,
                row_unit: 64 + 152,
                rows: 64 + 68,
                step: 64 + 84,
            },
            _ => {
                let wave = file_header(version);
                Self {
                    version,
                    headers: wave + 126,
                    numbers: wave + 110,
                    kind: wave,
                    name: wave + 6,
                    most_of_name: 20,
                    unit: wave + 34,
                    row_unit: wave + 38,
                    rows: wave + 42,
                    step: wave + 48,
                }
            }
        }
    }
}

/// The header of a file before that of its wave, in versions before 5 [bytes].
fn file_header(version: i16) -> usize {
    match version {
        1 => 8,
        2 => 16,
        _ => 20,
    }
}

/// The bytes of a wave.
struct WaveBytes<'b> {
    bytes: &'b [u8],
    is_big_endian: bool,
}

impl<'b> WaveBytes<'b> {
    fn new(bytes: &'b [u8]) -> Self {
        Self {
            bytes,
            is_big_endian: bytes.starts_with(&[0]),
        }
    }

    fn number<const BYTES: usize>(&self, at: usize) -> Option<[u8; BYTES]> {
        let mut own: [u8; BYTES] = *self.bytes.get(at..)?.first_chunk()?;
        if self.is_big_endian {
            own.reverse();
        }
        Some(own)
    }

    fn short(&self, at: usize) -> Option<i16> {
        self.number(at).map(i16::from_le_bytes)
    }

    /// A number of bytes or of rows.
    fn size(&self, at: usize) -> Option<usize> {
        usize::try_from(i32::from_le_bytes(self.number(at)?)).ok()
    }

    fn double(&self, at: usize) -> Option<f64> {
        self.number(at).map(f64::from_le_bytes)
    }

    /// The sum of the headers as short numbers, which is zero.
    fn checksum(&self, headers: usize) -> Option<i16> {
        let all = (0..headers).step_by(2);
        all.map(|at| self.short(at))
            .try_fold(0i16, |sum, own| Some(sum.wrapping_add(own?)))
    }

    /// Texts are in parts of a fixed length, ended by zeros; each byte is a character.
    fn text(&self, at: usize, length: usize) -> Option<String> {
        let own = self.bytes.get(at..at.checked_add(length)?)?;
        let own = own.iter().take_while(|byte| **byte != 0);
        Some(own.map(|byte| *byte as char).collect())
    }

    /// Rows, and columns.
    fn shape(&self, layout: &Layout) -> Option<(usize, usize)> {
        let rows = self.size(layout.rows)?;
        match layout.version {
            5 => Some((rows, self.size(layout.rows + 4)?.max(1))),
            _ => Some((rows, 1)),
        }
    }

    /// Where the note begins, and its length [bytes].
    fn note(&self, layout: &Layout) -> Option<(usize, usize)> {
        // Sizes are at most 2³¹ each, so their sums fit.
        match layout.version {
            5 => Some((64 + self.size(4)? + self.size(8)?, self.size(12)?)),
            1 => Some((file_header(1) + self.size(2)?, 0)),
            version => Some((file_header(version) + self.size(2)?, self.size(6)?)),
        }
    }

    /// The labels of columns, in version 5.
    fn labels(&self, note_end: usize, columns: usize) -> Option<Option<Vec<String>>> {
        let mut at = note_end + self.size(16)?;
        for dimension in 0..DIMENSIONS {
            at += self.size(20 + 4 * dimension)?;
        }
        at += self.size(36)?;
        if self.size(40)? < LABEL * (columns + 1) {
            return Some(None);
        }
        let label = |column| self.text(at + LABEL * (column + 1), LABEL);
        Some(Some((0..columns).map(label).collect::<Option<_>>()?))
    }
}

/// The content of a wave.
pub(super) struct Wave {
    /// The labels of the columns, each with its numbers; a single column has the wave's name.
    pub(super) columns: Vec<(String, Vec<f64>)>,
    /// Lines `name: value`.
    pub(super) note: String,
    /// Of the rows, in their unit.
    pub(super) step: f64,
    /// The unit of the rows, such as `s`.
    pub(super) row_unit: String,
    /// The unit of the numbers.
    pub(super) unit: String,
}

/// The number of columns of the wave in a file; none where it is no wave.
pub(super) fn columns(bytes: &[u8]) -> Option<usize> {
    is_wave(bytes).then_some(())?;
    let wave = WaveBytes::new(bytes);
    let (_, columns) = wave.shape(&Layout::of(wave.short(0)?))?;
    Some(columns)
}

impl Wave {
    pub(super) fn parse(file: &InstrumentFile<'_>) -> Result<Self, Error> {
        let damaged = |cause| file.damaged("the Igor binary wave", cause);
        let wave = WaveBytes::new(file.bytes);
        let short = || damaged("is cut short");
        let layout = Layout::of(wave.short(0).ok_or_else(short)?);
        match wave.checksum(layout.headers) {
            Some(0) => {}
            Some(_) => return Err(damaged("does not have the checksum that its header states")),
            None => return Err(damaged("is cut short in its header")),
        }
        let (rows, columns) = wave
            .shape(&layout)
            .filter(|(rows, columns)| *rows > 0 && *columns <= MAX_COLUMNS)
            .ok_or_else(|| damaged("does not have columns of numbers, as a force curve has"))?;
        if rows.saturating_mul(columns) > MAX_SAMPLES {
            return Err(damaged("has more than 33,554,432 numbers"));
        }
        let step = wave.double(layout.step);
        let step = step.filter(|step| *step > 0.0 && step.is_finite());
        let step = step.ok_or_else(|| damaged("does not state the step between its rows"))?;
        let width = match wave.short(layout.kind) {
            Some(2) => 4,
            Some(4) => 8,
            _ => return Err(damaged("has numbers that are not real, of 32 or 64 bits")),
        };
        let value = |place: usize| {
            let at = layout.numbers + width * place;
            match width {
                4 => wave.number(at).map(f32::from_le_bytes).map(f64::from),
                _ => wave.double(at),
            }
        };
        let size = || damaged("has a size below zero");
        let (note_at, note) = wave.note(&layout).ok_or_else(size)?;
        let labels = match columns {
            1 => vec![
                wave.text(layout.name, layout.most_of_name)
                    .ok_or_else(short)?,
            ],
            _ => wave
                .labels(note_at + note, columns)
                .ok_or_else(size)?
                .ok_or_else(|| damaged("does not name its columns"))?,
        };
        let column = |(place, label): (usize, String)| {
            let values: Option<Vec<f64>> = (rows * place..rows * (place + 1)).map(value).collect();
            Some((label, values?))
        };
        let columns: Option<Vec<_>> = labels.into_iter().enumerate().map(column).collect();
        Ok(Self {
            columns: columns.ok_or_else(short)?,
            note: wave.text(note_at, note).ok_or_else(short)?,
            step,
            row_unit: wave.text(layout.row_unit, UNIT).ok_or_else(short)?,
            unit: wave.text(layout.unit, UNIT).ok_or_else(short)?,
        })
    }

    pub(super) fn column(&self, names: &[&str]) -> Option<(&str, &[f64])> {
        names.iter().find_map(|name| {
            let own = self.columns.iter().find(|(label, _)| label == name)?;
            Some((own.0.as_str(), own.1.as_slice()))
        })
    }

    pub(super) fn noted(&self, name: &str) -> Option<&str> {
        let pairs = self.note.split(['\r', '\n']);
        let mut pairs = pairs.filter_map(|line| line.split_once(':'));
        let own = pairs.find(|(own, _)| *own == name)?;
        Some(own.1.trim())
    }

    pub(super) fn noted_number(&self, name: &str) -> Option<f64> {
        self.noted(name).and_then(super::properties::number)
    }
}
