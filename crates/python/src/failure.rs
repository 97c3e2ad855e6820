//! What the libraries refuse, as Python's exceptions: the sentences of the command, as `palpate.InputError` where the
//! command ends with status 2 and as `palpate.PalpateError` where it ends with 1. Python prints them to a terminal, so
//! that characters which a terminal obeys are escapes in them.

use std::fmt;

use palpate_files::printable;
use palpate_jobs::Error;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Why something cannot be done. The message is one sentence: the cause, then how to fix it.
#[derive(Debug)]
pub(crate) enum Failure {
    /// `palpate.InputError` or `palpate.PalpateError`.
    Job(Error),
    /// What Python itself refuses.
    Python(PyErr),
}

impl Failure {
    pub(crate) fn input(message: impl fmt::Display) -> Self {
        Self::Job(Error::input(message))
    }

    pub(crate) fn failed(message: impl fmt::Display) -> Self {
        Self::Job(Error::failed(message))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        use palpate_files::Error::BadContent;
        use palpate_simulate::Error::File;
        let is_content = match &error {
            Error::File(error) => matches!(**error, BadContent { .. }),
            Error::Simulate(error) => matches!(**error, File(BadContent { .. })),
            _ => false,
        };
        match is_content {
            // Values that no document can hold come from the caller here.
            true => Self::input(error),
            false => Self::Job(error),
        }
    }
}

palpate_jobs::from_carried_errors!(Failure);

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        static INPUT: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        static FAILED: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        let raised = |class: &PyOnceLock<Py<PyType>>, name: &str, error: Error| {
            Python::attach(|py| match class.import(py, "palpate.errors", name) {
                Ok(class) => {
                    Self::from_type(class.clone(), (printable(&error.to_string()).into_owned(),))
                }
                Err(error) => error,
            })
        };
        match failure {
            Failure::Job(error) if error.is_input() => raised(&INPUT, "InputError", error),
            Failure::Job(error) => raised(&FAILED, "PalpateError", error),
            Failure::Python(error) => error,
        }
    }
}
