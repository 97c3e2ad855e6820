//! Surfaces of the labels of a segmented volume.

use std::path::PathBuf;

use palpate_geometry::{
    Isosurface, IsosurfaceSettings, Label, LabelMap, isosurface as surface_of, read_label_map,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;
use crate::mesh::Mesh;
use crate::waiting::{Told, waiting};
use palpate_jobs::nearest;

/// The surfaces of organs from a segmented volume: NIfTI or NRRD.
///
/// Each is closed and in one piece, also where the border of the volume cuts the organ. Metres; x to the patient's
/// left, y to the back, z to the head, as all organs of one volume share it.
///
/// Parameters
/// ----------
/// path : path-like
///     The label map: .nii, .nii.gz or .nrrd.
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
///     By the label's name, or its number where it has none.
#[pyfunction]
#[pyo3(signature = (path, labels=None, *, triangles=20_000, smoothing=60, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn isosurface<'py>(
    py: Python<'py>,
    path: PathBuf,
    labels: Option<Vec<Wanted>>,
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
        surfaces(&map, &chosen, (&settings, told))
    })?;
    let dict = PyDict::new(py);
    for (name, mesh) in made {
        dict.set_item(name, Bound::new(py, mesh)?)?;
    }
    Ok(dict)
}

/// A label's name or number.
#[derive(Debug, FromPyObject)]
pub(crate) enum Wanted {
    Number(u16),
    Name(String),
}

impl Wanted {
    fn among<'l>(&self, labels: &'l [Label]) -> Result<&'l Label, Failure> {
        let words = match self {
            Self::Number(number) => number.to_string(),
            Self::Name(name) => name.clone(),
        };
        let is_wanted = |label: &&Label| {
            label.name.as_deref() == Some(&*words) || words.parse() == Ok(label.number)
        };
        labels
            .iter()
            .find(is_wanted)
            .ok_or_else(|| absent(labels, &words))
    }
}

fn absent(labels: &[Label], wanted: &str) -> Failure {
    let there: Vec<_> = labels.iter().map(named).collect();
    let names: Vec<&str> = labels
        .iter()
        .filter_map(|label| label.name.as_deref())
        .collect();
    let nearest = match names.is_empty() {
        true => String::new(),
        false => format!("the nearest is {}, and ", nearest(wanted, &names)),
    };
    match there.is_empty() {
        true => Failure::input("the volume has no label but zero; give one that is segmented"),
        false => Failure::input(format!(
            "the volume has no label {wanted:?}; {nearest}there are {}",
            there.join(", ")
        )),
    }
}

fn surfaces(
    map: &LabelMap,
    labels: &[&Label],
    (settings, told): (&IsosurfaceSettings, &Told),
) -> Result<Vec<(String, Mesh)>, Failure> {
    let mut made = Vec::new();
    for (number, label) in labels.iter().enumerate() {
        if told.is_asked_to_stop() {
            return Err(Failure::BrokenOff);
        }
        told.say(format!("the surface of {}", named(label)));
        told.at(number as f64 / labels.len() as f64);
        let found = surface_of(map, label.number, settings)?;
        let mut warnings = map.warnings().to_vec();
        warnings.extend(doubts(label, &found));
        let key = label.name.clone();
        let key = key.unwrap_or_else(|| label.number.to_string());
        made.push((key, Mesh::with_warnings(found.simplified.mesh, warnings)));
    }
    Ok(made)
}

fn doubts(label: &Label, found: &Isosurface) -> Vec<String> {
    let name = named(label);
    let all = [
        (
            found.other_pieces > 0,
            format!(
                "{name}: {} smaller pieces were left out, {} of {} voxels",
                found.other_pieces, found.other_voxels, label.voxels
            ),
        ),
        (
            found.filled_voxels > 0,
            format!(
                "{name}: {} voxels that were shut in were filled",
                found.filled_voxels
            ),
        ),
        (
            found.is_cut,
            format!("{name}: the border of the volume cuts it; it is closed by a flat side there"),
        ),
        (
            found.simplified.self_intersections > 0,
            format!(
                "{name}: {} triangles meet others; ask for more triangles",
                found.simplified.self_intersections
            ),
        ),
    ];
    all.into_iter()
        .filter(|(holds, _)| *holds)
        .map(|(_, text)| text)
        .collect()
}

fn named(label: &Label) -> String {
    match &label.name {
        Some(name) => format!("{} ({name})", label.number),
        None => label.number.to_string(),
    }
}
