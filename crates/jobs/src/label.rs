//! Labels of a segmented volume, as people name them, and what their surfaces leave in doubt.

use palpate_geometry::{Isosurface, Label};

use crate::{Error, nearest};

/// The label that is called so, by its name or its number.
///
/// # Errors
/// When there is none, with those that there are.
pub fn find<'l>(labels: &'l [Label], wanted: &str) -> Result<&'l Label, Error> {
    let is_wanted = |label: &&Label| {
        label.name.as_deref() == Some(wanted) || wanted.parse() == Ok(label.number)
    };
    let found = labels.iter().find(is_wanted);
    found.ok_or_else(|| absent(labels, wanted))
}

fn absent(labels: &[Label], wanted: &str) -> Error {
    let there: Vec<_> = labels.iter().map(in_words).collect();
    let names: Vec<&str> = labels
        .iter()
        .filter_map(|label| label.name.as_deref())
        .collect();
    let is_number = wanted.parse::<u32>().is_ok();
    let nearest = match names.is_empty() || is_number {
        true => String::new(),
        false => format!("the nearest is {}, and ", nearest(wanted, &names)),
    };
    match there.is_empty() {
        true => Error::input("the volume has no label but zero; give one that is segmented"),
        false => Error::input(format!(
            "the volume has no label {wanted:?}; {nearest}there are {}",
            there.join(", ")
        )),
    }
}

/// What deserves doubt in a label's surface, as sentences.
pub fn doubts(label: &Label, found: &Isosurface) -> Vec<String> {
    let name = in_words(label);
    let all = [
        (
            found.other_pieces > 0,
            format!(
                "{name}: {} smaller pieces were left out, {} of {} voxels",
                found.other_pieces, found.other_voxels, label.voxels
            ),
        ),
        (
            found.filled_voxels > 0,
            format!(
                "{name}: {} voxels that were shut in were filled",
                found.filled_voxels
            ),
        ),
        (
            found.is_cut,
            format!("{name}: the border of the volume cuts it; it is closed by a flat side there"),
        ),
        (
            found.simplified.self_intersections > 0,
            format!(
                "{name}: {} triangles meet others; ask for more triangles",
                found.simplified.self_intersections
            ),
        ),
    ];
    all.into_iter()
        .filter(|(holds, _)| *holds)
        .map(|(_, text)| text)
        .collect()
}

/// A label's number, and its name if it has one.
pub fn in_words(label: &Label) -> String {
    match &label.name {
        Some(name) => format!("{} ({name})", label.number),
        None => label.number.to_string(),
    }
}
