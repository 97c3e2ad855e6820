//! The texts of the trainer's window: `assets/texts/*.ftl`, in the format of Fluent, which has placeholders and the
//! plural forms of each language.
//!
//! A phrase that the chosen language lacks is English. The language belongs to the thread of the window.
//!
//! *How we know*: `window::texts::tests`: every key that the sources name is in the English catalogue and the other way
//! round; every translation has the placeholders of its English phrase.

use std::cell::RefCell;

use fluent_bundle::{FluentArgs, FluentBundle, FluentResource, FluentValue};
use palpate_files::Language;
use palpate_simulate::performance::{Phrase, PhraseValue};

/// The text of a key, with its placeholders filled: `text!("home-tried", count = 3)`.
macro_rules! text {
    ($key:expr $(, $name:ident = $value:expr)* $(,)?) => {
        $crate::window::texts::translate($key, &[$((stringify!($name), $value.into())),*])
    };
}
pub(super) use text;

const ENGLISH: &str = include_str!("../../../../assets/texts/en.ftl");

/// The languages that can be chosen, each in its own words, with its catalogue.
const LANGUAGES: [(Language, &str, &str); 3] = [
    (Language::English, "English", ENGLISH),
    (
        Language::German,
        "Deutsch",
        include_str!("../../../../assets/texts/de.ftl"),
    ),
    (
        Language::French,
        "Français",
        include_str!("../../../../assets/texts/fr.ftl"),
    ),
];

/// Keys of the texts of tasks begin with this.
const OF_TASKS: &str = "task-";

/// The phrases of a language.
struct Catalogue {
    language: Language,
    bundle: FluentBundle<FluentResource>,
}

impl Catalogue {
    fn new(language: Language) -> Self {
        let source = source(language);
        // A test reads every catalogue without an error.
        let resource = FluentResource::try_new(source.to_owned());
        let resource = resource.unwrap_or_else(|(read, _)| read);
        let locale = language.word().parse().unwrap_or_default();
        let mut bundle = FluentBundle::new(vec![locale]);
        // Marks around placeholders are for texts of both directions of writing.
        bundle.set_use_isolating(false);
        // The first of two phrases with one key stays; a test finds them.
        let _ = bundle.add_resource(resource);
        Self { language, bundle }
    }

    fn translate(&self, key: &str, values: &[(&str, FluentValue<'_>)]) -> Option<String> {
        let pattern = self.bundle.get_message(key)?.value()?;
        let values: FluentArgs<'_> = values.iter().cloned().collect();
        // What a phrase lacks is seen in its place.
        let mut lacking = Vec::new();
        let said = self
            .bundle
            .format_pattern(pattern, Some(&values), &mut lacking);
        Some(said.into_owned())
    }
}

thread_local! {
    /// The language of this thread's window, and English for what it lacks.
    static SPOKEN: RefCell<[Catalogue; 2]> =
        RefCell::new([Language::English, Language::English].map(Catalogue::new));
}

fn source(language: Language) -> &'static str {
    let own = LANGUAGES.iter().find(|(own, ..)| *own == language);
    own.map_or(ENGLISH, |(_, _, source)| *source)
}

/// The keys of a catalogue.
fn keys(source: &str) -> impl Iterator<Item = &str> {
    let lines = source.lines();
    let phrases = lines.filter(|line| line.starts_with(|letter: char| letter.is_ascii_lowercase()));
    phrases.filter_map(|line| Some(line.split_once('=')?.0.trim()))
}

/// From now on the texts of this thread are in `language`.
pub(super) fn set_language(language: Language) {
    SPOKEN.with_borrow_mut(|[spoken, _]| {
        if spoken.language != language {
            *spoken = Catalogue::new(language);
        }
    });
}

/// The languages that can be chosen, each in its own words.
pub(super) fn languages() -> impl Iterator<Item = (Language, &'static str)> {
    LANGUAGES
        .iter()
        .map(|(language, name, _)| (*language, *name))
}

/// How many phrases the chosen language has, and how many there are.
pub(super) fn translated() -> [usize; 2] {
    SPOKEN.with_borrow(|[spoken, _]| {
        let all: Vec<&str> = keys(ENGLISH).collect();
        let own = all.iter().filter(|key| spoken.bundle.has_message(key));
        [own.count(), all.len()]
    })
}

/// The text of a key, in the chosen language or else in English, with its placeholders filled.
pub(super) fn translate(key: &str, values: &[(&str, FluentValue<'_>)]) -> String {
    find(key, values).unwrap_or_else(|| key.to_owned())
}

/// The text of a key that is made of a name; none where the catalogue does not know the name.
pub(super) fn translate_if_known(key: &str) -> Option<String> {
    find(key, &[])
}

fn find(key: &str, values: &[(&str, FluentValue<'_>)]) -> Option<String> {
    SPOKEN.with_borrow(|catalogues| catalogues.iter().find_map(|own| own.translate(key, values)))
}

/// The name of a tool of a scene: `left` and `right` are hands.
pub(super) fn tool_name(name: &str) -> String {
    match name {
        "left" => text!("hand-left"),
        "right" => text!("hand-right"),
        name => name.to_owned(),
    }
}

/// Label of a key of the keyboard.
pub(super) fn key_name(key: &str) -> String {
    let named = format!("key-{}", key.to_lowercase());
    translate_if_known(&named).unwrap_or_else(|| key.to_owned())
}

/// A phrase of the simulation in the chosen language.
pub(super) fn phrase(own: &Phrase) -> String {
    let value = |value: &PhraseValue| -> FluentValue<'static> {
        match value {
            PhraseValue::Number(number) => (*number).into(),
            PhraseValue::Phrase(inner) => phrase(inner).into(),
        }
    };
    let values = own.values.iter().map(|(name, own)| (*name, value(own)));
    translate(own.key, &values.collect::<Vec<_>>())
}

/// A number with so many decimals, as the chosen language writes it.
pub(super) fn decimal(value: f64, decimals: usize) -> String {
    written(&format!("{value:.decimals$}"))
}

/// A number with the decimal separator of the chosen language.
pub(super) fn written(number: &str) -> String {
    match SPOKEN.with_borrow(|[spoken, _]| spoken.language) {
        Language::German | Language::French => number.replace('.', ","),
        Language::English | Language::System => number.to_owned(),
    }
}

/// Title or instructions of a task in the chosen language, if the task comes with the program and says the same as the
/// English catalogue; else as the task says them.
pub(super) fn of_task(words: &str) -> String {
    let key = SPOKEN.with_borrow(|[_, english]| {
        let mut own = keys(ENGLISH).filter(|key| key.starts_with(OF_TASKS));
        own.find(|key| english.translate(key, &[]).as_deref() == Some(words))
    });
    key.map_or_else(|| words.to_owned(), |key| translate(key, &[]))
}

#[cfg(test)]
mod tests;
