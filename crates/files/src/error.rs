use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::words::shortened;

/// The place of an error: a file and, when it is known, a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub path: PathBuf,
    /// Number of the line, from one.
    pub line: Option<usize>,
}

impl Place {
    /// A line of a file, counted from one.
    pub fn line(path: &Path, line: usize) -> Self {
        Self {
            path: path.to_owned(),
            line: Some(line),
        }
    }

    /// A file as a whole.
    pub fn file(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            line: None,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{} line {line}", self.path.display()),
            None => write!(f, "{}", self.path.display()),
        }
    }
}

/// Why a document cannot be read or written. Each message is one sentence with the place, the value found, the value
/// expected and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system refuses to read the file.
    #[error("{path} cannot be read: {source}; check the name and that you may read it", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A device or a pipe, which may never end.
    #[error("{path} is no regular file; name one, or copy what it holds into one", path = path.display())]
    NotAFile {
        /// The kind of the device.
        path: PathBuf,
    },
    /// A file that is larger than any of its kind.
    #[error("{path} has {bytes} bytes, and at most {most} are read of a file of its kind; check that it is the one you mean, or split it", path = path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size [bytes].
        bytes: u64,
        /// The largest that is read [bytes].
        most: u64,
    },
    /// The operating system refuses to write the file.
    #[error("{path} cannot be written: {source}; check that its folder exists, that you may write there and that the disk has room", path = path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A file would be replaced.
    #[error("{path} is there already; move it, name another place, or let it be replaced with --overwrite", path = path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// Two of the files to write are one.
    #[error("{path} is named twice; give each file its own name", path = path.display())]
    NamedTwice {
        /// The file.
        path: PathBuf,
    },
    /// Another program writes at the same place.
    #[error("{path} is being written by another program{by}; wait until it ends, or name another place", path = path.display(), by = process.map_or(String::new(), |process| format!(" (process {process})")))]
    InUse {
        /// The file or folder.
        path: PathBuf,
        /// The number of the other program's process, where it is known.
        process: Option<u32>,
    },
    /// The bytes are no UTF-8 text.
    #[error("{place}: found bytes that are not UTF-8 text; save the file as plain UTF-8 text")]
    NotText {
        /// The line with the first bad byte.
        place: Place,
    },
    /// The text breaks the rules of TOML.
    #[error(
        "{place}: this is not TOML: {message}; write `key = value`, with text in double quotes", message = shortened(message))]
    Syntax {
        /// The line where reading stopped.
        place: Place,
        /// The error of the TOML reader.
        message: String,
    },
    /// The document does not state its format.
    #[error("{path}: `format` is missing; add the line `{remedy}` at the top", path = path.display())]
    MissingFormat {
        /// The file.
        path: PathBuf,
        /// The line to add.
        remedy: &'static str,
    },
    /// The document is in a format that this version does not read.
    #[error(
        "{place}: format is {found}, but this version reads format 1; \
         set `format = 1` or use a newer version of palpate", found = shortened(found))]
    UnsupportedFormat {
        /// Where the format is stated.
        place: Place,
        /// The value found.
        found: String,
    },
    /// A key that no document of this kind has.
    #[error(
        "{place}: the key `{key}` is not known here; \
         the nearest known key is `{nearest}`, use it or remove the line", key = shortened(key))]
    UnknownKey {
        /// Where the key is.
        place: Place,
        /// The key with its tables, such as `organ.tisue`.
        key: String,
        /// The known key that looks most like it.
        nearest: String,
    },
    /// A key or column whose name ends in a unit that does not fit or is not known.
    #[error("{place}: the unit of `{key}` is not known here; use {accepted}", key = shortened(key))]
    UnknownUnit {
        /// Where the key is.
        place: Place,
        /// The key or column.
        key: String,
        /// The names that are accepted.
        accepted: String,
    },
    /// The same quantity twice, for instance in two units.
    #[error("{place}: `{second}` is given although `{first}` is given too; keep one of them", first = shortened(first), second = shortened(second))]
    GivenTwice {
        /// Where the second one is.
        place: Place,
        /// The first key or column.
        first: String,
        /// The second key or column.
        second: String,
    },
    /// A required key is missing.
    #[error("{place}: `{key}` is missing; give {expected}", key = shortened(key))]
    MissingKey {
        /// The table that lacks it.
        place: Place,
        /// The key with its tables, such as `organ.tissue`.
        key: String,
        /// The value to give.
        expected: Cow<'static, str>,
    },
    /// A key or a field with a value that cannot be used.
    #[error("{place}: `{key}` is {found}; give {expected}", key = shortened(key), found = shortened(found))]
    BadValue {
        /// Where the value is.
        place: Place,
        /// The key with its tables, or the column.
        key: String,
        /// The value found.
        found: String,
        /// The values that can be used.
        expected: Cow<'static, str>,
    },
    /// A table of numbers lacks a column.
    #[error("{place}: the column `{column}` is missing among {found}; add it or correct its name", found = shortened(found), column = shortened(column))]
    MissingColumn {
        /// The line with the names of the columns.
        place: Place,
        /// The column.
        column: String,
        /// The columns found.
        found: String,
    },
    /// No column of another program's table looks like a quantity.
    #[error(
        "{place}: no column looks like the {quantity} among {found}; say which it is with --{quantity} NAME", found = shortened(found))]
    UnrecognizedColumn {
        /// The line with the names of the columns.
        place: Place,
        /// The quantity: `time`, `depth` or `force`.
        quantity: &'static str,
        /// The columns found.
        found: String,
    },
    /// Several columns of another program's table look like a quantity.
    #[error(
        "{place}: the {quantity} may be {found}; say which it is, as in --{quantity} \"{first}\"", found = shortened(found), first = shortened(first))]
    AmbiguousColumn {
        /// The line with the names of the columns.
        place: Place,
        /// The quantity: `time`, `depth` or `force`.
        quantity: &'static str,
        /// The columns that it may be.
        found: String,
        /// The first of them.
        first: String,
    },
    /// A row that does not fit the columns.
    #[error("{place}: found {found}; give {expected}", found = shortened(found))]
    BadRow {
        /// The line of the row.
        place: Place,
        /// The content of the row.
        found: String,
        /// The expected content.
        expected: String,
    },
    /// A table of numbers without a row.
    #[error("{path}: found no rows below the names of the columns; add at least one", path = path.display())]
    NoRows {
        /// The file.
        path: PathBuf,
    },
    /// Times that do not increase.
    #[error(
        "{place}: `{column}` is {found} after {previous}; \
         sort the rows so that the time grows from each to the next", found = shortened(found), column = shortened(column), previous = shortened(previous))]
    TimeNotIncreasing {
        /// The line of the row.
        place: Place,
        /// The column that holds the time.
        column: String,
        /// The time found, as written.
        found: String,
        /// The time before it, as written.
        previous: String,
    },
    /// A stored response that needs more memory than is allowed or available.
    #[error("{path} takes {} of memory, and {} may be taken; close other programs, or delete the file, and it is made again when it is needed", gigabytes(*bytes), gigabytes(*memory as u64), path = path.display())]
    NoMemoryForResponse {
        /// The file.
        path: PathBuf,
        /// The memory that it needs [bytes].
        bytes: u64,
        /// The memory that is allowed [bytes].
        memory: usize,
    },
    /// A stored response that cannot be used.
    #[error("{path} is damaged: {what}; delete it, and it is made again when it is needed", path = path.display())]
    DamagedResponse {
        /// The file.
        path: PathBuf,
        /// Its defect.
        what: String,
    },
    /// A file of an instrument that is damaged, or in a form that is not supported.
    #[error("{path}: {part} {cause}; save or copy the file again", path = path.display(), part = shortened(part))]
    DamagedInstrumentFile {
        /// The file.
        path: PathBuf,
        /// The place in it.
        part: String,
        /// Its defect.
        cause: &'static str,
    },
    /// A file of an instrument that does not state a number which its forces need.
    #[error("{path} does not state {what}; state it as `{key}`, on the command line by --set {key}=NUMBER", path = path.display())]
    MissingCalibration {
        /// The file.
        path: PathBuf,
        /// The key of a recording.
        key: &'static str,
        /// The missing number, with its unit.
        what: &'static str,
    },
    /// Values made by a program, not read from a file, that no document can hold.
    #[error("{what} is {found}; give {expected}", found = shortened(found))]
    BadContent {
        /// The name of the value, such as `force_n of sample 3`.
        what: String,
        /// The value found.
        found: String,
        /// The values that can be used.
        expected: Cow<'static, str>,
    },
}

