use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::end_mark::RowDigest;
use crate::Error;

/// Rows that may be lost when the program is killed.
const ROWS_BETWEEN_FLUSHES: usize = 200;

/// The path of an unfinished table: next to `path`, with the ending `.part`.
pub fn unfinished(path: impl AsRef<Path>) -> PathBuf {
    let mut part = OsString::from(path.as_ref());
    part.push(".part");
    PathBuf::from(part)
}

/// Writes a table row by row into the [`unfinished`] file next to the target, to the disk at least every 200 rows and
/// only whole lines. Its end mark follows the last row; then it takes its name.
#[derive(Debug)]
pub(crate) struct TableWriter {
    path: PathBuf,
    part: PathBuf,
    file: File,
    /// Whole lines that are not in the file yet.
    waiting: String,
    rows: usize,
    digest: RowDigest,
}

impl TableWriter {
    /// Begins with `header`, comments, and the line of the `columns`. The folder must exist.
    pub(crate) fn create(path: &Path, header: &str, columns: &str) -> Result<Self, Error> {
        let part = unfinished(path);
        let file = File::create(&part).map_err(|source| Error::write(&part, source))?;
        let mut digest = RowDigest::default();
        digest.add(columns);
        let mut writer = Self {
            path: path.to_owned(),
            part,
            file,
            waiting: format!("{header}{columns}\n"),
            rows: 0,
            digest,
        };
        writer.flush()?;
        Ok(writer)
    }

    /// Adds the row that `put` writes, with its line end.
    pub(crate) fn row(
        &mut self,
        put: impl FnOnce(&mut String) -> fmt::Result,
    ) -> Result<(), Error> {
        let start = self.waiting.len();
        put(&mut self.waiting).expect("a string takes every text");
        self.digest.add(&self.waiting[start..]);
        self.rows += 1;
        match self.rows.is_multiple_of(ROWS_BETWEEN_FLUSHES) {
            true => self.flush(),
            false => Ok(()),
        }
    }

    /// Writes all rows to the file.
    pub(crate) fn flush(&mut self) -> Result<(), Error> {
        let written = self.write_waiting();
        written.map_err(|source| Error::write(&self.part, source))
    }

    /// Overwrites the header at a position [byte].
    pub(crate) fn write_over(&mut self, at: u64, text: &str) -> Result<(), Error> {
        let mut put = || {
            self.file.seek(SeekFrom::Start(at))?;
            self.file.write_all(text.as_bytes())?;
            self.file.seek(SeekFrom::End(0))
        };
        let put = put();
        put.map(drop)
            .map_err(|source| Error::write(&self.part, source))
    }

    /// Adds the end mark, writes all to the disk and, after `before`, gives the file its name.
    pub(crate) fn finish(
        mut self,
        before: impl FnOnce() -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.flush()?;
        self.waiting = std::mem::take(&mut self.digest).mark(self.rows);
        self.flush()?;
        let synced = self.file.sync_all();
        synced.map_err(|source| Error::write(&self.part, source))?;
        before()?;
        fs::rename(&self.part, &self.path).map_err(|source| Error::write(&self.path, source))
    }

    fn write_waiting(&mut self) -> io::Result<()> {
        let written = self.file.write_all(self.waiting.as_bytes());
        // Cleared in any case: half of it may be in the file, and must not be written twice.
        self.waiting.clear();
        written
    }
}

impl Drop for TableWriter {
    /// A table that ends in an error keeps its rows, without an end mark.
    fn drop(&mut self) {
        // An error cannot be reported here; `finish` reports it.
        let _ = self.write_waiting();
    }
}
