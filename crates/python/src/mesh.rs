//! Meshes of triangles.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2};
use palpate_files::write_atomically;
use palpate_geometry::{
    AabbTree, Gaps, LengthUnit, MeshReport, NodeId, ReadError, ReadFault, SimplifySettings,
    Surface, TriangleMesh, WrapSettings, WriteFormat, inspect, read_mesh, repair, simplify,
};
use palpate_jobs::envelope::envelope;
use palpate_jobs::{builtin_organ, json_text};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};

use crate::failure::Failure;
use crate::waiting::waiting;
use crate::{documents, numbers, written};

/// Triangles over shared vertices.
///
/// Parameters
/// ----------
/// vertices : array_like, shape (n, 3)
///     Places [m].
/// triangles : array_like of int, shape (m, 3)
///     Numbers of vertices, counter-clockwise seen from outside.
///
/// Raises
/// ------
/// InputError
///     When there is no triangle, a number is not finite or a vertex is not there.
#[pyclass(frozen, module = "palpate")]
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    pub(crate) mesh: TriangleMesh,
    warnings: Vec<String>,
}

impl Mesh {
    pub(crate) fn with_warnings(mesh: TriangleMesh, warnings: Vec<String>) -> Self {
        Self { mesh, warnings }
    }

    fn report(&self, py: Python<'_>) -> MeshReport {
        py.detach(|| inspect(&self.mesh))
    }
}

#[pymethods]
impl Mesh {
    #[new]
    fn new(vertices: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let vertices = numbers::points(vertices, "vertices")?;
        let triangles = numbers::triples(triangles, "triangles")?;
        let triangles = triangles.into_iter().map(|corners| corners.map(NodeId));
        let mesh = TriangleMesh::new(vertices, triangles.collect())?;
        Ok(Self::with_warnings(mesh, Vec::new()))
    }

    /// Reads a mesh: STL, OBJ, PLY or glTF.
    ///
    /// Parameters
    /// ----------
    /// path : path-like
    ///     The file.
    /// unit : {"m", "cm", "mm", "um"}, optional
    ///     Its unit; without one, metres are taken where that makes a plausible organ.
    #[classmethod]
    #[pyo3(signature = (path, unit=None))]
    fn read(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        path: PathBuf,
        unit: Option<&str>,
    ) -> Result<Self, Failure> {
        let unit: Option<LengthUnit> = unit.map(str::parse).transpose()?;
        let imported = py.detach(|| read_mesh(&path, unit)).map_err(about_unit)?;
        let warnings = imported.warnings.iter();
        let warnings = warnings
            .map(|warning| in_words_of_python(warning))
            .collect();
        Ok(Self::with_warnings(imported.mesh, warnings))
    }

    /// A built-in organ.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     esophagus, liver, kidney, stomach, spleen, diaphragm, hemisphere, cube or slab.
    /// triangles : int, optional
    ///     How many it shall have.
    #[classmethod]
    #[pyo3(signature = (name, triangles=None))]
    fn builtin(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        name: &str,
        triangles: Option<usize>,
    ) -> Result<Self, Failure> {
        let organ = builtin_organ(name)?;
        let triangles = triangles.unwrap_or(organ.default_triangles());
        let mesh = py.detach(|| organ.surface_mesh(triangles))?;
        Ok(Self::with_warnings(mesh, Vec::new()))
    }

