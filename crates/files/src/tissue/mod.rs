//! What an organ is made of: density, elasticity, relaxation, lumped parameters, each with its
//! standard error, and where they come from.

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

use crate::whole_file::{MOST_OF_DOCUMENT, read_text};
use crate::{Document, Domain, Error, Estimate, Key, Keys};

/// Density of soft tissue when a tissue does not state its own [kg/m³].
pub const DEFAULT_DENSITY_KG_M3: f64 = 1060.0;

/// A tissue. All moduli are instantaneous: `prony` says how they fall with time.
#[derive(Debug, Clone, PartialEq)]
pub struct Tissue {
    /// What it is, for people.
    pub name: Option<String>,
    /// Density [kg/m³].
    pub density_kg_m3: Estimate,
    /// The elastic law with its parameters.
    pub elasticity: Elasticity,
    /// G(t) = G₀ (1 − Σ gᵢ (1 − exp(−t/τᵢ))); empty when nothing relaxes.
    pub prony: Vec<PronyTerm>,
    /// Parameters of models without geometry.
    pub lumped: Lumped,
    /// Where the numbers come from, with what deserves doubt.
    pub source: TissueSource,
    /// What deserves a warning among the numbers of its file, as sentences. Those of a table in another document are
    /// that document's.
    pub warnings: Vec<String>,
}

impl Tissue {
    /// The keys of a tissue's table that do not depend on its law.
    const SHARED_KEYS: [&'static str; 6] =
        ["name", "density_kg_m3", "law", "prony", "lumped", "source"];

    /// The keys of a tissue's table, in a file or in line in a scene.
    pub const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"liver\"", "it has no name"),
        Key::estimate("density_kg_m3", Domain::DENSITY, "Its density.").default("1060.0"),
        Key::word("law", LawName::MEANINGS, "Its elastic law.").required("\"linear\""),
        Key::estimate(
            "youngs_modulus_pa",
            Domain::MODULUS,
            "`linear`: Young's modulus. All moduli are instantaneous: `prony` says how they fall.",
        )
        .optional("8000.0", "another law")
        .in_template(),
        Key::estimate(
            "poissons_ratio",
            laws::POISSONS_RATIO,
            "`linear`: Poisson's ratio.",
        )
        .optional("0.45", "another law")
        .in_template(),
        Key::estimate(
            "c10_pa",
            Domain::SIGNED_MODULUS,
            "`neo_hookean`, `reduced_polynomial`: C10, half the shear modulus; `mooney_rivlin`: C10.",
        )
        .optional("1333.0", "another law"),
        Key::estimate(
            "c01_pa",
            Domain::SIGNED_MODULUS,
            "`mooney_rivlin`: C01; c10_pa + c01_pa is half the shear modulus.",
        )
        .optional("300.0", "another law"),
        Key::estimate(
            "gamma_pa",
            Domain::MODULUS,
            "`exponential`: gamma, a third of Young's modulus at small strain.",
        )
        .optional("2667.0", "another law"),
        Key::estimate("alpha", Domain::EXPONENT, "`exponential`: alpha.")
            .optional("0.5", "another law"),
        Key::estimate("mu_1_pa", Domain::SIGNED_MODULUS, "`ogden`: mu of the first term; all mu together are the shear modulus.")
            .optional("2300.0", "another law"),
        Key::estimate("alpha_1", laws::SIGNED_EXPONENT, "`ogden`: alpha of the first term.")
            .optional("4.3", "another law"),
        Key::estimate("mu_2_pa", Domain::SIGNED_MODULUS, "`ogden`: mu of the second term.")
            .optional("100.0", "one term"),
        Key::estimate("alpha_2", laws::SIGNED_EXPONENT, "`ogden`: alpha of the second term.")
            .optional("-2.0", "one term"),
        Key::estimate("mu_3_pa", Domain::SIGNED_MODULUS, "`ogden`: mu of the third term.")
            .optional("10.0", "two terms"),
        Key::estimate("alpha_3", laws::SIGNED_EXPONENT, "`ogden`: alpha of the third term.")
            .optional("9.0", "two terms"),
        Key::estimate("c20_pa", Domain::SIGNED_MODULUS, "`reduced_polynomial`: C20.")
            .optional("500.0", "one term"),
        Key::estimate("c30_pa", Domain::SIGNED_MODULUS, "`reduced_polynomial`: C30.")
            .optional("200.0", "two terms"),
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

    /// The keys of a tissue's file, beside `format`.
    pub const FILE: &'static [Key] =
        &[Key::table("tissue", Self::KEYS, "What an organ is made of.").required("")];

    /// A tissue with the default density, no relaxation and no history.
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
        Self::parse(&read_text(path, MOST_OF_DOCUMENT)?, path)
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
