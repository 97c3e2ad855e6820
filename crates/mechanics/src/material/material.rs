use std::sync::Arc;

use palpate_files::Tissue;
use palpate_files::tissue::LawName;

use super::exponential::Exponential;
use super::fibres::FibreError;
use super::holzapfel_gasser_ogden::{Fibres, HolzapfelGasserOgden};
use super::law::Law;
use super::linear_elastic::LinearElastic;
use super::mooney_rivlin::MooneyRivlin;
use super::neo_hookean::NeoHookean;
use super::ogden::Ogden;
use super::prony::PronySeries;
use super::reduced_polynomial::ReducedPolynomial;
use crate::Error;

/// The material of a tissue for a model: a law, its relaxation, and warnings.
#[derive(Debug, Clone)]
pub struct Material {
    /// The instantaneous law; the hyperelastic ones are incompressible.
    pub law: Arc<dyn Law>,
    /// The law at small strain, without fibres, and nearly incompressible where it is incompressible.
    pub at_rest: LinearElastic,
    /// Relaxation of the force.
    pub prony: PronySeries,
    /// Plain sentences to pass on to the user.
    pub warnings: Vec<String>,
}

impl Material {
    /// As [`Self::from_tissue`], for a `model` without directions of fibres.
    ///
    /// # Errors
    /// As [`Self::from_tissue`], and when the tissue has fibres.
    pub fn isotropic(tissue: &Tissue, model: &'static str) -> Result<Self, Error> {
        if tissue.elasticity.law().has_fibres() {
            return Err(FibreError::NoDirection { model }.into());
        }
        Self::from_tissue(tissue)
    }

    /// The material that `tissue` describes.
    ///
    /// # Errors
    /// When its numbers are those of no solid.
    pub fn from_tissue(tissue: &Tissue) -> Result<Self, Error> {
        let (name, values) = (tissue.elasticity.law(), tissue.elasticity.values());
        let law = named(name, &values)?;
        let at_rest = match (name, values.as_slice()) {
            (LawName::Linear, &[modulus, ratio]) => LinearElastic::new(modulus, ratio)?,
            (LawName::HolzapfelGasserOgden, &[c10, ..]) => {
                LinearElastic::at_rest(&NeoHookean::incompressible(c10)?)?
            }
            _ => LinearElastic::at_rest(law.as_ref())?,
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
            warnings: [&tissue.source.warnings[..], &tissue.warnings].concat(),
        })
    }
}

/// The law of this name with these values of its parameters [unit of their keys], in the order of files. A new law
/// joins by a line here and by its row in `palpate_files::tissue`.
///
/// # Errors
/// When they are those of no solid.
pub fn named(name: LawName, values: &[f64]) -> Result<Arc<dyn Law>, Error> {
    // A value that is not there is none of a solid.
    let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
    Ok(match name {
        LawName::Linear => Arc::new(LinearElastic::new(at(0), at(1))?),
        LawName::NeoHookean => Arc::new(NeoHookean::incompressible(at(0))?),
        LawName::MooneyRivlin => Arc::new(MooneyRivlin::incompressible(at(0), at(1))?),
        LawName::Exponential => Arc::new(Exponential::incompressible(at(0), at(1))?),
        LawName::Ogden => Arc::new(Ogden::incompressible(values.as_chunks().0)?),
        LawName::ReducedPolynomial => Arc::new(ReducedPolynomial::incompressible(values)?),
        LawName::HolzapfelGasserOgden => {
            let fibres = Fibres {
                k1: at(1),
                k2: at(2),
                dispersion: at(3),
                angle_deg: at(4),
            };
            Arc::new(HolzapfelGasserOgden::incompressible(at(0), fibres)?)
        }
    })
}
