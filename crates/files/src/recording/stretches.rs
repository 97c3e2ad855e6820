use std::ops::Bound::{Excluded, Included};
use std::path::Path;

use super::foreign_names::Wanted;
use super::{ForeignColumns, Recording, RecordingHeader, Samples, StimulusKind};
use super::{foreign_table, foreign_units};
use crate::table::TableText;
use crate::units::Unit;
use crate::{Domain, Error};

const STRETCH: &[&str] = &["stretch", "lambda"];
const STRESS: &[&str] = &["stress"];

/// A table of stretches and nominal stresses, as a recording of a cube of one metre that is pulled
/// in a step a second; none when `text` holds no such table.
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
        return Ok(None);
    }
    let keys = table.header.keys(path, RecordingHeader::KEYS);
    let mut header = RecordingHeader::from_keys(&keys)?;
    header.stimulus = Some(StimulusKind::Uniaxial);
    header.area_m2 = Some(1.0);
    header.height_m = Some(1.0);
    let [stretch, stress] = [wanted[0].choose(&table)?, wanted[1].choose(&table)?];
    let unit = foreign_units::stress(&table, stress, columns)?;
    let remark = format!(
        "`{stretch}` and `{stress}` in {} were read as the stretching of a cube of one metre, a row a second",
        unit.spelling
    );
    Ok(Some(Recording {
        header,
        samples: samples(&table, stretch, (stress, unit))?,
        axes: None,
        extra_columns: Vec::new(),
        remarks: vec![remark],
        is_foreign: false,
        incomplete: None,
    }))
}

/// A height over that at rest [-].
const HEIGHT: Domain = Domain::number("a stretch", [Excluded(0.0), Included(1e3)]);

fn samples(
    table: &TableText<'_>,
    stretch: &str,
    (stress, unit): (&str, &'static Unit),
) -> Result<Samples, Error> {
    let named = |name| Unit::named(name).expect("SI units are in the table");
    let stretch = table.foreign_column(stretch, named("m"), named("m"))?;
    let stress = table.foreign_column(stress, unit, named("Pa"))?;
    let mut samples = Samples::default();
    let mut rows = table.rows();
    while let Some(row) = rows.next()? {
        samples.time_s.push(samples.time_s.len() as f64);
        let height = row.number(&stretch, HEIGHT)?;
        samples.depth_m.push(1.0 - height);
        samples
            .force_n
            .push(-row.number(&stress, Domain::ANY_FORCE)?);
    }
    if samples.time_s.is_empty() {
        let path = table.path.clone();
        return Err(Error::NoRows { path });
    }
    Ok(samples)
}
