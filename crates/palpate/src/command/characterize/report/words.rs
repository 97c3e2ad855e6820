//! What things are called on a page.

use crate::report::{Markup, symbol};

/// `3 recordings`.
pub(super) fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {what}"),
        number => format!("{number} {what}s"),
    }
}

/// A law by its key in the answer, or by its name in a tissue file.
pub(super) fn law(key: &str) -> &str {
    match key {
        "neo_hookean" => "neo-Hookean",
        "mooney_rivlin" => "Mooney-Rivlin",
        "exponential" | "blatz" => "exponential (Blatz)",
        other => other,
    }
}

/// The key in the answer of a law by its name in a tissue file.
pub(super) fn key(name: &str) -> &str {
    match name {
        "blatz" => "exponential",
        other => other,
    }
}

/// What a key of the answer stands for.
pub(super) fn quantity(key: &str) -> String {
    match key {
        "mean_elastic_modulus" => "mean elastic modulus".to_owned(),
        "sum_of_g" => "sum of g".to_owned(),
        "kelvin" => "Kelvin's law".to_owned(),
        "blatz" => "Blatz's law on a column".to_owned(),
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

/// Sentences that deserve doubt, as a list; nothing of none.
pub(super) fn doubts(title: &str, sentences: &[String]) -> Markup {
    if sentences.is_empty() {
        return Markup::default();
    }
    let each = sentences
        .iter()
        .map(|said| Markup::plain("li", capital(said)));
    let list = Markup::plain("ul", each.collect::<Markup>());
    Markup::of_class("div", "doubts", Markup::plain("strong", title).and(list))
}

/// A sentence with a capital, unless it begins with a name of a file or a key.
fn capital(sentence: &str) -> String {
    let first = sentence.split_whitespace().next().unwrap_or_default();
    let is_word = first.chars().all(|letter| letter.is_ascii_lowercase());
    let mut letters = sentence.chars();
    match letters.next().filter(|_| is_word) {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => sentence.to_owned(),
    }
}
