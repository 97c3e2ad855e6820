//! All printing goes through here: results to standard output, warnings and errors to standard error. Characters that
//! control a terminal (names come from anywhere) are printed as escapes, [`palpate_files::printable`], so that no
//! command can forget it; this program prints no colours of its own.
//!
//! A closed standard output is reported as [`Failure::ClosedPipe`], which ends the command quietly.

use std::fmt::Display;
use std::io::{self, Write};

use palpate_files::{is_hidden, printable, printable_lines};
use serde::Serialize;

use crate::failure::Failure;

/// The version, which every machine-readable answer has as `palpate`.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The version with build information.
pub(crate) const LONG_VERSION: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    "\ncommit ",
    env!("PALPATE_COMMIT"),
    "\ntarget ",
    env!("PALPATE_TARGET"),
    "\ndevices haply, openhaptics, force_dimension (libraries are loaded when one is opened)",
);

/// Prints `text` to standard output, with a line end if it has none.
pub(crate) fn text(text: impl Display) -> Result<(), Failure> {
    print(printable_lines(&text.to_string()))
}

/// Prints `text` to standard output as one line.
pub(crate) fn line(text: impl Display) -> Result<(), Failure> {
    print(printable(&text.to_string()))
}

/// Prints `answer` as one JSON document.
pub(crate) fn json(answer: &impl Serialize) -> Result<(), Failure> {
    print(json_text(answer)?)
}

/// `answer` as one JSON document, in which hidden characters are JSON's escapes.
pub(crate) fn json_text(answer: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(answer).map_err(|error| {
        Failure::failed(format!(
            "the answer is no JSON ({error}); use the text output"
        ))
    })?;
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        // The line ends are those between values: in a text they are escaped already, as are C0 characters.
        match letter != '\n' && is_hidden(letter) {
            true => {
                let mut units = [0; 2];
                for unit in letter.encode_utf16(&mut units) {
                    escaped += &format!("\\u{unit:04x}");
                }
            }
            false => escaped.push(letter),
        }
    }
    Ok(escaped)
}

/// Prints text that is printable already.
fn print(text: impl Into<String>) -> Result<(), Failure> {
    let mut text = text.into();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes())?;
    Ok(stdout.flush()?)
}

/// Prints a failure as one sentence to standard error, and the help that belongs to it below.
pub(crate) fn error(failure: &Failure) {
    complain("error", failure);
    if let Failure::CommandLine { help, .. } = failure {
        let _ = writeln!(io::stderr().lock(), "\n{}", printable_lines(help));
    }
}

/// Prints warnings to standard error, one line each.
pub(crate) fn warnings(warnings: &[String]) {
    for warning in warnings {
        complain("warning", warning);
    }
}

/// When standard error cannot be written either, there is no way to report it.
fn complain(kind: &str, message: impl Display) {
    let message = message.to_string();
    let _ = writeln!(
        io::stderr().lock(),
        "palpate: {kind}: {}",
        printable(&message)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader of JSON gets the bytes of a name, without characters that control a terminal.
    #[test]
    fn json_is_printable_and_means_the_same() {
        let name = "\u{1b}]0;\u{7}\u{9b}2J\u{7f}\u{202e}\u{e0041}\nliver \u{e4}";
        let text = json_text(&name).unwrap();
        assert_eq!(printable(&text), text);
        assert_eq!(serde_json::from_str::<String>(&text).unwrap(), name);
    }
}
