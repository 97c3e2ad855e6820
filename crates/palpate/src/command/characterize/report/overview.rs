use super::{map, strips, words};
use crate::report::{Markup, Table, quantity, symbol, warning_list};
use palpate_jobs::characterize::Pooled;
use palpate_jobs::characterize::{Answer, Specimen};

/// All specimens at once: each in a row, numbers over organs, files that could not be used.
pub(super) fn section(answer: &Answer) -> Markup {
    let specimens = match answer.specimens.len() > 1 {
        true => Markup::plain("h2", "Overview")
            .and(Markup::of_class("div", "figures", strips::figures(answer)))
            .and(map::figure(&answer.specimens))
            .and(pooled(answer))
            .and(each(&answer.specimens)),
        false => Markup::default(),
    };
    let inside = unusable(answer).and(specimens);
    Markup::of_class("section", "overview", inside)
}

fn each(specimens: &[Specimen]) -> Markup {
    let mut table = Table::new([
        "specimen",
        "recordings",
        "preferred law",
        "parameters",
        "misfit",
        "relaxes by",
        "mean modulus",
    ]);
    for (place, own) in specimens.iter().enumerate() {
        let link = format!("#specimen-{}", place + 1);
        let law = own.preferred();
        let parameters = law.iter().flat_map(|(_, law)| &law.parameters);
        let parameters = parameters.map(|(name, known)| {
            let value = quantity(name, known.value, known.standard_error);
            Markup::plain("div", symbol(name).and(format!(" = {value}")))
        });
        let none = || "–".to_owned();
        let relaxed = own.relaxation.as_ref().map(|found| {
            let sum: f64 = found.g.iter().map(|g| g.value).sum();
            format!("{:.1} %", 100.0 * sum)
        });
        let modulus = own.lumped.mean_elastic_modulus.as_ref();
        let modulus = modulus.map(|own| quantity("_pa", own.value, own.standard_deviation));
        table.row(vec![
            Markup::element("a", &[("href", link.as_str())], &*own.title),
            own.files.len().to_string().into(),
            law.map_or("none", |(key, _)| words::law(key)).into(),
            parameters.collect(),
            law.map_or_else(none, |(_, law)| format!("{:.2} %", 100.0 * law.misfit))
                .into(),
            relaxed.unwrap_or_else(none).into(),
            modulus.unwrap_or_else(none).into(),
        ]);
    }
    Markup::plain("h3", "Specimens").and(table)
}

fn pooled(answer: &Answer) -> Markup {
    let mut table = Table::new([
        "over subjects",
        "subjects",
        "specimens",
        "mean",
        "standard deviation",
        "95 % interval of the mean",
    ]);
    for pooled in answer.pooled.values() {
        let Pooled {
            n,
            specimens,
            mean,
            standard_deviation,
            interval_95,
            quantity: name,
            ..
        } = pooled;
        let parts: Vec<&str> = name.split('.').collect();
        let key = strips::key(name);
        let unit = |value: f64| quantity(key, value, None);
        let interval = interval_95.map(|[low, high]| format!("{} to {}", unit(low), unit(high)));
        let of = match parts.as_slice() {
            [.., law, key] if law != key => words::parameter(law, key),
            _ => words::quantity(parts.last().copied().unwrap_or_default()).into(),
        };
        let of = match strips::group(pooled.organ.as_deref(), pooled.condition.as_deref()) {
            Some(group) => Markup::from(format!("{group}: ")).and(of),
            None => of,
        };
        table.row(vec![
            of,
            n.to_string().into(),
            specimens.to_string().into(),
            unit(*mean).into(),
            standard_deviation.map_or("–".to_owned(), unit).into(),
            interval.unwrap_or_else(|| "–".to_owned()).into(),
        ]);
    }
    let note = "Each subject counts once, by the mean of its specimens; a specimen without a subject is one. Organs and conditions are kept \
                apart. Intervals hold the mean of all such subjects by Student's distribution.";
    Markup::plain("h3", "Over all specimens")
        .and(table)
        .and(Markup::of_class("p", "muted", note))
}

fn unusable(answer: &Answer) -> Markup {
    if answer.unusable.is_empty() {
        return Markup::default();
    }
    let sentences: Vec<String> = answer.unusable.iter().map(|own| own.sentence()).collect();
    warning_list("Files that could not be used", &sentences)
}