    /// Places of the vertices [m], a copy: float64, shape (n, 3).
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        numbers::rows(py, self.mesh.vertices().iter())
    }

    /// Numbers of the triangles' vertices, a copy: uint32, shape (m, 3).
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        corners(py, self.mesh.triangles())
    }

    /// Outward unit normals of the vertices [-]: shape (n, 3).
    ///
    /// Raises
    /// ------
    /// InputError
    ///     When the mesh bounds no solid.
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        let surface = py.detach(|| Surface::new(self.mesh.clone()))?;
        Ok(numbers::rows(py, surface.vertex_normals().iter()))
    }

    /// Enclosed volume [m³]; positive when a closed mesh faces outward.
    #[getter]
    fn volume(&self) -> f64 {
        self.mesh.volume()
    }

    /// Area [m²].
    #[getter]
    fn area(&self) -> f64 {
        self.mesh.area()
    }

    /// Size along x, y and z [m]: shape (3,).
    #[getter]
    fn extent<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let (low, high) = self.mesh.bounds();
        PyArray1::from_slice(py, (high - low).as_slice())
    }

    /// What is wrong, as `palpate mesh info` tells it: dicts with `kind`, `count` and `mend`; empty when the mesh
    /// bounds a solid of even triangles. It is searched for each time: a second for 100,000 triangles.
    #[getter]
    fn problems<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = json_text(&self.report(py).problems).map_err(Failure::from)?;
        documents::json(py, &in_words_of_python(&text))
    }

    /// Whether no edge has one triangle only.
    #[getter]
    fn is_closed(&self, py: Python<'_>) -> bool {
        self.report(py).closed
    }

    /// Distances of points from the surface [m], negative inside: shape (n,).
    ///
    /// Parameters
    /// ----------
    /// points : array_like, shape (n, 3)
    ///     Places [m].
    ///
    /// Raises
    /// ------
    /// InputError
    ///     When the mesh bounds no solid.
    fn signed_distances<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
    ) -> Result<Bound<'py, PyArray1<f64>>, Failure> {
        let points = numbers::points(points, "points")?;
        let distances = py.detach(|| {
            let surface = Surface::new(self.mesh.clone())?;
            let tree = AabbTree::new(surface.mesh());
            let distances = points.iter();
            let distances = distances.map(|point| surface.signed_distance(&tree, point).1);
            Ok::<Vec<f64>, Failure>(distances.collect())
        })?;
        Ok(PyArray1::from_vec(py, distances))
    }

    /// Plain sentences on warnings.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// The same surface with fewer, even triangles; it is repaired first.
    ///
    /// Parameters
    /// ----------
    /// triangles : int
    ///     How many there shall be; a closed mesh has an even number.
    fn simplify(&self, py: Python<'_>, triangles: usize) -> Result<Self, Failure> {
        let simplified = py.detach(|| {
            let (mesh, _) = repair(&self.mesh)?;
            Ok::<_, Failure>(simplify(&mesh, &SimplifySettings::to(triangles))?)
        })?;
        let warnings = simplified.warning().into_iter().collect();
        Ok(Self::with_warnings(simplified.mesh, warnings))
    }

    /// A closed surface around these triangles, which may have holes, pieces, double walls and self-intersections.
    ///
    /// Parameters
    /// ----------
    /// distance : float, optional
    ///     Largest distance of the surface from the triangles [m], by default 0.0005.
    /// close_gaps : float, optional
    ///     Width of gaps to close [m]; by default 2 mm where the body is open or in pieces without, else none.
    /// triangles : int, optional
    ///     How many the surface has at most, by default 100,000.
    /// progress : callable, False or None
    ///     Hears (part, words); False for silence, None for a bar.
    ///
    /// Returns
    /// -------
    /// Mesh
    ///     Closed, oriented outward and without self-intersections. Its ``warnings`` say where it is farther from the
    ///     triangles than ``distance``, and what was closed or left out.
    #[pyo3(signature = (*, distance=None, close_gaps=None, triangles=None, progress=None))]
    fn wrap(
        &self,
        py: Python<'_>,
        distance: Option<f64>,
        close_gaps: Option<f64>,
        triangles: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let usual = WrapSettings::default();
        let settings = WrapSettings {
            distance: distance.unwrap_or(usual.distance),
            gaps: close_gaps.map_or(usual.gaps, Gaps::Close),
            triangles: triangles.unwrap_or(usual.triangles),
            ..usual
        };
        let mesh = self.mesh.clone();
        let found = waiting(py, progress, move |told| {
            Ok(envelope(&mesh, &settings, told)?)
        })?;
        Ok(Self::with_warnings(
            found.wrapped.surface.mesh().clone(),
            found.warnings,
        ))
    }

    /// Writes it in metres, whole or not at all: .stl, .obj, .ply or .vtp. A file that exists is replaced with
    /// `overwrite=True`, else it is an error.
    #[pyo3(signature = (path, overwrite=false))]
    fn write(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> Result<(), Failure> {
        let format = WriteFormat::of(&path).map_err(|fault| ReadError {
            path: path.clone(),
            fault,
        })?;
        py.detach(|| {
            written::write(&path, overwrite, |path| {
                write_atomically(path, &format.bytes(&self.mesh, LengthUnit::Metre))
            })
        })
    }

    fn __len__(&self) -> usize {
        self.mesh.triangles().len()
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.mesh == other.mesh
    }

    fn __repr__(&self) -> String {
        let [x, y, z] = {
            let (low, high) = self.mesh.bounds();
            (high - low).map(|length| 1e3 * length).into()
        };
        format!(
            "<palpate.Mesh of {} vertices and {} triangles, {x:.1} x {y:.1} x {z:.1} mm>",
            self.mesh.vertices().len(),
            self.mesh.triangles().len()
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, own) = (slf.py(), slf.get());
        let parts = (own.vertices(py), own.triangles(py)).into_pyobject(py)?;
        (slf.get_type(), parts).into_pyobject(py)
    }
}

/// Numbers of vertices, three in a row.
pub(crate) fn corners<'py>(
    py: Python<'py>,
    triangles: &[[NodeId; 3]],
) -> Bound<'py, PyArray2<u32>> {
    let flat = triangles.iter().flatten().map(|node| node.0).collect();
    numbers::array(py, [triangles.len(), 3], flat)
}

/// The reader speaks of the scene's key, here it is an argument.
fn about_unit(error: ReadError) -> Failure {
    match error.fault {
        ReadFault::UnitNeeded { .. } => Failure::input(in_words_of_python(&error.to_string())),
        _ => error.into(),
    }
}

fn in_words_of_python(message: &str) -> String {
    message.replace("mesh_unit", "unit")
}
