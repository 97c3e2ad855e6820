use std::fmt::Display;

/// Why an item, or the whole run, ends early. The message is one sentence: cause, then mend.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A word that names no item and no row.
    #[error("there is no row `{word}`; the nearest is `{nearest}`, and there are {known}")]
    UnknownRow {
        /// The word.
        word: String,
        /// The name that is most like it.
        nearest: String,
        /// All names, with commas.
        known: String,
    },
    /// A place in the tables of the source that has no number.
    #[error("the source's tables have no number at `{0}`; please report this")]
    NotPublished(String),
    /// The folder of the figures cannot be used.
    #[error("the folder {folder} cannot be made or written ({source}); give another with --out")]
    Folder {
        /// As it was given.
        folder: String,
        /// In the words of the operating system.
        source: std::io::Error,
    },
    /// A file cannot be written, or a document is wrong.
    #[error(transparent)]
    File(#[from] palpate_files::Error),
    /// A mesh is no surface.
    #[error(transparent)]
    Mesh(#[from] palpate_geometry::MeshError),
    /// A built-in organ cannot be made.
    #[error(transparent)]
    Organ(#[from] palpate_geometry::OrganError),
    /// A mesh cannot be read.
    #[error(transparent)]
    MeshFile(#[from] palpate_geometry::ReadError),
    /// A model cannot be made or solved.
    #[error(transparent)]
    Mechanics(#[from] palpate_mechanics::Error),
    /// A recording does not give what is sought in it.
    #[error(transparent)]
    Characterize(#[from] palpate_characterize::Error),
    /// A scene cannot be simulated.
    #[error(transparent)]
    Simulate(#[from] palpate_simulate::Error),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Viewer(#[from] palpate_viewer::Error),
    /// A job failed.
    #[error(transparent)]
    Job(#[from] palpate_jobs::Error),
    /// Something else went wrong.
    #[error("{0}")]
    Failed(String),
}

impl Error {
    /// Something else went wrong.
    pub(crate) fn failed(message: impl Display) -> Self {
        Self::Failed(message.to_string())
    }

    /// Whether what was given has to be mended.
    pub fn is_input(&self) -> bool {
        match self {
            Self::UnknownRow { .. } => true,
            Self::Folder { source, .. } => palpate_files::names_wrong_path(source),
            Self::Mesh(error) => error.is_input(),
            Self::Organ(error) => error.is_input(),
            Self::MeshFile(error) => error.is_input(),
            Self::Mechanics(error) => error.is_input(),
            Self::Characterize(error) => error.is_input(),
            Self::File(error) => error.is_input(),
            Self::Simulate(error) => error.is_input(),
            Self::Viewer(error) => error.is_input(),
            Self::Job(error) => error.is_input(),
            Self::NotPublished(_) | Self::Failed(_) => false,
        }
    }
}
