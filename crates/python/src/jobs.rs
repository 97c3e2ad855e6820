//! Jobs, as `palpate.jobs` asks for them: documents and choices come in as text, answers go out as JSON, which is
//! what the command prints.
//!
//! A job that cannot end in good order is cancelled by Ctrl-C where it tells how far it is: its thread unwinds,
//! as no file is half written there.

use std::path::PathBuf;

use palpate_files::{Overwrite, Protocol, Scene};
use palpate_jobs::characterize::{Choice, NamedSpecimen, StudyFolder};
use palpate_jobs::measure::{Measuring, Out, Plan};
use palpate_jobs::preparation::resources;
use palpate_jobs::solve::{Problem, RequestedOutputs, in_words};
use palpate_jobs::{ProgressCallback, Recordings, Unusable, json_text};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use toml::Value;

use crate::documents;
use crate::failure::Failure;
use crate::fits;
use crate::waiting::{ProgressMessage, waiting};

/// Why a thread unwinds.
struct Cancelled;

impl ProgressCallback for ProgressMessage {
    fn report_step(&self, doing: &str) {
        break_off_if_asked(self);
        Self::say(self, doing);
    }

    fn report_fraction(&self, part: f64) {
        break_off_if_asked(self);
        Self::at(self, part);
    }

    fn should_stop(&self) -> bool {
        Self::should_stop(self)
    }
}

fn break_off_if_asked(told: &ProgressMessage) {
    if told.should_stop() {
        std::panic::resume_unwind(Box::new(Cancelled));
    }
}

/// A document: a file, or a text whose files are looked for beside the path it is called by.
type Given = (PathBuf, Option<String>);

/// What a solution comes with: the answer, the same in words, what is drawn of it, the body for ParaView, and the
/// recording of a ramp.
type Solved<'py> = (
    String,
    String,
    String,
    Option<Bound<'py, PyBytes>>,
    Option<String>,
);

/// The text of a tissue's file, or why there is none.
type FoundTissue = (Option<String>, Option<String>);

/// `palpate solve`.
#[pyfunction]
#[pyo3(signature = (problem, plot, vtu, progress=None))]
pub(crate) fn _solve(
    py: Python<'_>,
    problem: Given,
    plot: bool,
    vtu: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Solved<'_>> {
    let (answer, words, plot, vtu, recording) = waiting(py, progress, move |told| {
        let problem = match problem {
            (path, None) => Problem::read(&path)?,
            (path, Some(text)) => Problem::parse(&text, &path)?,
        };
        let answer = palpate_jobs::solve::solve(&problem, RequestedOutputs { plot, vtu }, told)?;
        let (json, words) = (json_text(&answer)?, in_words(&problem, &answer));
        let solution = answer.solution;
        let recording = solution.recording.as_ref().map(|own| own.to_csv());
        let plot = json_text(&solution.plot)?;
        Ok((json, words, plot, solution.vtu, recording))
    })?;
    let vtu = vtu.map(|bytes| PyBytes::new(py, &bytes));
    Ok((answer, words, plot, vtu, recording))
}

/// `palpate analyze`; `recordings` are [`Recordings`] as JSON.
#[pyfunction]
#[pyo3(signature = (recordings, progress=None))]
pub(crate) fn _analyze(
    py: Python<'_>,
    recordings: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let recordings = parse_recordings(recordings)?;
    waiting(py, progress, move |told| {
        let analyzed = palpate_jobs::analyze::analyze(&recordings, told)?;
        Ok(json_text(&analyzed)?)
    })
}

/// What a characterization comes with: the answer, tissues, and what was fitted of each specimen.
type Fitted<'py> = (String, Vec<FoundTissue>, Vec<Vec<Bound<'py, PyDict>>>);

/// How `palpate characterize` fits, as a dictionary.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct FitSettings {
    law: Option<String>,
    order: Option<usize>,
    terms: Option<usize>,
    draws: usize,
    seed: u64,
    in_loop: bool,
    closed_forms: bool,
}

