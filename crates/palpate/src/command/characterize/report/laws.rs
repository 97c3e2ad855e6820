use palpate_characterize::fit::MIN_IMPROVEMENT;

use super::words;
use crate::report::{Markup, Table, quantity, rounded, symbol, unit};
use palpate_jobs::characterize::{FitAnswer, Identified, Known, Specimen};

/// The laws side by side, and the preferred one.
pub(super) fn comparison(own: &Specimen) -> Markup {
    if own.fits.is_empty() {
        return Markup::default();
    }
    let preferred = own.preferred.as_deref();
    let least = own
        .fits
        .values()
        .map(criterion)
        .fold(f64::INFINITY, f64::min);
    let mut table = Table::new([
        "law",
        "parameters",
        "misfit",
        "criterion",
        "behind the best",
        "iterations",
        "runs of finite elements",
    ]);
    for (key, law) in own.laws() {
        let Some(fit) = own.fits.get(key) else {
            continue;
        };
        let name = Markup::from(words::law(key));
        let is_preferred = Some(key) == preferred;
        let name = if is_preferred { name.and(" ✓") } else { name };
        let cells = vec![
            name,
            law.parameters.len().to_string().into(),
            format!("{:.2} %", 100.0 * law.misfit).into(),
            rounded(criterion(fit), 5).into(),
            format!("{:.1}", criterion(fit) - least).into(),
            law.iterations.to_string().into(),
            law.solves.to_string().into(),
        ];
        match is_preferred {
            true => table.marked_row(cells),
            false => table.row(cells),
        }
    }
    let verdict = preferred.map_or_else(Markup::default, |key| verdict(key, own, least));
    Markup::plain("h3", "Which law").and(verdict).and(table)
}

/// The criterion for comparing laws [-].
fn criterion(fit: &FitAnswer) -> f64 {
    fit.information_criterion.unwrap_or(0.0)
}

/// Why a law is preferred.
fn verdict(preferred: &str, specimen: &Specimen, least: f64) -> Markup {
    let Some(own) = specimen.fits.get(preferred) else {
        return Markup::default();
    };
    let name = words::law(preferred);
    let why = match specimen.fits.len() {
        1 => format!("The {name} law is the only one that was found."),
        _ if criterion(own) <= least => {
            format!("The {name} law is preferred: no other is better by the information criterion.")
        }
        _ => format!(
            "The {name} law is preferred: it is the simplest that no other beats by more than {MIN_IMPROVEMENT}, and the best is ahead by {:.1} only.",
            criterion(own) - least
        ),
    };
    let how = format!(
        " Criterion: Akaike's with the correction for few samples, as if the {} samples were {} independent ones. The misfit is the root mean \
         square of what a law does not follow, over the largest value measured. A law without iterations is linear in its parameter: its fit ends where it starts.",
        own.samples,
        rounded(own.effective_samples, 2),
    );
    Markup::plain("p", Markup::plain("strong", why).and(how))
}

/// All parameters, with both kinds of error.
pub(super) fn parameters(own: &Specimen) -> Markup {
    let mut table = Table::new([
        "parameter",
        "of",
        "value",
        "standard error",
        "relative",
        "error of the model",
        "spread of fits made again",
        "95 % interval",
        "95 % profile, relaxation fixed",
        "verdict",
    ]);
    let mut add = |of: &str, name: &str, key: &str, known: &Known, marked: bool| {
        let relative = known.standard_error.filter(|_| known.value != 0.0);
        let relative = relative.map(|error| 100.0 * (error / known.value).abs());
        let cells = vec![
            symbol(name),
            of.into(),
            quantity(key, known.value, known.standard_error).into(),
            alone(key, known.standard_error).into(),
            relative
                .map_or("–".to_owned(), |part| format!("{} %", rounded(part, 2)))
                .into(),
            alone(key, known.discretisation_error).into(),
            alone(key, known.bootstrap_error).into(),
            interval(key, known.interval_95).into(),
            profile(key, known.profile_95).into(),
            verdict_on(known),
        ];
        match marked {
            true => table.marked_row(cells),
            false => table.row(cells),
        }
    };
    let preferred = own.preferred.as_deref();
    for (law, found) in own.laws() {
        for (name, known) in &found.parameters {
            add(words::law(law), name, name, known, Some(law) == preferred);
        }
    }
    if let Some(relaxation) = &own.relaxation {
        for (place, (g, tau)) in (1..).zip(relaxation.g.iter().zip(&relaxation.tau_s)) {
            add("relaxation", &format!("g_{place}"), "", g, false);
            add("relaxation", &format!("tau_{place}_s"), "_s", tau, false);
        }
    }
    match table.is_empty() {
        true => Markup::default(),
        false => Markup::plain("h3", "Parameters")
            .and(table)
            .and(Markup::of_class("p", "muted", INTERVALS)),
    }
}

