use std::ops::Bound::{Excluded, Included};
use std::path::Path;

use super::foreign_names::Wanted;
use super::{ForeignColumns, Origin, Recording, RecordingHeader, Samples, StimulusKind};
use super::{foreign_table, foreign_units};
use crate::table::{Column, TableText};
use crate::units::Unit;
use crate::{Domain, Error};

const STRETCH: &[&str] = &["stretch", "lambda"];
const STRAIN: &[&str] = &["strain", "dehnung"];
const STRESS: &[&str] = &["stress", "spannung"];
/// Words of columns that are not nominal, or not along the axis.
const EXCLUDED: &[&str] = &["true", "cauchy", "transverse", "lateral", "shear"];

/// A table without times of a piece that is deformed: of stretches or nominal strains and nominal stresses, as a recording
/// of a cube of one metre that is pulled in a step a second, or of displacements and forces of a piece between clamps; none
/// when `text` holds no such table.
pub(super) fn parse(
    text: &str,
    path: &Path,
    columns: &ForeignColumns,
) -> Result<Option<Recording>, Error> {
    let stress = Wanted::new("stress", None, STRESS).without(EXCLUDED);
    let stretch = Wanted::new("stretch", None, STRETCH).without(EXCLUDED);
    let strain = Wanted::new("strain", None, STRAIN).without(EXCLUDED);
    let of_strain = Axial {
        domain: STRAIN_DOMAIN,
        depth: |strain| -strain,
    };
    let of_stretch = Axial {
        domain: STRETCH_DOMAIN,
        depth: |stretch| 1.0 - stretch,
    };
    for (axial, length) in [(of_stretch, stretch), (of_strain, strain)] {
        let wanted = [length, stress];
        let (table, has_all) = foreign_table::find(text, path, &wanted)?;
        if has_all {
            return stressed(&table, path, columns, wanted, &axial).map(Some);
        }
    }
    clamped(text, path, columns)
}

/// The conversion of a column to the depth of the cube.
struct Axial {
    domain: Domain,
    /// The depth [m].
    depth: fn(f64) -> f64,
}

/// The recording of a cube of one metre.
fn stressed(
    table: &TableText<'_>,
    path: &Path,
    columns: &ForeignColumns,
    wanted: [Wanted<'_>; 2],
    axial: &Axial,
) -> Result<Recording, Error> {
    let keys = table.header.keys(path, RecordingHeader::KEYS);
    let mut header = RecordingHeader::from_keys(&keys)?;
    match header.stimulus {
        Some(StimulusKind::PlanarTension | StimulusKind::UniaxialTension) => {}
        Some(StimulusKind::SimpleShear) => {
            let expected =
                "no `simple_shear` of a table of stretches; give displacements and forces";
            return Err(keys.invalid("stimulus", expected));
        }
        _ => header.stimulus = Some(StimulusKind::Uniaxial),
    }
    header.area_m2 = Some(1.0);
    header.height_m = Some(1.0);
    let [length, stress] = [wanted[0].choose(table)?, wanted[1].choose(table)?];
    let (units, has_units) = foreign_units::stretch_and_stress(table, [length, stress], columns)?;
    let in_units = units.map(|unit| match unit.spelling {
        "-" => String::new(),
        spelling => format!(" in {spelling}"),
    });
    let remark = format!(
        "`{length}`{} and `{stress}`{} were read as the stretching of a cube of one metre, a row a second; positive ones are \
         tension",
        in_units[0], in_units[1]
    );
    let pulls = Pulls {
        columns: [
            table.foreign_column(length, units[0], named("one"))?,
            table.foreign_column(stress, units[1], named("pa"))?,
        ],
        has_units,
        domain: axial.domain,
        depth: axial.depth,
    };
    let samples = pulls.samples(table)?;
    Ok(Recording::read_as(
        Origin::Project,
        header,
        samples,
        vec![remark],
    ))
}

/// A height over that at rest [-].
const STRETCH_DOMAIN: Domain = Domain::number("a stretch", [Excluded(0.0), Included(1e3)]);

/// A change of height over the height at rest [-].
const STRAIN_DOMAIN: Domain = Domain::number("a nominal strain", [Excluded(-1.0), Included(1e3)]);

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
    let ([length, load], has_units) =
        foreign_units::displacement_and_force(&table, [depth, force], columns)?;
    let remark = format!(
        "`{depth}` in {} and `{force}` in {} were read as the {deformed}, a row a second",
        length.spelling, load.spelling
    );
    let pulls = Pulls {
        columns: [
            table.foreign_column(depth, length, named("m"))?,
            table.foreign_column(force, load, named("n"))?,
        ],
        has_units,
        domain: DISPLACEMENT,
        depth: |displacement| -displacement,
    };
    let samples = pulls.samples(&table)?;
    let recording = Recording::read_as(Origin::Project, header, samples, vec![remark]);
    Ok(Some(recording))
}

fn named(name: &str) -> &'static Unit {
    Unit::named(name).expect("SI units are in the table")
}

/// The columns of a pulled piece.
struct Pulls {
    /// Of the length and the load.
    columns: [Column; 2],
    /// Whether a row below the names holds the units.
    has_units: bool,
    /// Of the length.
    domain: Domain,
    /// The depth [m] of a length.
    depth: fn(f64) -> f64,
}

impl Pulls {
    fn samples(&self, table: &TableText<'_>) -> Result<Samples, Error> {
        let [length, load] = &self.columns;
        let mut samples = Samples::default();
        let mut rows = table.rows();
        if self.has_units {
            rows.next()?;
        }
        while let Some(row) = rows.next()? {
            samples.time_s.push(samples.time_s.len() as f64);
            let length = row.number(length, self.domain)?;
            samples.depth_m.push((self.depth)(length));
            samples.force_n.push(-row.number(load, Domain::ANY_FORCE)?);
        }
        if samples.time_s.is_empty() {
            let path = table.path.clone();
            return Err(Error::NoRows { path });
        }
        Ok(samples)
    }
}
