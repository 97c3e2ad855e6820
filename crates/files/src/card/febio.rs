use super::NoCard;
use crate::Tissue;

/// Bulk modulus over shear modulus of an incompressible law [-]: FEBio requires a number, and this one gives a
/// Poisson's ratio of 0.4995.
const STIFF_VOLUME: f64 = 1000.0;

/// A material of FEBio. Its relaxation is 1 + Σ γᵢ exp(−t/τᵢ) times the fully relaxed law: moduli are times 1 − Σ g,
/// and γᵢ = gᵢ/(1 − Σ g).
pub(super) fn card(tissue: &Tissue) -> Result<String, NoCard> {
    let left = 1.0 - tissue.prony.iter().map(|term| term.g.value).sum::<f64>();
    let law = tissue.elasticity.law();
    let written = law.row().febio.ok_or(NoCard::of("FEBio", law))?;
    let written = written(&tissue.elasticity.times(left).values());
    let (kind, mut numbers) = (written.kind, written.numbers);
    let relaxing = match written.shear_modulus {
        Some(shear) => {
            numbers.push(("k".to_owned(), STIFF_VOLUME * shear));
            "uncoupled viscoelastic"
        }
        None => "viscoelastic",
    };
    let axes = |depth: usize| {
        let indent = "\t".repeat(depth);
        match written.has_axes {
            true => format!(
                "{indent}<!-- The reference axis a, and d in the plane of the fibres: turn them to those of the body. -->\n\
                 {indent}<mat_axis type=\"vector\">\n{indent}\t<a>1,0,0</a>\n{indent}\t<d>0,1,0</d>\n{indent}</mat_axis>\n"
            ),
            false => String::new(),
        }
    };
    let density = ("density".to_owned(), tissue.density_kg_m3.value);
    let material = if tissue.prony.is_empty() {
        let inner = elements(&[vec![density], numbers].concat(), 3);
        format!(
            "\t\t<material id=\"1\" name=\"{}\" type=\"{kind}\">\n{inner}{}",
            tissue.card_name(),
            axes(3),
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
            "\t\t<material id=\"1\" name=\"{}\" type=\"{relaxing}\">\n{}{}\t\t\t<elastic type=\"{kind}\">\n{}{}\t\t\t</elastic>\n",
            tissue.card_name(),
            elements(&[density], 3),
            elements(&terms.collect::<Vec<_>>(), 3),
            elements(&numbers, 4),
            axes(4),
        )
    };
    Ok(format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Written by palpate. Units: N, m, kg, s, Pa. Moduli after relaxation. -->\n\
         <febio_spec version=\"4.0\">\n\t<Module type=\"solid\"/>\n\t<Material>\n{material}\t\t</material>\n\t</Material>\n</febio_spec>\n"
    ))
}

fn elements(values: &[(String, f64)], depth: usize) -> String {
    let indent = "\t".repeat(depth);
    let each = values
        .iter()
        .map(|(name, value)| format!("{indent}<{name}>{value:?}</{name}>\n"));
    each.collect()
}