fn gigabytes(bytes: u64) -> String {
    format!("{:.2} GB", 1e-9 * bytes as f64)
}

impl Error {
    /// Whether the input is invalid: true for a file or a name that must be corrected (exit status 2), false for a
    /// failure such as a full disk (exit status 1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Read { source, .. } | Self::Write { source, .. } => names_wrong_path(source),
            Self::InUse { .. } | Self::NoMemoryForResponse { .. } | Self::BadContent { .. } => {
                false
            }
            Self::NotAFile { .. }
            | Self::TooLarge { .. }
            | Self::Exists { .. }
            | Self::NamedTwice { .. }
            | Self::NotText { .. }
            | Self::Syntax { .. }
            | Self::MissingFormat { .. }
            | Self::UnsupportedFormat { .. }
            | Self::UnknownKey { .. }
            | Self::UnknownUnit { .. }
            | Self::GivenTwice { .. }
            | Self::MissingKey { .. }
            | Self::BadValue { .. }
            | Self::MissingColumn { .. }
            | Self::UnrecognizedColumn { .. }
            | Self::AmbiguousColumn { .. }
            | Self::BadRow { .. }
            | Self::NoRows { .. }
            | Self::TimeNotIncreasing { .. }
            | Self::DamagedResponse { .. }
            | Self::DamagedInstrumentFile { .. }
            | Self::MissingCalibration { .. } => true,
        }
    }

    /// The same, when the refused document is one that a program was about to write.
    pub(crate) fn of_content(self) -> Self {
        let (key, found, expected) = match self {
            Self::BadValue {
                key,
                found,
                expected,
                ..
            } => (key, found, expected),
            Self::MissingKey { key, expected, .. } => (key, "missing".to_owned(), expected),
            other => return other,
        };
        Self::BadContent {
            what: format!("`{key}`"),
            found,
            expected,
        }
    }

    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read {
            path: path.to_owned(),
            source,
        }
    }

    pub(crate) fn write(path: &Path, source: io::Error) -> Self {
        Self::Write {
            path: path.to_owned(),
            source,
        }
    }
}

/// Whether the operating system refuses because of the given name, which is invalid input.
pub fn names_wrong_path(source: &io::Error) -> bool {
    use io::ErrorKind;
    matches!(
        source.kind(),
        ErrorKind::NotFound
            | ErrorKind::NotADirectory
            | ErrorKind::IsADirectory
            | ErrorKind::PermissionDenied
            | ErrorKind::InvalidInput
            | ErrorKind::InvalidFilename
    )
}
