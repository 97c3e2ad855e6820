use std::collections::BTreeMap;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::Error;
use crate::error::Place;

/// A TOML value with its original digits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Text(String),
    /// A number with its digits as written.
    Integer(i128, String),
    /// A number with its digits as written.
    Number(f64, String),
    Boolean(bool),
    Date(String),
    List(Vec<Value>),
    Table(Table),
}

/// The value of a key and the line that the key is on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) line: usize,
    pub(crate) value: Value,
}

pub(crate) type Table = BTreeMap<String, Entry>;

impl Value {
    /// The value as an error shows it.
    pub(crate) fn described(&self) -> String {
        match self {
            Self::Text(text) => format!("{text:?}"),
            Self::Integer(_, written) | Self::Number(_, written) | Self::Date(written) => {
                written.clone()
            }
            Self::Boolean(truth) => truth.to_string(),
            Self::List(values) if values.len() <= 4 => {
                let values: Vec<_> = values.iter().map(Self::described).collect();
                format!("[{}]", values.join(", "))
            }
            Self::List(values) => format!("a list of {} values", values.len()),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

/// Reads TOML whose first line is line number `first_line` of the file.
pub(crate) fn parse(text: &str, path: &Path, first_line: usize) -> Result<Table, Error> {
    let lines = Lines::new(text, first_line);
    let document = DeTable::parse(text).map_err(|error| Error::Syntax {
        place: Place::line(path, lines.at(error.span().map_or(0, |span| span.start))),
        // The reader's sentences may have several lines; ours have one.
        message: error.message().replace('\n', " "),
    })?;
    table(document.get_ref(), &lines, path)
}

fn table(source: &DeTable<'_>, lines: &Lines, path: &Path) -> Result<Table, Error> {
    source
        .iter()
        .map(|(key, value)| {
            let line = lines.at(key.span().start);
            let value = node(key.get_ref(), value, lines, path)?;
            Ok((key.get_ref().to_string(), Entry { line, value }))
        })
        .collect()
}

fn node(
    key: &str,
    value: &Spanned<DeValue<'_>>,
    lines: &Lines,
    path: &Path,
) -> Result<Value, Error> {
    let bad = |found: &str| Error::BadValue {
        place: Place::line(path, lines.at(value.span().start)),
        key: key.to_owned(),
        found: found.to_owned(),
        expected: "a number of an ordinary size".into(),
    };
    Ok(match value.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => {
            let value = i128::from_str_radix(integer.as_str(), integer.radix())
                .map_err(|_| bad(integer.as_str()))?;
            Value::Integer(value, integer.to_string())
        }
        DeValue::Float(float) => {
            let value = float.as_str().parse().map_err(|_| bad(float.as_str()))?;
            Value::Number(value, float.as_str().to_owned())
        }
        DeValue::Boolean(truth) => Value::Boolean(*truth),
        DeValue::Datetime(date) => Value::Date(date.to_string()),
        DeValue::Array(values) => Value::List(
            values
                .iter()
                .map(|value| node(key, value, lines, path))
                .collect::<Result<_, _>>()?,
        ),
        DeValue::Table(inner) => Value::Table(table(inner, lines, path)?),
    })
}

/// Where the lines of a text begin.
struct Lines {
    starts: Vec<usize>,
    first_line: usize,
}

impl Lines {
    fn new(text: &str, first_line: usize) -> Self {
        let after_newlines = text.match_indices('\n').map(|(byte, _)| byte + 1);
        Self {
            starts: std::iter::once(0).chain(after_newlines).collect(),
            first_line,
        }
    }

    /// Number of the line that holds a byte.
    fn at(&self, byte: usize) -> usize {
        self.first_line + self.starts.partition_point(|&start| start <= byte) - 1
    }
}

/// A text as a TOML value on one line.
pub(crate) fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            control if control.is_control() => {
                quoted.push_str(&format!("\\u{:04X}", u32::from(control)));
            }
            other => quoted.push(other),
        }
    }
    quoted.push('"');
    quoted
}

/// A number in TOML, with the fewest digits that read back to it.
pub(crate) fn number(value: f64) -> String {
    if value.is_nan() {
        // Rust writes `NaN`.
        return "nan".to_owned();
    }
    format!("{value:?}")
}
