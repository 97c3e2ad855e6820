use std::path::{Path, PathBuf};

use palpate_files::Error;
use palpate_files::recording::{RecordingHeader, RecordingRow, RecordingWriter};

use crate::{Ended, RigSample};

/// Reason for the early end of a recording whose parameters are known.
const KNOWN_WELL_ENOUGH: &str = "its parameters were known well enough";

/// A recording while it is made.
#[derive(Debug)]
pub struct Recorder {
    file: PathBuf,
    writer: RecordingWriter,
    first: Option<f64>,
    samples: usize,
    peak: f64,
}

/// A recording that was made.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// Where it is.
    pub file: PathBuf,
    /// How many samples it has.
    pub samples: usize,
    /// The largest force [N].
    pub peak: f64,
    /// Why it ends before its stimulus; none when it is whole.
    pub cut_short: Option<String>,
}

/// The axes of a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// All six.
    Six,
    /// Its own alone.
    One,
}

impl Axes {
    /// Those of a sample.
    pub fn of(sample: &RigSample) -> Self {
        match sample.axes {
            Some(_) => Self::Six,
            None => Self::One,
        }
    }
}

impl Recorder {
    /// Begins the recording at `file`, whose folder must exist, of a sensor with six axes or one.
    ///
    /// # Errors
    /// When the operating system refuses, or `header` holds what a recording cannot.
    pub fn begin(file: &Path, header: &RecordingHeader, axes: Axes) -> Result<Self, Error> {
        Ok(Self {
            file: file.to_owned(),
            writer: match axes {
                Axes::Six => RecordingWriter::create_with_axes(file, header)?,
                Axes::One => RecordingWriter::create(file, header)?,
            },
            first: None,
            samples: 0,
            peak: 0.0,
        })
    }

    /// Takes a sample.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn take(&mut self, sample: &RigSample) -> Result<(), Error> {
        let row = self.row(sample);
        self.write(row)
    }

    /// The row of a sample, with its time from the first.
    pub(crate) fn row(&mut self, sample: &RigSample) -> RecordingRow {
        let begun = *self.first.get_or_insert(sample.time);
        // To the microsecond, the resolution of a clock.
        let time_s = (1e6 * (sample.time - begun)).round() / 1e6;
        RecordingRow {
            time_s,
            depth_m: sample.depth.unwrap_or_default(),
            force_n: sample.force,
            axes: sample.axes.map(|axes| axes.components()),
        }
    }

    /// Writes a row.
    pub(crate) fn write(&mut self, row: RecordingRow) -> Result<(), Error> {
        self.writer.write(row)?;
        self.samples += 1;
        self.peak = self.peak.max(row.force_n);
        Ok(())
    }

    /// Gives the file its name, and writes into the header how it `ended`.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(self, ended: &Result<Ended, crate::Error>) -> Result<Recorded, Error> {
        let cut_short = match ended {
            Ok(Ended::Complete) => None,
            Ok(Ended::Stopped) => Some("stopped by hand".to_owned()),
            Ok(Ended::Enough) => Some(KNOWN_WELL_ENOUGH.to_owned()),
            // The cause without its remedy.
            Err(error) => {
                let said = error.to_string();
                Some(said.split("; ").next().unwrap_or_default().to_owned())
            }
        };
        self.end(cut_short)
    }

    /// The same, with why it ends before its stimulus, if it does.
    pub(crate) fn end(self, cut_short: Option<String>) -> Result<Recorded, Error> {
        let said = cut_short.as_deref().unwrap_or(RecordingHeader::COMPLETE);
        self.writer.finish(said)?;
        Ok(Recorded {
            file: self.file,
            samples: self.samples,
            peak: self.peak,
            cut_short,
        })
    }
}
