//! Tables of pandas, which is asked for when one is wanted and not before.

use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;

/// A table of `columns`, with `attributes` beside it.
pub(crate) fn frame<'py>(
    columns: &Bound<'py, PyDict>,
    attributes: Bound<'py, PyDict>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let py = columns.py();
    let pandas = py.import("pandas").map_err(|cause| {
        let error = PyImportError::new_err(
            "a table needs pandas, which is not installed; `pip install palpate[pandas]`",
        );
        error.set_cause(py, Some(cause));
        error
    })?;
    let frame = pandas.call_method1("DataFrame", (columns,))?;
    frame.setattr("attrs", attributes)?;
    Ok(frame)
}
