//! Real recordings, lent to the tests from outside of the project.

use std::path::PathBuf;

/// The folder of real recordings, or nothing after a line that says why.
pub(crate) fn folder() -> Option<PathBuf> {
    let lent = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let folder = std::env::var_os("PALPATE_DATA").map_or(PathBuf::from(lent), PathBuf::from);
    let folder = folder.join("characterization");
    if folder.is_dir() {
        return Some(folder);
    }
    println!(
        "passed over: no real recordings in {}; set PALPATE_DATA to the folder around it",
        folder.display()
    );
    None
}
