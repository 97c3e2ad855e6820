use crate::{Error, Key, Keys};

/// The source of a tissue's numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TissueSource {
    /// The recordings that were fitted.
    pub recordings: Vec<String>,
    /// The method.
    pub method: Option<String>,
    /// The version of the program that computed them.
    pub version: Option<String>,
    /// Warnings, in plain sentences. Programs that use the tissue pass them on.
    pub warnings: Vec<String>,
}

impl TissueSource {
    pub(super) const KEYS: &[Key] = &[
        Key::texts("recordings", "The recordings that were fitted.").default("[]"),
        Key::text("method", "How the numbers were found.")
            .optional("\"relaxation fit\"", "unknown"),
        Key::text("version", "The version of the program that found them.")
            .optional("\"0.2.0\"", "unknown"),
        Key::texts(
            "warnings",
            "Warnings, in sentences. Programs that use the tissue pass them on.",
        )
        .default("[]"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let Some(source) = keys.table("source")? else {
            return Ok(Self::default());
        };
        Ok(Self {
            recordings: source.texts("recordings")?,
            method: source.text("method")?,
            version: source.text("version")?,
            warnings: source.texts("warnings")?,
        })
    }
}
