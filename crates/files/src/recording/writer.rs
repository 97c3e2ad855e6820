use std::fmt::Write as _;
use std::path::Path;

use super::write::{COLUMNS, axes_names};
use super::{RecordingHeader, RecordingRow};
use crate::Error;
use crate::table::{TableWriter, header_line};
use crate::toml_document::quoted;

/// The value of [`RecordingHeader::ended`] until it is finished.
const UNFINISHED: &str = "unfinished";

/// Space for the reason of its end, which is known last and written at the top [byte].
const ROOM: usize = 120;

/// Writes a recording while it is made, into an [`unfinished`](crate::unfinished) file next to the target, which is a
/// valid recording marked as unfinished. Only whole lines go to the disk, at least every 200 samples.
#[derive(Debug)]
pub struct RecordingWriter {
    table: TableWriter,
    /// Position of the line with the reason of its end [byte].
    ended_at: usize,
    has_axes: bool,
}

impl RecordingWriter {
    /// Begins the recording at `path`, of a sensor of one axis. Its folder must exist; the entry of `header` on its
    /// end is ignored.
    ///
    /// # Errors
    /// When the header has a value that a recording cannot have, or the operating system refuses.
    pub fn create(path: impl AsRef<Path>, header: &RecordingHeader) -> Result<Self, Error> {
        Self::begin(path.as_ref(), header, false)
    }

    /// The same, of a sensor of six axes.
    ///
    /// # Errors
    /// As for [`create`](Self::create).
    pub fn create_with_axes(
        path: impl AsRef<Path>,
        header: &RecordingHeader,
    ) -> Result<Self, Error> {
        Self::begin(path.as_ref(), header, true)
    }

    fn begin(path: &Path, header: &RecordingHeader, has_axes: bool) -> Result<Self, Error> {
        header.check(path)?;
        let head = RecordingHeader {
            ended: None,
            ..header.clone()
        };
        let head = head.print();
        let columns = match has_axes {
            true => COLUMNS.to_owned() + &axes_names(),
            false => COLUMNS.to_owned(),
        };
        Ok(Self {
            has_axes,
            ended_at: head.len(),
            table: TableWriter::create(path, &(head + &ended_line(UNFINISHED)), &columns)?,
        })
    }

    /// Adds a sample.
    ///
    /// # Errors
    /// When a number is not finite, the axes are not those that it began with, or the operating system refuses.
    pub fn write(&mut self, row: impl Into<RecordingRow>) -> Result<(), Error> {
        let row = row.into();
        let own = [row.time_s, row.depth_m, row.force_n];
        let mut all = own.iter().chain(row.axes.iter().flatten());
        let wrong = match all.find(|value| !value.is_finite()) {
            Some(value) => Some((value.to_string(), "a finite number")),
            None if row.axes.is_some() != self.has_axes => {
                let found = row.axes.map_or(1, |axes| axes.len());
                let found = format!("a force on {found} axes");
                Some((found, "the axes of the samples before it"))
            }
            None => None,
        };
        if let Some((found, expected)) = wrong {
            return Err(Error::BadContent {
                what: format!("a sample of the recording at {} s", row.time_s),
                found,
                expected: expected.into(),
            });
        }
        let [time, depth, force] = own;
        self.table.row(|text| {
            write!(text, "{time:?},{depth:?},{force:?}")?;
            for value in row.axes.iter().flatten() {
                write!(text, ",{value:?}")?;
            }
            writeln!(text)
        })
    }

    /// Writes at its top how it `ended` (in ASCII, truncated to the reserved space), adds the end mark, writes it to
    /// the disk and gives it its name.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(mut self, ended: &str) -> Result<(), Error> {
        self.table.flush()?;
        self.table
            .write_over(self.ended_at as u64, &ended_line(ended))?;
        self.table.finish(|| Ok(()))
    }
}

/// The line that states how a recording ended, always equally long.
fn ended_line(ended: &str) -> String {
    let plain = |c: char| match c {
        '"' => '\'',
        ' '..='~' if c != '\\' => c,
        _ => '?',
    };
    let value = quoted(&ended.chars().take(ROOM).map(plain).collect::<String>());
    header_line("ended", format!("{value:<width$}", width = ROOM + 2))
}
