use palpate_files::{Estimate, PronyTerm, Tissue};

use super::Characterization;
use crate::Error;
use crate::inverse::CandidateLaw;

impl Characterization {
    /// The tissue of `law`, or else of the one to be preferred: without a name and the files it came from.
    ///
    /// # Errors
    /// When no law was found.
    pub fn tissue(&self, law: Option<CandidateLaw>) -> Result<Tissue, Error> {
        let law = law
            .or_else(|| self.preferred_law())
            .ok_or_else(|| self.why_no_law())?;
        let mut tissue = if self.uniaxial.is_empty() {
            self.indented_tissue(law)?
        } else {
            self.uniaxial_tissue(law)?
        };
        tissue.source.warnings.extend(self.warnings.iter().cloned());
        Ok(tissue)
    }

    fn indented_tissue(&self, law: CandidateLaw) -> Result<Tissue, Error> {
        let relaxation = self.relaxation.as_ref().map_err(Clone::clone)?;
        let found = self.laws.iter().find(|(of, _)| *of == law);
        let (_, found) = found.ok_or(Error::NoContactForce)?;
        let found = found.as_ref().map_err(Clone::clone)?;
        let parameters: Vec<_> = found
            .parameters
            .iter()
            .map(|(_, estimate)| *estimate)
            .collect();
        let mut tissue = Tissue::new(law.elasticity(&parameters));
        let term = |[g, tau_s]: &[Estimate; 2]| PronyTerm {
            g: *g,
            tau_s: *tau_s,
        };
        tissue.lumped = self.without_geometry.lumped();
        tissue.prony = relaxation.terms.iter().map(term).collect();
        tissue.source.method = Some(METHOD.to_owned());
        tissue.source.warnings = [&self.relaxation_warnings[..], &found.warnings].concat();
        Ok(tissue)
    }

    fn uniaxial_tissue(&self, law: CandidateLaw) -> Result<Tissue, Error> {
        let found = self.uniaxial.iter().find(|(of, _)| *of == law);
        let (_, found) = found.ok_or(Error::NoContactForce)?;
        let found = found.as_ref().map_err(Clone::clone)?;
        let mut tissue = Tissue::new(found.elasticity);
        let method = match law {
            CandidateLaw::HolzapfelGasserOgden => FIBRES,
            _ => UNIAXIAL,
        };
        tissue.source.method = Some(method.to_owned());
        tissue.source.warnings.clone_from(&found.warnings);
        Ok(tissue)
    }

    /// Why there is no law, when there is none.
    fn why_no_law(&self) -> Error {
        let pressed = self.laws.iter().filter_map(|(_, law)| law.as_ref().err());
        let pulled = self
            .uniaxial
            .iter()
            .filter_map(|(_, law)| law.as_ref().err());
        pressed
            .chain(pulled)
            .next()
            .cloned()
            .unwrap_or(Error::NotFitted)
    }
}

/// How a tissue is found, for its file.
const METHOD: &str = "relaxation from the normalised force with the recorded course of depth, then the law by inverse finite elements";
/// The same for a piece along one axis.
const UNIAXIAL: &str = "nominal stress over stretch in closed form";
/// The same with fibres.
const FIBRES: &str =
    "nominal stress of homogeneous deformation, of pieces at their angles to the fibres together";
