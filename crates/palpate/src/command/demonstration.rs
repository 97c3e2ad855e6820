//! `palpate` without arguments.

use crate::failure::Failure;

/// A first touch that needs no file.
pub(crate) fn run() -> Result<(), Failure> {
    Err(Failure::failed(
        "the demonstration is not here yet; see `palpate --help` for what is",
    ))
}
