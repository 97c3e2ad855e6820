use std::borrow::Cow;

use crate::ReadFault;

/// The lines of a text with their numbers from one. Bytes that are not UTF-8 (a name in an old
/// encoding, say) are replaced, not refused.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    bytes
        .split(|&b| b == b'\n')
        .enumerate()
        .map(|(index, line)| (index + 1, String::from_utf8_lossy(line)))
}

pub(crate) fn number(word: Option<&str>, line: usize) -> Result<f64, ReadFault> {
    let word = word.unwrap_or("");
    word.parse().map_err(|_| unexpected(line, word, "a number"))
}

pub(crate) fn unexpected(line: usize, found: &str, expected: &'static str) -> ReadFault {
    /// A damaged file may have megabytes on one line.
    const MOST_CHARACTERS: usize = 60;
    let found = found.trim().chars().filter(|c| !c.is_control());
    ReadFault::Unexpected {
        line,
        found: found.take(MOST_CHARACTERS).collect(),
        expected,
    }
}
