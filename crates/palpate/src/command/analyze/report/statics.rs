use palpate_characterize::analyze::{StaticGroup, StaticPoint};

use crate::plot::{Plot, Series, Style};
use crate::report::{Markup, Scale, Table, figure, unit};

/// Means of all organs and states.
pub(super) fn overview(groups: &[StaticGroup]) -> Markup {
    let all: Vec<&StaticGroup> = groups.iter().collect();
    let scale = scale(&all);
    let series = groups.iter().enumerate().map(|(color, group)| {
        let organ = group
            .organ
            .as_deref()
            .unwrap_or("recordings without an organ");
        Series::new(
            format!(
                "{organ}{}",
                state(group).map_or(String::new(), |state| format!(", {state}"))
            ),
            means(group, scale),
            Style::LineWithDots,
            color,
        )
    });
    let plot = plot("Static response of all", scale, series.collect());
    match groups.is_empty() {
        true => Markup::default(),
        false => figure(&plot, "Mean steady force over depth."),
    }
}

/// Mean, least and largest of an organ's states, and every hold.
pub(super) fn figure_of(groups: &[&StaticGroup], points: &[StaticPoint]) -> Markup {
    if groups.is_empty() {
        return Markup::default();
    }
    let scale = scale(groups);
    let mut series = Vec::new();
    for (color, group) in groups.iter().enumerate() {
        let name = state(group).unwrap_or_else(|| "mean".to_owned());
        series.push(Series::new(
            name,
            means(group, scale),
            Style::LineWithDots,
            color,
        ));
        for row in group.rows.iter().filter(|row| row.n > 1) {
            let ends =
                [row.min_n, row.max_n].map(|force| (1e3 * row.depth_m, scale.factor * force));
            series.push(Series::new("", ends.to_vec(), Style::Line, color));
        }
    }
    let organ = &groups[0].organ;
    let own = points.iter().filter(|point| point.organ == *organ);
    let holds = own.map(|point| (1e3 * point.depth_m, scale.factor * point.steady_n));
    series.push(Series::new("each hold", holds.collect(), Style::Dots, 5));
    let plot = plot("Static response", scale, series);
    figure(
        &plot,
        "Mean steady force over depth, with a bar from the least to the largest.",
    )
}

fn plot(title: &str, scale: Scale, series: Vec<Series>) -> Plot {
    Plot {
        title: title.to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: format!("steady force [{}]", scale.unit),
        series,
        ..Plot::default()
    }
}

fn means(group: &StaticGroup, scale: Scale) -> Vec<(f64, f64)> {
    let rows = group.rows.iter();
    rows.map(|row| (1e3 * row.depth_m, scale.factor * row.mean_n))
        .collect()
}

/// For the largest force of all.
fn scale(groups: &[&StaticGroup]) -> Scale {
    let rows = groups.iter().flat_map(|group| &group.rows);
    unit(
        "_n",
        rows.fold(0.0, |most: f64, row| most.max(row.max_n.abs())),
    )
}

/// The condition, and the hours since death.
fn state(group: &StaticGroup) -> Option<String> {
    let condition = group
        .condition
        .map(|condition| condition.word().replace('_', " "));
    let hours = group
        .post_mortem_h
        .map(|hours| format!("{hours} h after death"));
    let parts: Vec<String> = condition.into_iter().chain(hours).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// The same in numbers.
pub(super) fn table(groups: &[&StaticGroup]) -> Markup {
    if groups.is_empty() {
        return Markup::default();
    }
    let Scale { factor, unit } = scale(groups);
    let named = ["mean", "least", "largest", "within", "between"];
    let named = named.map(|name| format!("{name} [{unit}]"));
    let [mean, least, largest, within, between] = named;
    let head = [
        "state".to_owned(),
        "depth [mm]".to_owned(),
        mean,
        least,
        largest,
        within,
        between,
    ];
    let mut table = Table::new(
        head.into_iter()
            .chain(["holds", "subjects"].map(str::to_owned)),
    );
    for group in groups {
        let state = state(group).unwrap_or_else(|| "–".to_owned());
        for row in &group.rows {
            let force = |force: Option<f64>| {
                force.map_or("–".to_owned(), |force| format!("{:.2}", factor * force))
            };
            let forces = [
                Some(row.mean_n),
                Some(row.min_n),
                Some(row.max_n),
                row.within_n,
                row.between_n,
            ];
            let mut cells = vec![state.clone(), format!("{:.2}", 1e3 * row.depth_m)];
            cells.extend(forces.map(force));
            cells.extend([row.n, row.subjects].map(|count| count.to_string()));
            table.row(cells.into_iter().map(Markup::from).collect());
        }
    }
    Markup::plain("h3", "Static response").and(table)
}
