//! Names on a page.

use palpate_files::tissue::LawName;

use crate::report::{Markup, symbol};

/// A law by its name.
pub(super) fn law(key: &str) -> &str {
    LawName::from_word(key).map_or(key, |law| law.row().title)
}

/// The meaning of a key of the answer.
pub(super) fn quantity(key: &str) -> String {
    match key {
        "mean_elastic_modulus" => "mean elastic modulus".to_owned(),
        "sum_of_g" => "sum of g".to_owned(),
        "linear_elastic" => "linear elastic contact".to_owned(),
        "adhesion" => "linear elastic contact with adhesion".to_owned(),
        "kelvin" => "Kelvin's law".to_owned(),
        "column" => "exponential law on a column".to_owned(),
        "nonlinear_springs" => "nonlinear springs".to_owned(),
        other => law(other).replace('_', " "),
    }
}

/// A parameter of `law`, both by their keys.
pub(super) fn parameter(law_key: &str, key: &str) -> Markup {
    match key {
        "mean_elastic_modulus" | "sum_of_g" => quantity(key).into(),
        key => symbol(key).and(format!(" {}", law(law_key))),
    }
}
