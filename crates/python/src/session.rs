//! Sessions: what happened when an organ was touched.

use std::path::{Path, PathBuf};

use numpy::PyArray1;
use palpate_files::{
    Claim, MAX_DOCUMENT_BYTES, Overwrite, Session as Document, SessionRow, read_text,
};
use palpate_jobs::json_text;
use palpate_simulate::performance;
use palpate_simulate::{SessionFolder, SessionFolderWriter, Summary};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::failure::Failure;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::simulator::Model;
use crate::{documents, frames, numbers};

/// The file of a summary, beside that of a session.
const SUMMARY: &str = "summary.json";

/// A session: for each tool and step its pose, its force and what it did.
#[pyclass(frozen, module = "palpate")]
pub(crate) struct Session {
    session: Document,
    scene: Option<palpate_files::Scene>,
    /// JSON, as `palpate simulate` writes it.
    summary: Option<String>,
}

impl Session {
    /// What `rows` of a motion came to.
    pub(crate) fn played(model: &Model, rows: Vec<SessionRow>, summary: &Summary) -> Self {
        let tools = model.prepared.tools().iter();
        Self {
            session: Document {
                header: model.prepared.session_header(),
                tools: tools.map(|tool| tool.name.clone()).collect(),
                rows,
                has_torques: true,
                incomplete: None,
            },
            scene: Some(model.scene.clone()),
            summary: json_text(summary).ok(),
        }
    }

    /// Reads a session from its folder, or from its file alone.
    pub(crate) fn of_folder(path: &Path) -> Result<Self, Failure> {
        let folder = SessionFolder::read(path)?;
        let beside = match path.is_dir() {
            true => path.join(SUMMARY),
            false => path.with_file_name(SUMMARY),
        };
        Ok(Self {
            session: folder.session,
            scene: folder.scene,
            summary: read_text(beside, MAX_DOCUMENT_BYTES).ok(),
        })
    }

    fn column(&self, of: impl Fn(&SessionRow) -> f64) -> Vec<f64> {
        self.session.rows.iter().map(of).collect()
    }
}

#[pymethods]
impl Session {
    /// Reads a session from its folder, or from its file alone.
    #[classmethod]
    fn read(_class: &Bound<'_, PyType>, path: PathBuf) -> Result<Self, Failure> {
        Self::of_folder(&path)
    }

    /// The names of the tools.
    #[getter]
    fn tools(&self) -> Vec<String> {
        self.session.tools.clone()
    }

