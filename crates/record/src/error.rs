use std::io;
use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;

/// Why a record cannot be used, or an attempt not be kept.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// There is no record to read.
    #[error("{path} holds no training record yet; record an attempt first, or name another file", path = path.display())]
    Missing {
        /// The file that was looked for.
        path: PathBuf,
    },
    /// Another program holds it.
    #[error("{path} is in use by another program; close what uses it, then try again", path = path.display())]
    Locked {
        /// The record.
        path: PathBuf,
    },
    /// It cannot be read as the record that it was.
    #[error(
        "{path} is damaged ({reason}) and stays as it is; put a copy of it in its place, or record an attempt, which keeps it aside and begins a new one",
        path = path.display()
    )]
    Damaged {
        /// The record.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// It is something else.
    #[error("{path} is no training record and stays as it is; name another file", path = path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// It was written by a later version.
    #[error(
        "{path} is a training record of version {found}, and this program knows them up to version {known}; use a newer one",
        path = path.display()
    )]
    Newer {
        /// The record.
        path: PathBuf,
        /// Its version.
        found: i64,
        /// The latest version that is known.
        known: i64,
    },
    /// The operating system does not let it be used.
    #[error("{path} cannot be used: {reason}; check that it is a file that you may write, in a folder that you may write, on a disk with room", path = path.display())]
    Unusable {
        /// The record.
        path: PathBuf,
        /// What the operating system says.
        reason: String,
    },
    /// A name is missing.
    #[error("an attempt has a {what} without a name; give it one")]
    Unnamed {
        /// What has none.
        what: &'static str,
    },
    /// A measure is no number.
    #[error("the measure `{key}` of an attempt is {value}; leave it out where there is none")]
    NoNumber {
        /// The measure.
        key: String,
        /// Its value.
        value: f64,
    },
    /// A measure stands twice in an attempt.
    #[error("the measure `{key}` stands twice in an attempt; leave one out")]
    Twice {
        /// The measure.
        key: String,
    },
    /// The name of a folder cannot be kept.
    #[error("the session's folder {path} has a name that is not UTF-8; rename it", path = path.display())]
    FolderName {
        /// The folder.
        path: PathBuf,
    },
    /// The database refuses what it should not.
    #[error("{path}: {reason}; please report this", path = path.display())]
    Failed {
        /// The record.
        path: PathBuf,
        /// What the database says.
        reason: String,
    },
}

impl Error {
    /// Whether what was given has to be mended.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Failed { .. })
    }

    /// What the operating system says of a file.
    pub(crate) fn of_system(path: &Path, error: &io::Error) -> Self {
        Self::Unusable {
            path: path.to_owned(),
            reason: error.to_string(),
        }
    }

    /// What the database says of its file.
    pub(crate) fn of_database(path: &Path, error: &rusqlite::Error) -> Self {
        let path = path.to_owned();
        let reason = match error {
            rusqlite::Error::SqliteFailure(_, Some(message)) => message.clone(),
            other => other.to_string(),
        };
        use rusqlite::Error::{
            FromSqlConversionFailure, IntegralValueOutOfRange, InvalidColumnType,
        };
        match error.sqlite_error_code() {
            Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => Self::Locked { path },
            Some(ErrorCode::NotADatabase | ErrorCode::DatabaseCorrupt) => {
                Self::Damaged { path, reason }
            }
            Some(
                ErrorCode::ReadOnly
                | ErrorCode::PermissionDenied
                | ErrorCode::CannotOpen
                | ErrorCode::DiskFull
                | ErrorCode::SystemIoFailure
                | ErrorCode::TooBig,
            ) => Self::Unusable { path, reason },
            _ => match error {
                // What stands in a column is not what was put there.
                InvalidColumnType(..)
                | FromSqlConversionFailure(..)
                | IntegralValueOutOfRange(..) => Self::Damaged { path, reason },
                _ => Self::Failed { path, reason },
            },
        }
    }
}
