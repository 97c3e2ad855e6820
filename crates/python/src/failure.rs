//! What the libraries refuse, as Python's exceptions: the sentences of the command, which ends with status 2 where
//! [`Failure::Input`] is raised and with 1 where [`Failure::Failed`] is. Python prints them to a terminal, so that
//! characters which a terminal obeys are escapes in them.

use std::fmt;

use palpate_files::printable;
use palpate_geometry::{
    IsosurfaceError, MeshError, OrganError, ReadError, SimplifyError, UnknownUnit,
};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Why something cannot be done. The message is one sentence: cause, then mend.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What was given has to be mended: `palpate.InputError`.
    Input(String),
    /// Something else went wrong: `palpate.PalpateError`.
    Failed(String),
    /// Somebody pressed Ctrl-C: `KeyboardInterrupt`.
    BrokenOff,
    /// What Python itself refuses.
    Python(PyErr),
}

impl Failure {
    pub(crate) fn input(message: impl fmt::Display) -> Self {
        Self::Input(message.to_string())
    }

    pub(crate) fn failed(message: impl fmt::Display) -> Self {
        Self::Failed(message.to_string())
    }

    fn by_fault(is_input: bool, message: impl fmt::Display) -> Self {
        match is_input {
            true => Self::input(message),
            false => Self::failed(message),
        }
    }
}

impl From<palpate_files::Error> for Failure {
    fn from(error: palpate_files::Error) -> Self {
        // Values that no document can hold come from the caller here.
        let is_content = matches!(error, palpate_files::Error::BadContent { .. });
        Self::by_fault(is_content || error.is_input(), error)
    }
}

impl From<palpate_simulate::Error> for Failure {
    fn from(error: palpate_simulate::Error) -> Self {
        use palpate_mechanics::Error::BrokenOff;
        match error {
            palpate_simulate::Error::File(error) => error.into(),
            palpate_simulate::Error::Model(BrokenOff) => Self::BrokenOff,
            error => Self::by_fault(error.is_input(), error),
        }
    }
}

/// Whatever these say is about what was given.
macro_rules! of_input {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::input(error)
            }
        }
    )*};
}

of_input!(
    ReadError,
    MeshError,
    OrganError,
    UnknownUnit,
    SimplifyError,
    IsosurfaceError,
    palpate_mechanics::Error,
    palpate_files::card::NoCard
);

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        static INPUT: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        static FAILED: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        let raised = |class: &PyOnceLock<Py<PyType>>, name: &str, message: String| {
            Python::attach(|py| match class.import(py, "palpate.errors", name) {
                Ok(class) => Self::from_type(class.clone(), (printable(&message).into_owned(),)),
                Err(error) => error,
            })
        };
        match failure {
            Failure::Input(message) => raised(&INPUT, "InputError", message),
            Failure::Failed(message) => raised(&FAILED, "PalpateError", message),
            Failure::BrokenOff => PyKeyboardInterrupt::new_err(()),
            Failure::Python(error) => error,
        }
    }
}
