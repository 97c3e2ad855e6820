//! `palpate design`: how to press next.

use palpate_jobs::design::{Request, design};
use palpate_jobs::json_text;
use pyo3::prelude::*;

use crate::failure::Failure;
use crate::waiting::waiting;

/// The answer, and the text of the protocol; `asked` is a [`Request`] as JSON.
#[pyfunction]
#[pyo3(signature = (asked, progress=None))]
pub(crate) fn _design(
    py: Python<'_>,
    asked: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<(String, String)> {
    let wish = Request::parse(asked).map_err(Failure::from)?;
    waiting(py, progress, move |told| {
        let found = design(&wish, told)?;
        Ok((json_text(&found.answer)?, found.protocol))
    })
}
