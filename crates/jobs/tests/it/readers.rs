//! The reader of problems, given any bytes. `fuzz/fuzz_targets/problems.rs` has this file too.

use std::path::Path;

use palpate_jobs::solve::Problem;

/// Reads a problem, which is not solved. An error must say where and that the input is invalid.
pub(crate) fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    // A tissue that it names lies beside it, in a folder that does not exist, or has an absolute path.
    if let Err(error) = Problem::parse(&text, Path::new("f/f")) {
        let message = error.to_string();
        assert!(error.is_input(), "{message}");
        assert!(message.starts_with(['f', '/']), "{message}");
    }
}
