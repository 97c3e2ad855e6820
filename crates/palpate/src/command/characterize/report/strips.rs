use std::collections::BTreeMap;

use super::curves::line;
use crate::plot::{Plot, Style};
use crate::report::{Markup, figure, unit};
use palpate_jobs::characterize::{Answer, Specimen};

/// Values by organ and condition, and the mean over subjects.
type Strips = BTreeMap<String, (Vec<f64>, f64)>;

/// A number of a specimen, where it has one.
type Value = fn(&Specimen) -> Option<f64>;

/// The main parameters of all specimens, by organ and condition.
pub(super) fn figures(answer: &Answer) -> Markup {
    let modulus = |own: &Specimen| {
        let found = own.lumped.mean_elastic_modulus.as_ref();
        found.map(|found| found.value)
    };
    let relaxed = |own: &Specimen| {
        let found = own.relaxation.as_ref()?;
        Some(found.g.iter().map(|g| g.value).sum())
    };
    let c10 = |own: &Specimen| {
        let law = own.laws.get("neo_hookean")?;
        Some(law.parameters.get("c10_pa")?.value)
    };
    let each: [(&str, &str, &str, Value); 3] = [
        (
            "C₁₀ of the neo-Hookean law",
            "c10_pa",
            "neo_hookean.c10_pa",
            c10,
        ),
        (
            "Mean elastic modulus",
            "_pa",
            "mean_elastic_modulus",
            modulus,
        ),
        (
            "Part of the force that relaxes",
            "",
            "relaxation.sum_of_g",
            relaxed,
        ),
    ];
    let drawn = each
        .into_iter()
        .filter_map(|(title, key, quantity, value)| {
            let pooled = answer
                .pooled
                .values()
                .filter(|own| own.quantity == quantity);
            let strips = pooled.map(|pooled| {
                let same = |own: &&Specimen| {
                    own.organ == pooled.organ && own.condition == pooled.condition
                };
                let own = answer.specimens.iter().filter(same);
                let name = group(pooled.organ.as_deref(), pooled.condition.as_deref());
                let name = name.unwrap_or_else(|| "specimens".to_owned());
                (name, (own.filter_map(value).collect(), pooled.mean))
            });
            let strips: Strips = strips.collect();
            (!strips.is_empty()).then(|| strip(title, key, &strips))
        });
    drawn.collect()
}

/// An organ and its condition, where the files state them.
pub(super) fn group(organ: Option<&str>, condition: Option<&str>) -> Option<String> {
    let condition = condition.map(|own| own.replace('_', " "));
    let parts: Vec<String> = organ
        .map(str::to_owned)
        .into_iter()
        .chain(condition)
        .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// One parameter: organs above one another, specimens side by side, the mean as a line.
fn strip(title: &str, key: &str, strips: &Strips) -> Markup {
    let all = strips.values().flat_map(|(values, _)| values);
    let most = all.fold(0.0_f64, |most, value| most.max(value.abs()));
    let scale = unit(key, most);
    let series = strips
        .iter()
        .enumerate()
        .flat_map(|(place, (organ, (values, mean)))| {
            let dots = values.iter().enumerate();
            let dots = dots.map(|(number, value)| (1.0 + number as f64, scale.factor * value));
            let mean = scale.factor * mean;
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
    figure(
        &plot,
        "Dashed: the mean over subjects, each of which counts once.",
    )
}

/// The key, with its unit, of a name of a pooled number.
pub(super) fn key(name: &str) -> &str {
    match name.rsplit('.').next().unwrap_or(name) {
        "mean_elastic_modulus" => "_pa",
        "sum_of_g" => "",
        key => key,
    }
}
