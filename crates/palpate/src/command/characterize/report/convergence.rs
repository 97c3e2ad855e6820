use palpate_characterize::fit::CORRELATED;
use palpate_characterize::inverse::Correlations;

use super::curves::line;
use super::words;
use crate::plot::{Plot, Style};
use crate::report::{Markup, Table, figure, quantity, symbol};
use palpate_jobs::characterize::Specimen;
use palpate_jobs::characterize::{DrawnLaw, FitPlots};

/// Convergence of the fits.
pub(super) fn figures(portrait: &FitPlots) -> Markup {
    let moved = portrait.laws.iter().filter(|law| law.iterations.len() > 1);
    moved.map(|law| figure(&way(law), caption(law))).collect()
}

/// Correlations between the errors of the preferred law.
pub(super) fn correlations(own: &Specimen) -> Markup {
    let preferred = own.preferred.as_deref();
    let fit = preferred.and_then(|law| Some((law, own.fits.get(law)?)));
    let heat = fit.map(|(law, fit)| heat(law, &fit.covariance.correlations()));
    heat.unwrap_or_default()
}

/// Parameters relative to their final values, step by step.
fn way(law: &DrawnLaw) -> Plot {
    let last = law.iterations.last().map_or(&[][..], Vec::as_slice);
    let series = law
        .names
        .iter()
        .zip(last)
        .enumerate()
        .map(|(place, (name, last))| {
            let most = law
                .iterations
                .iter()
                .fold(0.0_f64, |most, step| most.max(step[place].abs()));
            let size = if last.abs() > 1e-3 * most {
                *last
            } else {
                most.max(f64::MIN_POSITIVE)
            };
            let each = law.iterations.iter().enumerate();
            let points = each.map(|(step, values)| (step as f64, values[place] / size));
            line(plain(name), points.collect(), Style::LineWithDots, place)
        });
    let most = law.sums_of_squares.iter().copied().fold(0.0, f64::max);
    let sums = law.sums_of_squares.iter().enumerate();
    let sums = sums.map(|(step, sum)| (step as f64, if most > 0.0 { sum / most } else { 0.0 }));
    let sums = line(
        "sum of squares, over its largest".to_owned(),
        sums.collect(),
        Style::DashedLine,
        5,
    );
    Plot {
        title: format!("Convergence: {}", words::law(&law.law)),
        x_label: "iteration".to_owned(),
        y_label: "value over where it ended (or its largest, where that is zero) [-]".to_owned(),
        series: series.chain([sums]).collect(),
        ..Plot::default()
    }
}

fn caption(law: &DrawnLaw) -> String {
    let ends = law
        .names
        .iter()
        .zip(law.iterations.last().into_iter().flatten());
    let ends = ends.map(|(name, end)| format!("{} = {}", plain(name), quantity(name, *end, None)));
    format!("Ended at {}.", ends.collect::<Vec<_>>().join(", "))
}

/// The name of a parameter without its unit.
fn plain(name: &str) -> String {
    name.trim_end_matches("_pa").to_owned()
}

/// The largest correlation of two parameters, up or down [-].
pub(super) fn largest(correlations: &Correlations) -> f64 {
    let matrix = &correlations.matrix;
    let others =
        (0..matrix.nrows()).flat_map(|row| (0..row).map(move |column| matrix[(row, column)]));
    others.fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Correlations as a table of colors with numbers.
fn heat(law: &str, correlations: &Correlations) -> Markup {
    let Correlations { names, matrix, .. } = correlations;
    if names.len() < 2 {
        return Markup::default();
    }
    let head = names.iter().map(|name| symbol(name));
    let mut table = Table::new([Markup::default()].into_iter().chain(head)).of_class("heat");
    for (name, row) in names.iter().zip(matrix.row_iter()) {
        let cells = row.iter().map(|value| {
            // Blue for positive, orange for negative correlations.
            let color = if *value < 0.0 { 1 } else { 0 };
            let part = (100.0 * value.abs()).round() * 0.55;
            let style = format!(
                "background: color-mix(in srgb, var(--series-{color}) {part:.0}%, transparent)"
            );
            let shown = format!("{value:.2}").replace('-', "−");
            Markup::element(
                "span",
                &[("class", "cell"), ("style", style.as_str())],
                shown,
            )
        });
        table.row([symbol(name)].into_iter().chain(cells).collect());
    }
    let title = format!("Correlation of errors: {}", words::law(law));
    let most = largest(correlations);
    let note = match most >= CORRELATED {
        true => format!(
            "The largest is {most:.2}, up or down: from {CORRELATED:.2} on two parameters are known together and not each by itself, for what one gains \
             the other loses, or gains too."
        ),
        false => format!(
            "The largest is {most:.2}, up or down: below {CORRELATED:.2} no parameter can be taken for another."
        ),
    };
    Markup::plain("h3", title)
        .and(table)
        .and(Markup::of_class("p", "muted", note))
}
