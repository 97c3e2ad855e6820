//! Recordings: depth and force against time.

use std::path::PathBuf;

use numpy::PyArray1;
use palpate_files::Recording as Document;
use palpate_files::recording::{ForeignColumns, RecordingHeader, Samples, SensorAxes};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::failure::Failure;
use crate::{documents, frames, numbers, written};

/// A recording of an indentation.
///
/// Parameters
/// ----------
/// time : array_like, shape (n,)
///     The times [s], each after the one before it.
/// depth : array_like, shape (n,)
///     The depths [m], positive into the tissue from first contact.
/// force : array_like, shape (n,)
///     The forces on the tissue [N], positive into it.
/// header : dict, optional
///     What is known of the specimen, the indenter and the stimulus, by the keys of a recording's file.
#[pyclass(frozen, module = "palpate")]
#[derive(Debug, Clone)]
pub(crate) struct Recording {
    pub(crate) recording: Document,
}

#[pymethods]
impl Recording {
    #[new]
    #[pyo3(signature = (time, depth, force, header=None))]
    fn new(
        time: &Bound<'_, PyAny>,
        depth: &Bound<'_, PyAny>,
        force: &Bound<'_, PyAny>,
        header: Option<&Bound<'_, PyDict>>,
    ) -> Result<Self, Failure> {
        let header = match header {
            None => RecordingHeader::default(),
            Some(given) => {
                let text = documents::header(given)? + "time_s,depth_m,force_n\n0,0,0\n";
                Document::parse(&text, "header")?.header
            }
        };
        let samples = Samples {
            time_s: numbers::list(time, "time")?,
            depth_m: numbers::list(depth, "depth")?,
            force_n: numbers::list(force, "force")?,
        };
        let recording = Document::new(header, samples)?;
        Ok(Self { recording })
    }

    /// Reads a recording, the file of an instrument, or the table of another program.
    ///
    /// Parameters
    /// ----------
    /// path : path-like
    ///     The file. One that says its format is a recording; any other is a table of another program, unless a
    ///     column is named.
    /// time, depth, force : str, optional
    ///     The columns of a table of another program; found by their names if not given.
    /// depth_unit : {"m", "mm", "um", "nm"}, optional
    ///     The unit of the depth, where its name does not say it.
    /// force_unit : {"N", "mN", "uN", "nN"}, optional
    ///     The unit of the force, where its name does not say it.
    #[classmethod]
    #[pyo3(signature = (path, time=None, depth=None, force=None, depth_unit=None, force_unit=None))]
    fn read(
        _class: &Bound<'_, PyType>,
        path: PathBuf,
        time: Option<String>,
        depth: Option<String>,
        force: Option<String>,
        depth_unit: Option<String>,
        force_unit: Option<String>,
    ) -> Result<Self, Failure> {
        let columns = ForeignColumns {
            time,
            depth,
            force,
            depth_unit,
            force_unit,
        };
        let all = Document::read_all(&path, &columns, &RecordingHeader::default());
        let mut all = all.map_err(in_words_of_python)?;
        let count = all.len();
        let recording = all.swap_remove(0);
        if count > 1 {
            return Err(Failure::input(format!(
                "{} holds {count} recordings; give it to palpate.characterize, which reads all",
                path.display()
            )));
        }
        Ok(Self { recording })
    }

    /// The times [s], a copy: shape (n,).
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.recording.time_s())
    }

    /// The depths [m], a copy: shape (n,).
    #[getter]
    fn depth<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.recording.depth_m())
    }

    /// The forces [N], a copy: shape (n,).
    #[getter]
    fn force<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.recording.force_n())
    }

    /// What is known of the specimen, the indenter and the stimulus, by the keys of a recording's file.
    #[getter]
    fn header<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyDict>, Failure> {
        let header = &self.recording.header;
        let text: String = header
            .entries()
            .iter()
            .map(|(key, value)| format!("{key} = {value}\n"))
            .collect();
        let dict = documents::dict(py, &text)?;
        for extra in &header.extra {
            dict.set_item(&extra.key, &extra.value)?;
        }
        Ok(dict)
    }

    /// Why samples may be missing, in words; None for a recording with its end mark, and for other programs' tables.
    #[getter]
    fn incomplete(&self) -> Option<String> {
        self.recording.incomplete().map(ToString::to_string)
    }

    /// Whether it is from a table of another program, which has zeros and signs of its own.
    #[getter]
    fn is_foreign(&self) -> bool {
        self.recording.is_foreign()
    }

    /// What was done to read the table of another program, in plain sentences.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.recording.remarks().to_vec()
    }

    /// A pandas.DataFrame with the columns of a recording's file; its `attrs` are the header.
    fn to_frame<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyAny>, Failure> {
        let columns = PyDict::new(py);
        columns.set_item("time_s", self.time(py))?;
        columns.set_item("depth_m", self.depth(py))?;
        columns.set_item("force_n", self.force(py))?;
        if let Some(axes) = self.recording.axes() {
            for (name, values) in SensorAxes::COLUMNS.iter().zip(&axes.columns) {
                columns.set_item(name, PyArray1::from_slice(py, values))?;
            }
        }
        for column in self.recording.extra_columns() {
            match column.numbers() {
                Some(numbers) => columns.set_item(&column.name, PyArray1::from_vec(py, numbers))?,
                None => columns.set_item(&column.name, &column.values)?,
            }
        }
        frames::frame(&columns, self.header(py)?)
    }

    /// Writes a recording's file, whole or not at all. A file that exists is replaced with
    /// `overwrite=True`, else it is an error.
    #[pyo3(signature = (path, overwrite=false))]
    fn write(&self, path: PathBuf, overwrite: bool) -> Result<(), Failure> {
        written::write(&path, overwrite, |path| self.recording.write(path))
    }

    fn __len__(&self) -> usize {
        self.recording.time_s().len()
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.recording == other.recording
    }

    fn __repr__(&self) -> String {
        let times = self.recording.time_s();
        let duration = times
            .last()
            .zip(times.first())
            .map(|(last, first)| last - first);
        format!(
            "<palpate.Recording of {} samples over {:?} s>",
            times.len(),
            duration.unwrap_or_default()
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, own) = (slf.py(), slf.get());
        let parts = (own.time(py), own.depth(py), own.force(py), own.header(py)?);
        (slf.get_type(), parts.into_pyobject(py)?).into_pyobject(py)
    }
}

/// The reader speaks of options, here they are arguments.
fn in_words_of_python(error: palpate_files::Error) -> Failure {
    use palpate_files::Error::{AmbiguousColumn, UnknownUnit, UnrecognizedColumn};
    match error {
        AmbiguousColumn { .. } | UnrecognizedColumn { .. } | UnknownUnit { .. } => {
            let mut said = error.to_string();
            for name in ["time", "depth", "force"] {
                said = said.replace(&format!("--{name}-unit "), &format!("{name}_unit="));
                said = said.replace(&format!("--{name} "), &format!("{name}="));
            }
            Failure::input(said)
        }
        error => error.into(),
    }
}
