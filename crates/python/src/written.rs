//! Files that a program asks to be written.

use std::path::Path;

use palpate_files::{Claim, Error, Overwrite};

use crate::failure::Failure;

/// Writes `path`; a file that exists is replaced where that is allowed, else it is an error.
pub(crate) fn write(
    path: &Path,
    overwrite: bool,
    write: impl FnOnce(&Path) -> Result<(), Error>,
) -> Result<(), Failure> {
    let _claims = Claim::of_files([path], Overwrite::of_option(overwrite))?;
    Ok(write(path)?)
}
