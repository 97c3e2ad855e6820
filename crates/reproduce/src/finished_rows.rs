//! Finished rows on the disk: an interrupted or killed run loses none of them.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;

use palpate_jobs::ProgressCallback;

use super::Row;
use crate::Error;

/// One JSON object per line, in the folder of the figures. Each run appends to it, so that nothing is replaced: of two
/// lines of one row the later is newer.
pub const KEPT: &str = "rows.jsonl";

/// The file of finished rows; the first row creates it.
pub struct FinishedRows {
    path: PathBuf,
    file: Option<File>,
}

impl FinishedRows {
    pub(super) fn at(path: PathBuf) -> Self {
        Self { path, file: None }
    }

    /// Appends `rows`, whole lines at once, which `watch` does not cancel.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn keep(&mut self, rows: &[Row], watch: &dyn ProgressCallback) -> Result<(), Error> {
        if rows.is_empty() {
            return Ok(());
        }
        let mut lines = String::new();
        for row in rows {
            let line = serde_json::to_string(row)
                .map_err(|error| Error::failed(format!("a row is no JSON ({error})")))?;
            lines += &line;
            lines.push('\n');
        }
        let mut written = Ok(());
        watch.without_cancellation(&mut || written = self.append(&lines));
        written.map_err(|source| {
            let path = self.path.clone();
            palpate_files::Error::Write { path, source }.into()
        })
    }

    fn append(&mut self, lines: &str) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(opened(&self.path)?),
        };
        file.write_all(lines.as_bytes())
    }
}

/// Opens the file to append whole lines: a killed run may have left a partial line.
fn opened(path: &PathBuf) -> io::Result<File> {
    let mut file = OpenOptions::new()
        .create(true)
        .read(true)
        .append(true)
        .open(path)?;
    if file.seek(SeekFrom::End(0))? > 0 {
        file.seek(SeekFrom::End(-1))?;
        let mut last = [0];
        file.read_exact(&mut last)?;
        if last != *b"\n" {
            file.write_all(b"\n")?;
        }
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unfinished_line_stays_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(KEPT);
        std::fs::write(&path, "{\"row\":\"a\"}\n{\"ro").unwrap();
        for word in ["b", "c"] {
            let mut kept = FinishedRows::at(path.clone());
            kept.append(&format!("{{\"row\":\"{word}\"}}\n")).unwrap();
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let rows = text
            .lines()
            .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
        let names: Vec<_> = rows.map(|row| row["row"].clone()).collect();
        assert_eq!(names, ["a", "b", "c"]);
    }
}
