use std::path::{Path, PathBuf};

use crate::{BuiltinTissue, Error, Key, Keys, Tissue};

/// The tissue that a scene asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum TissueChoice {
    /// A tissue file.
    File(PathBuf),
    /// A tissue that comes with the program.
    Builtin(BuiltinTissue),
    /// A table in the scene.
    Inline(Box<Tissue>),
}

impl TissueChoice {
    /// The keys of a choice, among those of a table that has one.
    pub const KEYS: [Key; 2] = [
        Key::path_or_table(
            "tissue",
            Tissue::KEYS,
            "A tissue file, or a table with a tissue's keys.",
        )
        .optional("\"tissue.toml\"", "`builtin_tissue` names one"),
        Key::word(
            "builtin_tissue",
            BuiltinTissue::MEANINGS,
            "A tissue that comes with the program.",
        )
        .required_without("tissue", "\"pig-liver\""),
    ];

    /// The tissue itself, read when it is in a file of its own.
    ///
    /// # Errors
    /// When the file cannot be read or does not describe a tissue.
    pub fn read(&self) -> Result<Tissue, Error> {
        match self {
            Self::File(path) => Tissue::read(path),
            Self::Builtin(tissue) => Ok(Tissue::builtin(*tissue)),
            Self::Inline(tissue) => Ok((**tissue).clone()),
        }
    }

    /// The choice of a table with the keys `tissue` and `builtin_tissue`; the path of a file begins in
    /// `folder`.
    ///
    /// # Errors
    /// When the table has both keys, none, or one with a value that is no choice.
    pub fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let builtin = keys.word("builtin_tissue", BuiltinTissue::WORDS)?;
        match (builtin, keys.contains("tissue")) {
            (Some(_), true) => Err(keys.given_twice("tissue", "builtin_tissue")),
            (Some(builtin), false) => Ok(Self::Builtin(builtin)),
            (None, _) => Self::own(keys, folder),
        }
    }

    fn own(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        if keys.is_text("tissue")
            && let Some(path) = keys.text("tissue")?
        {
            return Ok(Self::File(folder.join(path)));
        }
        match keys.table("tissue")? {
            Some(tissue) => Ok(Self::Inline(Box::new(Tissue::from_keys(&tissue)?))),
            None => Err(keys.missing(
                "tissue",
                "`tissue = \"file.toml\"`, a table of that name, \
                 or `builtin_tissue = \"pig-liver\"` (or another built-in tissue)",
            )),
        }
    }
}
