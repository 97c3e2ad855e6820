//! TOML documents: every key is declared once ([`Key`]). Every value has its line number and every key its tables, so
//! that an error can name both.

mod document;
mod key;
mod keys;
mod numbers;
mod value;
mod values;

pub use document::Document;
pub(crate) use document::check_format;
pub use key::{Key, Omitted, ValueType, Word};
pub use keys::Keys;
pub(crate) use keys::Warnings;
pub(crate) use value::{Entry, Table, Value, number as toml_number, parse as parse_toml, quoted};
