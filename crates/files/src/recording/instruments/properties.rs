//! Java's properties: lines `key=value` [Java SE API, `java.util.Properties.load`].
//!
//! *Limits*: a key ends at the first `=`; no line goes on in the next. Programs of JPK write them so.

use std::collections::BTreeMap;

/// Values by their keys.
#[derive(Debug, Default)]
pub(super) struct Properties(BTreeMap<String, String>);

impl Properties {
    /// Those in `bytes`, each of which is a character of Latin-1.
    pub(super) fn parse(bytes: &[u8]) -> Self {
        let text: String = bytes.iter().map(|&byte| byte as char).collect();
        let lines = text.lines().map(str::trim_start);
        let lines = lines.filter(|line| !line.starts_with(['#', '!']));
        let pairs = lines.filter_map(|line| line.split_once('='));
        Self(
            pairs
                .map(|(key, value)| (key.trim_end().to_owned(), unescaped(value.trim_start())))
                .collect(),
        )
    }

    pub(super) fn get(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(String::as_str)
    }

    /// The value of the first key that begins and ends so.
    pub(super) fn between(&self, beginning: &str, end: &str) -> Option<&str> {
        let from = self.0.range(beginning.to_owned()..);
        let mut own = from.take_while(|(key, _)| key.starts_with(beginning));
        own.find(|(key, _)| key.ends_with(end))
            .map(|(_, value)| value.as_str())
    }
}

/// A finite number.
pub(super) fn number(text: &str) -> Option<f64> {
    let number: f64 = text.trim().parse().ok()?;
    number.is_finite().then_some(number)
}

/// Without the escapes `\:`, `\ ` and `\u00b5`.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        if c != '\\' {
            plain.push(c);
            continue;
        }
        match rest.next() {
            Some('u') => {
                let digits: String = rest.by_ref().take(4).collect();
                let code = u32::from_str_radix(&digits, 16).ok();
                plain.extend(code.and_then(char::from_u32));
            }
            other => plain.extend(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_and_comments() {
        let read = Properties::parse(b"#a=1\n b=2\\:3 \\u00b5m\nc.x.d= 4e-3\nbroken\n");
        assert_eq!(read.get("a"), None);
        assert_eq!(read.get("b"), Some("2:3 µm"));
        assert_eq!(read.between("c.", ".d").and_then(number), Some(4e-3));
        assert_eq!(number("2:3"), None);
        assert_eq!(number("NaN"), None);
    }
}
