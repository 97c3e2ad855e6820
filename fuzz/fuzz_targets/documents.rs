//! Any bytes as a document: the first byte names the reader, the rest is what it gets.

#![no_main]

use std::path::PathBuf;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/files/tests/it/readers.rs"]
mod readers;

/// A file that readers of files are given; quick where `TMPDIR` lies in memory.
static SCRATCH: LazyLock<PathBuf> =
    LazyLock::new(|| std::env::temp_dir().join(format!("palpate-fuzz-{}", std::process::id())));

fuzz_target!(|bytes: &[u8]| readers::read_as_told(bytes, &SCRATCH));
