use super::NoCard;
use crate::Tissue;

/// Most numbers on a line of data.
const MAX_ON_LINE: usize = 8;

/// Keywords of a material: moduli at time zero, Prony terms relative to them, as here.
pub(super) fn card(tissue: &Tissue) -> Result<String, NoCard> {
    let law = tissue.elasticity.law();
    let written = law.row().abaqus.ok_or(NoCard::of("Abaqus", law))?;
    let written = written(&tissue.elasticity.values());
    let moduli = if tissue.prony.is_empty() {
        ""
    } else {
        ", MODULI=INSTANTANEOUS"
    };
    let mut text = format!(
        "** {}, written by palpate. Units: N, m, kg, s, Pa.\n*MATERIAL, NAME={}\n*DENSITY\n{:?}\n{}{moduli}\n",
        tissue.name.as_deref().unwrap_or("tissue"),
        tissue.card_name(),
        tissue.density_kg_m3.value,
        written.keyword,
    );
    for numbers in written.numbers.chunks(MAX_ON_LINE) {
        let numbers: Vec<_> = numbers.iter().map(|number| format!("{number:?}")).collect();
        text += &format!("{}\n", numbers.join(", "));
    }
    if !tissue.prony.is_empty() {
        text += "** g, k, tau: relative to the instantaneous moduli.\n*VISCOELASTIC, TIME=PRONY\n";
    }
    for term in &tissue.prony {
        // One relaxation for the whole body: the bulk modulus falls with the shear modulus.
        let bulk = if written.compressible {
            term.g.value
        } else {
            0.0
        };
        text += &format!("{:?}, {bulk:?}, {:?}\n", term.g.value, term.tau_s.value);
    }
    if !written.fibres.is_empty() {
        text += &format!(
            "** Name this orientation in the *SOLID SECTION, and turn its axes to the reference axis and the plane of the fibres.\n\
             *ORIENTATION, NAME=fibres_of_{}, LOCAL DIRECTIONS={}\n1.0, 0.0, 0.0, 0.0, 1.0, 0.0\n3, 0.0\n",
            tissue.card_name(),
            written.fibres.len(),
        );
    }
    for [x, y, z] in written.fibres {
        text += &format!("{x:?}, {y:?}, {z:?}\n");
    }
    Ok(text)
}
