//! The force of a nonlinear tissue over depth, for the tips of a scene.

use palpate_files::tissue::LawName;
use palpate_files::{Elasticity, Tissue};
use palpate_mechanics::contact::{Friction, Tip};
use palpate_mechanics::finite_elements::indentation::Stiffening;
use palpate_mechanics::{Material, TipLaw};

use crate::Error;
use crate::tool::Tool;

/// Gives each tool the force over depth of the tissue that it meets; returns warnings. Tools with the same tip and
/// tissue share the work.
pub(crate) fn stiffen(
    tools: &mut [Tool],
    touched: &[(Tissue, Material)],
    at_step: &mut dyn FnMut(f64),
) -> Result<Vec<String>, Error> {
    let mut found: Vec<(Tip, Friction, Elasticity, Stiffening)> = Vec::new();
    let mut warnings = Vec::new();
    for (tool, (tissue, material)) in tools.iter_mut().zip(touched) {
        if tissue.elasticity.law() == LawName::Linear {
            continue;
        }
        let (tip, bond) = (tool.tip, tool.tip_friction);
        let alike = |(other, bonded, elasticity, _): &&(Tip, Friction, Elasticity, Stiffening)| {
            std::mem::discriminant(other) == std::mem::discriminant(&tip)
                && *bonded == bond
                && *elasticity == tissue.elasticity
        };
        let known = found.iter().find(alike).map(|known| known.3.clone());
        let stiffening = match known {
            Some(known) => known,
            None => {
                let stiffening = of(tissue, material, tip, bond, at_step)?;
                found.push((tip, bond, tissue.elasticity, stiffening.clone()));
                stiffening
            }
        };
        tool.law = TipLaw::stiffening(tip, bond, material, stiffening);
        warnings.push(format!(
            "the tissue's law {} stiffens with depth under the tip; what surrounds it, and a sideways force, \
             answer as at small strain, incompressible",
            tissue.elasticity.law(),
        ));
    }
    warnings.dedup();
    Ok(warnings)
}

/// The law of neo-Hookean tissue is the same for every modulus, and known.
fn of(
    tissue: &Tissue,
    material: &Material,
    tip: Tip,
    bond: Friction,
    at_step: &mut dyn FnMut(f64),
) -> Result<Stiffening, Error> {
    match tissue.elasticity.law() {
        LawName::NeoHookean => Ok(Stiffening::neo_hookean(tip, bond)),
        _ => Ok(Stiffening::of(material, tip, bond, at_step)?),
    }
}
