//! Igor binary waves (`.ibw`) with the force curves of Asylum Research's microscopes [WaveMetrics 2014]: numbers in columns,
//! one after another, below a header whose checksum must fit; the note has lines `name: value`, the labels name the columns.
//!
//! Deflection is in metres (`Defl`) or in volts (`DeflV`), the position of the base grows towards the specimen (`ZSnsr`, or
//! without a sensor `Raw`), and the step of the rows is in seconds.
//!
//! *Limits*: version 5, real numbers of 32 or 64 bits. Older versions hold one column; a curve needs two.

use super::properties::number;
use super::{Curve, InstrumentFile, MOST_SAMPLES};
use crate::quantity::plain_quantity;
use crate::recording::{Recording, RecordingHeader};
use crate::{Domain, Error};

/// The two headers together, and the first alone [bytes].
const HEADERS: usize = 384;
const FIRST_HEADER: usize = 64;
/// Dimensions of a wave, and the length of a label [bytes].
const DIMENSIONS: usize = 4;
const LABEL: usize = 32;

/// Columns of a wave at most.
const MOST_COLUMNS: usize = 64;

/// Columns of the base's position, the best first, and of the deflection in metres and in volts.
const POSITIONS: [&str; 4] = ["ZSnsr", "ZSensor", "Raw", "Height"];
const DEFLECTIONS: [&str; 2] = ["Defl", "Deflection"];
const VOLTS: [&str; 2] = ["DeflV", "DeflVolts"];

/// Whether a file is a wave: its version, in either order of bytes.
pub(super) fn is_wave(bytes: &[u8]) -> bool {
    matches!(bytes, [1 | 2 | 3 | 5, 0, ..] | [0, 1 | 2 | 3 | 5, ..])
}

/// The bytes of a wave.
struct Wave<'b> {
    bytes: &'b [u8],
    is_big_endian: bool,
}

impl Wave<'_> {
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
    fn checksum(&self) -> Option<i16> {
        let all = (0..HEADERS).step_by(2);
        all.map(|at| self.short(at))
            .try_fold(0i16, |sum, own| Some(sum.wrapping_add(own?)))
    }

    /// Texts of a dimension are in parts of a fixed length, ended by zeros; each byte is a character.
    fn text(&self, at: usize, length: usize) -> Option<String> {
        let own = self.bytes.get(at..at.checked_add(length)?)?;
        let own = own.iter().take_while(|byte| **byte != 0);
        Some(own.map(|byte| *byte as char).collect())
    }
}

/// What a wave contains.
struct Contents {
    /// The labels of the columns, each with its numbers.
    columns: Vec<(String, Vec<f64>)>,
    /// Lines `name: value`.
    note: String,
    /// [s]
    step: f64,
}

impl Contents {
    fn column(&self, names: &[&str]) -> Option<(&str, &[f64])> {
        names.iter().find_map(|name| {
            let own = self.columns.iter().find(|(label, _)| label == name)?;
            Some((own.0.as_str(), own.1.as_slice()))
        })
    }

    fn noted(&self, name: &str) -> Option<&str> {
        let pairs = self.note.split(['\r', '\n']);
        let mut pairs = pairs.filter_map(|line| line.split_once(':'));
        let own = pairs.find(|(own, _)| *own == name)?;
        Some(own.1.trim())
    }

    fn noted_number(&self, name: &str) -> Option<f64> {
        self.noted(name).and_then(number)
    }
}

/// The curve in a file.
pub(super) fn read(file: &InstrumentFile<'_>) -> Result<Recording, Error> {
    let contents = contents(file)?;
    let asked = file.columns.depth.as_deref();
    let position = match asked {
        Some(name) => contents.column(&[name]),
        None => contents.column(&POSITIONS),
    };
    let labels: Vec<&str> = contents.columns.iter().map(|own| own.0.as_str()).collect();
    let missing = || {
        file.damaged(
            format!("the wave with the columns {}", labels.join(", ")),
            "lacks the deflection (Defl) or the position of the base (ZSnsr or Raw, or one that --depth names)",
        )
    };
    let (name, position) = position.ok_or_else(missing)?;
    let stated = contents.noted_number("SpringConstant");
    let spring_constant = stated
        .or(file.said.spring_constant_n_per_m)
        .filter(|own| Domain::STIFFNESS.contains(*own))
        .ok_or_else(|| {
            let what = "the spring constant of its cantilever, in newtons per metre";
            file.uncalibrated("spring_constant_n_per_m", what)
        })?;
    let noted = contents.noted_number("InvOLS");
    let sensitivity = noted
        .or(file.said.sensitivity_m_per_v)
        .filter(|own| Domain::SENSITIVITY.contains(*own));
    let deflection: Vec<f64> = match contents.column(&DEFLECTIONS) {
        Some((_, metres)) => metres.to_vec(),
        None => {
            let (_, volts) = contents.column(&VOLTS).ok_or_else(missing)?;
            let sensitivity = sensitivity.ok_or_else(|| {
                let what = "the sensitivity of its optical lever, in metres per volt";
                file.uncalibrated("sensitivity_m_per_v", what)
            })?;
            volts.iter().map(|own| own * sensitivity).collect()
        }
    };
    // Rows that a trigger left empty are at the end.
    let both = position.iter().zip(&deflection);
    let is_empty = |(z, d): (&f64, &f64)| z.is_nan() || d.is_nan();
    let count = position.len() - both.rev().take_while(|own| is_empty(*own)).count();
    let curve = Curve {
        time: (0..count).map(|row| contents.step * row as f64).collect(),
        height: position[..count].iter().map(|z| -z).collect(),
        force: deflection[..count]
            .iter()
            .map(|d| spring_constant * d)
            .collect(),
        deflection: deflection[..count].to_vec(),
    };
    let remark = format!(
        "read as a force curve of Asylum Research in an Igor binary wave: position from `{name}`, less the deflection of the \
         cantilever; spring constant {}; a sample every {}",
        plain_quantity("_n_per_m", spring_constant, None),
        plain_quantity("_s", contents.step, None),
    );
    let header = header(&contents, spring_constant, sensitivity);
    curve.recording(file, "the wave", header, vec![remark])
}

