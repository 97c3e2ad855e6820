use std::borrow::Cow;

use crate::text_cell;

/// A line above a table: `# key = value`, the value in TOML.
pub(crate) fn header_line(key: &str, value: impl std::fmt::Display) -> String {
    format!("# {key} = {value}\n")
}

/// A text as a field of a table, which is no formula in a spreadsheet. [`super::Row`] gives it back as it is.
pub(crate) fn field(text: &str) -> Cow<'_, str> {
    let cell = text_cell(text);
    // A leading `#` would read as a comment, and spaces at the ends would be trimmed.
    match cell.contains([',', '"', '\n', '\r', '#']) {
        true => Cow::Owned(format!("\"{}\"", cell.replace('"', "\"\""))),
        false => cell,
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
