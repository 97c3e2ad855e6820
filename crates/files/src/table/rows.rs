use std::borrow::Cow;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::{Column, Layout, TableText};
use crate::atomic_write::newlines;
use crate::error::Place;
use crate::{Domain, Error, cell_text};

/// The rows of a table, one after the other. Blank lines and comments are skipped.
pub(crate) struct Rows<'t> {
    table: &'t TableText<'t>,
    reader: csv::Reader<&'t [u8]>,
    record: StringRecord,
    /// A byte of the text whose line number is known, and that number.
    byte: usize,
    line: usize,
}

/// A row with a field for each column.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<'r> {
    path: &'r Path,
    layout: Layout,
    record: &'r StringRecord,
    pub(crate) line: usize,
}

/// Whether trimmed fields are a row, and neither blank nor a comment, which may be indented.
pub(super) fn is_row<'f>(mut fields: impl Iterator<Item = &'f str>) -> bool {
    let first = fields.next().unwrap_or("");
    !first.starts_with('#') && (!first.is_empty() || fields.any(|field| !field.is_empty()))
}

impl<'t> Rows<'t> {
    pub(super) fn new(table: &'t TableText<'t>) -> Self {
        let reader = ReaderBuilder::new()
            .delimiter(table.layout.delimiter)
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(table.below.as_bytes());
        Self {
            table,
            reader,
            record: StringRecord::new(),
            byte: 0,
            line: table.below_line,
        }
    }

    /// The next row; none at the end.
    pub(crate) fn next(&mut self) -> Result<Option<Row<'_>>, Error> {
        loop {
            let byte = self.reader.position().byte() as usize;
            let more = self.reader.read_record(&mut self.record);
            self.count_lines_to(byte);
            match more {
                Ok(true) => {}
                Ok(false) => return Ok(None),
                Err(error) => return Err(self.bad_row(&error.to_string(), "a row of text fields")),
            }
            if is_row(self.record.iter()) {
                break;
            }
        }
        self.check_width()?;
        Ok(Some(Row {
            path: &self.table.path,
            layout: self.table.layout,
            record: &self.record,
            line: self.line,
        }))
    }

    /// Moves the known line number to the record that was read from `byte` on. The reader skips blank lines and
    /// comments without reporting them; they are counted here.
    fn count_lines_to(&mut self, byte: usize) {
        let text = self.table.below.as_bytes();
        self.line += newlines(&text[self.byte..byte]);
        self.byte = byte;
        while let Some(b'#' | b'\n' | b'\r') = text.get(self.byte) {
            let Some(end) = text[self.byte..].iter().position(|&b| b == b'\n') else {
                break;
            };
            self.byte += end + 1;
            self.line += 1;
        }
    }

    /// One field for each column; additional empty ones at the end are accepted.
    fn check_width(&self) -> Result<(), Error> {
        // The names of the columns are read as a row too, when their number is not known yet.
        let columns = self.table.columns().len();
        let fields = self.record.len();
        let surplus = self.record.iter().skip(columns).any(|f| !f.is_empty());
        if columns == 0 || (fields >= columns && !surplus) {
            return Ok(());
        }
        Err(self.bad_row(
            &format!("{fields} fields"),
            &format!("{columns} fields, one for each column"),
        ))
    }

    fn bad_row(&self, found: &str, expected: &str) -> Error {
        Error::BadRow {
            place: Place::line(&self.table.path, self.line),
            found: found.to_owned(),
            expected: expected.to_owned(),
        }
    }
}

impl<'r> Row<'r> {
    pub(crate) fn fields(&self) -> impl Iterator<Item = &'r str> + use<'r> {
        self.record.iter().map(cell_text)
    }

    pub(crate) fn field(&self, index: usize) -> &'r str {
        self.record.get(index).map_or("", cell_text)
    }

    pub(crate) fn text(&self, column: &Column) -> &'r str {
        self.field(column.index)
    }

    /// A number of the row, in the unit that was expected.
    pub(crate) fn number(&self, column: &Column, domain: Domain) -> Result<f64, Error> {
        let given = self
            .as_number(column)
            .ok_or_else(|| self.invalid(column, domain.expected()))?;
        let value = column.convert(given);
        match domain.contains(value) {
            true => Ok(value),
            false => Err(self.invalid(
                column,
                domain.expected() + &domain.meant(&column.name, given),
            )),
        }
    }

    fn as_number(&self, column: &Column) -> Option<f64> {
        let text = self.text(column);
        if self.layout.decimal_comma && !text.contains('.') {
            return text.replacen(',', ".", 1).parse().ok();
        }
        text.parse().ok()
    }

    /// 0 or 1.
    pub(crate) fn boolean(&self, column: &Column) -> Result<bool, Error> {
        match self.as_number(column) {
            Some(0.0) => Ok(false),
            Some(1.0) => Ok(true),
            _ => Err(self.invalid(column, "0 or 1")),
        }
    }

    pub(crate) fn invalid(&self, column: &Column, expected: impl Into<Cow<'static, str>>) -> Error {
        Error::BadValue {
            place: self.place(),
            key: column.name.clone(),
            found: format!("{:?}", self.text(column)),
            expected: expected.into(),
        }
    }

    pub(crate) fn place(&self) -> Place {
        Place::line(self.path, self.line)
    }

    /// Checks that the time of this row comes after the one before it, as written.
    pub(crate) fn check_after(
        &self,
        column: &Column,
        time: f64,
        previous: Option<f64>,
    ) -> Result<(), Error> {
        match previous {
            Some(previous) if time <= previous => Err(Error::TimeNotIncreasing {
                place: self.place(),
                column: column.name.clone(),
                found: self.text(column).to_owned(),
                previous: format!("{} s", previous),
            }),
            _ => Ok(()),
        }
    }
}
