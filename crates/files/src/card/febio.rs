use super::NoCard;
use crate::{Elasticity, Tissue};

/// Bulk modulus over shear modulus of what keeps its volume [-]: FEBio takes a number, and this one leaves
/// Poisson's ratio at 0.4995.
const STIFF_VOLUME: f64 = 1000.0;

/// What FEBio calls the parameters of the terms of Ogden's law.
const OGDEN: [[&str; 2]; 3] = [["c1", "m1"], ["c2", "m2"], ["c3", "m3"]];

/// A material of FEBio. Its relaxation is 1 + Σ γᵢ exp(−t/τᵢ) times a law that is left when all has
/// relaxed: moduli are times 1 − Σ g, and γᵢ = gᵢ/(1 − Σ g).
pub(super) fn card(tissue: &Tissue) -> Result<String, NoCard> {
    let left = 1.0 - tissue.prony.iter().map(|term| term.g.value).sum::<f64>();
    let (kind, relaxing, numbers) = match tissue.elasticity {
        Elasticity::Linear {
            youngs_modulus_pa: youngs,
            poissons_ratio: poisson,
        } => {
            let numbers = vec![("E", left * youngs.value), ("v", poisson.value)];
            ("isotropic elastic", "viscoelastic", numbers)
        }
        Elasticity::NeoHookean { c10_pa } => {
            let numbers = distortion(left * c10_pa.value, 0.0);
            ("Mooney-Rivlin", "uncoupled viscoelastic", numbers)
        }
        Elasticity::MooneyRivlin { c10_pa, c01_pa } => {
            let numbers = distortion(left * c10_pa.value, left * c01_pa.value);
            ("Mooney-Rivlin", "uncoupled viscoelastic", numbers)
        }
        Elasticity::Ogden { terms } => {
            // c/m² (…) with c = 2 μ.
            let mut numbers = Vec::new();
            let mut shear = 0.0;
            for ([c, m], term) in OGDEN.into_iter().zip(terms.iter().flatten()) {
                numbers.push((c, 2.0 * left * term.mu_pa.value));
                numbers.push((m, term.alpha.value));
                shear += left * term.mu_pa.value;
            }
            numbers.push(("k", STIFF_VOLUME * shear));
            ("Ogden", "uncoupled viscoelastic", numbers)
        }
        Elasticity::ReducedPolynomial { .. } | Elasticity::Exponential { .. } => {
            return Err(NoCard::of("FEBio", tissue.elasticity.law()));
        }
    };
    let density = ("density", tissue.density_kg_m3.value);
    let material = if tissue.prony.is_empty() {
        let inner = elements(&[vec![density], numbers].concat(), 3);
        format!(
            "\t\t<material id=\"1\" name=\"{}\" type=\"{kind}\">\n{inner}",
            tissue.card_name()
        )
    } else {
        let times = (1..).zip(&tissue.prony);
        let terms = times.flat_map(|(i, term)| {
            [
                (format!("t{i}"), term.tau_s.value),
                (format!("g{i}"), term.g.value / left),
            ]
        });
        format!(
            "\t\t<material id=\"1\" name=\"{}\" type=\"{relaxing}\">\n{}{}\t\t\t<elastic type=\"{kind}\">\n{}\t\t\t</elastic>\n",
            tissue.card_name(),
            elements(&[density], 3),
            elements(&terms.collect::<Vec<_>>(), 3),
            elements(&numbers, 4),
        )
    };
    Ok(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Written by palpate. Units: N, m, kg, s, Pa. Moduli after relaxation. -->\n\
         <febio_spec version=\"4.0\">\n\t<Module type=\"solid\"/>\n\t<Material>\n{material}\t\t</material>\n\t</Material>\n</febio_spec>\n"
    ))
}

fn distortion(c1: f64, c2: f64) -> Vec<(&'static str, f64)> {
    vec![
        ("c1", c1),
        ("c2", c2),
        ("k", STIFF_VOLUME * 2.0 * (c1 + c2)),
    ]
}

fn elements<N: AsRef<str>>(values: &[(N, f64)], depth: usize) -> String {
    let indent = "\t".repeat(depth);
    let each = values.iter().map(|(name, value)| {
        let name = name.as_ref();
        format!("{indent}<{name}>{value:?}</{name}>\n")
    });
    each.collect()
}
