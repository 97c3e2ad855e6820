use super::{convergence, curves, laws, lumped, relaxation, words};
use crate::report::{Markup, count, quantity, rounded, symbol, warning_list};
use palpate_jobs::characterize::FitPlots;
use palpate_jobs::characterize::{Identified, Known, Specimen};

/// The section on one specimen, with its title if it is one of `several`.
pub(super) fn section(place: usize, own: &Specimen, several: bool, portrait: &FitPlots) -> Markup {
    let files = own
        .files
        .iter()
        .map(|file| Markup::plain("code", file.display().to_string()));
    let files = files.enumerate().map(|(place, file)| match place {
        0 => file,
        _ => Markup::from(", ").and(file),
    });
    let title = match several {
        true => Markup::plain("h2", &*own.title),
        false => Markup::default(),
    };
    let files = Markup::of_class("p", "muted", files.collect::<Markup>());
    let figures = curves::figures(own, portrait)
        .and(relaxation::drawn(portrait))
        .and(convergence::figures(portrait));
    let inside = title
        .and(files)
        .and(headline(own, portrait))
        .and(verdicts(own))
        .and(Markup::of_class("div", "figures", figures))
        .and(laws::comparison(own))
        .and(laws::parameters(own))
        .and(laws::noise(own))
        .and(convergence::correlations(own))
        .and(lumped::tables(own))
        .and(missing(own));
    let id = format!("specimen-{}", place + 1);
    Markup::element(
        "section",
        &[("id", id.as_str()), ("class", "specimen")],
        inside,
    )
}

/// The preferred law with its numbers, relaxation, and facts on the specimen from the recordings.
fn headline(own: &Specimen, portrait: &FitPlots) -> Markup {
    let mut cards = Vec::new();
    match own.preferred() {
        Some((key, law)) => {
            let misfit = format!("misfit {:.2} %", 100.0 * law.misfit);
            cards.push(card("preferred law", words::law(key), misfit));
            for (name, known) in &law.parameters {
                cards.push(known_card(symbol(name), name, known));
            }
        }
        None => cards.push(card("preferred law", "none", "the reasons stand below")),
    }
    if let Some(relaxation) = &own.relaxation {
        let relaxed: f64 = relaxation.g.iter().map(|g| g.value).sum();
        let terms = count(relaxation.g.len(), "term");
        cards.push(card(
            "relaxes by",
            format!("{:.1} %", 100.0 * relaxed),
            terms,
        ));
    }
    if let Some(modulus) = &own.lumped.mean_elastic_modulus {
        let depth = quantity("depth_m", modulus.depth_m, None);
        let value = quantity("_pa", modulus.value, modulus.standard_deviation);
        cards.push(card(
            "mean elastic modulus",
            value,
            format!("relaxed, at {depth}"),
        ));
    }
    let cards = Markup::of_class("dl", "cards", cards.into_iter().collect::<Markup>());
    Markup::of_class("p", "muted", facts(own, portrait)).and(cards)
}

/// Facts on the specimen from the recordings.
fn facts(own: &Specimen, portrait: &FitPlots) -> String {
    let named = [
        ("organ", &own.organ),
        ("subject", &own.subject),
        ("site", &own.site),
    ];
    let named = named
        .into_iter()
        .filter_map(|(name, value)| Some((name, value.as_deref()?)));
    let facts = portrait
        .facts
        .iter()
        .map(|(name, value)| (&**name, &**value));
    let facts = named
        .chain(facts)
        .map(|(name, value)| format!("{name}: {value}"));
    facts.collect::<Vec<_>>().join(" · ")
}

fn card(name: impl Into<Markup>, value: impl Into<Markup>, note: impl Into<Markup>) -> Markup {
    let name = Markup::plain("dt", name);
    let note = Markup::plain("small", note);
    let value = Markup::plain("dd", value.into().and(note));
    Markup::plain("div", name.and(value))
}

fn known_card(name: Markup, key: &str, known: &Known) -> Markup {
    let off = known.discretisation_error.filter(|off| *off > 0.0);
    let note = off.map_or(String::new(), |off| {
        format!("± {} by the model", laws::alone(key, Some(off)))
    });
    card(name, quantity(key, known.value, known.standard_error), note)
}

/// The identifiability of each parameter, and warnings.
fn verdicts(own: &Specimen) -> Markup {
    let others = own
        .warnings
        .iter()
        .filter(|warning| !own.identifiability.contains(warning));
    let others: Vec<String> = others.cloned().collect();
    let apart = match own.identifiability.is_empty() {
        true => Markup::plain("p", known_by_itself(own).unwrap_or_default()),
        false => warning_list("What these recordings cannot tell", &own.identifiability),
    };
    apart.and(warning_list("Warnings", &others))
}

/// The sentence on a preferred law and a relaxation with individually identified parameters, with the numbers that
/// show it; none where one is not.
fn known_by_itself(own: &Specimen) -> Option<String> {
    let (name, law) = own.preferred()?;
    let terms = own.relaxation.iter();
    let terms = terms.flat_map(|found| found.g.iter().chain(&found.tau_s));
    let all: Vec<&Known> = law.parameters.values().chain(terms).collect();
    let is_settled =
        |own: &Option<Identified>| matches!(own, Some(Identified::Known | Identified::Stated));
    if all.iter().any(|own| !is_settled(&own.verdict)) {
        return None;
    }
    let errors = all
        .iter()
        .filter_map(|own| Some((own.standard_error? / own.value).abs()));
    let largest = errors.fold(0.0, f64::max);
    let correlations = own.fits.get(name)?.covariance.correlations();
    Some(format!(
        "Every parameter is known by itself from these recordings: standard errors are {} % at most, correlations {:.2} at most, up or down.",
        rounded(100.0 * largest, 2),
        convergence::largest(&correlations)
    ))
}

/// Why results are missing.
fn missing(own: &Specimen) -> Markup {
    if own.reasons.is_empty() {
        return Markup::default();
    }
    let each = own.reasons.iter().map(|(key, reason)| {
        let name = Markup::plain("strong", words::quantity(key));
        Markup::plain("li", name.and(format!(": {reason}")))
    });
    let list = Markup::plain("ul", each.collect::<Markup>());
    Markup::plain("h3", "What was not found, and why").and(list)
}
