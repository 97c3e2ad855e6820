use super::curves::{MEASURED, TIME, line, scaled};
use crate::plot::{Plot, Shade, Style};
use crate::report::{Markup, figure, unit};
use palpate_jobs::characterize::DrawnRecording;

/// The recordings, with the segments recognised in them.
pub(super) fn figure_of(own: &DrawnRecording) -> Markup {
    let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let force = unit("_n", most(&own.force));
    let over_time = |name: &str, values: &[f64], style, color| {
        let points = scaled(&own.time, values, force.factor);
        line(name.to_owned(), points, style, color)
    };
    let plot = Plot {
        title: "Recordings".to_owned(),
        x_label: TIME.to_owned(),
        y_label: format!("force [{}]", force.unit),
        series: vec![
            over_time("measured", &own.force, Style::FineLine, MEASURED),
            over_time("filtered", &own.filtered_force, Style::Line, 0),
        ],
        shades: own
            .segments
            .iter()
            .map(|(kind, span)| Shade {
                span: *span,
                color: color(kind),
            })
            .collect(),
        ..Plot::default()
    };
    let segments = own.segments.iter().map(|(kind, [from, to])| {
        let key = Markup::of_class("span", &format!("key key-{}", color(kind)), "");
        key.and(format!("{kind} from {from:.2} to {to:.2} s. "))
    });
    let file = Markup::plain("code", &*own.file);
    let caption = file.and(". ").and(segments.collect::<Markup>());
    figure(
        &plot,
        caption.and("The model is fitted to the force as measured."),
    )
}

/// The color of a part of the stimulus, by its first word.
fn color(kind: &str) -> usize {
    match kind.split_whitespace().next() {
        Some("ramp") => 1,
        Some("hold") => 4,
        Some("retreat") => 3,
        _ => 2,
    }
}
