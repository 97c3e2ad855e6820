use super::Markup;

/// `3 recordings`.
pub(crate) fn count(number: usize, what: &str) -> String {
    match number {
        1 => format!("1 {what}"),
        number => format!("{number} {what}s"),
    }
}

/// Warnings as a list; empty without warnings.
pub(crate) fn warning_list(title: &str, sentences: &[String]) -> Markup {
    if sentences.is_empty() {
        return Markup::default();
    }
    let each = sentences
        .iter()
        .map(|warning| Markup::plain("li", capital(warning)));
    let list = Markup::plain("ul", each.collect::<Markup>());
    Markup::of_class("div", "warnings", Markup::plain("strong", title).and(list))
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
