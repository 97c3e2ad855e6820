use std::path::Path;

use super::RecordingHeader;
use super::foreign_names::Wanted;
use crate::Error;
use crate::table::{Header, Layout, TableText};

/// Lines that are searched even if they hold none of the names, for the error message.
const HEAD: usize = 50;

/// The table in `text` whose first line holds the names of all columns that are `wanted`, or as many of them as any
/// line does; and whether it holds all.
pub(super) fn find<'t>(
    text: &'t str,
    path: &Path,
    wanted: &[Wanted<'_>],
) -> Result<(TableText<'t>, bool), Error> {
    let mut above = Vec::new();
    let mut rest = text;
    let mut nearest: Option<(Likeness, TableText<'t>)> = None;
    while !rest.is_empty() {
        let (line, next) = rest.split_once('\n').unwrap_or((rest, ""));
        if above.len() < HEAD || wanted.iter().any(|quantity| quantity.may_be_in(line)) {
            for (likeness, mut table) in tables_at(rest, above.len() + 1, path, wanted) {
                if likeness.names == wanted.len() {
                    table.header = Header::of_foreign(&above, path, RecordingHeader::KEYS)?;
                    return Ok((table, true));
                }
                if nearest.as_ref().is_none_or(|(most, _)| likeness > *most) {
                    nearest = Some((likeness, table));
                }
            }
        }
        above.push(line);
        rest = next;
    }
    nearest
        .map(|(_, table)| (table, false))
        .ok_or_else(|| Error::NoRows {
            path: path.to_owned(),
        })
}

/// How well a line matches the names of the columns: more of the names, then more columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Likeness {
    names: usize,
    columns: usize,
}

/// The tables that begin at the first line of `text`, one for each delimiter.
fn tables_at<'t>(
    text: &'t str,
    line: usize,
    path: &Path,
    wanted: &[Wanted<'_>],
) -> impl Iterator<Item = (Likeness, TableText<'t>)> {
    // Some programs write the names of the columns as a comment.
    let text = text.trim_start_matches(['#', ' ']);
    b",;\t".iter().filter_map(move |&delimiter| {
        let layout = Layout {
            delimiter,
            decimal_comma: delimiter != b',',
        };
        let table = TableText::below(text, line, layout, path).ok().flatten()?;
        let columns = table.columns();
        let is_there = |quantity: &&Wanted<'_>| !quantity.candidates(columns).is_empty();
        let likeness = Likeness {
            // With the wrong delimiter one column holds all the words.
            names: wanted.iter().filter(is_there).count().min(columns.len()),
            columns: columns.len().min(3),
        };
        Some((likeness, table))
    })
}
