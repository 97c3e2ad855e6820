//! Suggestions for misspelled names.

use palpate_geometry::Organ;

use crate::Error;

/// The built-in organ of a name.
///
/// # Errors
/// When there is none, with the nearest.
pub fn builtin_organ(name: &str) -> Result<Organ, Error> {
    name.parse().map_err(|_| {
        let names = Organ::ALL.map(Organ::name);
        Error::input(format!(
            "there is no built-in organ `{name}`; the nearest is `{}`, and there are {}",
            nearest(name, &names),
            names.join(", ")
        ))
    })
}

/// The one of `known` that takes the fewest changed letters to become `name`, those that hold all of it first;
/// the first of equals.
pub fn nearest<'k>(name: &str, known: &[&'k str]) -> &'k str {
    let name = name.to_lowercase();
    let far = |known: &&&str| (!known.contains(&name), distance(&name, known));
    let by_distance = known.iter().min_by_key(far);
    by_distance.copied().unwrap_or_default()
}

/// Levenshtein's distance: letters put in, left out or changed.
fn distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, other) in to.iter().enumerate() {
            let changed = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_the_one_that_was_meant() {
        let known = ["liver", "kidney", "spleen"];
        assert_eq!(nearest("Kidny", &known), "kidney");
        assert_eq!(nearest("splen", &known), "spleen");
        let sides = ["liver", "kidney_right", "kidney_left"];
        assert_eq!(nearest("kidney", &sides), "kidney_left");
        assert_eq!(distance("kitten", "sitting"), 3);
    }
}
