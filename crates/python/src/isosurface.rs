//! Surfaces of the labels of a segmented volume.

use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_geometry::{
    IsosurfaceSettings, Label, LabelMap, isosurface_with_progress as surface_of, read_label_map,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;
use crate::mesh::Mesh;
use crate::waiting::{ProgressMessage, waiting};
use palpate_jobs::label;

/// The surfaces of organs from a segmented volume: NIfTI, NRRD or a segmentation object of DICOM.
///
/// Each is closed and in one piece, also where the border of the volume cuts the organ. Metres; x to the patient's
/// left, y to the back, z to the head, as all organs of one volume share it.
///
/// Parameters
/// ----------
/// path : path-like
///     The label map: .nii, .nii.gz, .nrrd, a segmentation of DICOM, or a folder with one.
/// labels : list of str or int, optional
///     Names or numbers of the labels; all of them without.
/// triangles : int
///     How many triangles each surface has at most.
/// smoothing : int
///     Rounds of smoothing; 0 leaves the steps of the voxels.
/// progress : callable, False or None
///     Hears (part, words); False for silence, None for a bar.
///
/// Returns
/// -------
/// dict of str to Mesh
///     By the label's name, or its number where it has none or shares it with another.
#[pyfunction]
#[pyo3(signature = (path, labels=None, *, triangles=20_000, smoothing=60, progress=None))]
pub(crate) fn isosurface<'py>(
    py: Python<'py>,
    path: PathBuf,
    labels: Option<Vec<LabelChoice>>,
    triangles: usize,
    smoothing: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let settings = IsosurfaceSettings {
        smoothing,
        triangles,
    };
    let made = waiting(py, progress, |told| {
        told.say("reading the volume");
        let map = read_label_map(&path)?;
        let all = map.labels();
        let chosen: Vec<&Label> = match &labels {
            None => all.iter().collect(),
            Some(wanted) => wanted
                .iter()
                .map(|wanted| wanted.among(&all))
                .collect::<Result<_, _>>()?,
        };
        surfaces(&map, &chosen, &settings, told)
    })?;
    let dict = PyDict::new(py);
    for (name, mesh) in made {
        dict.set_item(name, Bound::new(py, mesh)?)?;
    }
    Ok(dict)
}

/// A label's name or number.
#[derive(Debug, FromPyObject)]
pub(crate) enum LabelChoice {
    Number(u16),
    Name(String),
}

impl LabelChoice {
    fn among<'l>(&self, labels: &'l [Label]) -> Result<&'l Label, Failure> {
        let words = match self {
            Self::Number(number) => number.to_string(),
            Self::Name(name) => name.clone(),
        };
        Ok(label::find(labels, &words)?)
    }
}

fn surfaces(
    map: &LabelMap,
    labels: &[&Label],
    settings: &IsosurfaceSettings,
    told: &ProgressMessage,
) -> Result<Vec<(String, Mesh)>, Failure> {
    let mut made = Vec::new();
    for (number, label) in labels.iter().enumerate() {
        told.say(format!("the surface of {}", label::in_words(label)));
        told.at(number as f64 / labels.len() as f64);
        let found = surface_of(map, label.number, settings, &mut |part| {
            told.at((number as f64 + part) / labels.len() as f64);
            match told.should_stop() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        let found = found?;
        let mut warnings = map.warnings().to_vec();
        warnings.extend(label::warnings(label, &found));
        let is_alone = labels
            .iter()
            .filter(|other| other.name == label.name)
            .count()
            == 1;
        let key = label.name.clone().filter(|_| is_alone);
        let key = key.unwrap_or_else(|| label.number.to_string());
        made.push((key, Mesh::with_warnings(found.simplified.mesh, warnings)));
    }
    Ok(made)
}
