//! The tissue of an organ: density, elasticity, relaxation, lumped parameters, each with its standard error, and
//! their sources.

mod builtin;
mod elasticity;
mod laws;
mod lumped;
mod prony;
mod source;
mod write;

use std::path::Path;

pub use builtin::BuiltinTissue;
pub use elasticity::Elasticity;
pub use laws::{LawName, LawRow};
pub use lumped::{EffectiveColumn, Kelvin, Lumped, NonlinearSprings};
pub use prony::PronyTerm;
pub use source::TissueSource;

use crate::atomic_write::{MAX_DOCUMENT_BYTES, read_text};
use crate::{Document, Domain, Error, Estimate, Key, Keys};

/// Density of soft tissue when a tissue does not state its own [kg/m³].
pub const DEFAULT_DENSITY_KG_M3: f64 = 1060.0;

/// A tissue. All moduli are instantaneous: `prony` describes their relaxation.
#[derive(Debug, Clone, PartialEq)]
pub struct Tissue {
    /// A description, for people.
    pub name: Option<String>,
    /// Density [kg/m³].
    pub density_kg_m3: Estimate,
    /// The elastic law with its parameters.
    pub elasticity: Elasticity,
    /// G(t) = G₀ (1 − Σ gᵢ (1 − exp(−t/τᵢ))); empty when nothing relaxes.
    pub prony: Vec<PronyTerm>,
    /// Parameters of models without geometry.
    pub lumped: Lumped,
    /// The source of the numbers, with warnings.
    pub source: TissueSource,
    /// Warnings about the numbers of its file, as sentences. A table in another document adds its warnings to that
    /// document.
    pub warnings: Vec<String>,
}

impl Tissue {
    /// The keys of a tissue's table, in a file or in line in a scene.
    pub const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"liver\"", "it has no name"),
        Key::estimate("density_kg_m3", Domain::DENSITY, "Its density.").default("1060.0"),
        Key::word("law", LawName::MEANINGS, "Its elastic law.").required("\"linear\""),
        laws::LINEAR.parameters[0],
        laws::LINEAR.parameters[1],
        laws::MOONEY_RIVLIN.parameters[0],
        laws::MOONEY_RIVLIN.parameters[1],
        laws::EXPONENTIAL.parameters[0],
        laws::EXPONENTIAL.parameters[1],
        laws::OGDEN.parameters[0],
        laws::OGDEN.parameters[1],
        laws::OGDEN.parameters[2],
        laws::OGDEN.parameters[3],
        laws::OGDEN.parameters[4],
        laws::OGDEN.parameters[5],
        laws::REDUCED_POLYNOMIAL.parameters[1],
        laws::REDUCED_POLYNOMIAL.parameters[2],
        laws::HOLZAPFEL_GASSER_OGDEN.parameters[1],
        laws::HOLZAPFEL_GASSER_OGDEN.parameters[2],
        laws::HOLZAPFEL_GASSER_OGDEN.parameters[3],
        laws::HOLZAPFEL_GASSER_OGDEN.parameters[4],
        Key::tables(
            "prony",
            prony::KEYS,
            "G(t) = G0 (1 - sum of g (1 - exp(-t/tau))): its relaxation, a table for each term.",
        )
        .optional("", "it does not relax"),
        Key::table(
            "lumped",
            Lumped::KEYS,
            "Parameters of models without geometry.",
        )
        .optional("", "none"),
        Key::table("source", TissueSource::KEYS, "Where the numbers come from.")
            .optional("", "unknown"),
    ];

    /// The keys of a tissue's file, without `format`.
    pub const FILE: &'static [Key] =
        &[Key::table("tissue", Self::KEYS, "What an organ is made of.").required("")];

    /// A tissue with the default density, no relaxation and no source.
    pub fn new(elasticity: Elasticity) -> Self {
        Self {
            name: None,
            density_kg_m3: DEFAULT_DENSITY_KG_M3.into(),
            elasticity,
            prony: Vec::new(),
            lumped: Lumped::default(),
            source: TissueSource::default(),
            warnings: Vec::new(),
        }
    }

    /// Reads a tissue file.
    ///
    /// # Errors
    /// When the file cannot be read or does not describe a tissue.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_DOCUMENT_BYTES)?, path)
    }

    /// Reads the text of a tissue file; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text does not describe a tissue.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let document = Document::parse(text, path)?;
        let keys = document.keys(Self::FILE)?;
        match keys.table("tissue")? {
            Some(tissue) => {
                let mut tissue = Self::from_keys(&tissue)?;
                tissue.warnings = keys.warnings();
                Ok(tissue)
            }
            None => Err(keys.missing("tissue", "a table `[tissue]`")),
        }
    }

    /// A tissue from its table, which was opened with [`Tissue::KEYS`].
    ///
    /// # Errors
    /// When the table does not describe a tissue.
    pub fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let density = keys.estimate("density_kg_m3")?;
        Ok(Self {
            name: keys.text("name")?,
            density_kg_m3: density.unwrap_or(DEFAULT_DENSITY_KG_M3.into()),
            elasticity: Elasticity::from_keys(keys)?,
            prony: prony::from_keys(keys)?,
            lumped: Lumped::from_keys(keys)?,
            source: TissueSource::from_keys(keys)?,
            warnings: Vec::new(),
        })
    }
}
