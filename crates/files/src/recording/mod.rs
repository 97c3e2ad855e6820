//! Recordings of a measurement: depth and force against time, with the specimen, the indenter and the stimulus.

mod axes;
mod foreign;
mod foreign_names;
mod foreign_table;
mod foreign_units;
mod header;
mod header_keys;
mod instruments;
mod samples;
mod stated_speed;
mod stretches;
mod write;
mod writer;

use std::path::Path;

use axes::Reading;
pub use axes::{RecordingRow, SensorAxes};
pub use foreign::ForeignColumns;
pub use header::{
    Condition, IndenterFriction, IndenterShape, RecordingHeader, Specimen, StimulusKind, Support,
};
pub use instruments::{deflection_beside, position_beside};
use samples::Repeated;
pub use samples::{ExtraColumn, Samples};
pub use writer::RecordingWriter;

pub use crate::table::ExtraKey;

use crate::atomic_write::{MAX_TABLE_BYTES, read_text};
use crate::table::{Ended, TableText};
use crate::{Error, Incomplete};

/// The origin of a recording, which determines the known zeros and signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    /// This project: depth counts from first contact.
    Project,
    /// An instrument: signs are known, first contact and the force's zero are not.
    Instrument,
    /// Another program: neither zeros nor signs are known.
    Foreign,
}

/// A recording. Depth is positive into the tissue from first contact; force is positive on the tissue. One from a
/// table of another program ([`Recording::is_foreign`]) keeps that program's zeros and signs; one from an
/// instrument's file ([`Recording::read_all`]) has the file's zeros.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The specimen, the indenter and the stimulus.
    pub header: RecordingHeader,
    samples: Samples,
    axes: Option<SensorAxes>,
    extra_columns: Vec<ExtraColumn>,
    /// Conversions of the file of another program, and warnings about the comments above its numbers.
    remarks: Vec<String>,
    origin: Origin,
    incomplete: Option<Incomplete>,
}

impl Recording {
    /// A recording of `samples`.
    ///
    /// # Errors
    /// When there is no sample, the numbers of samples differ, one is not finite or the time does
    /// not grow.
    pub fn new(header: RecordingHeader, samples: Samples) -> Result<Self, Error> {
        samples.check()?;
        Ok(Self::read_as(Origin::Project, header, samples, Vec::new()))
    }

    /// A whole recording of the three columns alone.
    fn read_as(
        origin: Origin,
        header: RecordingHeader,
        samples: Samples,
        remarks: Vec<String>,
    ) -> Self {
        Self {
            header,
            samples,
            axes: None,
            extra_columns: Vec::new(),
            remarks,
            origin,
            incomplete: None,
        }
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

    /// Whether a table states its format, as the recordings of this project do; others are
    /// [foreign](Recording::read_foreign).
    fn states_format(text: &str) -> bool {
        let comments = text
            .lines()
            .take_while(|line| line.trim_start().starts_with('#'));
        let mut keys = comments.map(|line| line.trim_start_matches(['#', ' ']));
        keys.any(|key| key.starts_with("format"))
    }

    /// Reads a recording file. A last line without its end is left out.
    ///
    /// # Errors
    /// When the file cannot be read or does not hold a recording.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_TABLE_BYTES)?, path)
    }

    /// Reads the text of a recording file; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text does not hold a recording.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let ended = Ended::of(text);
        let table = TableText::parse(ended.whole, path, RecordingHeader::KEYS)?;
        let keys = table.header.keys(path, RecordingHeader::KEYS);
        let mut header = RecordingHeader::from_keys(&keys)?;
        header.extra.clone_from(&table.header.extra);
        let columns = [
            table.column("time_s")?,
            table.column("depth_m")?,
            table.column("force_n")?,
        ];
        let axes = SensorAxes::columns_of(&table)?;
        let reading = Reading {
            columns: &columns,
            axes: axes.as_ref(),
            on_repeated: Repeated::Refused,
        };
        let read = samples::read(&table, &reading, |_| false)?;
        let incomplete = ended.incomplete(read.samples.time_s.len());
        Ok(Self {
            header,
            samples: read.samples,
            axes: read.axes,
            extra_columns: read.extra_columns,
            remarks: keys.warnings(),
            origin: Origin::Project,
            incomplete,
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

    /// The six axes of its sensor; none for a sensor of one axis.
    pub fn axes(&self) -> Option<&SensorAxes> {
        self.axes.as_ref()
    }

    /// Whether it is from a table of another program: its signs need not be those of this project.
    pub fn is_foreign(&self) -> bool {
        self.origin == Origin::Foreign
    }

    /// Whether its depth counts from first contact; those of instruments and of other programs need not.
    pub fn begins_at_contact(&self) -> bool {
        self.origin == Origin::Project
    }

    /// Conversions of the table of another program, and warnings about the comments above its numbers, in plain
    /// sentences.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Why samples may be missing; none for a recording with its end mark, and for the table of another program,
    /// which has no such mark.
    pub fn incomplete(&self) -> Option<&Incomplete> {
        self.incomplete.as_ref()
    }

    /// Unknown columns, which are preserved.
    pub fn extra_columns(&self) -> &[ExtraColumn] {
        &self.extra_columns
    }
}
