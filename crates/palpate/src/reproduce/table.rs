//! The rows for a person.

use super::Row;

/// Aligned columns, and the notes below as numbered lines.
pub(crate) fn table(rows: &[Row]) -> String {
    let mut notes: Vec<&str> = Vec::new();
    let mut lines = vec![
        [
            "row",
            "published",
            "ours",
            "unit",
            "ratio",
            "took [s]",
            "note",
        ]
        .map(str::to_owned),
    ];
    for row in rows {
        lines.push(cells(row, number_of(&row.note, &mut notes)));
    }
    let widths: Vec<usize> = (0..7)
        .map(|column| {
            lines
                .iter()
                .map(|line| line[column].chars().count())
                .max()
                .unwrap_or(0)
        })
        .collect();
    let mut text = String::new();
    for line in &lines {
        for (column, cell) in line.iter().enumerate() {
            let width = widths[column];
            // Words to the left, numbers to the right.
            let padded = match column {
                0 | 3 => format!("{cell:<width$}  "),
                _ => format!("{cell:>width$}  "),
            };
            text.push_str(&padded);
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    for row in rows.iter().filter(|row| row.file.is_some()) {
        let file = row.file.iter().map(|file| file.display().to_string());
        text.push_str(&format!("\n{}: {}", row.row, file.collect::<String>()));
    }
    text.push('\n');
    for (number, note) in notes.iter().enumerate() {
        text.push_str(&format!("\n[{}] {note}", number + 1));
    }
    text
}

fn cells(row: &Row, note: String) -> [String; 7] {
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