    /// Under which conditions it was played.
    #[getter]
    fn header<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let header = &self.session.header;
        let dict = PyDict::new(py);
        dict.set_item("version", &header.version)?;
        dict.set_item("scene_digest", &header.scene_digest)?;
        dict.set_item("model", header.model.word())?;
        dict.set_item("step_s", header.step_s)?;
        dict.set_item("seed", header.seed)?;
        dict.set_item("force_scale", header.force_scale)?;
        Ok(dict)
    }

    /// Why rows may be missing, in words; None for a session with its end mark.
    #[getter]
    fn incomplete(&self) -> Option<String> {
        self.session.incomplete.as_ref().map(ToString::to_string)
    }

    /// The scene that it happened in; None for a session that was recorded without it.
    #[getter]
    fn scene(&self) -> Option<Scene> {
        let scene = self.scene.clone();
        scene.map(|scene| Scene { scene })
    }

    /// What it came to: what the command wrote into summary.json, or the same counts of a session that was played
    /// here; empty where neither is known.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.summary {
            Some(text) => documents::json(py, text),
            None => Ok(PyDict::new(py).into_any()),
        }
    }

    /// The columns of a session's file by their names: arrays of numbers and truths, lists of texts.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = &self.session.rows;
        let columns = PyDict::new(py);
        let add = |name: &str, of: &dyn Fn(&SessionRow) -> f64| {
            columns.set_item(name, PyArray1::from_vec(py, self.column(of)))
        };
        let truths = |name: &str, of: &dyn Fn(&SessionRow) -> bool| {
            let truths = rows.iter().map(of).collect();
            columns.set_item(name, numbers::array(py, [rows.len()], truths))
        };
        add("time_s", &|row| row.time_s)?;
        let names: Vec<&str> = rows
            .iter()
            .map(|row| &*self.session.tools[row.tool])
            .collect();
        columns.set_item("tool", names)?;
        for (axis, name) in ["x_m", "y_m", "z_m"].into_iter().enumerate() {
            add(name, &|row| row.position_m[axis])?;
        }
        for (axis, name) in ["qx", "qy", "qz", "qw"].into_iter().enumerate() {
            add(name, &|row| row.orientation[axis])?;
        }
        add("grip", &|row| row.grip)?;
        truths("cut", &|row| row.cut)?;
        for (axis, name) in ["fx_n", "fy_n", "fz_n"].into_iter().enumerate() {
            add(name, &|row| row.force_n[axis])?;
        }
        for (axis, name) in ["tx_nm", "ty_nm", "tz_nm"].into_iter().enumerate() {
            add(name, &|row| row.torque_nm[axis])?;
        }
        truths("contact", &|row| row.contact)?;
        add("depth_m", &|row| row.depth_m)?;
        let events: Vec<String> = rows.iter().map(SessionRow::event_text).collect();
        columns.set_item("event", events)?;
        add("grip_force_n", &|row| row.grip_force_n)?;
        Ok(columns)
    }

    /// A pandas.DataFrame with the columns of a session's file; its `attrs` are the header.
    fn to_frame<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyAny>, Failure> {
        frames::frame(&self.columns(py)?, self.header(py)?)
    }

    /// The motion that was played, to be played again.
    fn motion(&self) -> Result<Motion, Failure> {
        let motion = self.session.motion()?;
        Ok(Motion { motion })
    }

    /// How well the task was done, as `palpate score` tells it; that of `scene` if one is given.
    #[pyo3(signature = (scene=None))]
    fn score<'py>(&self, py: Python<'py>, scene: Option<&Scene>) -> PyResult<Bound<'py, PyDict>> {
        let scene = scene.map(|scene| &scene.scene).or(self.scene.as_ref());
        let task = scene.map(|scene| scene.task.clone()).unwrap_or_default();
        let score = performance::score(&task, &self.session.tools, &self.session.rows);
        crate::simulator::score::dict(py, &score, &task)
    }

    /// Writes session.csv, and scene.toml where the scene is known, into a folder, which is made. A session that is
    /// there is replaced with `overwrite=True`, else it is an error.
    #[pyo3(signature = (folder, overwrite=false))]
    fn write(&self, py: Python<'_>, folder: PathBuf, overwrite: bool) -> Result<(), Failure> {
        py.detach(|| write(&folder, self, Overwrite::of_option(overwrite)))
    }

    fn __len__(&self) -> usize {
        self.session.rows.len()
    }

    fn __repr__(&self) -> String {
        let (rows, tools) = (self.session.rows.len(), self.session.tools.join(", "));
        format!("<palpate.Session of {rows} rows of {tools}>")
    }
}

fn write(folder: &Path, own: &Session, overwrite: Overwrite) -> Result<(), Failure> {
    if let Some(why) = &own.session.incomplete {
        return Err(Failure::input(format!(
            "the session is {why}, and written again it would pass for a whole one; copy its folder instead"
        )));
    }
    let Document {
        header,
        tools,
        rows,
        ..
    } = &own.session;
    let folder = Claim::of_folder(folder, overwrite)?;
    let scene = own.scene.as_ref();
    let scene = scene.and_then(|scene| scene.written.as_deref());
    let mut writer = SessionFolderWriter::begin(folder, scene, header, tools)?;
    for row in rows {
        writer.write(row)?;
    }
    writer.finish()?;
    Ok(())
}
