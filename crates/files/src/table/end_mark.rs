//! The last line of a table of numbers: how many rows stand above it, and their digest.
//!
//! ```text
//! # end = { rows = 1201, sha256 = "9f86…" }
//! ```
//!
//! The digest is the SHA-256 of the line with the names of the columns and of every line below it down to the
//! mark, each ended by one line feed. The comments above the names do not count, so that a header may be completed
//! by hand. A table that is written by hand may end with `# end = { rows = 3 }`.

use std::fmt::{self, Write as _};
use std::path::Path;

use sha2::{Digest, Sha256};

use super::header::{comments_above, key_and_value};
use crate::atomic_write::newlines;
use crate::toml_document::{Value, parse_toml};

/// Why a table may lack rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Incomplete {
    /// There is no end mark.
    Unmarked,
    /// The last line has no line end: writing was interrupted. It is left out.
    CutLine {
        /// Its number, from one.
        line: usize,
    },
    /// The last line has no line end, and its last number may be truncated. It counts all the same.
    OpenLine {
        /// Its number, from one.
        line: usize,
    },
    /// The end mark states another number of rows.
    OtherRows {
        /// The number in the mark.
        marked: u64,
        /// The number of rows that were read.
        found: usize,
    },
    /// The digest in the end mark does not match the rows.
    OtherContent,
}

impl fmt::Display for Incomplete {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unmarked => f.write_str(
                "incomplete: no end mark (`# end = ...`) follows its last row, so it was cut off, or written by \
                 hand or by an earlier version",
            ),
            Self::CutLine { line } => write!(
                f,
                "incomplete: line {line} was cut off in its middle, and is left out"
            ),
            Self::OpenLine { line } => write!(
                f,
                "incomplete: line {line} is the last and has no line end, so that its last number may have been cut off"
            ),
            Self::OtherRows { marked, found } => write!(
                f,
                "incomplete or changed: the end mark is of {marked} rows, and there are {found}"
            ),
            Self::OtherContent => f.write_str(
                "changed or damaged: the digest in its end mark is that of other rows",
            ),
        }
    }
}

/// The digest of the names of the columns and of the rows below them, line by line.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowDigest(Sha256);

impl RowDigest {
    pub(crate) fn add(&mut self, lines: &str) {
        for line in lines.lines() {
            self.0.update(line);
            self.0.update("\n");
        }
    }

    /// The end mark of so many rows.
    pub(super) fn mark(self, rows: usize) -> String {
        let digest = self.hexadecimal();
        format!("# end = {{ rows = {rows}, sha256 = \"{digest}\" }}\n")
    }

    /// In hexadecimal digits.
    pub(crate) fn hexadecimal(self) -> String {
        self.0
            .finalize()
            .iter()
            .fold(String::new(), |mut text, byte| {
                write!(text, "{byte:02x}").expect("a string takes every text");
                text
            })
    }
}

/// The end mark of the table in `text`, which has so many rows.
pub(crate) fn end_mark(text: &str, rows: usize) -> String {
    let mut digest = RowDigest::default();
    digest.add(comments_above(text).1);
    digest.mark(rows)
}

/// The whole lines of a table, and its end mark.
pub(crate) struct Ended<'t> {
    /// The text without a last line that was cut off.
    pub(crate) whole: &'t str,
    /// The number of that line, from one.
    pub(crate) cut_line: Option<usize>,
    mark: Option<Mark>,
    /// The text above the mark.
    above: &'t str,
}

/// The content of an end mark.
struct Mark {
    rows: u64,
    sha256: Option<String>,
}

impl<'t> Ended<'t> {
    pub(crate) fn of(text: &'t str) -> Self {
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let rest = text[whole.len()..].trim();
        // A comment has no number that could be truncated, and an end mark counts without its line end.
        let is_cut = !rest.is_empty() && !rest.starts_with('#');
        let cut_line = is_cut.then(|| 1 + newlines(whole.as_bytes()));
        let whole = if is_cut { whole } else { text };
        let trimmed = whole.trim_end();
        let last = trimmed.rfind('\n').map_or(0, |end| end + 1);
        Self {
            whole,
            cut_line,
            mark: Mark::of(&trimmed[last..]),
            above: &whole[..last],
        }
    }

    /// Why the table of so many rows may lack some; none where its end mark matches.
    pub(crate) fn incomplete(&self, rows: usize) -> Option<Incomplete> {
        if let Some(line) = self.cut_line {
            return Some(Incomplete::CutLine { line });
        }
        let Some(mark) = &self.mark else {
            return Some(Incomplete::Unmarked);
        };
        if mark.rows != rows as u64 {
            return Some(Incomplete::OtherRows {
                marked: mark.rows,
                found: rows,
            });
        }
        let own = mark.sha256.as_ref()?;
        let mut digest = RowDigest::default();
        digest.add(comments_above(self.above).1);
        (*own != digest.hexadecimal()).then_some(Incomplete::OtherContent)
    }
}

impl Mark {
    /// A line that is an end mark.
    fn of(line: &str) -> Option<Self> {
        let text = line.trim().strip_prefix('#')?.trim();
        key_and_value(text).filter(|(key, _)| *key == "end")?;
        let entries = parse_toml(text, Path::new(""), 1).ok()?;
        let Value::Table(entries) = &entries.get("end")?.value else {
            return None;
        };
        let rows = match entries.get("rows")?.value {
            Value::Integer(rows, _) => u64::try_from(rows).ok()?,
            _ => return None,
        };
        let sha256 = match entries.get("sha256").map(|entry| &entry.value) {
            Some(Value::Text(text)) => Some(text.clone()),
            Some(_) => return None,
            None => None,
        };
        Some(Self { rows, sha256 })
    }
}
