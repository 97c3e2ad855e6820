use std::fmt::Write as _;
use std::path::Path;

use super::RecordingHeader;
use crate::Error;
use crate::table::{TableWriter, header_line};
use crate::toml_document::quoted;

/// [`RecordingHeader::ended`] until it is finished.
const UNFINISHED: &str = "unfinished";

/// Room for how it ended, which is known last and stands at the top [byte].
const ROOM: usize = 120;

/// Writes a recording while it is made, into the [`unfinished`](crate::unfinished) file beside its own, which reads
/// as a recording too and says that it is unfinished. Only whole lines go to the disk, at least every 200 samples.
#[derive(Debug)]
pub struct RecordingWriter {
    table: TableWriter,
    /// Where the line of how it ended begins [byte].
    ended_at: usize,
}

impl RecordingWriter {
    /// Begins the recording at `path`. Its folder must exist; what `header` says of its end is not taken.
    ///
    /// # Errors
    /// When the header holds what a recording cannot, or the operating system refuses.
    pub fn create(path: impl AsRef<Path>, header: &RecordingHeader) -> Result<Self, Error> {
        let path = path.as_ref();
        header.check(path)?;
        let head = RecordingHeader {
            ended: None,
            ..header.clone()
        };
        let head = head.print();
        Ok(Self {
            ended_at: head.len(),
            table: TableWriter::create(
                path,
                &(head + &ended_line(UNFINISHED)),
                "time_s,depth_m,force_n",
            )?,
        })
    }

    /// Adds a sample: time [s], depth [m] and force [N].
    ///
    /// # Errors
    /// When one is no finite number, or the operating system refuses.
    pub fn write(&mut self, [time, depth, force]: [f64; 3]) -> Result<(), Error> {
        if let Some(wrong) = [time, depth, force].iter().find(|value| !value.is_finite()) {
            return Err(Error::BadContent {
                what: format!("a sample of the recording at {time} s"),
                found: wrong.to_string(),
                expected: "a finite number".into(),
            });
        }
        self.table
            .row(|text| writeln!(text, "{time:?},{depth:?},{force:?}"))
    }

    /// Says at its top how it `ended` (in ASCII, what is longer than its room is cut), ends it with its mark,
    /// brings it to the disk and gives it its name.
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

/// The line of how a recording ended, always equally long.
fn ended_line(ended: &str) -> String {
    let plain = |c: char| match c {
        '"' => '\'',
        ' '..='~' if c != '\\' => c,
        _ => '?',
    };
    let value = quoted(&ended.chars().take(ROOM).map(plain).collect::<String>());
    header_line("ended", format!("{value:<width$}", width = ROOM + 2))
}