/// `palpate characterize`: the answer, the tissue of each specimen or why there is none, and what was fitted.
#[pyfunction]
#[pyo3(signature = (recordings, settings, study=None, overwrite=false, progress=None))]
pub(crate) fn _characterize<'py>(
    py: Python<'py>,
    recordings: &str,
    settings: FitSettings,
    study: Option<PathBuf>,
    overwrite: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Fitted<'py>> {
    let recordings = parse_recordings(recordings)?;
    let (answer, tissues, fits) = waiting(py, progress, move |told| {
        let choice = Choice {
            law: settings
                .law
                .map(|name| Choice::law_named(&name, settings.order))
                .transpose()?,
            terms: settings.terms,
            draws: settings.draws,
            seed: settings.seed,
            in_loop: settings.in_loop,
            closed_forms: settings.closed_forms,
        };
        let open = |path: PathBuf| StudyFolder::open(&path, Overwrite::of_option(overwrite));
        let folder = study.map(open).transpose()?;
        let found =
            palpate_jobs::characterize::characterize(&recordings, choice, folder.as_ref(), told)?;
        let tissues = found.tissues.into_iter().map(|tissue| match tissue {
            Ok(text) => (Some(text), None),
            Err(why) => (None, Some(why.to_string())),
        });
        let tissues: Vec<FoundTissue> = tissues.collect();
        Ok((json_text(&found.answer)?, tissues, found.samples))
    })?;
    let each = fits.into_iter().map(|specimen| {
        let recordings = specimen.into_iter();
        recordings
            .map(|(file, fit)| fits::samples(py, file, fit))
            .collect()
    });
    Ok((answer, tissues, each.collect::<PyResult<_>>()?))
}

/// The specimens among `recordings`, what each is called and its files; and the sentences about what cannot be used.
#[pyfunction]
pub(crate) fn _specimens(recordings: &str) -> PyResult<(Vec<NamedSpecimen>, Vec<String>)> {
    let recordings = parse_recordings(recordings)?;
    let (found, unusable) =
        palpate_jobs::characterize::specimens(&recordings).map_err(Failure::from)?;
    Ok((found, unusable.iter().map(Unusable::sentence).collect()))
}

/// `palpate measure --headless` into a folder or file, whose recordings may be lost or not.
#[pyfunction]
#[pyo3(signature = (protocol, out, overwrite, seed, progress=None))]
pub(crate) fn _measure(
    py: Python<'_>,
    protocol: Option<Given>,
    out: PathBuf,
    overwrite: bool,
    seed: u64,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    waiting(py, progress, move |told| {
        let protocol = match protocol {
            None => Protocol::parse(palpate_jobs::measure::DEFAULT, "the default protocol")?,
            Some((path, None)) => Protocol::read(&path)?,
            Some((path, Some(text))) => Protocol::parse(&text, &path)?,
        };
        let measuring = Measuring::of(Plan::of(protocol, seed)?, told)?;
        let out = Out {
            path: &out,
            overwrite: Overwrite::of_option(overwrite),
        };
        let files = palpate_jobs::measure::files(&measuring, out)?;
        let recorded = measuring.run(&files, told)?;
        let answer = palpate_jobs::measure::Answer::new(recorded, &measuring);
        Ok(json_text(&answer)?)
    })
}

/// `palpate precompute`.
#[pyfunction]
#[pyo3(signature = (scene, memory=None, progress=None))]
pub(crate) fn _precompute(
    py: Python<'_>,
    scene: Given,
    memory: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    waiting(py, progress, move |told| {
        let scene = match scene {
            (path, None) => Scene::read(&path)?,
            (path, Some(text)) => Scene::parse(&text, &path)?,
        };
        let mut resources = resources();
        if let Some(bytes) = memory {
            resources.memory = bytes as usize;
        }
        let answer = palpate_jobs::preparation::precompute(scene, &resources, told)?;
        Ok(json_text(&answer)?)
    })
}

/// What is measured without a protocol.
#[pyfunction]
pub(crate) fn _default_protocol() -> &'static str {
    palpate_jobs::measure::DEFAULT
}

/// The text of a document.
#[pyfunction]
pub(crate) fn _toml(document: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = documents::table(document, "").and_then(|mut table| {
        table.entry("format").or_insert(Value::Integer(1));
        documents::text(&table)
    });
    Ok(table?)
}

fn parse_recordings(recordings: &str) -> Result<Recordings, Failure> {
    serde_json::from_str(recordings).map_err(Failure::input)
}

/// Puts the jobs into the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(_solve, module)?)?;
    module.add_function(wrap_pyfunction!(_analyze, module)?)?;
    module.add_function(wrap_pyfunction!(_characterize, module)?)?;
    module.add_function(wrap_pyfunction!(crate::design::_design, module)?)?;
    module.add_function(wrap_pyfunction!(fits::_evaluate, module)?)?;
    module.add_function(wrap_pyfunction!(_specimens, module)?)?;
    module.add_function(wrap_pyfunction!(_measure, module)?)?;
    module.add_function(wrap_pyfunction!(_precompute, module)?)?;
    module.add_function(wrap_pyfunction!(_default_protocol, module)?)?;
    module.add_function(wrap_pyfunction!(_toml, module)?)
}
