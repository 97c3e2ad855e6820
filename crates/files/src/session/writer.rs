use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::row::COLUMNS;
use super::{SessionHeader, SessionRow};
use crate::Error;

/// Rows that may be lost when the program is killed.
const ROWS_BETWEEN_FLUSHES: usize = 200;

/// Writes a session while it is played. Only whole lines go to the disk, at least every 200 rows;
/// the same rows give the same bytes.
#[derive(Debug)]
pub struct SessionWriter {
    path: PathBuf,
    file: File,
    tools: Vec<String>,
    /// Whole lines that are not in the file yet.
    waiting: String,
    waiting_rows: usize,
}

impl SessionWriter {
    /// Creates a session file for the `tools` of the scene, in its order. The folder must exist.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn create(
        path: impl AsRef<Path>,
        header: &SessionHeader,
        tools: &[String],
    ) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        let file = File::create(&path).map_err(|source| Error::write(&path, source))?;
        let mut writer = Self {
            path,
            file,
            tools: tools.to_vec(),
            waiting: header.print() + COLUMNS + "\n",
            waiting_rows: 0,
        };
        writer.flush()?;
        Ok(writer)
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
        row.print(tool, &mut self.waiting)
            .expect("a string takes every text");
        self.waiting_rows += 1;
        if self.waiting_rows < ROWS_BETWEEN_FLUSHES {
            return Ok(());
        }
        self.flush()
    }

    /// Brings all rows to the file.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn flush(&mut self) -> Result<(), Error> {
        let written = self.write_waiting();
        written.map_err(|source| Error::write(&self.path, source))
    }

    /// Brings all rows to the disk and closes the file.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(mut self) -> Result<(), Error> {
        self.flush()?;
        let synced = self.file.sync_all();
        synced.map_err(|source| Error::write(&self.path, source))
    }

    fn write_waiting(&mut self) -> io::Result<()> {
        let written = self.file.write_all(self.waiting.as_bytes());
        // Cleared in any case: half of it may be in the file, and must not come twice.
        self.waiting.clear();
        self.waiting_rows = 0;
        written
    }
}

impl Drop for SessionWriter {
    /// A session that ends in an error keeps what was played.
    fn drop(&mut self) {
        // There is nobody left to tell; `finish` is for who wants to know.
        let _ = self.write_waiting();
    }
}
