use super::study::HandOverCost;

use super::DRAWN;
use palpate_jobs::plot::{Plot, Series, Style};

/// Errors over two cycles of the hand, in percent of the peak force.
pub(super) fn of_errors(courses: &[(&str, HandOverCost)]) -> Plot {
    let (model, hand) = DRAWN;
    let series = courses.iter().enumerate().map(|(color, (name, cost))| {
        let first = cost.course.first().map_or(0.0, |[time, ..]| *time);
        let shown = cost
            .course
            .iter()
            .take_while(|[time, ..]| time - first <= 2.0 / hand);
        let points =
            shown.map(|[time, _, made, exact]| (time - first, 100.0 * (made - exact) / cost.peak));
        Series {
            name: name.replace('_', " "),
            points: points.collect(),
            style: Style::Line,
            color,
        }
    });
    Plot {
        title: format!("Force at 1 kHz from a model at {model} Hz, hand at {hand} Hz"),
        x_label: "time [s]".to_owned(),
        y_label: "error [% of the peak force]".to_owned(),
        series: series.collect(),
        ..Plot::default()
    }
}
