//! The rows as a table for people.

use super::mark::Mark;
use super::{Item, Row};

/// The name and title of `item` over its rows.
pub fn section(item: &Item, rows: &[Row]) -> String {
    format!("{}: {}\n\n{}", item.name, item.title, table(rows))
}

/// What the marks of `rows` mean; empty without one.
pub fn legend(rows: &[Row]) -> String {
    let is_used = |mark: &Mark| rows.iter().any(|row| row.mark == Some(*mark));
    let used = Mark::ALL.into_iter().filter(is_used);
    used.map(|mark| format!("{}: {}.\n", mark.word(), mark.meaning()))
        .collect()
}

const NAMES: [&str; 8] = [
    "row",
    "published",
    "ours",
    "unit",
    "ratio",
    "took [s]",
    "note",
    "mark",
];

/// Aligned columns, and the notes below as numbered lines.
fn table(rows: &[Row]) -> String {
    let mut notes: Vec<&str> = Vec::new();
    let mut lines = vec![NAMES.map(str::to_owned)];
    for row in rows {
        lines.push(cells(row, number_of(&row.note, &mut notes)));
    }
    let is_empty = |column: usize| lines[1..].iter().all(|line| line[column].is_empty());
    let columns: Vec<usize> = (0..NAMES.len())
        .filter(|&column| column != 7 || !is_empty(column))
        .collect();
    let width = |column: usize| {
        let widths = lines.iter().map(|line| line[column].chars().count());
        widths.max().unwrap_or(0)
    };
    let mut text = String::new();
    for line in &lines {
        for &column in &columns {
            let (cell, width) = (&line[column], width(column));
            // Words to the left, numbers to the right.
            let padded = match column {
                0 | 3 | 7 => format!("{cell:<width$}  "),
                _ => format!("{cell:>width$}  "),
            };
            text.push_str(&padded);
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    let files = rows
        .iter()
        .filter_map(|row| Some((row, row.file.as_ref()?)));
    let files: String = files
        .map(|(row, file)| format!("{}: {}\n", row.row, file.display()))
        .collect();
    let notes = notes.iter().enumerate();
    let notes: String = notes
        .map(|(place, note)| format!("[{}] {note}\n", place + 1))
        .collect();
    let parts = [text, files, notes].into_iter();
    let parts = parts.filter(|part| !part.is_empty());
    parts.map(|part| part + "\n").collect()
}

fn cells(row: &Row, note: String) -> [String; 8] {
    [
        row.row.clone(),
        number(row.published),
        match (&row.file, row.ours) {
            (Some(_), _) => "figure".to_owned(),
            (None, ours) => number(ours),
        },
        row.unit.to_owned(),
        number(row.ratio),
        format!("{:.1}", row.seconds),
        note,
        row.mark.map_or("", Mark::word).to_owned(),
    ]
}

/// Rows with the same note share its number.
fn number_of<'r>(note: &'r str, notes: &mut Vec<&'r str>) -> String {
    if note.is_empty() {
        return String::new();
    }
    let known = notes.iter().position(|known| *known == note);
    let at = known.unwrap_or_else(|| {
        notes.push(note);
        notes.len() - 1
    });
    format!("[{}]", at + 1)
}

/// Four digits; nothing is a dash.
fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) if value.fract() == 0.0 && value.abs() < 1e6 => format!("{value}"),
        Some(value) if (1e-3..1e5).contains(&value.abs()) => {
            let digits = 3 - value.abs().log10().floor() as i32;
            format!("{value:.*}", digits.max(0) as usize)
        }
        Some(value) => format!("{value:.3e}"),
    }
}