/// Meaning of the columns of intervals and verdicts.
const INTERVALS: &str = "The interval is the standard error times the quantile of Student's distribution, with the warning about the \
relaxation. The profile holds the relaxation at what was found and so leaves that uncertainty out: it shows how far the objective is from a parabola, and \
may be narrower than the interval. The verdict follows from the standard error (hardly known: more than a quarter of the value), the \
largest correlation (tied: 0.95 or more, up or down) and the bounds.";

/// How well a parameter is identified, in words.
fn verdict_on(known: &Known) -> Markup {
    match (known.verdict, &known.correlated_with) {
        (Some(Identified::Known), _) => "known".into(),
        (Some(Identified::HardlyKnown), _) => "hardly known".into(),
        (Some(Identified::Stated), _) => "as stated".into(),
        (Some(Identified::OnBound), _) => "on its bound, no estimate".into(),
        (Some(Identified::Correlated), Some(with)) => Markup::from("tied to ")
            .and(symbol(&with.parameter))
            .and(format!(
                " ({})",
                format!("{:.2}", with.correlation).replace('-', "−")
            )),
        _ => "–".into(),
    }
}

/// The 95 % confidence interval of a parameter.
fn interval(key: &str, bounds: Option<[f64; 2]>) -> String {
    profile(key, bounds.map(|bounds| bounds.map(Some)))
}

/// Effect of noise on the parameters (section 6.4.6).
pub(super) fn noise(own: &Specimen) -> Markup {
    let mut table = Table::new(["law", "noise", "parameter", "spread", "of its value"]);
    for (law, found) in own.laws() {
        for effect in &found.noise_study {
            for (name, spread) in &effect.spread {
                let value = found.parameters.get(name).map(|known| known.value);
                let part = value
                    .filter(|value| *value != 0.0)
                    .map(|value| spread / value);
                table.row(vec![
                    words::law(law).into(),
                    format!("{} %", rounded(100.0 * effect.noise, 2)).into(),
                    symbol(name),
                    alone(name, Some(*spread)).into(),
                    part.map_or("–".to_owned(), |part| {
                        format!("{} %", rounded(100.0 * part.abs(), 2))
                    })
                    .into(),
                ]);
            }
        }
    }
    if table.is_empty() {
        return Markup::default();
    }
    let how = "Independent noise, whose standard deviation is so much of the largest force, was added to the model's own force, and the law sought \
         again: the standard deviation of what was found.";
    Markup::plain("h3", "What noise would do")
        .and(Markup::plain("p", how))
        .and(table)
}

/// The interval of a parameter by the objective.
fn profile(key: &str, bounds: Option<[Option<f64>; 2]>) -> String {
    let end = |bound: Option<f64>| bound.map_or("?".to_owned(), |end| quantity(key, end, None));
    bounds.map_or("–".to_owned(), |[low, high]| {
        format!("{} to {}", end(low), end(high))
    })
}

/// An error by itself, to two digits.
pub(super) fn alone(key: &str, error: Option<f64>) -> String {
    error.map_or("–".to_owned(), |error| {
        let scale = unit(key, error);
        format!("{}\u{202f}{}", rounded(scale.factor * error, 2), scale.unit)
    })
}
