use std::fmt::Write;

use palpate_jobs::characterize::{Answer, Known, LawAnswer, Specimen};

/// What was found, for people.
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
    writeln!(text, "{} ({files} {recordings})", specimen.title)?;
    if let Some(modulus) = &specimen.mean_elastic_modulus {
        let (value, depth) = (1e-3 * modulus.value, 1e3 * modulus.depth_m);
        write!(text, "  mean modulus     {value:.2}")?;
        if let Some(spread) = modulus.standard_deviation {
            write!(text, " ± {:.2}", 1e-3 * spread)?;
        }
        writeln!(text, " kPa at {depth:.2} mm, relaxed")?;
    }
    if let Some(relaxation) = &specimen.relaxation {
        for (place, (g, tau)) in (1..).zip(relaxation.g.iter().zip(&relaxation.tau_s)) {
            let (g, tau) = (shown(g), shown(tau));
            writeln!(text, "  relaxation {place}     g {g:<22} tau {tau} s")?;
        }
    }
    for (name, law) in specimen.laws() {
        writeln!(text, "  {name:<16} {}", of_law(law))?;
    }
    if let Some(law) = specimen.preferred.as_deref() {
        let law = if law == "blatz" { "exponential" } else { law };
        writeln!(text, "  preferred        {law}")?;
    }
    writeln!(text)
}

fn of_law(law: &LawAnswer) -> String {
    let each = law.parameters.iter().map(|(name, known)| {
        let unit = if name.ends_with("_pa") { " Pa" } else { "" };
        format!("{} {}{unit}", name.trim_end_matches("_pa"), shown(known))
    });
    let parameters: Vec<_> = each.collect();
    let misfit = 100.0 * law.misfit;
    format!(
        "{}; misfit {misfit:.1} % of the largest force",
        parameters.join(", ")
    )
}

fn shown(known: &Known) -> String {
    match known.standard_error {
        Some(error) => format!("{:.4} ± {:.1e}", known.value, error),
        None => format!("{:.4}", known.value),
    }
}
