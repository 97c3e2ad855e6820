use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::*;

/// The phrases of a catalogue: keys and texts, with all their lines.
fn phrases(source: &str) -> BTreeMap<&str, String> {
    let mut phrases: BTreeMap<&str, String> = BTreeMap::new();
    let mut key = "";
    for line in source.lines().filter(|line| !line.starts_with('#')) {
        let mut text = line;
        if let Some((own, rest)) = line.split_once('=').filter(|_| !line.starts_with(' ')) {
            assert!(!phrases.contains_key(own.trim()), "{own} is there twice");
            (key, text) = (own.trim(), rest);
        }
        let own = phrases.entry(key).or_default();
        own.push_str(text);
        own.push('\n');
    }
    phrases
}

/// Names of placeholders.
fn placeholders(text: &str) -> BTreeSet<&str> {
    let names = text.split('$').skip(1);
    let end = |letter: char| !letter.is_ascii_alphanumeric() && letter != '_';
    names.filter_map(|rest| rest.split(end).next()).collect()
}

#[test]
fn every_catalogue_is_read_without_an_error() {
    for (language, _, source) in LANGUAGES {
        let read = FluentResource::try_new(source.to_owned());
        assert!(read.is_ok(), "{language:?}: {read:?}");
        let found: BTreeSet<_> = phrases(source)
            .into_keys()
            .filter(|key| !key.is_empty())
            .collect();
        let listed: Vec<_> = keys(source).collect();
        assert_eq!(listed.len(), found.len(), "{language:?}");
    }
}

/// A translation has the placeholders of its English phrase, and no phrase of its own.
#[test]
fn translations_fill_the_same_placeholders() {
    let english = phrases(ENGLISH);
    for (language, _, source) in LANGUAGES {
        for (key, text) in phrases(source) {
            let Some(original) = english.get(key) else {
                panic!("{language:?}: {key} is no key of en.ftl")
            };
            assert_eq!(
                placeholders(&text),
                placeholders(original),
                "{language:?}: {key}"
            );
        }
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => sources(&path, found),
            false => found.push(path),
        }
    }
}

/// Texts of the sources that look like keys, outside of tests.
fn named() -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("../simulate/src/performance/feedback.rs")];
    sources(&root.join("src/window"), &mut files);
    let mut found = BTreeSet::new();
    let is_test = |file: &Path| file.to_string_lossy().ends_with("tests.rs");
    for file in files.iter().filter(|file| !is_test(file)) {
        let text = std::fs::read_to_string(file).unwrap();
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let literals = text.split('"').filter(|literal| {
            let parts: Vec<_> = literal.split('-').collect();
            let is_part = |part: &&str| {
                !part.is_empty()
                    && part
                        .chars()
                        .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
            };
            let is_word = literal.starts_with(|c: char| c.is_ascii_lowercase());
            is_word && parts.len() > 1 && parts.iter().all(is_part)
        });
        found.extend(literals.map(str::to_owned));
    }
    found
}

/// Names of a thread and of packages, which are no keys.
const NO_KEYS: [&str; 4] = [
    "libx11-6",
    "libx11-xcb1",
    "libxkbcommon-x11-0",
    "palpate-demonstration",
];

/// Keys that are made of a name: of a task's text, a measure, a key of the keyboard.
const MADE: [&str; 3] = [OF_TASKS, "measure-", "key-"];

#[test]
fn every_key_is_in_the_catalogue_and_used() {
    let named = named();
    let english: BTreeSet<_> = keys(ENGLISH).collect();
    for key in named.iter().filter(|key| !NO_KEYS.contains(&key.as_str())) {
        assert!(english.contains(key.as_str()), "{key} is not in en.ftl");
    }
    for key in &english {
        let is_made = MADE.iter().any(|beginning| key.starts_with(beginning));
        assert!(
            is_made || named.contains(*key),
            "nothing uses {key} of en.ftl"
        );
    }
}

/// What comes with the program is in the catalogue, so that it can be translated.
#[test]
fn tasks_have_their_texts_in_the_catalogue() {
    let tasks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/tasks");
    let mut files = Vec::new();
    sources(&tasks, &mut files);
    files.retain(|file| file.extension().is_some_and(|end| end == "toml"));
    assert!(files.len() >= 4);
    set_language(Language::German);
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let scene = palpate_files::Scene::parse(&text, &file).unwrap();
        let own = [scene.task.title, scene.task.instructions].map(Option::unwrap);
        for words in &own {
            let key = keys(ENGLISH).filter(|key| key.starts_with(OF_TASKS));
            let mut english = key.map(|key| Catalogue::new(Language::English).translate(key, &[]));
            let is_there = english.any(|own| own.as_deref() == Some(words));
            assert!(is_there, "{}: `{words}` is not in en.ftl", file.display());
        }
        assert_ne!(of_task(&own[1]), own[1], "{} in German", file.display());
    }
    assert_eq!(of_task("A task of my own"), "A task of my own");
}

/// Judge: grammars. French has one error where there are none, German and English have several.
#[test]
fn plurals_and_numbers_are_those_of_the_language() {
    for (language, none, one, two, half) in [
        (
            Language::English,
            "9 s, 0 errors",
            "9 s, 1 error",
            "9 s, 2 errors",
            "0.5",
        ),
        (
            Language::German,
            "9 s, 0 Fehler",
            "9 s, 1 Fehler",
            "9 s, 2 Fehler",
            "0,5",
        ),
        (
            Language::French,
            "9 s, 0 erreur",
            "9 s, 1 erreur",
            "9 s, 2 erreurs",
            "0,5",
        ),
    ] {
        set_language(language);
        for (errors, words) in [(0, none), (1, one), (2, two)] {
            assert_eq!(text!("common-time-errors", s = 9.0, errors = errors), words);
        }
        assert_eq!(decimal(0.5, 1), half);
        assert_eq!(translated()[1], keys(ENGLISH).count());
    }
}

/// What a language lacks is English.
#[test]
fn a_phrase_that_is_not_translated_is_english() {
    let lacking = Catalogue::new(Language::French);
    assert_eq!(lacking.translate("no-such-key", &[]), None);
    set_language(Language::French);
    assert_eq!(text!("common-back"), "Retour");
    assert_eq!(translate("no-such-key", &[]), "no-such-key");
}
