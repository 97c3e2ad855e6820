use std::borrow::Cow;
use std::path::Path;

use super::axes::{Reading, SensorAxes};
use super::foreign_names::Wanted;
use super::samples::{self, Repeated};
use super::{
    Origin, Recording, RecordingHeader, foreign_table, foreign_units, stated_speed, stretches,
};
use crate::Error;
use crate::atomic_write::{MAX_TABLE_BYTES, read_bytes};
use crate::table::{Column, Row};

/// The columns of time, depth and force in a table of another program. A column that is not named is recognised by
/// its name, if the match is unique.
///
/// The unit is taken from the name (`Load (mN)`, `Load [mN]`, `load_mn`, `Load mN`), from a row of
/// units below the names, or as stated here. A time without a unit is in seconds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ForeignColumns {
    /// The column of the time.
    pub time: Option<String>,
    /// The column of the depth.
    pub depth: Option<String>,
    /// The column of the force.
    pub force: Option<String>,
    /// The unit of the depth, such as `mm`.
    pub depth_unit: Option<String>,
    /// The unit of the force, such as `mN`.
    pub force_unit: Option<String>,
}

impl ForeignColumns {
    /// Whether a column is named.
    pub(super) fn names_any(&self) -> bool {
        [&self.time, &self.depth, &self.force]
            .iter()
            .any(|name| name.is_some())
    }
}

/// The text of a table. Machines that do not write UTF-8 mostly write Latin-1, where each byte is a character.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| byte as char).collect(),
    }
}

impl Recording {
    /// Reads a table with other columns. See [`Recording::parse_foreign`].
    ///
    /// # Errors
    /// When the file cannot be read, or as for [`Recording::parse_foreign`].
    pub fn read_foreign(path: impl AsRef<Path>, columns: &ForeignColumns) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse_foreign(&text(&read_bytes(path, MAX_TABLE_BYTES)?), path, columns)
    }

    /// Reads the text of a table with other columns; `path` is its name in errors.
    ///
    /// Fields are separated by commas, semicolons or tabs; with the latter two a decimal comma is understood. Lines
    /// above the names of the columns are ignored, except comments `# key = value` with the keys of a recording. A
    /// row that repeats the one above it in every field is left out. A table of stretches or strains with stresses is
    /// read as the recording of a cube of one metre; one of distances and forces without times gets times from the
    /// speed that a line above it states. A force in g or kg is the weight of that mass. [`Recording::remarks`] lists
    /// how columns and units were interpreted.
    ///
    /// # Errors
    /// When a column is not there, its unit is not known or its numbers make no recording.
    pub fn parse_foreign(
        text: &str,
        path: impl AsRef<Path>,
        columns: &ForeignColumns,
    ) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let wanted = columns.wanted();
        let (table, has_all) = foreign_table::find(text, path, &wanted)?;
        let is_open = wanted.iter().all(Wanted::is_recognised);
        if !has_all
            && is_open
            && let Some(recording) = stretches::parse(text, path, columns)?
        {
            return Ok(recording);
        }
        if !has_all
            && columns.time.is_none()
            && let Some(recording) = stated_speed::parse(text, path, columns)?
        {
            return Ok(recording);
        }
        let keys = table.header.keys(path, RecordingHeader::KEYS);
        let header = RecordingHeader::from_keys(&keys)?;
        let (found, has_units) = foreign_units::columns(&table, columns)?;
        let is_unit_row = |row: &Row<'_>| has_units && foreign_units::of_row(row, &found).is_some();
        let axes = SensorAxes::columns_of(&table)?;
        let reading = Reading {
            columns: &found,
            axes: axes.as_ref(),
            on_repeated: Repeated::LeftOut,
        };
        let read = samples::read(&table, &reading, is_unit_row)?;
        let mut remarks = Vec::new();
        if wanted.iter().any(Wanted::is_recognised) {
            remarks.push(taken(&found));
        }
        if read.repeated > 0 {
            let rows = read.repeated;
            remarks.push(format!(
                "{rows} rows that repeat the row above them were left out"
            ));
        }
        Ok(Self {
            axes: read.axes,
            extra_columns: read.extra_columns,
            ..Self::read_as(Origin::Foreign, header, read.samples, remarks)
        })
    }
}

fn taken([time, depth, force]: &[Column; 3]) -> String {
    let name = |column: &Column| format!("`{}` in {}", column.name, column.spelling());
    format!(
        "the time was taken from {}, the depth from {}, the force from {}; name the columns if that is wrong",
        name(time),
        name(depth),
        name(force)
    )
}
