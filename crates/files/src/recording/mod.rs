//! What was measured on a specimen: depth and force against time, and what is known of the
//! specimen, the indenter and the stimulus.

mod foreign;
mod foreign_table;
mod foreign_units;
mod header;
mod header_keys;
mod samples;
mod write;

use std::path::Path;

pub use foreign::ForeignColumns;
pub use header::{Condition, IndenterShape, RecordingHeader, Specimen, Stimulus};
pub use samples::{ExtraColumn, Samples};

pub use crate::table::ExtraKey;

use crate::Error;
use crate::table::TableText;
use crate::whole_file::read_text;

/// A recording. Depth is positive into the tissue from first contact; force is positive on the
/// tissue.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// What is known of the specimen, the indenter and the stimulus.
    pub header: RecordingHeader,
    samples: Samples,
    extra_columns: Vec<ExtraColumn>,
}

impl Recording {
    /// A recording of `samples`.
    ///
    /// # Errors
    /// When there is no sample, the numbers of samples differ, one is not finite or the time does
    /// not grow.
    pub fn new(header: RecordingHeader, samples: Samples) -> Result<Self, Error> {
        samples.check()?;
        Ok(Self {
            header,
            samples,
            extra_columns: Vec::new(),
        })
    }

    /// The same recording with one more column.
    ///
    /// # Errors
    /// When the column has another number of values than the recording has samples, or a name that
    /// a recording gives another meaning.
    pub fn with_extra_column(mut self, column: ExtraColumn) -> Result<Self, Error> {
        column.check(self.samples.time_s.len())?;
        self.extra_columns.push(column);
        Ok(self)
    }

    /// Reads a recording file.
    ///
    /// # Errors
    /// When the file cannot be read or does not hold a recording.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path)?, path)
    }

    /// Reads the text of a recording file; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text does not hold a recording.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let table = TableText::parse(text, path, RecordingHeader::KEYS)?;
        let keys = table.header.keys(path, RecordingHeader::KEYS);
        let mut header = RecordingHeader::from_keys(&keys)?;
        header.extra.clone_from(&table.header.extra);
        let columns = [
            table.column("time_s")?,
            table.column("depth_m")?,
            table.column("force_n")?,
        ];
        let (samples, extra_columns) = samples::read(&table, &columns, |_| false)?;
        Ok(Self {
            header,
            samples,
            extra_columns,
        })
    }

    /// The times [s], each after the one before it.
    pub fn time_s(&self) -> &[f64] {
        &self.samples.time_s
    }

    /// The depths [m].
    pub fn depth_m(&self) -> &[f64] {
        &self.samples.depth_m
    }

    /// The forces [N].
    pub fn force_n(&self) -> &[f64] {
        &self.samples.force_n
    }

    /// The columns that are kept although they mean nothing here.
    pub fn extra_columns(&self) -> &[ExtraColumn] {
        &self.extra_columns
    }
}
