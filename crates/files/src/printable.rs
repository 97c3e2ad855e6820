//! Text from elsewhere, made safe to show: names in documents, names of files and of devices, messages of libraries.
//!
//! Control characters control a terminal, and invisible characters mislead a reader. Both are shown as escapes,
//! `\u{1b}`. A spreadsheet treats a text that begins with `=` as a formula; [`text_cell`] puts an apostrophe before
//! it, as people do.
//!
//! *How we know*: the tests below; `foreign_text::…` of the command, with hostile names in every kind of document.
//!
//! *Limits*: letters that look like others (`а` and `a`) are not told apart. A text that holds `\u{1b}` in letters
//! looks like an escape.

use std::borrow::Cow;

use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Beginnings of a formula in a spreadsheet; the last four are the wide forms that some programs accept.
const FORMULA: [char; 11] = ['=', '+', '-', '@', '\t', '\r', '\n', '＝', '＋', '－', '＠'];

/// Whether a character controls its display, or is invisible: control characters (C0, DEL, C1), format characters
/// such as those that turn the direction of writing, separators of lines, and letters without a shape.
pub fn is_hidden(letter: char) -> bool {
    use GeneralCategory::{Control, Format, LineSeparator, ParagraphSeparator};
    if letter.is_ascii() {
        return letter.is_ascii_control();
    }
    let fillers = matches!(letter, '\u{115f}' | '\u{1160}' | '\u{3164}' | '\u{ffa0}');
    let category = letter.general_category();
    let hidden = [Control, Format, LineSeparator, ParagraphSeparator];
    fillers || hidden.contains(&category)
}

/// `text` as one line: every hidden character is shown as an escape.
pub fn printable(text: &str) -> Cow<'_, str> {
    shown(text, is_hidden)
}

/// As [`printable`], but lines end where they did.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    shown(text, |letter| letter != '\n' && is_hidden(letter))
}

fn shown(text: &str, is_hidden: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.chars().any(&is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(2 * text.len());
    for letter in text.chars() {
        match is_hidden(letter) {
            true => shown.extend(letter.escape_unicode()),
            false => shown.push(letter),
        }
    }
    Cow::Owned(shown)
}

/// `text` as a cell that no spreadsheet treats as a formula. Numbers are unchanged. [`cell_text`] gives the text
/// back.
pub fn text_cell(text: &str) -> Cow<'_, str> {
    match is_formula(text) {
        true => Cow::Owned(format!("'{text}")),
        false => Cow::Borrowed(text),
    }
}

/// The text of a cell that [`text_cell`] made.
pub fn cell_text(cell: &str) -> &str {
    match cell.strip_prefix('\'') {
        Some(text) if is_formula(text) => text,
        _ => cell,
    }
}

/// Whether a text begins as a formula. One with apostrophes before that counts too, so that [`cell_text`] can tell
/// which were added.
fn is_formula(text: &str) -> bool {
    let text = text.trim_start_matches('\'');
    text.starts_with(FORMULA) && text.parse::<f64>().is_err()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_shown_as_escapes() {
        for (text, expected) in [
            ("\u{1b}]0;title\u{7}", r"\u{1b}]0;title\u{7}"),
            ("\u{9b}31m\u{7f}", r"\u{9b}31m\u{7f}"),
            ("a\r\nb\tc", r"a\u{d}\u{a}b\u{9}c"),
            // Right-to-left override, isolate, zero-width space, byte-order mark, tag, line separator, filler.
            ("\u{202e}\u{2066}\u{200b}", r"\u{202e}\u{2066}\u{200b}"),
            ("\u{feff}\u{e0041}\u{2028}", r"\u{feff}\u{e0041}\u{2028}"),
            ("\u{3164}", r"\u{3164}"),
        ] {
            assert_eq!(printable(text), expected);
        }
        for plain in [
            "Lebergewebe, 4 °C",
            "肝臓",
            "كبد",
            "5 ± 1\u{202f}mm",
            "é",
            "'=1",
        ] {
            assert!(matches!(printable(plain), Cow::Borrowed(_)), "{plain}");
        }
        assert_eq!(printable_lines("a\n\u{1b}[2J"), "a\n\\u{1b}[2J");
    }

    #[test]
    fn no_cell_of_text_is_a_formula_and_all_come_back() {
        for formula in [
            "=HYPERLINK(\"x\")",
            "+1+1",
            "-2+3",
            "@SUM(A1)",
            "\t=1",
            "\r=1",
            "\n=1",
            "＝1",
            "'=1",
            "''-x",
            "-",
        ] {
            let cell = text_cell(formula);
            assert!(cell.starts_with('\''), "{formula}");
            assert_eq!(cell_text(&cell), formula);
        }
        for plain in [
            "liver", "-5", "+1.5e-3", "-inf", "", "'", "'liver", "a=b", "'-5",
        ] {
            assert_eq!(text_cell(plain), plain);
            assert_eq!(cell_text(plain), plain);
        }
    }
}
