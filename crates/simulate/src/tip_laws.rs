//! The force of a nonlinear tissue over depth, for the tips of a scene.

use palpate_files::{Elasticity, Tissue};
use palpate_mechanics::contact::{Bond, Tip};
use palpate_mechanics::finite_elements::indentation::Stiffening;
use palpate_mechanics::{Material, TipLaw};

use crate::Error;
use crate::tool::Tool;

/// Gives each tool the tissue's force over depth; what deserves doubt about it. Tools with the same tip
/// share the work.
pub(crate) fn stiffen(
    tools: &mut [Tool],
    (tissue, material): (&Tissue, &Material),
    at_step: &mut dyn FnMut(f64),
) -> Result<Vec<String>, Error> {
    if matches!(tissue.elasticity, Elasticity::Linear { .. }) {
        return Ok(Vec::new());
    }
    let mut found: Vec<(Tip, Bond, Stiffening)> = Vec::new();
    for tool in tools {
        let (tip, bond) = (tool.tip, tool.bond);
        let alike = |(other, bonded, _): &&(Tip, Bond, Stiffening)| {
            std::mem::discriminant(other) == std::mem::discriminant(&tip) && *bonded == bond
        };
        let known = found.iter().find(alike).map(|known| known.2.clone());
        let stiffening = match known {
            Some(known) => known,
            None => {
                let stiffening = of(tissue, material, (tip, bond), at_step)?;
                found.push((tip, bond, stiffening.clone()));
                stiffening
            }
        };
        tool.law = TipLaw::stiffening(tip, bond, material, stiffening);
    }
    Ok(vec![format!(
        "the tissue's law {} stiffens with depth under the tip; what surrounds it, and a sideways force, \
         answer as at small strain, incompressible",
        tissue.elasticity.law(),
    )])
}

/// That of neo-Hookean tissue is the same for every modulus, and known.
fn of(
    tissue: &Tissue,
    material: &Material,
    (tip, bond): (Tip, Bond),
    at_step: &mut dyn FnMut(f64),
) -> Result<Stiffening, Error> {
    match tissue.elasticity {
        Elasticity::NeoHookean { .. } => Ok(Stiffening::neo_hookean(tip, bond)),
        _ => Ok(Stiffening::of(material, (tip, bond), at_step)?),
    }
}
