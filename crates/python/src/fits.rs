//! Samples of fits as arrays, and laws at other depths.

use numpy::IntoPyArray;
use palpate_jobs::characterize::{DrawnFit, FoundLaw};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;
use crate::numbers;

/// A recording that was fitted, with its file: arrays by their names, those of laws under `laws`.
pub(crate) fn samples<'py>(
    py: Python<'py>,
    file: String,
    fit: DrawnFit,
) -> PyResult<Bound<'py, PyDict>> {
    let laws = PyDict::new(py);
    for law in fit.laws {
        let values = (law.values.into_pyarray(py), law.reach.into_pyarray(py));
        laws.set_item(law.law, values)?;
    }
    let own = PyDict::new(py);
    own.set_item("file", file)?;
    own.set_item("is_piece", fit.is_piece)?;
    let test = fit.test.map(serde_json::to_value).transpose();
    let test = test.map_err(Failure::input)?;
    own.set_item("test", test.as_ref().and_then(|own| own.as_str()))?;
    own.set_item("fibre_axis_angle_deg", fit.fibre_axis_angle_deg)?;
    own.set_item("time", fit.time.into_pyarray(py))?;
    own.set_item("course", fit.course.into_pyarray(py))?;
    own.set_item("measured", fit.measured.into_pyarray(py))?;
    own.set_item("laws", laws)?;
    Ok(own)
}

/// Forces or stresses of a law, given as JSON, over a course, and their standard errors.
#[pyfunction]
#[pyo3(signature = (law, time, course))]
pub(crate) fn _evaluate<'py>(
    py: Python<'py>,
    law: &str,
    time: Option<&Bound<'py, PyAny>>,
    course: &Bound<'py, PyAny>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let law: FoundLaw = serde_json::from_str(law).map_err(Failure::input)?;
    let time = time.map(|time| numbers::list(time, "time")).transpose()?;
    let course = numbers::list(course, "depth")?;
    let found = law
        .evaluate(time.as_deref(), &course)
        .map_err(Failure::from)?;
    let (values, errors): (Vec<f64>, Vec<f64>) = found.into_iter().map(<(f64, f64)>::from).unzip();
    Ok((
        values.into_pyarray(py).into_any(),
        errors.into_pyarray(py).into_any(),
    ))
}
