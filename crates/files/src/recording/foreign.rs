use std::fs;
use std::path::Path;

use super::{Recording, RecordingHeader, foreign_table, foreign_units, samples};
use crate::Error;
use crate::table::Row;

/// Where a table that is not in the format of this project holds time, depth and force.
///
/// The unit is taken from the name (`Load (mN)`, `Load [mN]`, `load_mn`, `Load mN`), from a row of
/// units below the names, or as stated here. A time without a unit is in seconds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ForeignColumns {
    /// The column of the time.
    pub time: String,
    /// The column of the depth.
    pub depth: String,
    /// The column of the force.
    pub force: String,
    /// The unit of the depth, such as `mm`.
    pub depth_unit: Option<String>,
    /// The unit of the force, such as `mN`.
    pub force_unit: Option<String>,
}

impl Recording {
    /// Reads a table with other columns. See [`Recording::parse_foreign`].
    ///
    /// # Errors
    /// When the file cannot be read, or as for [`Recording::parse_foreign`].
    pub fn read_foreign(path: impl AsRef<Path>, columns: &ForeignColumns) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|source| Error::read(path, source))?;
        // Machines that do not write UTF-8 mostly write Latin-1, where each byte is a character.
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| error.as_bytes().iter().map(|&byte| byte as char).collect());
        Self::parse_foreign(&text, path, columns)
    }

    /// Reads the text of a table with other columns; `path` is its name in errors.
    ///
    /// Fields are separated by commas, semicolons or tabs; with the latter two a decimal comma is
    /// understood. Lines above the names of the columns are passed over, but for comments
    /// `# key = value` with the keys of a recording.
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
        let table = foreign_table::find(text, path, columns)?;
        let keys = table.header.keys(path, RecordingHeader::KEYS);
        let header = RecordingHeader::from_keys(&keys)?;
        let (found, has_units) = foreign_units::columns(&table, columns)?;
        let is_unit_row = |row: &Row<'_>| has_units && foreign_units::of_row(row, &found).is_some();
        let (samples, extra_columns) = samples::read(&table, &found, is_unit_row)?;
        Ok(Self {
            header,
            samples,
            extra_columns,
        })
    }
}
