//! Words of the documents: enumerations that are written as text, and lists and quotations in sentences.

use std::borrow::Cow;

/// An enumeration whose variants are written as words.
pub(crate) trait Worded: Copy + 'static {
    /// Every variant with its word.
    const WORDS: &'static [(&'static str, Self)];

    /// The word that stands for this in a file.
    fn word(self) -> &'static str;
}

/// An enumeration whose variants are written as words: `FromStr` without an error type of its own.
macro_rules! words {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[doc = $meaning:literal])+ $variant:ident = $word:literal $(| $former:literal)*,)+
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name { $($(#[doc = $meaning])+ $variant,)+ }

        impl $name {
            /// Every variant with its word, in the order of the documentation.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$variant),)+];

            /// Every word with its meaning.
            pub const MEANINGS: &'static [$crate::Word] = &[$(($word, concat!($($meaning),+)),)+];

            /// Words of earlier versions, which are still read.
            pub const FORMER: &'static [(&'static str, Self)] = &[$($(($former, Self::$variant),)*)+];

            /// The word that stands for this in a file.
            pub fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)+ }
            }

            /// What `word` stands for, also one of an earlier version; none when it is no word of the lists.
            pub fn from_word(word: &str) -> Option<Self> {
                let known = Self::WORDS.iter().chain(Self::FORMER);
                known.into_iter().find(|(own, _)| *own == word).map(|(_, value)| *value)
            }
        }

        impl $crate::words::Worded for $name {
            const WORDS: &'static [(&'static str, Self)] = Self::WORDS;

            fn word(self) -> &'static str {
                Self::word(self)
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }
    };
}

pub(crate) use words;

/// The longest quotation of a file in an error [characters]: a damaged file may have megabytes on one line.
const LONGEST_QUOTATION: usize = 200;

/// A text as an error quotes it: one that is longer than 200 characters is cut there, with its length.
pub(crate) fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(LONGEST_QUOTATION) {
        None => Cow::Borrowed(text),
        Some((end, _)) => Cow::Owned(format!("{}… ({} bytes)", &text[..end], text.len())),
    }
}

/// "a", "a or b", "a, b or c".
pub(crate) fn or_list(names: &[impl AsRef<str>]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match names.as_slice() {
        [] => "nothing".to_owned(),
        [only] => (*only).to_owned(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// The one of `known` that looks most like `name`, and how alike they are (1 is equal) [-].
pub(crate) fn nearest<'k>(name: &str, known: &[&'k str]) -> Option<(&'k str, f64)> {
    // The rest is ignored: the time grows with the length.
    let name = match name.char_indices().nth(LONGEST_QUOTATION) {
        None => name.to_lowercase(),
        Some((end, _)) => name[..end].to_lowercase(),
    };
    known
        .iter()
        .map(|known| (*known, strsim::normalized_damerau_levenshtein(&name, known)))
        // The first of equals, so that the answer is deterministic.
        .reduce(|best, next| if next.1 > best.1 { next } else { best })
}

/// The one of `known` that `name` was probably meant to be: one or two letters off.
pub(crate) fn near_miss<'k>(name: &str, known: &[&'k str]) -> Option<&'k str> {
    nearest(name, known)
        .filter(|&(known, alike)| alike >= 0.8 && known != name)
        .map(|(known, _)| known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_misses_are_misspellings() {
        let known = ["indenter_radius_m", "grip", "qx"];
        assert_eq!(
            near_miss("indenter_radus_m", &known),
            Some("indenter_radius_m")
        );
        assert_eq!(near_miss("Grip", &known), Some("grip"));
        assert_eq!(near_miss("gripp", &known), Some("grip"));
        assert_eq!(near_miss("grip", &known), None);
        assert_eq!(near_miss("operator", &known), None);
    }

    #[test]
    fn quotations_are_short() {
        assert_eq!(shortened("é"), "é");
        let long = "é".repeat(5_000_000);
        assert!(shortened(&long).len() < 500);
        assert!(shortened(&long).ends_with("… (10000000 bytes)"));
    }

    #[test]
    fn lists_read_like_english() {
        assert_eq!(or_list(&["a"]), "a");
        assert_eq!(or_list(&["a", "b", "c"]), "a, b or c");
    }
}
