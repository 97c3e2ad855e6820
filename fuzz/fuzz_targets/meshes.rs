//! Any bytes as a mesh, a volume or a label map: the first byte names the reader, the rest is what it gets.

#![no_main]

use std::path::PathBuf;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/geometry/tests/it/readers.rs"]
mod readers;

/// A folder for the file that is read; quick where `TMPDIR` lies in memory.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("palpate-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
});

fuzz_target!(|bytes: &[u8]| readers::read_as_told(bytes, &FOLDER));
