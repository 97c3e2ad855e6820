use std::borrow::Cow;

/// A line above a table: `# key = value`, the value in TOML.
pub(crate) fn header_line(key: &str, value: impl std::fmt::Display) -> String {
    format!("# {key} = {value}\n")
}

/// A text as a field of a table.
pub(crate) fn field(text: &str) -> Cow<'_, str> {
    // A leading `#` would read as a comment, and spaces at the ends would be trimmed.
    let plain = !text.contains([',', '"', '\n', '\r', '#']);
    if plain {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_quoted_only_when_needed() {
        assert_eq!(field("right"), "right");
        assert_eq!(field("a,b"), "\"a,b\"");
        assert_eq!(field("a \"b\""), "\"a \"\"b\"\"\"");
    }
}
