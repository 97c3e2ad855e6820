//! Force curves of Asylum Research's microscopes in Igor binary waves (`.ibw`): the note has lines `name: value`, the labels
//! name the columns.
//!
//! Deflection is in metres (`Defl`) or in volts (`DeflV`), the position of the base grows towards the specimen
//! (`ZSnsr`, or without a sensor `Raw`), and the step of the rows is in seconds. A wave of one column is the
//! deflection, and the position is in the other wave of the pair.

use super::igor_pair::position_named;
use super::igor_wave::{Wave, columns};
use super::{Curve, InstrumentFile};
use crate::atomic_write::{MAX_TABLE_BYTES, read_bytes};
use crate::quantity::plain_quantity;
use crate::recording::{Recording, RecordingHeader};
use crate::{Domain, Error};

/// Columns of the base's position, the best first, and of the deflection in metres and in volts.
pub(super) const POSITIONS: [&str; 4] = ["ZSnsr", "ZSensor", "Raw", "Height"];
pub(super) const DEFLECTIONS: [&str; 2] = ["Defl", "Deflection"];
pub(super) const VOLTS: [&str; 2] = ["DeflV", "DeflVolts"];

/// The curve in a file.
pub(super) fn read(file: &InstrumentFile<'_>) -> Result<Recording, Error> {
    let wave = Wave::parse(file)?;
    let wave = match wave.columns.len() {
        1 => paired(file, wave)?,
        _ => wave,
    };
    let position = match file.columns.depth.as_deref() {
        Some(name) => wave.column(&[name]),
        None => wave.column(&POSITIONS),
    };
    let labels: Vec<&str> = wave.columns.iter().map(|own| own.0.as_str()).collect();
    let missing = || {
        file.damaged(
            format!("the wave with the columns {}", labels.join(", ")),
            "lacks the deflection (Defl) or the position of the base (ZSnsr or Raw, or one that --depth names)",
        )
    };
    let (name, position) = position.ok_or_else(missing)?;
    let stated = wave.noted_number("SpringConstant");
    let spring_constant = stated
        .or(file.given.spring_constant_n_per_m)
        .filter(|own| Domain::STIFFNESS.contains(*own))
        .ok_or_else(|| {
            let what = "the spring constant of its cantilever, in newtons per metre";
            file.uncalibrated("spring_constant_n_per_m", what)
        })?;
    let noted = wave.noted_number("InvOLS");
    let sensitivity = noted
        .or(file.given.sensitivity_m_per_v)
        .filter(|own| Domain::SENSITIVITY.contains(*own));
    let deflection: Vec<f64> = match wave.column(&DEFLECTIONS) {
        Some((_, metres)) => metres.to_vec(),
        None => {
            let (_, volts) = wave.column(&VOLTS).ok_or_else(missing)?;
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
        time: (0..count).map(|row| wave.step * row as f64).collect(),
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
        plain_quantity("_s", wave.step, None),
    );
    let header = header(&wave, spring_constant, sensitivity);
    curve.recording(file, "the wave", header, vec![remark])
}

/// A wave of one column, joined with the wave of its position.
fn paired(file: &InstrumentFile<'_>, mut wave: Wave) -> Result<Wave, Error> {
    let (label, _) = &wave.columns[0];
    let part = format!("the wave {label} of one column");
    let damaged = |cause| file.damaged(part.clone(), cause);
    let column = file.columns.depth.as_deref();
    let names = match &column {
        Some(name) => std::slice::from_ref(name),
        None => &POSITIONS[..],
    };
    let (name, position) = position_named(file.path, names).ok_or_else(|| {
        damaged(
            "is no force curve without the position of the base: put that wave beside it under the same name with ZSnsr \
             (or Raw, or what --depth says) in place of Defl, and name the file of the deflection; or join both in Igor \
             (Concatenate), label the columns (SetDimLabel), and save that wave",
        )
    })?;
    let bytes = read_bytes(&position, MAX_TABLE_BYTES)?;
    let other = InstrumentFile {
        bytes: &bytes,
        path: &position,
        ..*file
    };
    if columns(&bytes) != Some(1) {
        return Err(other.damaged("the file", "is no Igor binary wave of one column"));
    }
    let mut position = Wave::parse(&other)?;
    let of_position = |cause| Err(other.damaged("the wave of the position", cause));
    if wave.row_unit != "s" || position.row_unit != "s" {
        return Err(damaged(
            "or the wave of the position has rows that are not in seconds; state their step in Igor (SetScale/P x) and save \
             it again",
        ));
    }
    if position.columns[0].1.len() != wave.columns[0].1.len() || position.step != wave.step {
        return of_position("has other rows than the wave of the deflection");
    }
    if !["m", ""].contains(&position.unit.as_str()) {
        return of_position("is not in metres");
    }
    let stem = file.path.file_stem().unwrap_or_default().to_string_lossy();
    let label = match wave.unit.as_str() {
        "m" => DEFLECTIONS[0],
        "V" => VOLTS[0],
        "" if VOLTS.iter().any(|name| stem.contains(name)) => VOLTS[0],
        "" => DEFLECTIONS[0],
        _ => return Err(damaged("has a deflection that is not in m or V")),
    };
    wave.columns[0].0 = label.to_owned();
    let (_, position) = position.columns.swap_remove(0);
    wave.columns.push((name.to_owned(), position));
    Ok(wave)
}

fn header(wave: &Wave, spring_constant: f64, sensitivity: Option<f64>) -> RecordingHeader {
    let place = |name| {
        let own = wave.noted_number(name);
        own.filter(|own| Domain::COORDINATE.contains(*own))
    };
    let model = wave.noted("MicroscopeModel").unwrap_or_default();
    RecordingHeader {
        position_m: place("XLVDT").zip(place("YLVDT")).map(|(x, y)| [x, y, 0.0]),
        spring_constant_n_per_m: Some(spring_constant),
        sensitivity_m_per_v: sensitivity,
        source: Some(format!("Asylum Research {model}").trim_end().to_owned()),
        ..RecordingHeader::default()
    }
}
