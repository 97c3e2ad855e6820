use std::path::Path;

use super::row::COLUMNS;
use super::{SessionHeader, SessionRow};
use crate::Error;
use crate::table::TableWriter;

/// Writes a session while it is played, into an [`unfinished`](crate::unfinished) file next to the target. Only whole
/// lines go to the disk, at least every 200 rows; the same rows give the same bytes.
#[derive(Debug)]
pub struct SessionWriter {
    table: TableWriter,
    tools: Vec<String>,
}

impl SessionWriter {
    /// Begins a session for the `tools` of the scene, in its order. The folder must exist.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn create(
        path: impl AsRef<Path>,
        header: &SessionHeader,
        tools: &[String],
    ) -> Result<Self, Error> {
        Ok(Self {
            table: TableWriter::create(path.as_ref(), &header.print(), COLUMNS)?,
            tools: tools.to_vec(),
        })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// When a number of the row is not finite, its tool is not one of the session's, or the
    /// operating system refuses.
    pub fn write(&mut self, row: &SessionRow) -> Result<(), Error> {
        let wrong = |what: &str, found: String, expected: &'static str| Error::BadContent {
            what: format!("{what} of the session's row at {} s", row.time_s),
            found,
            expected: expected.into(),
        };
        if let Some((column, value)) = row.not_finite() {
            return Err(wrong(column, value.to_string(), "a finite number"));
        }
        let tool = self.tools.get(row.tool).ok_or_else(|| {
            wrong(
                "the tool",
                row.tool.to_string(),
                "the number of a tool of the session",
            )
        })?;
        self.table.row(|text| row.print(tool, text))
    }

    /// Writes all rows to the file.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn flush(&mut self) -> Result<(), Error> {
        self.table.flush()
    }

    /// Adds the end mark, writes the session to the disk and gives it its name.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(self) -> Result<(), Error> {
        self.finish_after(|| Ok(()))
    }

    /// The same; `before` runs when the session is on the disk and does not have its name yet.
    ///
    /// # Errors
    /// When the operating system refuses, or `before` does.
    pub fn finish_after(self, before: impl FnOnce() -> Result<(), Error>) -> Result<(), Error> {
        self.table.finish(before)
    }
}
