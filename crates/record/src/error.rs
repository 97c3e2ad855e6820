use std::io;
use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;

/// Why a record cannot be used, or an attempt cannot be stored.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// There is no record to read.
    #[error("{path} holds no training record yet; record an attempt first, or name another file", path = path.display())]
    Missing {
        /// The missing file.
        path: PathBuf,
    },
    /// Another program locks it.
    #[error("{path} is in use by another program; close what uses it, then try again", path = path.display())]
    Locked {
        /// The record.
        path: PathBuf,
    },
    /// The file is damaged.
    #[error(
        "{path} is damaged ({reason}) and stays as it is; put a copy of it in its place, or record an attempt, which keeps it aside and begins a new one",
        path = path.display()
    )]
    Damaged {
        /// The record.
        path: PathBuf,
        /// The damage.
        reason: String,
    },
    /// It is another kind of file.
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
        /// The latest known version.
        known: i64,
    },
    /// The disk is full or broken.
    #[error("{path} cannot be written: {reason}; make room on its disk, or name a file on another one", path = path.display())]
    Disk {
        /// The record.
        path: PathBuf,
        /// The error of the operating system.
        reason: String,
    },
    /// Its name or its permissions prevent its use.
    #[error("{path} cannot be used: {reason}; check that it is a file that you may write, in a folder that you may write", path = path.display())]
    Unusable {
        /// The record.
        path: PathBuf,
        /// The error of the operating system.
        reason: String,
    },
    /// A name is missing.
    #[error("an attempt has a {what} without a name; give it one")]
    Unnamed {
        /// The item without a name.
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
    /// An attempt has a measure twice.
    #[error("the measure `{key}` stands twice in an attempt; leave one out")]
    Twice {
        /// The measure.
        key: String,
    },
    /// The PIN is not the teacher's.
    #[error("{path} has a teacher's PIN, and it is another one; give it with --pin", path = path.display())]
    WrongPin {
        /// The record.
        path: PathBuf,
    },
    /// No such passed attempt.
    #[error(
        "there is no passed attempt of {trainee} with this session in the record; only a passed attempt can be an expert's"
    )]
    NoExpert {
        /// The trainee.
        trainee: String,
    },
    /// The name of a folder cannot be stored.
    #[error("the session's folder {path} has a name that is not UTF-8; rename it", path = path.display())]
    FolderName {
        /// The folder.
        path: PathBuf,
    },
    /// The database rejects a valid operation.
    #[error("{path}: {reason}; please report this", path = path.display())]
    Failed {
        /// The record.
        path: PathBuf,
        /// The error of the database.
        reason: String,
    },
}

impl Error {
    /// Whether the input is invalid (exit status 2), and not the disk or another program at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Locked { .. } | Self::Disk { .. } | Self::Failed { .. } => false,
            Self::Missing { .. }
            | Self::Damaged { .. }
            | Self::Foreign { .. }
            | Self::Newer { .. }
            | Self::Unusable { .. }
            | Self::Unnamed { .. }
            | Self::NoNumber { .. }
            | Self::Twice { .. }
            | Self::WrongPin { .. }
            | Self::NoExpert { .. }
            | Self::FolderName { .. } => true,
        }
    }

    /// Converts an error of the operating system.
    pub(crate) fn of_system(path: &Path, error: &io::Error) -> Self {
        use io::ErrorKind::{
            AlreadyExists, InvalidFilename, InvalidInput, IsADirectory, NotADirectory, NotFound,
            PermissionDenied,
        };
        let path = path.to_owned();
        let reason = error.to_string();
        match error.kind() {
            AlreadyExists | InvalidFilename | InvalidInput | IsADirectory | NotADirectory
            | NotFound | PermissionDenied => Self::Unusable { path, reason },
            _ => Self::Disk { path, reason },
        }
    }

    /// Converts an error of the database.
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
                | ErrorCode::TooBig,
            ) => Self::Unusable { path, reason },
            Some(ErrorCode::DiskFull | ErrorCode::SystemIoFailure) => Self::Disk { path, reason },
            _ => match error {
                // A column has another value than was written.
                InvalidColumnType(..)
                | FromSqlConversionFailure(..)
                | IntegralValueOutOfRange(..) => Self::Damaged { path, reason },
                _ => Self::Failed { path, reason },
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use rusqlite::ffi::{self, SQLITE_BUSY, SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_READONLY};

    use super::*;

    /// Exit status 1 is for errors that no change of the input would fix.
    #[test]
    fn a_full_disk_and_a_lock_are_failures_and_no_invalid_input() {
        let path = Path::new("training.sqlite");
        let of_code = |code| rusqlite::Error::SqliteFailure(ffi::Error::new(code), None);
        for (code, is_input) in [
            (SQLITE_FULL, false),
            (SQLITE_IOERR_WRITE, false),
            (SQLITE_BUSY, false),
            (SQLITE_READONLY, true),
        ] {
            let error = Error::of_database(path, &of_code(code));
            assert_eq!(error.is_input(), is_input, "{error}");
        }
        for (kind, is_input) in [
            (io::ErrorKind::StorageFull, false),
            (io::ErrorKind::PermissionDenied, true),
        ] {
            let error = Error::of_system(path, &kind.into());
            assert_eq!(error.is_input(), is_input, "{error}");
        }
    }
}
