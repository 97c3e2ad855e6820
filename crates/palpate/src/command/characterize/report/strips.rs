use std::collections::BTreeMap;

use super::curves::line;
use crate::plot::{Plot, Style};
use crate::report::{Markup, figure, unit};
use palpate_jobs::characterize::{Answer, Specimen};

/// Values by organ.
type Strips = BTreeMap<String, Vec<f64>>;

/// A number of a specimen, where it has one.
type Value = fn(&Specimen) -> Option<f64>;

/// The main parameters of all specimens, by organ.
pub(super) fn figures(answer: &Answer) -> Markup {
    let modulus = |own: &Specimen| own.mean_elastic_modulus.as_ref().map(|found| found.value);
    let relaxed = |own: &Specimen| {
        let found = own.relaxation.as_ref()?;
        Some(found.g.iter().map(|g| g.value).sum())
    };
    let c10 = |own: &Specimen| Some(own.neo_hookean.as_ref()?.parameters.get("c10_pa")?.value);
    let each: [(&str, &str, Value); 3] = [
        ("C₁₀ of the neo-Hookean law", "c10_pa", c10),
        ("Mean elastic modulus", "_pa", modulus),
        ("Part of the force that relaxes", "", relaxed),
    ];
    let drawn = each.into_iter().filter_map(|(title, key, value)| {
        let mut strips = Strips::new();
        for own in &answer.specimens {
            let organ = own.organ.clone().unwrap_or_else(|| "specimens".to_owned());
            strips.entry(organ).or_default().extend(value(own));
        }
        strips.retain(|_, values| !values.is_empty());
        (!strips.is_empty()).then(|| strip(title, key, &strips))
    });
    drawn.collect()
}

/// One parameter: organs above one another, specimens beside one another, the mean as a line.
fn strip(title: &str, key: &str, strips: &Strips) -> Markup {
    let all = strips.values().flatten();
    let most = all.fold(0.0_f64, |most, value| most.max(value.abs()));
    let scale = unit(key, most);
    let series = strips
        .iter()
        .enumerate()
        .flat_map(|(place, (organ, values))| {
            let dots = values.iter().enumerate();
            let dots = dots.map(|(number, value)| (1.0 + number as f64, scale.factor * value));
            let mean = scale.factor * values.iter().sum::<f64>() / values.len() as f64;
            let ends = [(1.0, mean), (values.len() as f64, mean)];
            let mean = line(String::new(), ends.into(), Style::DashedLine, place);
            [
                line(organ.clone(), dots.collect(), Style::Dots, place),
                mean,
            ]
        });
    let unit = if scale.unit.is_empty() {
        "-"
    } else {
        scale.unit
    };
    let plot = Plot {
        title: title.to_owned(),
        x_label: "specimens of an organ, in the order below".to_owned(),
        y_label: format!("value [{unit}]"),
        series: series.collect(),
        ..Plot::default()
    };
    figure(&plot, "Dashed: the mean of each organ.")
}

/// The key, with its unit, of a name of a pooled number.
pub(super) fn key(name: &str) -> &str {
    match name.rsplit('.').next().unwrap_or(name) {
        "mean_elastic_modulus" => "_pa",
        "sum_of_g" => "",
        key => key,
    }
}

/// The organ in the name of a pooled number.
pub(super) fn organ<'a>(name: &str, answer: &'a Answer) -> Option<&'a str> {
    let organs = answer
        .specimens
        .iter()
        .filter_map(|own| own.organ.as_deref());
    let mut named = organs.filter(|organ| {
        name.strip_prefix(organ)
            .is_some_and(|rest| rest.starts_with('.'))
    });
    named.next()
}
