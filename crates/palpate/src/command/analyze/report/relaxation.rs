use palpate_characterize::analyze::Relaxation;
use palpate_characterize::{Analysis, CleanRecording};

use super::{CURVES, some_of, title};
use crate::plot::{Axis, Plot, Series, Style, thinned_indices};
use crate::report::{Markup, Table, figure, quantity};
use palpate_jobs::ReadRecording;

/// The shortest hold to report, relative to the longest [-].
const SHORTEST: f64 = 0.5;

type Own = (ReadRecording, Analysis);

/// Forces of the longest holds over their peaks.
pub(super) fn figure_of(own: &[&Own]) -> Markup {
    let holds: Vec<_> = relaxing(own).collect();
    if holds.is_empty() {
        return Markup::default();
    }
    let drawn = holds.iter().take(CURVES).enumerate();
    let series = drawn.map(|(color, (read, relaxation))| {
        let clean = &read.clean;
        let until = relaxation.hold_start_s + relaxation.hold_s;
        let places = thinned_indices(&clean.time, &clean.depth, &clean.filtered_force);
        let within =
            |place: &usize| (relaxation.hold_start_s..=until).contains(&clean.time[*place]);
        let points = places.into_iter().filter(within).map(|place| {
            let part = clean.filtered_force[place] / relaxation.peak_n;
            (clean.time[place], part)
        });
        let depth = 1e3 * depth_at(clean, until);
        let name = format!("{}, {depth:.1} mm", title(read));
        Series::new(name, points.collect(), Style::FineLine, color)
    });
    let plot = Plot {
        title: "Relaxation".to_owned(),
        x_label: "time from first contact [s]".to_owned(),
        y_label: "force over its peak [-]".to_owned(),
        x_axis: Axis::Logarithmic,
        series: series.collect(),
        ..Plot::default()
    };
    let caption = format!(
        "The longest hold of each recording, after the filter.{}",
        some_of(holds.len())
    );
    figure(&plot, caption)
}

/// Recordings with a hold that is not much shorter than the longest: one before an oscillation only lets the tissue
/// settle.
fn relaxing<'a>(own: &'a [&'a Own]) -> impl Iterator<Item = (&'a ReadRecording, &'a Relaxation)> {
    let each = own
        .iter()
        .filter_map(|(read, analysis)| Some((read, analysis.relaxation.as_ref()?)));
    let longest = each.clone().map(|(_, own)| own.hold_s).fold(0.0, f64::max);
    each.filter(move |(_, own)| own.hold_s >= SHORTEST * longest)
}

/// Depth at `time` [m].
fn depth_at(clean: &CleanRecording, time: f64) -> f64 {
    let place = clean.time.partition_point(|own| *own < time);
    clean.depth.get(place).copied().unwrap_or_default()
}

/// The same in numbers.
pub(super) fn table(own: &[&Own]) -> Markup {
    let mut table = Table::new([
        "recording",
        "peak",
        "steady",
        "steady over peak",
        "within 10 % after",
        "held for",
    ]);
    for (read, relaxation) in relaxing(own) {
        table.row(vec![
            Markup::plain("code", read.path.display().to_string()),
            quantity("_n", relaxation.peak_n, None).into(),
            quantity("_n", relaxation.steady_n, None).into(),
            format!("{:.1} %", 100.0 * relaxation.ratio).into(),
            format!("{:.1} s", relaxation.settle_s).into(),
            format!("{:.1} s", relaxation.hold_s).into(),
        ]);
    }
    match table.is_empty() {
        true => Markup::default(),
        false => Markup::plain("h3", "Relaxation").and(table),
    }
}
