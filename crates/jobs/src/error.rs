use std::fmt::Display;
use std::path::Path;

use palpate_geometry::{MeshError, OrganError, ReadError, UnknownUnit};

/// Why a job ends early. The message is one sentence: cause, then mend.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// What was given has to be mended.
    #[error("{0}")]
    Input(String),
    /// Something else went wrong.
    #[error("{0}")]
    Failed(String),
}

impl Error {
    /// What was given has to be mended.
    pub fn input(message: impl Display) -> Self {
        Self::Input(message.to_string())
    }

    /// Something else went wrong.
    pub fn failed(message: impl Display) -> Self {
        Self::Failed(message.to_string())
    }

    /// Whether what was given has to be mended.
    pub fn is_input(&self) -> bool {
        matches!(self, Self::Input(_))
    }

    /// The same, with the file that it is about.
    pub(crate) fn about(self, file: &Path) -> Self {
        let named = |message: String| match message.contains(&*file.to_string_lossy()) {
            true => message,
            false => format!("{}: {message}", file.display()),
        };
        match self {
            Self::Input(message) => Self::Input(named(message)),
            Self::Failed(message) => Self::Failed(named(message)),
        }
    }
}

/// Errors that are always about what was given.
macro_rules! of_input {
    ($($error:ty),+) => {
        $(impl From<$error> for Error {
            fn from(error: $error) -> Self {
                Self::input(error)
            }
        })+
    };
}

/// Errors that know themselves whether they are.
macro_rules! of_either {
    ($($error:ty),+) => {
        $(impl From<$error> for Error {
            fn from(error: $error) -> Self {
                match error.is_input() {
                    true => Self::input(error),
                    false => Self::failed(error),
                }
            }
        })+
    };
}

of_input!(
    MeshError,
    OrganError,
    ReadError,
    UnknownUnit,
    palpate_mechanics::Error,
    palpate_characterize::Error
);
of_either!(palpate_files::Error, palpate_simulate::Error);
