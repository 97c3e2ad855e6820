use std::borrow::Cow;
use std::cell::RefCell;

use crate::Error;
use crate::error::Place;
use crate::units::{self, Match};
use crate::words::nearest;

use super::key::{Key, names};
use super::value::{Entry, Table, Value};

/// The keys of one table of a document, with access to their values.
///
/// A key that ends in a unit is found under the same name in another unit too, and converted.
#[derive(Debug, Clone)]
pub struct Keys<'d> {
    place: Place,
    name: String,
    table: &'d Table,
    known: &'static [Key],
    warnings: &'d Warnings,
}

/// A key that was found.
pub(crate) struct Found<'d> {
    pub(crate) place: Place,
    /// The key with its tables, as written.
    pub(crate) key: String,
    pub(crate) value: &'d Value,
    pub(crate) unit: Match,
    pub(crate) warnings: &'d Warnings,
}

/// Warnings about a document, collected while it is read.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Warnings(RefCell<Vec<String>>);

impl Warnings {
    /// Adds a sentence, unless it is there.
    pub(crate) fn add(&self, sentence: String) {
        let mut all = self.0.borrow_mut();
        // A key may be read twice.
        if !all.contains(&sentence) {
            all.push(sentence);
        }
    }
}

impl Found<'_> {
    pub(crate) fn invalid(&self, expected: impl Into<Cow<'static, str>>) -> Error {
        Error::BadValue {
            place: self.place.clone(),
            key: self.key.clone(),
            found: self.value.described(),
            expected: expected.into(),
        }
    }
}

impl<'d> Keys<'d> {
    pub(crate) fn of_table(
        place: Place,
        name: String,
        table: &'d Table,
        known: &'static [Key],
        warnings: &'d Warnings,
    ) -> Self {
        Self {
            place,
            name,
            table,
            known,
            warnings,
        }
    }

    /// Warnings about the numbers that were read so far, in the whole document.
    pub fn warnings(&self) -> Vec<String> {
        self.warnings.0.borrow().clone()
    }

    /// Where the table is.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// A key with the tables that it is in, such as `organ.tissue.alpha`.
    pub fn full_name(&self, key: &str) -> String {
        if self.name.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.name)
        }
    }

    /// Checks that the table holds no other keys than those that are declared.
    ///
    /// # Errors
    /// Names the first other key and the declared one that is nearest to it.
    pub fn only_declared(&self) -> Result<(), Error> {
        self.only(&names(self.known))
    }

    /// The declaration of a key.
    ///
    /// # Panics
    /// When it is not declared: a mistake in the program, not in a document.
    pub(crate) fn declared(&self, key: &str) -> &'static Key {
        let declared = self.known.iter().find(|known| known.name == key);
        declared.unwrap_or_else(|| unreachable!("`{key}` is not declared"))
    }

    /// Checks that the table holds no other keys than `known`.
    ///
    /// # Errors
    /// Names the first other key and the known one that is nearest to it.
    pub fn only(&self, known: &[&str]) -> Result<(), Error> {
        let stranger = self
            .table
            .iter()
            .filter(|(key, _)| {
                !known
                    .iter()
                    .any(|known| units::matches(key, known).is_some())
            })
            .min_by_key(|(_, entry)| entry.line);
        match stranger {
            Some((key, entry)) => Err(self.stranger(key, entry, known)),
            None => Ok(()),
        }
    }

    fn stranger(&self, key: &str, entry: &Entry, known: &[&str]) -> Error {
        let place = self.place_of(entry);
        let accepted = known
            .iter()
            .find_map(|known| units::accepted_instead(key, known));
        if let Some(accepted) = accepted {
            return Error::UnknownUnit {
                place,
                key: self.full_name(key),
                accepted,
            };
        }
        let nearest = nearest(key, known).map_or("format", |(nearest, _)| nearest);
        Error::UnknownKey {
            place,
            key: self.full_name(key),
            nearest: self.full_name(nearest),
        }
    }

    fn place_of(&self, entry: &Entry) -> Place {
        Place::line(&self.place.path, entry.line)
    }

    /// Where a key is; the table's own place when it is not there.
    pub fn place_of_key(&self, key: &'static str) -> Place {
        match self.find(key) {
            Ok(Some(found)) => found.place,
            _ => self.place.clone(),
        }
    }

    /// Whether a key is there.
    pub fn contains(&self, key: &'static str) -> bool {
        self.table
            .keys()
            .any(|own| units::matches(own, key).is_some())
    }

    pub(super) fn entry(&self, key: &str) -> Option<&'d Entry> {
        self.table.get(key)
    }

    pub(crate) fn find(&self, key: &'static str) -> Result<Option<Found<'d>>, Error> {
        debug_assert!(
            self.known.iter().any(|known| known.name == key),
            "`{key}` is not declared"
        );
        let mut all = self
            .table
            .iter()
            .filter_map(|(own, entry)| Some((own, entry, units::matches(own, key)?)));
        let Some((own, entry, unit)) = all.next() else {
            return Ok(None);
        };
        if let Some((twin, other, _)) = all.next() {
            let later = if other.line >= entry.line {
                other
            } else {
                entry
            };
            return Err(Error::GivenTwice {
                place: self.place_of(later),
                first: self.full_name(own),
                second: self.full_name(twin),
            });
        }
        Ok(Some(Found {
            place: self.place_of(entry),
            key: self.full_name(own),
            value: &entry.value,
            unit,
            warnings: self.warnings,
        }))
    }

    /// The keys of a `table` that was found outside this one, in the same file, under its full `name`.
    pub(crate) fn of_entry<'t>(
        &self,
        name: &str,
        entry: &Entry,
        table: &'t Table,
        known: &'static [Key],
    ) -> Keys<'t>
    where
        'd: 't,
    {
        Keys::of_table(
            self.place_of(entry),
            name.to_owned(),
            table,
            known,
            self.warnings,
        )
    }

    /// The error for the value of an entry, under its full `name`.
    pub(crate) fn invalid_entry(&self, name: &str, entry: &Entry, expected: &'static str) -> Error {
        Error::BadValue {
            place: self.place_of(entry),
            key: self.full_name(name),
            found: entry.value.described(),
            expected: expected.into(),
        }
    }

    /// The error for a missing required key.
    pub fn missing(&self, key: &str, expected: impl Into<Cow<'static, str>>) -> Error {
        Error::MissingKey {
            place: self.place.clone(),
            key: self.full_name(key),
            expected: expected.into(),
        }
    }

    /// The error for a key with an invalid value.
    pub fn invalid(&self, key: &'static str, expected: impl Into<Cow<'static, str>>) -> Error {
        match self.find(key) {
            Ok(Some(found)) => found.invalid(expected),
            Ok(None) => self.missing(key, expected),
            Err(error) => error,
        }
    }

    /// Checks that a key is not there; `expected` states the remedy and the reason.
    ///
    /// # Errors
    /// When it is there.
    pub fn refuse(&self, key: &'static str, expected: &'static str) -> Result<(), Error> {
        match self.find(key)? {
            Some(found) => Err(found.invalid(expected)),
            None => Ok(()),
        }
    }

    /// The error for two keys of which only one may be there.
    pub fn given_twice(&self, first: &'static str, second: &'static str) -> Error {
        Error::GivenTwice {
            place: self.place.clone(),
            first: self.full_name(first),
            second: self.full_name(second),
        }
    }
}
