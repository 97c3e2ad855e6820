//! The declaration of a key: the only place that defines its values. The reader's checks, templates, JSON Schemas and
//! the reference come from it.

use crate::Domain;

/// A key of a document.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Its name, which ends in the unit of its value.
    pub name: &'static str,
    /// The type of its value.
    pub value_type: ValueType,
    /// Its meaning, as sentences.
    pub meaning: &'static str,
    /// Its default.
    pub omitted: Omitted,
    /// An example for a template, as TOML writes it; empty for a table, which has its own keys.
    pub example: &'static str,
    /// Whether a template sets it, rather than naming it in a comment.
    pub in_template: bool,
}

/// The type of a key's value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ValueType {
    /// A number [unit of the key].
    Number(Domain),
    /// A number, or a table of a value and its standard error [unit of the key].
    Estimate(Domain),
    /// Three numbers [unit of the key].
    Vector(Domain),
    /// Three numbers, not all zero [-].
    Direction,
    /// A list of numbers [unit of the key].
    Numbers(Domain),
    /// A list of three numbers each [unit of the key].
    Vectors(Domain),
    /// A whole number, from the first to the second.
    Integer(u64, u64),
    /// `true` or `false`.
    Boolean,
    /// A text.
    Text,
    /// A text or a whole number.
    Label,
    /// A list of texts.
    Texts,
    /// The path of a file or folder, from the document's own folder.
    Path,
    /// One of these words.
    Word(&'static [Word]),
    /// One of these words, or a table.
    WordOrTable(&'static [Word], &'static [Key]),
    /// A table.
    Table(&'static [Key]),
    /// A table, or a list of tables.
    TableOrTables(&'static [Key]),
    /// The path of a file, or a table.
    PathOrTable(&'static [Key]),
    /// A number [unit of the key], or the name of a draw of numbers.
    NumberOrDraw(Domain),
    /// A list of tables.
    Tables(&'static [Key]),
    /// A table of tables under names of somebody's choice.
    Named(&'static [Key]),
    /// Something else, in words.
    Other(&'static str),
}

/// The default of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Omitted {
    /// None: the document is refused.
    Refused,
    /// None unless another key is there, which is named.
    RefusedWithout(&'static str),
    /// The value of [`Key::example`].
    Example,
    /// Described in words.
    Means(&'static str),
}

/// A word that a key may hold, and what it means.
pub type Word = (&'static str, &'static str);

impl Key {
    const fn new(name: &'static str, value_type: ValueType, meaning: &'static str) -> Self {
        Self {
            name,
            value_type,
            meaning,
            omitted: Omitted::Refused,
            example: "",
            in_template: true,
        }
    }

    /// A number.
    pub const fn number(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Number(domain), meaning)
    }

    /// A number, or a table of a value and its standard error.
    pub const fn estimate(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Estimate(domain), meaning)
    }

    /// Three numbers.
    pub const fn vector(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Vector(domain), meaning)
    }

    /// Three numbers, not all zero.
    pub const fn direction(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Direction, meaning)
    }

    /// A list of numbers.
    pub const fn numbers(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Numbers(domain), meaning)
    }

    /// A list of three numbers each.
    pub const fn vectors(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Vectors(domain), meaning)
    }

    /// A whole number from `least` to `most`.
    pub const fn integer(name: &'static str, least: u64, most: u64, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Integer(least, most), meaning)
    }

    /// `true` or `false`.
    pub const fn boolean(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Boolean, meaning)
    }

    /// A text.
    pub const fn text(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Text, meaning)
    }

    /// A text or a whole number.
    pub const fn label(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Label, meaning)
    }

    /// A list of texts.
    pub const fn texts(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Texts, meaning)
    }

    /// The path of a file or folder.
    pub const fn path(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, ValueType::Path, meaning)
    }

    /// One of `words`.
    pub const fn word(name: &'static str, words: &'static [Word], meaning: &'static str) -> Self {
        Self::new(name, ValueType::Word(words), meaning)
    }

    /// One of `words`, or a table with these keys.
    pub const fn word_or_table(
        name: &'static str,
        words: &'static [Word],
        keys: &'static [Self],
        meaning: &'static str,
    ) -> Self {
        Self::new(name, ValueType::WordOrTable(words, keys), meaning)
    }

    /// A table with these keys, or a list of such tables.
    pub const fn table_or_tables(
        name: &'static str,
        keys: &'static [Self],
        meaning: &'static str,
    ) -> Self {
        Self::new(name, ValueType::TableOrTables(keys), meaning)
    }

    /// A table with these keys.
    pub const fn table(name: &'static str, keys: &'static [Self], meaning: &'static str) -> Self {
        Self::new(name, ValueType::Table(keys), meaning)
    }

    /// The path of a file, or a table with these keys.
    pub const fn path_or_table(
        name: &'static str,
        keys: &'static [Self],
        meaning: &'static str,
    ) -> Self {
        Self::new(name, ValueType::PathOrTable(keys), meaning)
    }

    /// A list of tables with these keys.
    pub const fn tables(name: &'static str, keys: &'static [Self], meaning: &'static str) -> Self {
        Self::new(name, ValueType::Tables(keys), meaning)
    }

    /// A table of tables with these keys, under names of somebody's choice.
    pub const fn named(name: &'static str, keys: &'static [Self], meaning: &'static str) -> Self {
        Self::new(name, ValueType::Named(keys), meaning)
    }

    /// A number, or the name of a draw of numbers.
    pub const fn number_or_draw(name: &'static str, domain: Domain, meaning: &'static str) -> Self {
        Self::new(name, ValueType::NumberOrDraw(domain), meaning)
    }

    /// A value described by the words `holds`.
    pub const fn other(
        name: &'static str,
        value_type: &'static str,
        meaning: &'static str,
    ) -> Self {
        Self::new(name, ValueType::Other(value_type), meaning)
    }

    /// The same, but required; with an `example`.
    pub const fn required(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    /// The same, but required unless `other` is there; with an `example`.
    pub const fn required_without(self, other: &'static str, example: &'static str) -> Self {
        Self {
            example,
            omitted: Omitted::RefusedWithout(other),
            ..self
        }
    }

    /// The same, with the default `value`.
    pub const fn default(self, value: &'static str) -> Self {
        Self {
            example: value,
            omitted: Omitted::Example,
            in_template: false,
            ..self
        }
    }

    /// The same, with an `example`; `meaning` describes the default.
    pub const fn optional(self, example: &'static str, meaning: &'static str) -> Self {
        Self {
            example,
            omitted: Omitted::Means(meaning),
            in_template: false,
            ..self
        }
    }

    /// The same estimate in another domain.
    pub const fn within(self, domain: Domain) -> Self {
        Self {
            value_type: ValueType::Estimate(domain),
            ..self
        }
    }

    /// The same, set in a template.
    pub const fn in_template(self) -> Self {
        Self {
            in_template: true,
            ..self
        }
    }

    /// The domain of the numbers in it.
    ///
    /// # Panics
    /// When it holds none: a mistake in the program, not in a document.
    pub(crate) fn domain(&self) -> Domain {
        match self.value_type {
            ValueType::Number(domain)
            | ValueType::Estimate(domain)
            | ValueType::Vector(domain)
            | ValueType::NumberOrDraw(domain)
            | ValueType::Vectors(domain)
            | ValueType::Numbers(domain) => domain,
            ValueType::Direction => Domain::FINITE,
            _ => unreachable!("`{}` is declared without a domain", self.name),
        }
    }

    /// The keys of the tables in it; empty where there are none.
    pub fn keys(&self) -> &'static [Self] {
        match self.value_type {
            ValueType::Table(keys)
            | ValueType::TableOrTables(keys)
            | ValueType::WordOrTable(_, keys)
            | ValueType::PathOrTable(keys)
            | ValueType::Tables(keys)
            | ValueType::Named(keys) => keys,
            _ => &[],
        }
    }
}

/// The names of keys.
pub(crate) fn names(keys: &[Key]) -> Vec<&'static str> {
    keys.iter().map(|key| key.name).collect()
}
