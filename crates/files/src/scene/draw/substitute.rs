//! Substitutes drawn values.

use std::path::Path;

use toml::Value as Toml;

use super::Drawn;
use crate::Error;
use crate::error::Place;
use crate::toml_document::{Entry, Table, Value, toml_number};
use crate::words::nearest;

/// The key that refers to a draw.
const TAKES: &str = "draw";

/// A table in which every `{ draw = "NAME" }` is the value of that name.
pub(super) fn in_table(
    table: &Table,
    values: &[(String, Drawn)],
    path: &Path,
) -> Result<Table, Error> {
    let one = |(key, entry): (&String, &Entry)| {
        let value = in_value(&entry.value, values, path, key, entry.line)?;
        let line = entry.line;
        Ok((key.clone(), Entry { line, value }))
    };
    table.iter().map(one).collect()
}

fn in_value(
    value: &Value,
    values: &[(String, Drawn)],
    path: &Path,
    key: &str,
    line: usize,
) -> Result<Value, Error> {
    match value {
        Value::Table(table) if table.len() == 1 && table.contains_key(TAKES) => {
            let bad = |found: String, expected: String| Error::BadValue {
                place: Place::line(path, line),
                key: format!("{key}.{TAKES}"),
                found,
                expected: expected.into(),
            };
            let reference = &table[TAKES].value;
            let Value::Text(name) = reference else {
                let expected = "the name of a draw, in double quotes".to_owned();
                return Err(bad(reference.described(), expected));
            };
            match values.iter().find(|(own, _)| own == name) {
                Some((_, drawn)) => Ok(drawn.in_document()),
                None => {
                    let names: Vec<&str> = values.iter().map(|(own, _)| own.as_str()).collect();
                    let expected = match nearest(name, &names) {
                        Some((nearest, _)) => format!("a name in `[draw]`, such as {nearest:?}"),
                        None => "a name in `[draw]`".to_owned(),
                    };
                    Err(bad(reference.described(), expected))
                }
            }
        }
        Value::Table(table) => Ok(Value::Table(in_table(table, values, path)?)),
        Value::List(list) => {
            let each = list
                .iter()
                .map(|value| in_value(value, values, path, key, line));
            Ok(Value::List(each.collect::<Result<_, _>>()?))
        }
        other => Ok(other.clone()),
    }
}

impl Drawn {
    fn in_document(&self) -> Value {
        let number = |value: f64| Value::Number(value, toml_number(value));
        match self {
            Self::Number(value) => number(*value),
            Self::Vector(vector) => Value::List(vector.iter().map(|c| number(*c)).collect()),
            Self::Text(text) => Value::Text(text.clone()),
        }
    }
}

/// The table `[variant]`.
pub(super) fn entry(seed: u64, drawn: &[(String, Drawn)]) -> Entry {
    let at_line = |value| Entry { line: 0, value };
    let drawn = drawn
        .iter()
        .map(|(name, value)| (name.clone(), at_line(value.in_document())));
    let seed = Value::Integer(i128::from(seed), seed.to_string());
    at_line(Value::Table(Table::from([
        ("seed".to_owned(), at_line(seed)),
        ("drawn".to_owned(), at_line(Value::Table(drawn.collect()))),
    ])))
}

/// A table as TOML.
pub(super) fn text(table: Table) -> String {
    toml::to_string(&in_toml(Value::Table(table))).expect("tables with keys of text are TOML")
}

fn in_toml(value: Value) -> Toml {
    match value {
        Value::Text(text) => Toml::String(text),
        Value::Integer(value, _) => match i64::try_from(value) {
            Ok(value) => Toml::Integer(value),
            Err(_) => Toml::Float(value as f64),
        },
        Value::Number(value, _) => Toml::Float(value),
        Value::Boolean(truth) => Toml::Boolean(truth),
        Value::Date(date) => match date.parse() {
            Ok(date) => Toml::Datetime(date),
            Err(_) => Toml::String(date),
        },
        Value::List(values) => Toml::Array(values.into_iter().map(in_toml).collect()),
        Value::Table(table) => {
            let each = table.into_iter();
            Toml::Table(
                each.map(|(key, entry)| (key, in_toml(entry.value)))
                    .collect(),
            )
        }
    }
}
