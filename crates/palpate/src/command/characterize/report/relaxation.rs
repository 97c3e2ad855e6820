use super::curves::{self, TIME, line};
use crate::plot::{Axis, Plot, Style};
use crate::report::{Markup, figure};
use palpate_jobs::characterize::{DrawnRelaxation, FitPlots};

/// Forces over the instantaneous elastic force, and the relaxation functions, over the logarithm of time.
fn plot(portrait: &FitPlots) -> Option<Plot> {
    let mut series = Vec::new();
    let seen = portrait.recordings.iter().filter_map(|own| {
        let fit = own.fitted.as_ref()?;
        Some((&fit.time, fit.relaxation.as_ref()?))
    });
    for (place, (time, relaxation)) in seen.enumerate() {
        let DrawnRelaxation {
            measured,
            fitted,
            of_step,
        } = relaxation;
        let name = |name: &str| {
            if place == 0 {
                name.to_owned()
            } else {
                String::new()
            }
        };
        let after = |values: &[f64]| time.iter().copied().zip(values.iter().copied()).collect();
        series.push(curves::measured(name("measured"), after(measured)));
        series.push(line(
            name("with the recorded course"),
            after(fitted),
            Style::Line,
            0,
        ));
        series.push(line(
            name("ramp taken for a step"),
            of_step.clone(),
            Style::DottedLine,
            1,
        ));
    }
    let function = portrait.relaxation.as_ref()?;
    series.push(line(
        "G(t)/G(0)".to_owned(),
        function.points.clone(),
        Style::DashedLine,
        2,
    ));
    Some(Plot {
        title: "Relaxation".to_owned(),
        x_label: TIME.to_owned(),
        y_label: "force over instantaneous elastic force [-]".to_owned(),
        x_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    })
}

/// The same in its frame; nothing where no relaxation was found.
pub(super) fn drawn(portrait: &FitPlots) -> Markup {
    let caption = "G(t)/G(0) is what a step would show. While the indenter still moves the force lies below it, and the ramp relaxes as it goes: \
                   a fit that takes the ramp for a step misses that part.";
    plot(portrait).map_or_else(Markup::default, |plot| figure(&plot, caption))
}
