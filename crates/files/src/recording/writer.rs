use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{Seek, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use super::RecordingHeader;
use crate::Error;
use crate::table::header_line;
use crate::toml_document::quoted;

/// [`RecordingHeader::ended`] until it is finished.
const UNFINISHED: &str = "unfinished";

/// Room for how it ended, which is known last and stands at the top [byte].
const ROOM: usize = 120;

/// Samples that may be lost when the program is killed: half a second at 1 kHz.
const SAMPLES_BETWEEN_FLUSHES: usize = 500;

/// Writes a recording while it is made. Only whole lines go to the disk, at least every 500 samples. Until it
/// is [finished](Self::finish) the file has the ending `.part`, which reads as a recording too and says that
/// it is unfinished.
#[derive(Debug)]
pub struct RecordingWriter {
    path: PathBuf,
    part: PathBuf,
    file: File,
    /// Whole lines that are not in the file yet.
    waiting: String,
    samples: usize,
    /// Where the line of how it ended begins [byte].
    ended_at: usize,
}

impl RecordingWriter {
    /// Where the recording at `path` is while it is made.
    pub fn part(path: &Path) -> PathBuf {
        let mut part = path.as_os_str().to_owned();
        part.push(".part");
        PathBuf::from(part)
    }

    /// Begins the recording at `path`. Its folder must exist; what `header` says of its end is not taken.
    ///
    /// # Errors
    /// When the header holds what a recording cannot, or the operating system refuses.
    pub fn create(path: impl AsRef<Path>, header: &RecordingHeader) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        header.check(&path)?;
        let head = RecordingHeader {
            ended: None,
            ..header.clone()
        };
        let head = head.print();
        let part = Self::part(&path);
        let file = File::create(&part).map_err(|source| Error::write(&part, source))?;
        let mut writer = Self {
            path,
            part,
            file,
            ended_at: head.len(),
            waiting: head + &ended_line(UNFINISHED) + "time_s,depth_m,force_n\n",
            samples: 0,
        };
        writer.flush()?;
        Ok(writer)
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
        writeln!(self.waiting, "{time:?},{depth:?},{force:?}").expect("a string takes every text");
        self.samples += 1;
        match self.samples.is_multiple_of(SAMPLES_BETWEEN_FLUSHES) {
            true => self.flush(),
            false => Ok(()),
        }
    }

    /// Brings all samples to the file, says at its top how it `ended` (in ASCII, what is longer than its room
    /// is cut) and gives it its name.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(mut self, ended: &str) -> Result<(), Error> {
        self.flush()?;
        self.file
            .seek(SeekFrom::Start(self.ended_at as u64))
            .and_then(|_| self.file.write_all(ended_line(ended).as_bytes()))
            .map_err(|source| Error::write(&self.part, source))?;
        fs::rename(&self.part, &self.path).map_err(|source| Error::write(&self.path, source))
    }

    fn flush(&mut self) -> Result<(), Error> {
        self.file
            .write_all(self.waiting.as_bytes())
            .and_then(|()| self.file.flush())
            .map_err(|source| Error::write(&self.part, source))?;
        self.waiting.clear();
        Ok(())
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
