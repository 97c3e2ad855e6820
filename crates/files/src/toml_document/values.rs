use std::borrow::Cow;

use crate::error::Place;
use crate::words::or_list;
use crate::{Error, Keys};

use super::key::{Key, ValueType};
use super::value::{Entry, Table, Value};

impl<'d> Keys<'d> {
    /// A text that is not empty.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn text(&self, key: &'static str) -> Result<Option<String>, Error> {
        self.read(
            key,
            "a text in double quotes that is not empty",
            |value| match value {
                Value::Text(text) if !text.trim().is_empty() => Some(text.clone()),
                _ => None,
            },
        )
    }

    /// A text that is not empty, or a whole number as a text: a name that may be a number.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn text_or_integer(&self, key: &'static str) -> Result<Option<String>, Error> {
        match self.find(key)?.map(|found| found.value) {
            Some(Value::Integer(value, _)) => Ok(Some(value.to_string())),
            _ => self.text(key),
        }
    }

    /// A list of texts; empty when the key is missing.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn texts(&self, key: &'static str) -> Result<Vec<String>, Error> {
        let list = self.read(key, "a list of texts", |value| {
            let Value::List(values) = value else {
                return None;
            };
            values
                .iter()
                .map(|value| match value {
                    Value::Text(text) => Some(text.clone()),
                    _ => None,
                })
                .collect()
        })?;
        Ok(list.unwrap_or_default())
    }

    /// `true` or `false`.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn boolean(&self, key: &'static str) -> Result<Option<bool>, Error> {
        self.read(key, "true or false", |value| match value {
            Value::Boolean(truth) => Some(*truth),
            _ => None,
        })
    }

    /// One of a list of `words`.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn word<T: Copy>(
        &self,
        key: &'static str,
        words: &[(&'static str, T)],
    ) -> Result<Option<T>, Error> {
        debug_assert!(
            self.lists(key, words),
            "`{key}` is declared with other words than are read"
        );
        let names: Vec<_> = words.iter().map(|(word, _)| format!("{word:?}")).collect();
        let mut expected = or_list(&names);
        if let ValueType::WordOrTable(_, keys) = self.declared(key).value_type {
            let keys: Vec<_> = keys.iter().map(|key| key.name).collect();
            expected += &format!(", or a table {{ {} }}", keys.join(", "));
        }
        self.read(key, expected, |value| match value {
            Value::Text(text) => words.iter().find(|(word, _)| word == text).map(|(_, t)| *t),
            _ => None,
        })
    }

    /// One of a list of `words`, or one of the `former` words that earlier versions wrote, which no error names.
    ///
    /// # Errors
    /// When the value is anything else.
    pub fn word_or_former<T: Copy>(
        &self,
        key: &'static str,
        words: &[(&'static str, T)],
        former: &[(&'static str, T)],
    ) -> Result<Option<T>, Error> {
        if let Some(Value::Text(text)) = self.find(key)?.map(|found| found.value)
            && let Some((_, value)) = former.iter().find(|(word, _)| word == text)
        {
            return Ok(Some(*value));
        }
        self.word(key, words)
    }

    /// Whether the value of a key is a text.
    pub fn is_text(&self, key: &'static str) -> bool {
        matches!(
            self.entry(key),
            Some(Entry {
                value: Value::Text(_),
                ..
            })
        )
    }

    /// Whether the value of a key is a table.
    pub(crate) fn is_table(&self, key: &'static str) -> bool {
        matches!(
            self.entry(key),
            Some(Entry {
                value: Value::Table(_),
                ..
            })
        )
    }

    /// A table with the keys that are declared for it.
    ///
    /// # Errors
    /// When the value is no table or has another key.
    pub fn table(&self, key: &'static str) -> Result<Option<Keys<'d>>, Error> {
        self.table_of(key, self.declared(key).keys())
    }

    /// A table of which `known` are the keys that may occur.
    pub(crate) fn table_of(
        &self,
        key: &'static str,
        known: &'static [Key],
    ) -> Result<Option<Keys<'d>>, Error> {
        let Some(found) = self.find(key)? else {
            return Ok(None);
        };
        let Value::Table(table) = found.value else {
            return Err(found.invalid("a table"));
        };
        let keys = Keys::of_table(found.place, found.key, table, known, found.warnings);
        keys.only_declared()?;
        Ok(Some(keys))
    }

    /// A table whose keys are free names.
    ///
    /// # Errors
    /// When the value is no table.
    pub(crate) fn any_table(&self, key: &'static str) -> Result<Option<&'d Table>, Error> {
        self.read(key, "a table", |value| match value {
            Value::Table(table) => Some(table),
            _ => None,
        })
    }

    /// A list, each of whose values is interpreted.
    ///
    /// # Errors
    /// When the value is no list, or one of its values is invalid.
    pub(crate) fn values_of<T>(
        &self,
        key: &'static str,
        expected: &'static str,
        understand: impl Fn(&Value) -> Option<T>,
    ) -> Result<Vec<T>, Error> {
        let list = self.read(key, expected, |value| match value {
            Value::List(values) => values.iter().map(&understand).collect(),
            _ => None,
        })?;
        Ok(list.unwrap_or_default())
    }

    /// A list of tables with the keys that are declared for them; empty when the key is missing.
    ///
    /// # Errors
    /// When the value is no list of tables or one of them has another key.
    pub fn tables(&self, key: &'static str) -> Result<Vec<Keys<'d>>, Error> {
        let known = self.declared(key).keys();
        let Some(found) = self.find(key)? else {
            return Ok(Vec::new());
        };
        // A table in place of a list is a list of one here.
        if let (ValueType::TableOrTables(_), Value::Table(_)) =
            (self.declared(key).value_type, found.value)
        {
            return Ok(self.table_of(key, known)?.into_iter().collect());
        }
        let Value::List(values) = found.value else {
            return Err(found.invalid("a list of tables"));
        };
        values
            .iter()
            .enumerate()
            .map(|(number, value)| {
                let Value::Table(table) = value else {
                    return Err(found.invalid("a list of tables"));
                };
                // Each table of a list has its own lines; the list is on the line of its first key.
                let line = table.values().map(|entry| entry.line).min();
                let place = line.map_or(found.place.clone(), |line| {
                    Place::line(&found.place.path, line)
                });
                let name = format!("{}[{number}]", found.key);
                let keys = Keys::of_table(place, name, table, known, found.warnings);
                keys.only_declared()?;
                Ok(keys)
            })
            .collect()
    }

    /// Whether a key is declared with these words.
    fn lists<T>(&self, key: &str, words: &[(&'static str, T)]) -> bool {
        let own = words.iter().map(|(word, _)| *word);
        match self.declared(key).value_type {
            ValueType::Word(declared) | ValueType::WordOrTable(declared, _) => {
                declared.iter().map(|(word, _)| *word).eq(own)
            }
            _ => false,
        }
    }

    fn read<T>(
        &self,
        key: &'static str,
        expected: impl Into<Cow<'static, str>>,
        understand: impl FnOnce(&'d Value) -> Option<T>,
    ) -> Result<Option<T>, Error> {
        let Some(found) = self.find(key)? else {
            return Ok(None);
        };
        match understand(found.value) {
            Some(value) => Ok(Some(value)),
            None => Err(found.invalid(expected)),
        }
    }
}
