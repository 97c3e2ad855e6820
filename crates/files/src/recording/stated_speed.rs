use std::path::Path;

use super::{ForeignColumns, Origin, Recording, RecordingHeader, Samples};
use super::{foreign_table, foreign_units};
use crate::table::TableText;
use crate::units::Unit;
use crate::{Domain, Error};

/// Lines above a table in which a speed is sought.
const MAX_LINES: usize = 100;
/// Names of a speed, and of one that is not that of the test.
const SPEED: [&str; 4] = ["speed", "velocity", "geschwindigkeit", "crosshead rate"];
const OTHERS: [&str; 6] = ["pre", "post", "return", "approach", "vor", "rück"];

/// A table of distances and forces without times, as testing machines write it, below a line that states the speed:
/// time is distance over speed. None for another table, or where the speed of the test is missing or ambiguous.
pub(super) fn parse(
    text: &str,
    path: &Path,
    columns: &ForeignColumns,
) -> Result<Option<Recording>, Error> {
    let [_, depth, force] = columns.wanted();
    let (table, has_all) = foreign_table::find(text, path, &[depth, force])?;
    let speed = speed(text).filter(|_| has_all);
    let Some(speed) = speed else {
        return Ok(None);
    };
    let keys = table.header.keys(path, RecordingHeader::KEYS);
    let header = RecordingHeader::from_keys(&keys)?;
    let names = [depth.choose(&table)?, force.choose(&table)?];
    let (units, has_unit_row) = foreign_units::displacement_and_force(&table, names, columns)?;
    let (samples, still) = samples(&table, names, units, has_unit_row, speed)?;
    let mut remarks = vec![format!(
        "the time is the way over the stated speed of {} mm/s; the depth was taken from `{}` in {}, the force from `{}` in {}; \
         name the columns if that is wrong",
        1e3 * speed,
        names[0],
        units[0].spelling,
        names[1],
        units[1].spelling
    )];
    if still > 0 {
        remarks.push(format!(
            "{still} rows in which the distance did not change were left out, for no time can be told from them"
        ));
    }
    let recording = Recording::read_as(Origin::Foreign, header, samples, remarks);
    Ok(Some(recording))
}

/// The samples, and how many rows were left out; names and units are those of distance and force.
fn samples(
    table: &TableText<'_>,
    [depth, force]: [&str; 2],
    [length, load]: [&'static Unit; 2],
    has_unit_row: bool,
    speed: f64,
) -> Result<(Samples, usize), Error> {
    let si = |name: &str| Unit::named(name).expect("SI units are in the table");
    let depth = table.foreign_column(depth, length, si("m"))?;
    let force = table.foreign_column(force, load, si("n"))?;
    let mut samples = Samples::default();
    let mut rows = table.rows();
    if has_unit_row {
        rows.next()?;
    }
    let (mut time, mut still) = (0.0, 0);
    while let Some(row) = rows.next()? {
        let own = row.number(&depth, Domain::POSITION)?;
        let load = row.number(&force, Domain::ANY_FORCE)?;
        if let Some(before) = samples.depth_m.last() {
            let next = time + (own - before).abs() / speed;
            if next <= time {
                still += 1;
                continue;
            }
            time = next;
        }
        samples.time_s.push(time);
        samples.depth_m.push(own);
        samples.force_n.push(load);
    }
    match samples.time_s.is_empty() {
        true => Err(Error::NoRows {
            path: table.path.clone(),
        }),
        false => Ok((samples, still)),
    }
}

/// The one speed of the test [m/s] that lines above a table state, such as `Test Speed;1,00;mm/s` or `Speed (mm/min): 10`.
fn speed(text: &str) -> Option<f64> {
    let stated = text.lines().take(MAX_LINES).filter_map(of_line);
    let speeds: Vec<f64> = stated.collect();
    let first = *speeds.first()?;
    speeds.iter().all(|own| *own == first).then_some(first)
}

fn of_line(line: &str) -> Option<f64> {
    let lower = line.to_lowercase();
    let is_of_test = SPEED.iter().any(|word| lower.contains(word))
        && !lower
            .split(|c: char| !c.is_alphabetic())
            .any(|word| OTHERS.iter().any(|other| word.starts_with(other)));
    if !is_of_test {
        return None;
    }
    let parts = line.split([';', '\t', ',', ' ', ':', '=', '(', ')', '[', ']', '"']);
    let unit = parts
        .filter_map(Unit::named)
        .find(|unit| unit.si == "m_per_s")?;
    let fields = lower.split([';', '\t', ' ', ':', '=', '(', ')', '[', ']', '"']);
    let value =
        fields.filter_map(|own| own.trim_matches(',').replace(',', ".").parse::<f64>().ok());
    let speed = value.map(|own| own * unit.multiply / unit.divide).next()?;
    (speed > 0.0 && speed.is_finite()).then_some(speed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_of_machines() {
        let near = |line, truth: f64| {
            let own = of_line(line).unwrap();
            assert!((own / truth - 1.0).abs() < 1e-12, "{line}: {own}");
        };
        near("Test Speed;1,50;mm/s", 1.5e-3);
        near("Speed (mm/min): 10;", 10.0 / 6e4);
        near("Prüfgeschwindigkeit\t10\tmm/min", 10.0 / 6e4);
        near("\"Test Speed\",\"2.00\",\"mm/s\"", 2e-3);
        assert_eq!(of_line("Pre-Test Speed;1,50;mm/s"), None);
        assert_eq!(of_line("Vorgeschwindigkeit;1;mm/s"), None);
        assert_eq!(of_line("Test Speed;fast"), None);
        assert_eq!(speed("Speed 1 mm/s\nSpeed 2 mm/s\n"), None);
    }
}
