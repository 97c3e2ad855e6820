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
    let found: String = found.trim().chars().filter(|c| !c.is_control()).collect();
    ReadFault::Unexpected {
        line,
        found: shortened(&found).into_owned(),
        expected,
    }
}

/// Longest quotation of a file in an error [characters]: a damaged file may have megabytes on one
/// line.
const LONGEST_QUOTATION: usize = 200;

/// A text as an error quotes it: one longer than 200 characters is cut there, with its length.
pub(crate) fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(LONGEST_QUOTATION) {
        None => Cow::Borrowed(text),
        Some((end, _)) => Cow::Owned(format!("{}… ({} bytes)", &text[..end], text.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotations_are_short() {
        let line = format!("v {}", "9".repeat(5_000_000));
        let error = unexpected(3, &line, "a number").to_string();
        assert!(error.len() < 500, "{} bytes", error.len());
        assert!(error.contains("5000002 bytes"), "{error}");
        assert_eq!(shortened("é"), "é");
    }
}