fn header(contents: &Contents, spring_constant: f64, sensitivity: Option<f64>) -> RecordingHeader {
    let place = |name| {
        let own = contents.noted_number(name);
        own.filter(|own| Domain::COORDINATE.contains(*own))
    };
    let model = contents.noted("MicroscopeModel").unwrap_or_default();
    RecordingHeader {
        position_m: place("XLVDT").zip(place("YLVDT")).map(|(x, y)| [x, y, 0.0]),
        spring_constant_n_per_m: Some(spring_constant),
        sensitivity_m_per_v: sensitivity,
        source: Some(format!("Asylum Research {model}").trim_end().to_owned()),
        ..RecordingHeader::default()
    }
}

fn contents(file: &InstrumentFile<'_>) -> Result<Contents, Error> {
    let damaged = |cause| file.damaged("the Igor binary wave", cause);
    let wave = Wave {
        bytes: file.bytes,
        is_big_endian: file.bytes.starts_with(&[0]),
    };
    if wave.short(0) != Some(5) {
        return Err(damaged(
            "is of a version before 5, with one column, and a force curve has its deflection and its position in one wave",
        ));
    }
    match wave.checksum() {
        Some(0) => {}
        Some(_) => return Err(damaged("does not have the checksum that its header states")),
        None => return Err(damaged("is cut short in its header")),
    }
    let short = || damaged("is cut short");
    let (rows, columns) = wave
        .size(FIRST_HEADER + 68)
        .zip(wave.size(FIRST_HEADER + 72))
        .filter(|(rows, columns)| *rows > 0 && (2..=MOST_COLUMNS).contains(columns))
        .ok_or_else(|| damaged("does not have columns of numbers, as a force curve has"))?;
    if rows.saturating_mul(columns) > MOST_SAMPLES {
        return Err(damaged("has more than 33,554,432 numbers"));
    }
    let step = wave.double(FIRST_HEADER + 84);
    let step = step.filter(|step| *step > 0.0 && step.is_finite());
    let step = step.ok_or_else(|| damaged("does not state the time between its rows"))?;
    let width = match wave.short(FIRST_HEADER + 16) {
        Some(2) => 4,
        Some(4) => 8,
        _ => return Err(damaged("has numbers that are not real, of 32 or 64 bits")),
    };
    let value = |place: usize| {
        let at = HEADERS + width * place;
        match width {
            4 => wave.number(at).map(f32::from_le_bytes).map(f64::from),
            _ => wave.double(at),
        }
    };
    let size = |at: usize| {
        wave.size(at)
            .ok_or_else(|| damaged("has a size below zero"))
    };
    let (data, formula, note) = (size(4)?, size(8)?, size(12)?);
    // Sizes are at most 2³¹ each, so their sums fit.
    let note_at = FIRST_HEADER + data + formula;
    let mut labels_at = note_at + note + size(16)?;
    for dimension in 0..DIMENSIONS {
        labels_at += size(20 + 4 * dimension)?;
    }
    labels_at += size(36)?;
    if size(40)? < LABEL * (columns + 1) {
        return Err(damaged("does not name its columns"));
    }
    let column = |place: usize| {
        let label = wave.text(labels_at + LABEL * (place + 1), LABEL)?;
        let values: Option<Vec<f64>> = (rows * place..rows * (place + 1)).map(value).collect();
        Some((label, values?))
    };
    let columns: Option<Vec<_>> = (0..columns).map(column).collect();
    Ok(Contents {
        columns: columns.ok_or_else(short)?,
        note: wave.text(note_at, note).ok_or_else(short)?,
        step,
    })
}
