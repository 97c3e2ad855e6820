//! No problem panics, whatever it says.

use std::path::Path;

use palpate_jobs::solve::Problem;

use crate::readers;

/// The corpus of `fuzz/`: what led the reader somewhere new.
#[test]
fn the_corpus_of_problems_is_read_or_refused() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/problems");
    let mut accepted = 0;
    for entry in std::fs::read_dir(corpus).unwrap() {
        let path = entry.unwrap().path();
        println!("{}", path.display());
        let bytes = std::fs::read(path).unwrap();
        readers::read(&bytes);
        let text = String::from_utf8_lossy(&bytes);
        accepted += usize::from(Problem::parse(&text, Path::new("f")).is_ok());
    }
    // One of each kind at least: else the others would only meet the first error.
    assert!(accepted >= 5, "{accepted}");
}
