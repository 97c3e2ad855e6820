use std::fmt;

use palpate_files::printable_lines;

/// Well-formed markup: text is escaped, and every element is closed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Markup(String);

impl Markup {
    /// Of an `svg` that was drawn by this program.
    pub(crate) fn drawn(svg: String) -> Self {
        Self(svg)
    }

    pub(crate) fn element(
        name: &str,
        attributes: &[(&str, &str)],
        inside: impl Into<Self>,
    ) -> Self {
        let mut opened = format!("<{name}");
        for (key, value) in attributes {
            let value = Self::from(*value);
            opened += &format!(" {key}=\"{value}\"");
        }
        let inside = inside.into();
        Self(format!("{opened}>{inside}</{name}>"))
    }

    /// An element without attributes.
    pub(crate) fn plain(name: &str, inside: impl Into<Self>) -> Self {
        Self::element(name, &[], inside)
    }

    /// An element of a class.
    pub(crate) fn of_class(name: &str, class: &str, inside: impl Into<Self>) -> Self {
        Self::element(name, &[("class", class)], inside)
    }

    pub(crate) fn and(mut self, next: impl Into<Self>) -> Self {
        self.0 += &next.into().0;
        self
    }
}

/// Escaped text; hidden characters, which XML may not hold or no reader sees, are shown as [`printable_lines`].
impl From<&str> for Markup {
    fn from(text: &str) -> Self {
        let mut escaped = String::with_capacity(text.len());
        for letter in printable_lines(text).chars() {
            match letter {
                '&' => escaped += "&amp;",
                '<' => escaped += "&lt;",
                '>' => escaped += "&gt;",
                '"' => escaped += "&quot;",
                '\u{fffe}' | '\u{ffff}' => escaped.push(char::REPLACEMENT_CHARACTER),
                letter => escaped.push(letter),
            }
        }
        Self(escaped)
    }
}

impl From<String> for Markup {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl FromIterator<Self> for Markup {
    fn from_iter<T: IntoIterator<Item = Self>>(each: T) -> Self {
        each.into_iter().fold(Self::default(), Self::and)
    }
}

impl fmt::Display for Markup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_no_markup() {
        let hostile = Markup::element("p", &[("title", "\"><script>")], "<b>&\u{1}\u{202e}");
        let expected = "<p title=\"&quot;&gt;&lt;script&gt;\">&lt;b&gt;&amp;\\u{1}\\u{202e}</p>";
        assert_eq!(hostile.to_string(), expected);
    }
}
