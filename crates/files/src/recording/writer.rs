use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::RecordingHeader;
use crate::Error;

/// Samples that may be lost when the program is killed: half a second at 1 kHz.
const SAMPLES_BETWEEN_FLUSHES: usize = 500;

/// Writes a recording while it is made. Only whole lines go to the disk, at least every 500 samples. Until it
/// is [finished](Self::finish) the file has the ending `.part`, which reads as a recording too.
#[derive(Debug)]
pub struct RecordingWriter {
    path: PathBuf,
    part: PathBuf,
    file: File,
    /// Whole lines that are not in the file yet.
    waiting: String,
    samples: usize,
}

impl RecordingWriter {
    /// Begins the recording at `path`. Its folder must exist.
    ///
    /// # Errors
    /// When the header holds what a recording cannot, or the operating system refuses.
    pub fn create(path: impl AsRef<Path>, header: &RecordingHeader) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        header.check(&path)?;
        let mut part = path.clone().into_os_string();
        part.push(".part");
        let part = PathBuf::from(part);
        let file = File::create(&part).map_err(|source| Error::write(&part, source))?;
        let mut writer = Self {
            path,
            part,
            file,
            waiting: header.print() + "time_s,depth_m,force_n\n",
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

    /// Brings all samples to the file and gives it its name.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(mut self) -> Result<(), Error> {
        self.flush()?;
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
