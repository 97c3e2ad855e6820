use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

use palpate_files::card::NoCard;
use palpate_files::names_wrong_path;
use palpate_geometry::{
    IsosurfaceError, MeshError, OrganError, ReadError, SimplifyError, UnknownUnit, WrapError,
};

/// Why a job ends early. The message is one sentence: the cause, then how to fix it.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A document or another file.
    #[error(transparent)]
    File(Box<palpate_files::Error>),
    /// The file of a mesh or volume.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A built-in organ.
    #[error(transparent)]
    Organ(#[from] OrganError),
    /// A unit of length.
    #[error(transparent)]
    Unit(#[from] UnknownUnit),
    /// A mesh with fewer triangles.
    #[error(transparent)]
    Simplify(#[from] SimplifyError),
    /// The surface of a label.
    #[error(transparent)]
    Isosurface(#[from] IsosurfaceError),
    /// The envelope of triangles.
    #[error(transparent)]
    Wrap(#[from] WrapError),
    /// A material card for a law that the package lacks.
    #[error(transparent)]
    Card(#[from] NoCard),
    /// A law or a solver.
    #[error(transparent)]
    Mechanics(#[from] palpate_mechanics::Error),
    /// A fit.
    #[error(transparent)]
    Characterize(#[from] palpate_characterize::Error),
    /// A scene, or its simulation.
    #[error(transparent)]
    Simulate(Box<palpate_simulate::Error>),
    /// The rig.
    #[error(transparent)]
    Measure(#[from] palpate_measure::Error),
    /// A haptic device or force sensor that is not opened.
    #[error(transparent)]
    Open(#[from] palpate_devices::OpenError),
    /// A device that fails while it is used.
    #[error(transparent)]
    Device(#[from] palpate_servo::Fault),
    /// Any of these, with the file that it concerns.
    #[error("{}: {error}", file.display())]
    About {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        #[source]
        error: Box<Error>,
    },
    /// The output folder of a job.
    #[error("the folder {} cannot be made or written ({source}); give another with {option}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The option that selects another folder.
        option: &'static str,
        /// The error of the operating system.
        source: io::Error,
    },
    /// None of several recordings can be used.
    #[error("none of the {count} recordings can be used; the first: {first}")]
    NoRecording {
        /// The number of recordings.
        count: usize,
        /// Why the first cannot be used.
        #[source]
        first: Box<Error>,
    },
    /// Another input that is invalid.
    #[error("{0}")]
    Input(String),
    /// Another failure.
    #[error("{0}")]
    Failed(String),
}

impl Error {
    /// Another input that is invalid.
    pub fn input(message: impl Display) -> Self {
        Self::Input(message.to_string())
    }

    /// Another failure.
    pub fn failed(message: impl Display) -> Self {
        Self::Failed(message.to_string())
    }

    /// Whether the input is invalid; otherwise it is another failure.
    pub fn is_input(&self) -> bool {
        match self {
            Self::File(error) => error.is_input(),
            Self::Read(error) => error.is_input(),
            Self::Mesh(error) => error.is_input(),
            Self::Organ(error) => error.is_input(),
            Self::Simplify(error) => error.is_input(),
            Self::Isosurface(error) => error.is_input(),
            Self::Wrap(error) => error.is_input(),
            Self::Mechanics(error) => error.is_input(),
            Self::Characterize(error) => error.is_input(),
            Self::Simulate(error) => error.is_input(),
            Self::Measure(error) => error.is_input(),
            Self::Open(error) => error.is_input(),
            Self::Device(error) => error.is_input(),
            Self::About { error, .. } | Self::NoRecording { first: error, .. } => error.is_input(),
            Self::Folder { source, .. } => names_wrong_path(source),
            Self::Unit(_) | Self::Card(_) | Self::Input(_) => true,
            Self::Failed(_) => false,
        }
    }

    /// The exit status of a command that ends with this error: 2 when the input is invalid, else 1.
    pub fn exit_status(&self) -> u8 {
        exit_status(self.is_input())
    }

    /// A folder that cannot be written, with the option that selects another; other errors are unchanged.
    pub fn of_folder(option: &'static str, error: palpate_files::Error) -> Self {
        match error {
            palpate_files::Error::Write { path, source } => Self::Folder {
                folder: path,
                option,
                source,
            },
            other => other.into(),
        }
    }

    /// The same, with the file that it concerns.
    pub fn about(self, file: &Path) -> Self {
        match self.to_string().contains(&*file.to_string_lossy()) {
            true => self,
            false => Self::About {
                file: file.to_owned(),
                error: Box::new(self),
            },
        }
    }
}

impl From<palpate_files::Error> for Error {
    fn from(error: palpate_files::Error) -> Self {
        Self::File(Box::new(error))
    }
}

impl From<palpate_simulate::Error> for Error {
    fn from(error: palpate_simulate::Error) -> Self {
        Self::Simulate(Box::new(error))
    }
}

/// The exit status of a command that ends with an error: 2 when the input is invalid, else 1.
pub fn exit_status(is_input: bool) -> u8 {
    match is_input {
        true => 2,
        false => 1,
    }
}

/// Implements `From` of every error that [`Error`] carries for a type that has `From<Error>`.
#[macro_export]
macro_rules! from_carried_errors {
    ($own:ty) => {
        $crate::from_carried_errors!(
            $own: FileError, NoCard, ReadError, MeshError, OrganError, UnknownUnit, SimplifyError, IsosurfaceError,
            WrapError, MechanicsError, CharacterizeError, SimulateError, MeasureError, OpenError, Fault
        );
    };
    ($own:ty: $($error:ident),+) => {
        $(impl From<$crate::carried::$error> for $own {
            fn from(error: $crate::carried::$error) -> Self {
                Self::from($crate::Error::from(error))
            }
        })+
    };
}

/// For [`from_carried_errors`].
#[doc(hidden)]
pub mod carried {
    pub use palpate_characterize::Error as CharacterizeError;
    pub use palpate_devices::OpenError;
    pub use palpate_files::Error as FileError;
    pub use palpate_files::card::NoCard;
    pub use palpate_geometry::{
        IsosurfaceError, MeshError, OrganError, ReadError, SimplifyError, UnknownUnit, WrapError,
    };
    pub use palpate_measure::Error as MeasureError;
    pub use palpate_mechanics::Error as MechanicsError;
    pub use palpate_servo::Fault;
    pub use palpate_simulate::Error as SimulateError;
}
