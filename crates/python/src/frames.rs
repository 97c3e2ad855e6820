//! Tables of pandas, which is asked for when one is wanted and not before.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::Failure;

/// A table of `columns`, with `attributes` beside it.
pub(crate) fn frame<'py>(
    columns: &Bound<'py, PyDict>,
    attributes: Bound<'py, PyDict>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let pandas = columns.py().import("pandas")?;
    let frame = pandas.call_method1("DataFrame", (columns,))?;
    frame.setattr("attrs", attributes)?;
    Ok(frame)
}
