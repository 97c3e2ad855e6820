use palpate_characterize::Analysis;

use super::{CURVES, some_of, title};
use crate::plot::{Plot, Series, Style, thinned_indices};
use crate::report::{Markup, figure, unit};
use palpate_jobs::ReadRecording;

/// Force over depth of the recordings without oscillation.
pub(super) fn figure_of(own: &[&(ReadRecording, Analysis)]) -> Markup {
    let pressed: Vec<&ReadRecording> = own
        .iter()
        .filter(|(_, analysis)| analysis.sinusoids.is_empty() && analysis.sweeps.is_empty())
        .map(|(read, _)| read)
        .collect();
    if pressed.is_empty() {
        return Markup::default();
    }
    let drawn = || pressed.iter().take(CURVES);
    let largest = |of: fn(&ReadRecording) -> &[f64]| {
        let all = drawn().flat_map(|read| of(read));
        all.fold(0.0_f64, |most, value| most.max(value.abs()))
    };
    let depth = unit("_m", largest(|read| &read.clean.depth));
    let force = unit("_n", largest(|read| &read.clean.filtered_force));
    let series = drawn().enumerate().map(|(color, read)| {
        let clean = &read.clean;
        let places = thinned_indices(&clean.time, &clean.depth, &clean.filtered_force);
        let points = places.into_iter().map(|place| {
            let [along, up] = [clean.depth[place], clean.filtered_force[place]];
            (depth.factor * along, force.factor * up)
        });
        let deepest = 1e3 * clean.depth.iter().copied().fold(0.0, f64::max);
        let name = format!("{}, {deepest:.1} mm", title(read));
        Series::new(name, points.collect(), Style::FineLine, color)
    });
    let plot = Plot {
        title: "Force over depth".to_owned(),
        x_label: format!("depth [{}]", depth.unit),
        y_label: format!("force [{}]", force.unit),
        series: series.collect(),
        ..Plot::default()
    };
    let caption = format!(
        "From first contact, after the filter; a hold is a fall at one depth.{}",
        some_of(pressed.len())
    );
    figure(&plot, caption)
}
