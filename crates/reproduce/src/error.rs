use std::fmt::Display;

/// Why an item, or the whole run, ends early. The message is one sentence: the cause, then how to fix it.
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
    /// A picture cannot be drawn.
    #[error(transparent)]
    Viewer(#[from] palpate_viewer::Error),
    /// A job, or a library below it.
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

    /// Whether the input is invalid, rather than something else at fault.
    pub fn is_input(&self) -> bool {
        match self {
            Self::UnknownRow { .. } => true,
            Self::Viewer(error) => error.is_input(),
            Self::Job(error) => error.is_input(),
            Self::NotPublished(_) | Self::Failed(_) => false,
        }
    }
}

palpate_jobs::from_carried_errors!(Error);
