//! No reader panics, whatever it is given.

use std::collections::BTreeSet;
use std::path::Path;

use palpate_files::recording::ForeignColumns;
use palpate_files::{Protocol, Recording, Scene, Session};
use proptest::prelude::*;

use crate::readers::{self, READERS};
use crate::{MOTION, PROTOCOL, RECORDING, SCENE, SESSION, TISSUE, tries};

/// Gives a text to every reader.
fn read_all(text: &str) {
    let folder = tempfile::tempdir().unwrap();
    for reader in READERS {
        readers::read(*reader, text.as_bytes(), &folder.path().join("scratch"));
    }
}

/// The corpus of `fuzz/`: what led a reader somewhere new.
#[test]
fn the_corpus_is_read_or_refused() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/documents");
    let folder = tempfile::tempdir().unwrap();
    let mut met = BTreeSet::new();
    for entry in std::fs::read_dir(corpus).unwrap() {
        let path = entry.unwrap().path();
        println!("{}", path.display());
        let bytes = std::fs::read(path).unwrap();
        met.extend(bytes.first().copied());
        readers::read_as_told(&bytes, &folder.path().join("scratch"));
    }
    assert!(READERS.iter().all(|reader| met.contains(reader)), "{met:?}");
}

/// One of the valid documents with some of its bytes replaced, removed or repeated.
fn mutated() -> impl Strategy<Value = String> {
    let documents = [SCENE, TISSUE, MOTION, PROTOCOL, SESSION, RECORDING];
    let pieces = prop_oneof![
        Just(""),
        Just("\n"),
        Just("\r"),
        Just("\""),
        Just(","),
        Just("#"),
        Just("-"),
        Just("1e999"),
        Just("nan"),
        Just("["),
        Just("{"),
        Just("é"),
        Just("\0"),
        Just("99999999999999999999999999999999999999999"),
    ];
    let place = any::<prop::sample::Index>();
    let change = (place, 0usize..20, pieces);
    let changes = prop::collection::vec(change, 1..6);
    (prop::sample::select(documents.to_vec()), changes).prop_map(|(document, changes)| {
        let mut bytes = document.as_bytes().to_vec();
        for (place, removed, piece) in changes {
            let start = place.index(bytes.len().max(1)).min(bytes.len());
            let end = (start + removed).min(bytes.len());
            bytes.splice(start..end, piece.bytes());
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

proptest! {
    #![proptest_config(tries(10_000))]

    #[test]
    #[ignore = "long"]
    fn changed_documents_are_read_or_refused(text in mutated()) {
        read_all(&text);
    }

    #[test]
    #[ignore = "long"]
    fn any_text_is_refused(text in any::<String>()) {
        read_all(&text);
        read_all(&format!("format = 1\n{text}"));
        read_all(&format!("# format = 1\n{text}"));
    }
}

proptest! {
    #![proptest_config(tries(500))]

    #[test]
    fn any_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        std::fs::write(&path, &bytes).unwrap();
        let _ = Scene::read(&path);
        let _ = Protocol::read(&path);
        let _ = Session::read(&path);
        let _ = Recording::read_foreign(&path, &ForeignColumns::default());
    }
}

/// What is changed below was right: else the changes would only ever meet the first error.
#[test]
fn the_protocol_that_is_changed_is_one() {
    let protocol = Protocol::parse(PROTOCOL, "f").unwrap();
    assert_eq!((protocol.specimens.len(), protocol.stimuli.len()), (2, 5));
}

#[test]
fn deep_nesting_is_refused() {
    read_all(&format!("format = 1\na = {}", "[".repeat(100_000)));
    read_all(&format!("format = 1\na = {}", "{a=".repeat(100_000)));
    read_all(&format!("format = 1\n{} = 1", "a.".repeat(100_000)));
    read_all(&format!("format = 1\n[{}a]", "a.".repeat(100_000)));
}
