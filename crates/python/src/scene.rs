//! What stands in a scene.

use std::path::PathBuf;

use palpate_files::Scene as Document;
use palpate_files::scene::Task;
use palpate_jobs::nearest;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use toml::Value;

use crate::documents;
use crate::failure::Failure;

/// What stands for the file of a scene that comes from Python in a sentence.
const NAME: &str = "scene";

/// Scenes that come with the program.
const BUILT_IN: [(&str, &str); 6] = [
    (
        "esophagus",
        include_str!("../../../assets/esophagus/scene.toml"),
    ),
    (
        "palpation",
        include_str!("../../../assets/tasks/palpation.toml"),
    ),
    (
        "traction",
        include_str!("../../../assets/tasks/traction.toml"),
    ),
    (
        "retraction",
        include_str!("../../../assets/tasks/retraction.toml"),
    ),
    (
        "cutting",
        include_str!("../../../assets/tasks/cutting.toml"),
    ),
    (
        "myotomy",
        include_str!("../../../assets/tasks/myotomy.toml"),
    ),
];

/// A scene: an organ, its tissue, the model that moves it and the tools that touch it.
///
/// Parameters
/// ----------
/// content : dict
///     What a scene's file holds; ``format`` may be left out. Paths begin in the working folder.
/// seed : int, default 0
///     Which variant of a scene that draws its numbers (``[draw]``).
#[pyclass(frozen, module = "palpate")]
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    pub(crate) scene: Document,
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (content, seed=0))]
    fn new(content: &Bound<'_, PyDict>, seed: u64) -> Result<Self, Failure> {
        let mut table = documents::table(content, "")?;
        table.entry("format").or_insert(Value::Integer(1));
        Self::drawn(&Document::parse(&documents::text(&table)?, NAME)?, seed)
    }

    /// A scene that comes with the program.
    ///
    /// Parameters
    /// ----------
    /// name : {"esophagus", "palpation", "traction", "retraction", "cutting", "myotomy"}
    ///     The esophagus without anything to do, or a task: find the stiff spot in a liver, hold an even pull, lift a
    ///     lobe of a liver and touch what it covers, cut a circle out of a sheet, cut the muscle of the lower esophagus.
    /// seed : int, default 0
    ///     Which variant of the task.
    #[classmethod]
    #[pyo3(signature = (name, seed=0))]
    fn builtin(_class: &Bound<'_, PyType>, name: &str, seed: u64) -> Result<Self, Failure> {
        let Some((name, text)) = BUILT_IN.iter().find(|(known, _)| *known == name) else {
            let names = BUILT_IN.map(|(name, _)| name);
            return Err(Failure::input(format!(
                "there is no built-in scene `{name}`; the nearest is `{}`, and there are {}",
                nearest(name, &names),
                names.join(", ")
            )));
        };
        Self::drawn(
            &Document::parse(text, format!("built-in scene {name}"))?,
            seed,
        )
    }

    /// Reads a scene's file; of one that draws its numbers the variant of ``seed``.
    #[classmethod]
    #[pyo3(signature = (path, seed=0))]
    fn read(_class: &Bound<'_, PyType>, path: PathBuf, seed: u64) -> Result<Self, Failure> {
        Self::drawn(&Document::read(path)?, seed)
    }

    /// Reads the text of a scene's file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     The text.
    /// folder : path-like, optional
    ///     Where the paths in it begin; without one in the working folder.
    /// seed : int, default 0
    ///     Which variant of a scene that draws its numbers.
    #[classmethod]
    #[pyo3(signature = (text, folder=None, seed=0))]
    fn parse(
        _class: &Bound<'_, PyType>,
        text: &str,
        folder: Option<PathBuf>,
        seed: u64,
    ) -> Result<Self, Failure> {
        let path = folder.unwrap_or_default().join(NAME);
        Self::drawn(&Document::parse(text, path)?, seed)
    }

    /// The names of the tools, in the order of the scene.
    #[getter]
    fn tools(&self) -> Vec<String> {
        let tools = self.scene.tools.iter();
        tools.map(|tool| tool.name.clone()).collect()
    }

    /// Length of the model's step [s].
    #[getter]
    fn step(&self) -> f64 {
        self.scene.model.step_s
    }

    /// What there is to do, as the table `task` of the file; empty where nothing is.
    #[getter]
    fn task<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyDict>, Failure> {
        let task = self.to_dict(py)?.get_item("task")?;
        let task = task.map(|task| task.cast_into::<PyDict>());
        let task = task
            .transpose()
            .map_err(|error| Failure::Python(error.into()))?;
        Ok(task.unwrap_or_else(|| PyDict::new(py)))
    }

    /// The text of its file, which means the same in any folder.
    fn to_toml(&self) -> String {
        // Every scene here was read from a text.
        self.scene.written.clone().unwrap_or_default()
    }

    /// What its file holds.
    fn to_dict<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyDict>, Failure> {
        documents::dict(py, &self.to_toml())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.scene.written == other.scene.written
    }

    fn __repr__(&self) -> String {
        let title = self.scene.task.title.as_deref();
        let title = title.map_or(String::new(), |title| format!(" {title:?}"));
        format!(
            "<palpate.Scene{title} with the tools {}>",
            self.tools().join(", ")
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let parse = slf.get_type().getattr("parse")?;
        (parse, (slf.get().to_toml(),)).into_pyobject(slf.py())
    }
}

impl Scene {
    fn drawn(scene: &Document, seed: u64) -> Result<Self, Failure> {
        let scene = palpate_simulate::draw_variant(scene, seed)?;
        Ok(Self { scene })
    }

    /// What there is to do; none where nobody judges.
    pub(crate) fn judged(scene: &Document) -> Option<&Task> {
        (scene.task != Task::default()).then_some(&scene.task)
    }
}
