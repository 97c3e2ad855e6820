//! Labels of a segmented volume by name or number, and warnings about their surfaces.

use palpate_geometry::{Isosurface, Label};

use crate::{Error, nearest};

/// The label of this number, or else of this name.
///
/// # Errors
/// When there is none, with the available labels, or when several have the name.
pub fn find<'l>(labels: &'l [Label], wanted: &str) -> Result<&'l Label, Error> {
    let by_number = labels
        .iter()
        .find(|label| wanted.parse() == Ok(label.number));
    if let Some(found) = by_number {
        return Ok(found);
    }
    let of_name = |label: &&Label| label.name.as_deref() == Some(wanted);
    let found: Vec<&Label> = labels.iter().filter(of_name).collect();
    match found.as_slice() {
        [] => Err(absent(labels, wanted)),
        [only] => Ok(only),
        several => {
            let numbers: Vec<_> = several.iter().map(|l| l.number.to_string()).collect();
            Err(Error::input(format!(
                "the labels {} are all called {wanted:?}; choose one by its number, such as {}",
                numbers.join(", "),
                numbers[0]
            )))
        }
    }
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

/// Warnings about a label's surface, as sentences.
pub fn warnings(label: &Label, found: &Isosurface) -> Vec<String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn label(number: u16, name: &str) -> Label {
        Label {
            number,
            name: Some(name.to_owned()),
            voxels: 1,
            volume: 1e-9,
        }
    }

    #[test]
    fn a_name_that_two_labels_have_is_refused_with_both_numbers() {
        let labels = [label(2, "spleen"), label(3, "liver"), label(7, "liver")];
        let error = find(&labels, "liver").unwrap_err();
        assert!(error.is_input());
        let error = error.to_string();
        assert!(
            error.contains("3, 7") && error.contains("by its number"),
            "{error}"
        );
        assert_eq!(find(&labels, "7").unwrap(), &labels[2]);
        assert_eq!(find(&labels, "spleen").unwrap(), &labels[0]);
        assert!(find(&labels, "kidney").is_err());
    }

    /// Otherwise the label 5 could not be selected.
    #[test]
    fn a_number_is_a_number_before_it_is_a_name() {
        let labels = [label(4, "5"), label(5, "liver")];
        assert_eq!(find(&labels, "5").unwrap(), &labels[1]);
    }
}
