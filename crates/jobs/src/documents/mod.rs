//! Documentation of the documents, from the declarations that their readers use: a template, a JSON Schema for
//! editors, and the reference for people.

mod reference;
mod schema;
mod template;

use palpate_files::{Key, Omitted, Protocol, Scene, Tissue, ValueType};

use crate::solve::Problem;

pub use reference::reference;
pub use schema::schema;
pub use template::template;

/// A kind of document that people write.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its word.
    pub word: &'static str,
    /// A sentence that describes it.
    pub meaning: &'static str,
    /// Its keys, without `format`.
    pub keys: &'static [Key],
    /// Whether `{ draw = "NAME" }` may stand for any value.
    can_draw: bool,
}

/// All kinds.
pub fn kinds() -> Vec<Kind> {
    let fixed = |word, meaning, keys| Kind {
        word,
        meaning,
        keys,
        can_draw: false,
    };
    let mut kinds = vec![
        Kind {
            can_draw: true,
            ..fixed(
                "scene",
                "An organ, what it is made of, what moves it, the tools that touch it, and what there is to do.",
                Scene::KEYS,
            )
        },
        fixed("tissue", "What an organ is made of.", Tissue::FILE),
        fixed(
            "protocol",
            "What the rig measures: every stimulus on every specimen.",
            Protocol::KEYS,
        ),
    ];
    let problems = Problem::kinds();
    kinds.extend(problems.map(|(word, meaning, keys)| fixed(word, meaning, keys)));
    kinds
}

/// A kind by its word.
pub fn kind(word: &str) -> Option<Kind> {
    kinds().into_iter().find(|kind| kind.word == word)
}

/// The values of a key, with the units that its name may end in.
fn holds(key: &Key) -> String {
    let list =
        |domain: palpate_files::Domain, what: &str| format!("{what}, each {}", domain.expected());
    match key.value_type {
        ValueType::Number(domain) => domain.expected(),
        ValueType::Estimate(domain) => format!(
            "{}, or a table `{{ value, standard_error }}`",
            domain.expected()
        ),
        ValueType::NumberOrDraw(domain) => format!("{}, or the name of a draw", domain.expected()),
        ValueType::Vector(domain) => list(domain, "three numbers [x, y, z]"),
        ValueType::Numbers(domain) => list(domain, "a list of numbers"),
        ValueType::Vectors(domain) => list(domain, "a list of points [x, y, z]"),
        ValueType::Direction => "a direction: three numbers, not all 0".to_owned(),
        ValueType::Integer(0, u64::MAX) => "a whole number".to_owned(),
        ValueType::Integer(least, most) => format!("a whole number from {least} to {most}"),
        ValueType::Boolean => "`true` or `false`".to_owned(),
        ValueType::Text => "a text".to_owned(),
        ValueType::Label => "a text or a whole number".to_owned(),
        ValueType::Texts => "a list of texts".to_owned(),
        ValueType::Path => "a path, from the document's folder".to_owned(),
        ValueType::Word(_) => "one of the words".to_owned(),
        ValueType::WordOrTable(..) => "one of the words, or a table".to_owned(),
        ValueType::Table(_) => "a table".to_owned(),
        ValueType::TableOrTables(_) => "a table, or a list of tables".to_owned(),
        ValueType::PathOrTable(_) => "a path, from the document's folder, or a table".to_owned(),
        ValueType::Tables(_) => "a list of tables".to_owned(),
        ValueType::Named(_) => "tables under names of your choice".to_owned(),
        ValueType::Other(what) => what.to_owned(),
    }
}

/// The default of a key.
fn omitted(key: &Key) -> String {
    match key.omitted {
        Omitted::Refused => "required".to_owned(),
        Omitted::RefusedWithout(other) => format!("required without `{other}`"),
        Omitted::Example => format!("default {}", key.example),
        Omitted::Means(meaning) => format!("default: {meaning}"),
    }
}

/// The meaning of a key on one line.
fn meaning(key: &Key) -> String {
    key.meaning.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether the value of a key is written under a header of its own.
fn is_table(key: &Key) -> bool {
    matches!(
        key.value_type,
        ValueType::Table(_)
            | ValueType::TableOrTables(_)
            | ValueType::Tables(_)
            | ValueType::Named(_)
    )
}
