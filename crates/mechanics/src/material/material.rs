use palpate_files::{Elasticity, Tissue};

use super::linear_elastic::{LinearElastic, NEARLY_INCOMPRESSIBLE};
use super::prony::PronySeries;
use crate::Error;

/// A tissue as a model takes it: a law, its relaxation, and what deserves doubt.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The instantaneous law; for the hyperelastic ones, what they are at small strain.
    pub law: LinearElastic,
    /// How the force relaxes.
    pub prony: PronySeries,
    /// Plain sentences to pass on to the user.
    pub doubts: Vec<String>,
}

impl Material {
    /// The material that `tissue` describes.
    ///
    /// # Errors
    /// When its numbers are those of no solid.
    pub fn from_tissue(tissue: &Tissue) -> Result<Self, Error> {
        let incompressible = |modulus| LinearElastic::new(modulus, NEARLY_INCOMPRESSIBLE);
        let law = match tissue.elasticity {
            Elasticity::Linear {
                youngs_modulus_pa,
                poissons_ratio,
            } => LinearElastic::new(youngs_modulus_pa.value, poissons_ratio.value)?,
            // At rest the shear moduli are 2 C10, 2 (C10 + C01) and γ; E is three times that.
            Elasticity::NeoHookean { c10_pa } => incompressible(6.0 * c10_pa.value)?,
            Elasticity::MooneyRivlin { c10_pa, c01_pa } => {
                incompressible(6.0 * (c10_pa.value + c01_pa.value))?
            }
            Elasticity::Blatz { gamma_pa, .. } => incompressible(3.0 * gamma_pa.value)?,
        };
        let terms: Vec<_> = tissue
            .prony
            .iter()
            .map(|term| (term.g.value, term.tau_s.value))
            .collect();
        let mut doubts = tissue.source.warnings.clone();
        if !matches!(tissue.elasticity, Elasticity::Linear { .. }) {
            doubts.push(format!(
                "the tissue's law {} is taken as it is at small strain: E = {:.1} Pa, incompressible; \
                 its stiffening with depth is not felt",
                tissue.elasticity.law(),
                law.youngs_modulus(),
            ));
        }
        Ok(Self {
            law,
            prony: PronySeries::new(&terms)?,
            doubts,
        })
    }
}
