//! Files of indentation instruments: recognises them by content, and reads their curves as recordings.
//!
//! Height is that of the cantilever's base, measured upwards; the tip is lower by less than that, for the cantilever
//! bends. So depth = (z₀ + d₀) − (z + d), with z the height, d the deflection and z₀, d₀ those of the first sample; force is
//! the spring constant times the deflection. First contact is unknown: depth counts from the first sample.
//!
//! *How we know*: `instruments::…`: real files against the export of another program; files of an independent writer, cut
//! short and changed byte by byte.

mod igor;
mod igor_pair;
mod igor_wave;
mod jpk;
mod jpk_segment;
mod nanosurf;
mod nanosurf_places;
mod optics11;
mod properties;
mod zip;

use std::path::Path;

pub use igor_pair::{deflection_beside, position_beside};

use super::{ForeignColumns, Origin, Recording, RecordingHeader, Samples};
use crate::atomic_write::{MAX_TABLE_BYTES, read_bytes};
use crate::{Domain, Error};

/// Samples of all curves of one file that are read at most [-].
const MAX_SAMPLES: usize = 1 << 25;

impl Recording {
    /// Reads all recordings in a file: of this project, of an instrument, or the table of another program. An instrument's
    /// file may hold several, a map of a surface.
    ///
    /// # Errors
    /// As for [`Recording::parse_all`], and when the file cannot be read.
    pub fn read_all(
        path: impl AsRef<Path>,
        columns: &ForeignColumns,
        given: &RecordingHeader,
    ) -> Result<Vec<Self>, Error> {
        let path = path.as_ref();
        Self::parse_all(&read_bytes(path, MAX_TABLE_BYTES)?, path, columns, given)
    }

    /// Reads all recordings in the `bytes` of a file, whose name in errors is `path`. The spring constant and the
    /// sensitivity of a cantilever come from `given` where the file does not have them.
    ///
    /// # Errors
    /// When the bytes hold no recording, or forces cannot be computed because a calibration is missing.
    pub fn parse_all(
        bytes: &[u8],
        path: impl AsRef<Path>,
        columns: &ForeignColumns,
        given: &RecordingHeader,
    ) -> Result<Vec<Self>, Error> {
        let path = path.as_ref();
        let file = InstrumentFile {
            bytes,
            path,
            columns,
            given,
        };
        if jpk::is_archive(bytes) {
            return jpk::read(&file);
        }
        if igor_wave::is_wave(bytes) {
            return Ok(vec![igor::read(&file)?]);
        }
        if nanosurf::is_nid(bytes) {
            return nanosurf::read(&file);
        }
        let text = super::foreign::text(bytes);
        let text = text.trim_start_matches('\u{feff}');
        if let Some(recording) = optics11::read(text, &file)? {
            return Ok(vec![recording]);
        }
        let recording = match columns.names_any() || !Self::states_format(text) {
            true => Self::parse_foreign(text, path, columns)?,
            false => Self::parse(&crate::atomic_write::text(bytes.to_vec(), path)?, path)?,
        };
        Ok(vec![recording])
    }
}

/// A file, with the values that the user gives.
struct InstrumentFile<'f> {
    bytes: &'f [u8],
    path: &'f Path,
    columns: &'f ForeignColumns,
    given: &'f RecordingHeader,
}

impl InstrumentFile<'_> {
    fn damaged(&self, part: impl Into<String>, cause: &'static str) -> Error {
        Error::DamagedInstrumentFile {
            path: self.path.to_owned(),
            part: part.into(),
            cause,
        }
    }

    fn uncalibrated(&self, key: &'static str, what: &'static str) -> Error {
        Error::MissingCalibration {
            path: self.path.to_owned(),
            key,
            what,
        }
    }
}

/// One curve as an instrument measured it. All columns have one number for each sample.
#[derive(Debug, Default)]
struct Curve {
    /// [s]
    time: Vec<f64>,
    /// Of the cantilever's base, upwards [m].
    height: Vec<f64>,
    /// Of the cantilever, upwards as the tissue pushes [m].
    deflection: Vec<f64>,
    /// On the tissue [N].
    force: Vec<f64>,
}

impl Curve {
    /// The recording of this curve.
    fn recording(
        self,
        file: &InstrumentFile<'_>,
        part: &str,
        header: RecordingHeader,
        remarks: Vec<String>,
    ) -> Result<Recording, Error> {
        if self.time.is_empty() {
            return Err(file.damaged(part, "has no samples"));
        }
        let tip = || self.height.iter().zip(&self.deflection).map(|(z, d)| z + d);
        let from = tip().next().unwrap_or(0.0);
        let samples = Samples {
            depth_m: tip().map(|z| from - z).collect(),
            time_s: self.time,
            force_n: self.force,
        };
        let fits = |values: &[f64], domain: Domain| values.iter().all(|v| domain.contains(*v));
        if !fits(&samples.time_s, Domain::TIME)
            || !fits(&samples.depth_m, Domain::POSITION)
            || !fits(&samples.force_n, Domain::ANY_FORCE)
        {
            return Err(file.damaged(part, "has times, heights or forces that are none"));
        }
        if samples.time_s.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err(file.damaged(part, "has times that do not grow"));
        }
        Ok(Recording {
            remarks,
            origin: Origin::Instrument,
            ..Recording::new(header, samples)?
        })
    }
}
