use std::path::Path;

use crate::error::Place;
use crate::toml_document::{Table, Warnings, check_format, parse_toml};
use crate::words::near_miss;
use crate::{Error, Key, Keys, units};

/// Keys that may stand above a table: each is compared with all that are known, and no instrument writes more.
const MAX_KEYS: usize = 1000;

/// The comments above a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Header {
    entries: Table,
    warnings: Warnings,
    /// Keys that are not known, in the order of the file.
    pub(crate) extra: Vec<ExtraKey>,
}

/// An unknown key above a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExtraKey {
    /// Its name.
    pub key: String,
    /// Its value, as written.
    pub value: String,
}

/// The comments and blank lines above the first line of a table, and the text from there on.
pub(super) fn comments_above(text: &str) -> (Vec<&str>, &str) {
    let mut above = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (line, next) = rest.split_once('\n').unwrap_or((rest, ""));
        if !(line.trim().is_empty() || line.trim_start().starts_with('#')) {
            break;
        }
        above.push(line);
        rest = next;
    }
    (above, rest)
}

impl Header {
    /// The keys in the comments `above` a table, of which the first is line 1.
    pub(crate) fn parse(above: &[&str], path: &Path, known: &'static [Key]) -> Result<Self, Error> {
        let mut header = Self::default();
        let mut keys = 0;
        for (line, text) in (1..).zip(above) {
            let text = text.trim().trim_start_matches('#').trim();
            let Some((key, value)) = key_and_value(text) else {
                continue;
            };
            let place = Place::line(path, line);
            keys += 1;
            if keys > MAX_KEYS {
                return Err(Error::BadRow {
                    place,
                    found: format!("more than {MAX_KEYS} keys above the table"),
                    expected: "fewer, or the names of the columns before them".to_owned(),
                });
            }
            let is_known = |known: &Key| units::matches(key, known.name).is_some();
            if key == "format" || known.iter().any(is_known) {
                header.add(text, place)?;
            } else {
                check_stranger(key, known, place)?;
                header.extra.push(ExtraKey {
                    key: key.to_owned(),
                    value: value.to_owned(),
                });
            }
        }
        Ok(header)
    }

    /// The known keys in the comments above a table of another program. Other comments were not written for this
    /// program.
    pub(crate) fn of_foreign(
        above: &[&str],
        path: &Path,
        known: &'static [Key],
    ) -> Result<Self, Error> {
        let is_known = |line: &str| {
            let comment = line.trim().strip_prefix('#').and_then(key_and_value);
            comment
                .is_some_and(|(key, _)| known.iter().any(|k| units::matches(key, k.name).is_some()))
        };
        let ours: Vec<_> = above
            .iter()
            .map(|line| if is_known(line) { *line } else { "" })
            .collect();
        Self::parse(&ours, path, known)
    }

    fn add(&mut self, text: &str, place: Place) -> Result<(), Error> {
        for (key, entry) in parse_toml(text, &place.path, place.line.unwrap_or(1))? {
            if self.entries.contains_key(&key) {
                return Err(Error::GivenTwice {
                    place,
                    first: key.clone(),
                    second: key,
                });
            }
            self.entries.insert(key, entry);
        }
        Ok(())
    }

    pub(super) fn check_format(&mut self, path: &Path) -> Result<(), Error> {
        check_format(self.entries.remove("format"), path, "# format = 1")
    }

    /// The keys that are known.
    pub(crate) fn keys(&self, path: &Path, known: &'static [Key]) -> Keys<'_> {
        Keys::of_table(
            Place::file(path),
            String::new(),
            &self.entries,
            known,
            &self.warnings,
        )
    }
}

/// `key = value`; none for a comment in plain words.
pub(super) fn key_and_value(text: &str) -> Option<(&str, &str)> {
    let (key, value) = text.split_once('=')?;
    let key = key.trim();
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    (!key.is_empty() && key.chars().all(is_bare)).then_some((key, value.trim()))
}

/// Anybody may write more keys above a table, but one that is nearly a known key is a mistake.
fn check_stranger(key: &str, known: &[Key], place: Place) -> Result<(), Error> {
    // `length_unit` is somebody's own key; `length` and `length_kg` are `length_m` gone wrong.
    let is_base = |known: &str| {
        known.starts_with(key) && units::split(known).is_some_and(|(base, _)| base == key)
    };
    let named = known.iter().map(|known| known.name);
    let known: Vec<&str> = named.chain(["format"]).collect();
    let has_unit = units::split(key).is_some();
    let accepted = known
        .iter()
        .filter(|known| has_unit || is_base(known))
        .find_map(|known| units::accepted_instead(key, known));
    if let Some(accepted) = accepted {
        return Err(Error::UnknownUnit {
            place,
            key: key.to_owned(),
            accepted,
        });
    }
    match near_miss(key, &known) {
        Some(nearest) => Err(Error::UnknownKey {
            place,
            key: key.to_owned(),
            nearest: nearest.to_owned(),
        }),
        None => Ok(()),
    }
}
