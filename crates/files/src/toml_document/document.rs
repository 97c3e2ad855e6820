use std::path::{Path, PathBuf};

use crate::atomic_write::{MAX_DOCUMENT_BYTES, read_text};
use crate::error::Place;
use crate::{Error, Keys};

use super::key::Key;
use super::keys::Warnings;
use super::value::{Entry, Table, Value, parse};

/// A TOML file in `format = 1`, parsed but not yet interpreted.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    path: PathBuf,
    root: Table,
    warnings: Warnings,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read, is not TOML or is not in format 1.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_DOCUMENT_BYTES)?, path)
    }

    /// Reads a text; `path` is its name in errors.
    ///
    /// # Errors
    /// When it is not TOML or is not in format 1.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        // Some editors begin a file with a byte order mark.
        let mut root = parse(text.strip_prefix('\u{feff}').unwrap_or(text), &path, 1)?;
        check_format(root.remove("format"), &path, "format = 1")?;
        Ok(Self {
            path,
            root,
            warnings: Warnings::default(),
        })
    }

    /// Changes the document's values before they are interpreted.
    ///
    /// # Errors
    /// Those of `change`, which gets the document's keys to name places.
    pub(crate) fn change<T>(
        &mut self,
        change: impl FnOnce(&mut Table, &Keys<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let mut root = std::mem::take(&mut self.root);
        let changed = change(&mut root, &self.open_keys(&[]));
        self.root = root;
        changed
    }

    /// The keys of the whole document, of which `known` are those in addition to `format` that may occur.
    ///
    /// # Errors
    /// When there is a key that is not known.
    pub fn keys(&self, known: &'static [Key]) -> Result<Keys<'_>, Error> {
        let keys = self.open_keys(known);
        keys.only_declared()?;
        Ok(keys)
    }

    /// The keys of a document in which one of them decides which others may occur: `known` are those of all cases,
    /// and [`Keys::only`] checks them once the case is known.
    pub fn open_keys(&self, known: &'static [Key]) -> Keys<'_> {
        Keys::of_table(
            Place::file(&self.path),
            String::new(),
            &self.root,
            known,
            &self.warnings,
        )
    }
}

/// Checks the value of `format`; `remedy` is the line to add when there is none.
pub(crate) fn check_format(
    format: Option<Entry>,
    path: &Path,
    remedy: &'static str,
) -> Result<(), Error> {
    match format {
        None => Err(Error::MissingFormat {
            path: path.to_owned(),
            remedy,
        }),
        Some(Entry {
            value: Value::Integer(1, _),
            ..
        }) => Ok(()),
        Some(Entry { line, value }) => Err(Error::UnsupportedFormat {
            place: Place::line(path, line),
            found: value.described(),
        }),
    }
}
