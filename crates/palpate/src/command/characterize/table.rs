use std::fmt::Write;

use palpate_characterize::inverse::CandidateLaw;
use palpate_files::printable;
use palpate_files::quantity::{plain_quantity, without_unit};
use palpate_files::tissue::LawName;
use palpate_jobs::characterize::{Answer, Identified, Known, LawAnswer, Named, Specimen};

/// The characterization for people.
pub(super) fn of(answer: &Answer) -> String {
    let mut text = String::new();
    for specimen in &answer.specimens {
        // Writing to a string does not fail.
        let _ = write(&mut text, specimen);
    }
    text
}

fn write(text: &mut String, specimen: &Specimen) -> std::fmt::Result {
    let files = specimen.files.len();
    let recordings = if files == 1 {
        "recording"
    } else {
        "recordings"
    };
    writeln!(
        text,
        "{} ({files} {recordings})",
        printable(&specimen.title)
    )?;
    if let Some(modulus) = &specimen.lumped.mean_elastic_modulus {
        let value = plain_quantity("_pa", modulus.value, modulus.standard_deviation);
        let depth = plain_quantity("_m", modulus.depth_m, None);
        writeln!(text, "  mean modulus     {value} at {depth}, relaxed")?;
    }
    let contact = [
        ("linear elastic", &specimen.lumped.linear_elastic),
        ("adhesion", &specimen.lumped.adhesion),
    ];
    // Instruments' own programs, which state positions, report such a modulus.
    let is_of_instrument = specimen.position_m.is_some() || specimen.laws.is_empty();
    for (name, found) in contact {
        if let Some(found) = found.as_ref().filter(|_| is_of_instrument) {
            writeln!(text, "  {name:<16} {}", of_contact(found))?;
        }
    }
    if let Some(relaxation) = &specimen.relaxation {
        for (place, (g, tau)) in (1..).zip(relaxation.g.iter().zip(&relaxation.tau_s)) {
            let (g, tau) = (shown("", g), shown("_s", tau));
            writeln!(text, "  relaxation {place}     g {g}, tau {tau}")?;
        }
    }
    for name in CandidateLaw::NAMES.map(LawName::word) {
        if let Some(law) = specimen.laws.get(name) {
            writeln!(text, "  {name:<16} {}", of_law(law))?;
        } else if let Some(why) = specimen.reasons.get(name) {
            writeln!(text, "  {name:<16} not found: {why}")?;
        }
    }
    if let Some(law) = &specimen.preferred {
        writeln!(text, "  preferred        {law}")?;
    }
    writeln!(text)
}

/// A modulus and a work of adhesion, with the misfit.
fn of_contact(found: &Named) -> String {
    let misfit = found.get("misfit").map_or(0.0, |misfit| misfit.value);
    let value = |key: &str, name: &str| Some(format!("{name} {}", shown(key, found.get(key)?)));
    let parts = [
        value("youngs_modulus_pa", "E"),
        value("work_of_adhesion_j_per_m2", "w"),
        value("pull_off_n", "pull-off force"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let branch = match parts.len() {
        1 => "approach",
        _ => "retraction",
    };
    let misfit = 100.0 * misfit;
    format!(
        "{}; {branch}, misfit {misfit:.1} % of the largest force",
        parts.join(", ")
    )
}

fn of_law(law: &LawAnswer) -> String {
    let each = law.parameters.iter();
    let parameters: Vec<_> = each
        .map(|(name, known)| format!("{} {}", without_unit(name), shown(name, known)))
        .collect();
    let misfit = 100.0 * law.misfit;
    let solves = match law.solves {
        0 => String::new(),
        1 => "; 1 run of finite elements".to_owned(),
        solves => format!("; {solves} runs of finite elements"),
    };
    format!(
        "{}; misfit {misfit:.1} % of the largest force{solves}",
        parameters.join(", ")
    )
}

/// A parameter with its error, and why it is not identified individually.
fn shown(key: &str, known: &Known) -> String {
    let value = plain_quantity(key, known.value, known.standard_error);
    let remark = match (known.verdict, &known.correlated_with) {
        (Some(Identified::OnBound), _) => "on its bound".to_owned(),
        (Some(Identified::HardlyKnown), _) => "hardly known".to_owned(),
        (Some(Identified::Stated), _) => "as stated".to_owned(),
        (Some(Identified::Correlated), Some(with)) => format!(
            "tied to {}: correlation {:.2}",
            without_unit(&with.parameter),
            with.correlation
        ),
        _ => return value,
    };
    format!("{value} ({remark})")
}
