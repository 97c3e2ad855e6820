//! All that is printed goes through here: results to standard output, complaints to standard error.
//!
//! A reader that has gone is reported as [`Failure::NobodyReads`], which ends the command quietly.

use std::fmt::Display;
use std::io::{self, Write};

use serde::Serialize;

use crate::failure::Failure;

/// The version that stands in every machine-readable answer as `palpate`.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Prints `text` to standard output, with a line end if it has none.
pub(crate) fn text(text: impl Display) -> Result<(), Failure> {
    let mut text = text.to_string();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    Ok(stdout.flush()?)
}

/// Prints `answer` as one JSON document.
pub(crate) fn json(answer: &impl Serialize) -> Result<(), Failure> {
    text(json_text(answer)?)
}

/// `answer` as one JSON document.
pub(crate) fn json_text(answer: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(answer).map_err(|error| {
        Failure::failed(format!(
            "the answer is no JSON ({error}); use the text output"
        ))
    })
}

/// Prints a failure as one sentence to standard error.
pub(crate) fn error(failure: &Failure) {
    complain("error", failure);
}

/// Prints what deserves doubt to standard error, one line each.
pub(crate) fn warnings(warnings: &[String]) {
    for warning in warnings {
        complain("warning", warning);
    }
}

/// When standard error cannot be written either, there is nobody left to tell.
fn complain(kind: &str, message: impl Display) {
    let _ = writeln!(io::stderr().lock(), "palpate: {kind}: {message}");
}
