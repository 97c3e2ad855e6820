use std::ops::Bound::{Excluded, Included};
use std::path::Path;

use super::foreign_names::Wanted;
use super::{ForeignColumns, Origin, Recording, RecordingHeader, Samples, StimulusKind};
use super::{foreign_table, foreign_units};
use crate::table::TableText;
use crate::units::Unit;
use crate::{Domain, Error};

const STRETCH: &[&str] = &["stretch", "lambda"];
const STRESS: &[&str] = &["stress"];

/// A table without times of a piece that is deformed: of stretches and nominal stresses, as a recording of a cube of one
/// metre that is pulled in a step a second, or of displacements and forces of a piece between clamps; none when `text` holds
/// no such table.
pub(super) fn parse(
    text: &str,
    path: &Path,
    columns: &ForeignColumns,
) -> Result<Option<Recording>, Error> {
    let wanted = [
        Wanted::new("stretch", None, STRETCH),
        Wanted::new("stress", None, STRESS),
    ];
    let (table, has_all) = foreign_table::find(text, path, &wanted)?;
    if !has_all {
        return clamped(text, path, columns);
    }
    let keys = table.header.keys(path, RecordingHeader::KEYS);
    let mut header = RecordingHeader::from_keys(&keys)?;
    match header.stimulus {
        Some(StimulusKind::PlanarTension | StimulusKind::UniaxialTension) => {}
        Some(StimulusKind::SimpleShear) => {
            let expected =
                "no `simple_shear` of a table of stretches; give displacements and forces";
            return Err(keys.bad("stimulus", expected));
        }
        _ => header.stimulus = Some(StimulusKind::Uniaxial),
    }
    header.area_m2 = Some(1.0);
    header.height_m = Some(1.0);
    let [stretch, stress] = [wanted[0].choose(&table)?, wanted[1].choose(&table)?];
    let unit = foreign_units::stress(&table, stress, columns)?;
    let remark = format!(
        "`{stretch}` and `{stress}` in {} were read as the stretching of a cube of one metre, a row a second",
        unit.spelling
    );
    let pulls = Pulls {
        length: (stretch, named("m"), HEIGHT),
        load: (stress, unit, named("Pa")),
        depth: |height| 1.0 - height,
    };
    let samples = samples(&table, &pulls)?;
    let recording = Recording::read_as(Origin::Project, header, samples, vec![remark]);
    Ok(Some(recording))
}

/// A height over that at rest [-].
const HEIGHT: Domain = Domain::number("a stretch", [Excluded(0.0), Included(1e3)]);

/// A displacement of a clamp [m].
const DISPLACEMENT: Domain =
    Domain::quantity("a displacement", "m", [Included(-10.0), Included(10.0)]);

/// Displacements and forces of a piece between clamps; none of another table.
fn clamped(text: &str, path: &Path, columns: &ForeignColumns) -> Result<Option<Recording>, Error> {
    let [_, depth, force] = columns.wanted();
    let (table, has_all) = foreign_table::find(text, path, &[depth, force])?;
    if !has_all {
        return Ok(None);
    }
    let keys = table.header.keys(path, RecordingHeader::KEYS);
    let header = RecordingHeader::from_keys(&keys)?;
    let deformed = match header.stimulus {
        Some(StimulusKind::PlanarTension) => "pull of a sheet",
        Some(StimulusKind::UniaxialTension) => "pull of a strip",
        Some(StimulusKind::SimpleShear) => "shear of a piece",
        _ => return Ok(None),
    };
    let [depth, force] = [depth.choose(&table)?, force.choose(&table)?];
    let ([length, load], _) = foreign_units::sheet(&table, [depth, force], columns)?;
    let remark = format!(
        "`{depth}` in {} and `{force}` in {} were read as the {deformed}, a row a second",
        length.spelling, load.spelling
    );
    let pulls = Pulls {
        length: (depth, length, DISPLACEMENT),
        load: (force, load, named("N")),
        depth: |way| -way,
    };
    let samples = samples(&table, &pulls)?;
    let recording = Recording::read_as(Origin::Project, header, samples, vec![remark]);
    Ok(Some(recording))
}

fn named(name: &str) -> &'static Unit {
    Unit::named(name).expect("SI units are in the table")
}

/// The columns of a pulled piece.
struct Pulls<'c> {
    /// Name, unit and domain in SI units.
    length: (&'c str, &'static Unit, Domain),
    /// Name, unit and the SI unit of it.
    load: (&'c str, &'static Unit, &'static Unit),
    /// The depth [m] of a length.
    depth: fn(f64) -> f64,
}

fn samples(table: &TableText<'_>, pulls: &Pulls<'_>) -> Result<Samples, Error> {
    let (length, unit, domain) = pulls.length;
    let length = table.foreign_column(length, unit, named("m"))?;
    let (load, unit, si) = pulls.load;
    let load = table.foreign_column(load, unit, si)?;
    let mut samples = Samples::default();
    let mut rows = table.rows();
    while let Some(row) = rows.next()? {
        samples.time_s.push(samples.time_s.len() as f64);
        let length = row.number(&length, domain)?;
        samples.depth_m.push((pulls.depth)(length));
        samples.force_n.push(-row.number(&load, Domain::ANY_FORCE)?);
    }
    if samples.time_s.is_empty() {
        let path = table.path.clone();
        return Err(Error::NoRows { path });
    }
    Ok(samples)
}
