use super::NoCard;
use crate::{Elasticity, Tissue};

/// Keywords of a material: moduli at time zero, Prony terms relative to them, as here.
pub(super) fn card(tissue: &Tissue) -> Result<String, NoCard> {
    let (law, compressible) = match tissue.elasticity {
        Elasticity::Linear {
            youngs_modulus_pa: youngs,
            poissons_ratio: poisson,
        } => {
            let numbers = [youngs.value, poisson.value];
            (lines("*ELASTIC", tissue, &numbers), true)
        }
        // The last number is 2/κ: zero for what keeps its volume, which takes hybrid elements.
        Elasticity::NeoHookean { c10_pa } => {
            let numbers = [c10_pa.value, 0.0];
            (lines("*HYPERELASTIC, NEO HOOKE", tissue, &numbers), false)
        }
        Elasticity::MooneyRivlin { c10_pa, c01_pa } => {
            let numbers = [c10_pa.value, c01_pa.value, 0.0];
            (
                lines("*HYPERELASTIC, MOONEY-RIVLIN", tissue, &numbers),
                false,
            )
        }
        Elasticity::Ogden { terms } => {
            let terms: Vec<_> = terms.iter().flatten().collect();
            let keyword = format!("*HYPERELASTIC, OGDEN, N={}", terms.len());
            let each = terms.iter();
            let numbers = each.flat_map(|term| [term.mu_pa.value, term.alpha.value]);
            let numbers: Vec<f64> = numbers.chain(vec![0.0; terms.len()]).collect();
            (lines(&keyword, tissue, &numbers), false)
        }
        Elasticity::ReducedPolynomial { .. } => {
            let constants = tissue.elasticity.parameters();
            let count = constants.len();
            let keyword = format!("*HYPERELASTIC, REDUCED POLYNOMIAL, N={count}");
            let numbers = constants.iter().map(|(_, constant)| constant.value);
            let numbers: Vec<f64> = numbers.chain(vec![0.0; count]).collect();
            (lines(&keyword, tissue, &numbers), false)
        }
        Elasticity::Exponential { .. } => {
            return Err(NoCard::of("Abaqus", tissue.elasticity.law()));
        }
    };
    let mut text = format!(
        "** {}, written by palpate. Units: N, m, kg, s, Pa.\n*MATERIAL, NAME={}\n*DENSITY\n{:?}\n{law}",
        tissue.name.as_deref().unwrap_or("tissue"),
        tissue.card_name(),
        tissue.density_kg_m3.value,
    );
    if !tissue.prony.is_empty() {
        text += "** g, k, tau: relative to the instantaneous moduli.\n*VISCOELASTIC, TIME=PRONY\n";
    }
    for term in &tissue.prony {
        // One relaxation for the whole body: the bulk modulus falls with the shear modulus.
        let bulk = if compressible { term.g.value } else { 0.0 };
        text += &format!("{:?}, {bulk:?}, {:?}\n", term.g.value, term.tau_s.value);
    }
    Ok(text)
}

fn lines(keyword: &str, tissue: &Tissue, numbers: &[f64]) -> String {
    let moduli = if tissue.prony.is_empty() {
        ""
    } else {
        ", MODULI=INSTANTANEOUS"
    };
    // At most eight numbers stand on a line.
    let rows = numbers.chunks(8).map(|row| {
        let row: Vec<_> = row.iter().map(|number| format!("{number:?}")).collect();
        row.join(", ")
    });
    format!(
        "{keyword}{moduli}\n{}\n",
        rows.collect::<Vec<_>>().join(",\n")
    )
}
