use std::sync::Arc;

use palpate_files::{Elasticity, Tissue};

use super::exponential::Exponential;
use super::law::Law;
use super::linear_elastic::LinearElastic;
use super::mooney_rivlin::MooneyRivlin;
use super::neo_hookean::NeoHookean;
use super::ogden::Ogden;
use super::prony::PronySeries;
use super::reduced_polynomial::ReducedPolynomial;
use crate::Error;

/// A tissue as a model takes it: a law, its relaxation, and what deserves doubt.
#[derive(Debug, Clone)]
pub struct Material {
    /// The instantaneous law; the hyperelastic ones are incompressible.
    pub law: Arc<dyn Law>,
    /// What the law is at small strain, nearly incompressible where it is incompressible.
    pub at_rest: LinearElastic,
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
        let (law, at_rest) = match tissue.elasticity {
            Elasticity::Linear {
                youngs_modulus_pa,
                poissons_ratio,
            } => {
                let linear = LinearElastic::new(youngs_modulus_pa.value, poissons_ratio.value)?;
                (Arc::new(linear) as Arc<dyn Law>, linear)
            }
            Elasticity::NeoHookean { c10_pa } => {
                linearized(NeoHookean::incompressible(c10_pa.value)?)?
            }
            Elasticity::MooneyRivlin { c10_pa, c01_pa } => {
                linearized(MooneyRivlin::incompressible(c10_pa.value, c01_pa.value)?)?
            }
            Elasticity::Exponential { gamma_pa, alpha } => {
                linearized(Exponential::incompressible(gamma_pa.value, alpha.value)?)?
            }
            Elasticity::Ogden { terms } => {
                let terms = terms.iter().flatten();
                let terms: Vec<_> = terms
                    .map(|term| [term.mu_pa.value, term.alpha.value])
                    .collect();
                linearized(Ogden::incompressible(&terms)?)?
            }
            Elasticity::ReducedPolynomial { .. } => {
                let constants = tissue.elasticity.parameters().into_iter();
                let constants: Vec<_> = constants.map(|(_, constant)| constant.value).collect();
                linearized(ReducedPolynomial::incompressible(&constants)?)?
            }
        };
        let terms: Vec<_> = tissue
            .prony
            .iter()
            .map(|term| (term.g.value, term.tau_s.value))
            .collect();
        Ok(Self {
            law,
            at_rest,
            prony: PronySeries::new(&terms)?,
            doubts: [&tissue.source.warnings[..], &tissue.warnings].concat(),
        })
    }
}

fn linearized(law: impl Law + 'static) -> Result<(Arc<dyn Law>, LinearElastic), Error> {
    let at_rest = LinearElastic::at_rest(&law)?;
    Ok((Arc::new(law), at_rest))
}
