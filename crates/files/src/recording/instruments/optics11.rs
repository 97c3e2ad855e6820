//! Text files of the Piuma and the Chiaro of Optics11 Life: lines of name and value, separated by tabs, then a table of
//! time, load, indentation, cantilever and piezo.
//!
//! The instrument's own column of the indentation is zero before the contact that it found; here depth is the piezo's displacement
//! less the cantilever's deflection, so that the contact is found as for any other recording.

use super::{Curve, InstrumentFile};
use crate::quantity::plain_quantity;
use crate::recording::{IndenterShape, Recording, RecordingHeader};
use crate::units::Unit;
use crate::{Domain, Error};

/// How many lines stand above the table at most [-].
const MAX_LINES: usize = 200;
/// Columns of the table, and their SI units.
const COLUMNS: [(&str, &str); 4] = [
    ("Time", "s"),
    ("Load", "n"),
    ("Cantilever", "m"),
    ("Piezo", "m"),
];

/// The recording in `text`; none when it is no file of these instruments.
pub(super) fn read(text: &str, file: &InstrumentFile<'_>) -> Result<Option<Recording>, Error> {
    let is_head = |line: &&str| {
        line.starts_with("Time (") && COLUMNS.iter().all(|(name, _)| line.contains(name))
    };
    let Some(head) = text
        .lines()
        .take(MAX_LINES)
        .find(is_head)
        .filter(|_| text.starts_with("Date\t"))
    else {
        return Ok(None);
    };
    let column = |(name, si): (&str, &str)| {
        let mut names = head.split('\t').map(str::trim).enumerate();
        let found = names.find(|(_, own)| own.starts_with(name));
        let found = found.and_then(|(place, own)| Some((place, unit_of(own)?)));
        let unknown = || file.damaged(format!("the column {name}"), "has no unit that is known");
        found.filter(|(_, unit)| unit.si == si).ok_or_else(unknown)
    };
    let [time, load, cantilever, piezo] = COLUMNS.map(column);
    let columns = [time?, load?, cantilever?, piezo?];
    let above = text.lines().take_while(|line| *line != head);
    let entries: Vec<(&str, &str)> = above.flat_map(pairs).collect();
    let curve = curve(text, head, &columns, file)?;
    let header = header(&entries);
    let remarks = vec![remark(&header, &entries)];
    curve
        .recording(file, "the table", header, remarks)
        .map(Some)
}

/// Names and values, which take turns in a line.
fn pairs(line: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut fields = line.split('\t').map(str::trim);
    std::iter::from_fn(move || Some((fields.next()?, fields.next()?)))
}

/// The unit in brackets at the end of a name.
fn unit_of(name: &str) -> Option<&'static Unit> {
    let (_, unit) = name.trim().strip_suffix(')')?.rsplit_once('(')?;
    Unit::named(unit)
}

fn curve(
    text: &str,
    head: &str,
    columns: &[(usize, &'static Unit); 4],
    file: &InstrumentFile<'_>,
) -> Result<Curve, Error> {
    let mut curve = Curve::default();
    let lines = (1..)
        .zip(text.lines())
        .skip_while(|(_, line)| *line != head)
        .skip(1);
    for (number, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        let fields: Vec<&str> = line.split('\t').collect();
        let values = columns.map(|(place, unit)| {
            let value: f64 = fields.get(place)?.trim().replace(',', ".").parse().ok()?;
            Some(value * unit.multiply / unit.divide)
        });
        let [Some(time), Some(force), Some(deflection), Some(piezo)] = values else {
            return Err(file.damaged(format!("line {number}"), "is cut short or holds no numbers"));
        };
        curve.time.push(time);
        curve.force.push(force);
        curve.deflection.push(deflection);
        curve.height.push(-piezo);
    }
    Ok(curve)
}

/// A number above the table in SI units, by the beginning of its name, which ends with its unit.
fn number(entries: &[(&str, &str)], name: &str) -> Option<f64> {
    let (full, value) = entries.iter().find(|(own, _)| own.starts_with(name))?;
    let unit = unit_of(full)?;
    let value: f64 = value.replace(',', ".").parse().ok()?;
    Some(value * unit.multiply / unit.divide)
}

fn header(entries: &[(&str, &str)]) -> RecordingHeader {
    let coordinate = |name| number(entries, name).filter(|own| Domain::COORDINATE.contains(*own));
    let position = coordinate("X-position").zip(coordinate("Y-position"));
    let device = entries.iter().find(|(name, _)| *name == "Device:");
    RecordingHeader {
        indenter_shape: Some(IndenterShape::Sphere),
        indenter_radius_m: number(entries, "Tip radius")
            .filter(|own| Domain::TIP_RADIUS.contains(*own)),
        spring_constant_n_per_m: number(entries, "k (")
            .filter(|own| Domain::STIFFNESS.contains(*own)),
        position_m: position.map(|(x, y)| [x, y, 0.0]),
        source: device.map(|(_, name)| format!("Optics11 {name}")),
        ..RecordingHeader::default()
    }
}

/// How it was read, and the result of the instrument's own fit.
fn remark(header: &RecordingHeader, entries: &[(&str, &str)]) -> String {
    let stated =
        |key: &str, value: Option<f64>| value.map(|value| plain_quantity(key, value, None));
    let sphere = stated("_m", header.indenter_radius_m);
    let spring = stated("_n_per_m", header.spring_constant_n_per_m);
    let fits = entries.iter().filter(|(name, _)| name.starts_with("E["));
    let fits = fits.filter_map(|(name, value)| {
        let (name, value) = (
            name.split(' ').next()?,
            value.replace(',', ".").parse().ok()?,
        );
        Some(format!("{name} = {}", plain_quantity("_pa", value, None)))
    });
    let fits: Vec<String> = fits.collect();
    let own = match fits.is_empty() {
        true => String::new(),
        false => format!("; the instrument's own fit states {}", fits.join(", ")),
    };
    format!(
        "read as a text file of Optics11: depth is the piezo's displacement less the deflection of the cantilever; a sphere of {} radius, \
         spring constant {}{own}",
        sphere.as_deref().unwrap_or("unknown"),
        spring.as_deref().unwrap_or("unknown")
    )
}
