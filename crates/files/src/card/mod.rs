//! A tissue as finite element packages read it, each with its own conventions.
//!
//! Here moduli are instantaneous and gᵢ is relative to them: G(t) = G₀ (1 − Σ gᵢ (1 − exp(−t/τᵢ))). A card
//! that keeps the numbers and changes the convention would be wrong by Σ g.

mod abaqus;
mod febio;

use crate::Tissue;
use crate::tissue::LawName;

/// A package that does not know a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "{package} has no law like `{law}` of its own; write the card of another law, such as neo_hookean"
)]
pub struct NoCard {
    /// The package.
    pub package: &'static str,
    /// The law's name in files.
    pub law: &'static str,
}

impl NoCard {
    fn of(package: &'static str, law: LawName) -> Self {
        Self {
            package,
            law: law.word(),
        }
    }
}

impl Tissue {
    /// The keywords of Abaqus for this tissue, in newtons, metres, kilograms and seconds.
    ///
    /// # Errors
    /// When Abaqus has no such law.
    pub fn to_abaqus(&self) -> Result<String, NoCard> {
        abaqus::card(self)
    }

    /// The material of FEBio 4 for this tissue, in newtons, metres, kilograms and seconds.
    ///
    /// # Errors
    /// When FEBio has no such law.
    pub fn to_febio(&self) -> Result<String, NoCard> {
        febio::card(self)
    }

    /// What it is called in a card.
    fn card_name(&self) -> String {
        let name = self.name.as_deref().unwrap_or("tissue");
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        name.chars().map(plain).collect()
    }
}
