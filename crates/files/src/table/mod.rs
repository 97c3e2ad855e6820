//! Tables of numbers (CSV): comments with `# key = value` above a line with the names of the
//! columns, which may carry units.

mod columns;
mod end_mark;
mod header;
mod rows;
mod write;
mod writer;

use std::path::{Path, PathBuf};

pub(crate) use columns::Column;
pub use end_mark::Incomplete;
pub(crate) use end_mark::{Ended, RowDigest, end_mark};
pub use header::ExtraKey;
pub(crate) use header::Header;
pub(crate) use rows::{Row, Rows};
pub(crate) use write::{field, header_line};
pub(crate) use writer::TableWriter;
pub use writer::unfinished;

use crate::error::Place;
use crate::{Error, Key, cell_text};

/// The format of a table's fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) delimiter: u8,
    /// Whether a comma may stand for the decimal point.
    pub(crate) decimal_comma: bool,
}

impl Layout {
    /// As in the project's own files.
    pub(crate) const OWN: Self = Self {
        delimiter: b',',
        decimal_comma: false,
    };
}

/// Columns of a table at most: each name is compared with all that are known.
const MAX_COLUMNS: usize = 1000;

/// A table whose header is read and whose rows are still text.
#[derive(Debug, Clone)]
pub(crate) struct TableText<'t> {
    pub(crate) path: PathBuf,
    pub(crate) header: Header,
    columns: Vec<String>,
    column_line: usize,
    /// The text below the names of the columns and the number of its first line.
    below: &'t str,
    below_line: usize,
    layout: Layout,
}

impl<'t> TableText<'t> {
    /// Reads the head of one of the project's own tables, whose comments may hold the keys `known`
    /// and must hold `format = 1`.
    pub(crate) fn parse(text: &'t str, path: &Path, known: &'static [Key]) -> Result<Self, Error> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (above, rest) = header::comments_above(text);
        let mut header = Header::parse(&above, path, known)?;
        header.check_format(path)?;
        let line = above.len() + 1;
        Self::below(rest, line, Layout::OWN, path)?.map_or_else(
            || {
                Err(Error::BadRow {
                    place: Place::line(path, line),
                    found: "the end of the file".to_owned(),
                    expected: "a line with the names of the columns".to_owned(),
                })
            },
            |table| Ok(Self { header, ..table }),
        )
    }

    /// A table whose column names are the first line of `text`, which is line number `line`.
    pub(crate) fn below(
        text: &'t str,
        line: usize,
        layout: Layout,
        path: &Path,
    ) -> Result<Option<Self>, Error> {
        let (names, below) = text.split_once('\n').unwrap_or((text, ""));
        let mut table = Self {
            path: path.to_owned(),
            header: Header::default(),
            columns: Vec::new(),
            column_line: line,
            below: names,
            below_line: line,
            layout,
        };
        let names = match names.contains(['"', '\u{feff}']) {
            false => plain_fields(names, layout.delimiter),
            true => {
                let mut rows = table.rows();
                let names = rows.next()?;
                names.map(|row| row.fields().map(str::to_owned).collect())
            }
        };
        if names
            .as_ref()
            .is_some_and(|names| names.len() > MAX_COLUMNS)
        {
            return Err(Error::BadRow {
                place: Place::line(path, line),
                found: format!("more than {MAX_COLUMNS} columns"),
                expected: "fewer columns, and a line end after their names".to_owned(),
            });
        }
        table.below = below;
        table.below_line = line + 1;
        Ok(names.map(|columns| Self { columns, ..table }))
    }

    /// The names of the columns, as written.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    pub(crate) fn rows(&self) -> Rows<'_> {
        Rows::new(self)
    }

    pub(crate) fn column_place(&self) -> Place {
        Place::line(&self.path, self.column_line)
    }
}

/// The fields of the first row in a line without quotes, as the parser of CSV finds them, whose table of states takes
/// longer to build than a line to split.
fn plain_fields(line: &str, delimiter: u8) -> Option<Vec<String>> {
    // A carriage return ends a row, and a line feed alone ends a comment.
    let rows = line.split('\r').take_while(|row| !row.starts_with('#'));
    let mut rows = rows.map(|row| row.split(char::from(delimiter)).map(str::trim));
    let row = rows.find(|fields| rows::is_row(fields.clone()))?;
    Some(row.map(|field| cell_text(field).to_owned()).collect())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn parsed(line: &str, delimiter: u8) -> Option<Vec<String>> {
        let layout = Layout {
            delimiter,
            ..Layout::OWN
        };
        let table = TableText {
            path: PathBuf::from("f"),
            header: Header::default(),
            columns: Vec::new(),
            column_line: 1,
            below: line,
            below_line: 1,
            layout,
        };
        let mut rows = table.rows();
        let row = rows.next().unwrap();
        row.map(|row| row.fields().map(str::to_owned).collect())
    }

    proptest! {
        /// Judge: the parser of CSV.
        #[test]
        fn names_of_columns_are_those_of_the_parser(
            pieces in prop::collection::vec(
                prop::sample::select(vec![",", ";", "\t", " ", "#", "\"", "\r", "'", "=", "-1", "Zeit [s]", "é", "\u{feff}", "\u{a0}"]),
                0..12,
            ),
            delimiter in prop::sample::select(b",;\t".to_vec()),
        ) {
            let line: String = pieces.concat();
            let layout = Layout { delimiter, decimal_comma: false };
            let table = TableText::below(&line, 1, layout, Path::new("f")).unwrap();
            prop_assert_eq!(table.map(|table| table.columns), parsed(&line, delimiter));
        }
    }
}
