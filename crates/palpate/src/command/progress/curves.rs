//! Learning curves as the source's figure 2-1 has them: time and errors over the number of attempts.

use palpate_record::Spread;

use super::learning_curves::{CurveQuantity, LearningCurve};
use crate::plot::{Axis, Band, Plot, Series, Style};

/// Trainees that are drawn one by one, at most; all are in the mean.
pub(super) const TRAINEES: usize = 24;

/// Colors of the plots.
const MEAN: usize = 0;
const EXPERTS: usize = 2;
const EACH: usize = 5;

/// Operation time, errors, and the proficient measures, where there is data.
pub(super) fn plots(course: &LearningCurve<'_>) -> Vec<Plot> {
    let all: [(&str, &str, CurveQuantity); 3] = [
        ("Operation time", "time [s]", CurveQuantity::Time),
        ("Errors", "errors in an attempt", CurveQuantity::Errors),
        (
            "Proficient measures",
            "part of the measures [%]",
            CurveQuantity::ProficientPart,
        ),
    ];
    let plots = all.into_iter().filter_map(|(title, label, of)| {
        let plot = plot(course, of)?;
        Some(Plot {
            title: title.to_owned(),
            x_label: "attempt".to_owned(),
            y_label: label.to_owned(),
            ..plot
        })
    });
    plots.collect()
}

fn plot(course: &LearningCurve<'_>, of: CurveQuantity) -> Option<Plot> {
    let curve = course.curve(of);
    let last = curve.last()?.attempt as f64;
    let mut plot = Plot {
        x_axis: Axis::Counted,
        y_axis: match of {
            CurveQuantity::Errors => Axis::Counted,
            CurveQuantity::Time | CurveQuantity::ProficientPart => Axis::Linear,
        },
        ..Plot::default()
    };
    let several = course.trainees.len() > 1;
    for trainee in course.trainees.iter().take(TRAINEES).filter(|_| several) {
        let points = (1..).zip(&trainee.attempts);
        let points =
            points.filter_map(|(number, own)| Some((f64::from(number), own.quantity(of)?)));
        plot.series
            .push(Series::new("", points.collect(), Style::FineLine, EACH));
    }
    let point = |spread: &Spread| {
        let deviation = spread.standard_deviation.unwrap_or(0.0);
        // Neither times nor counts are negative.
        [(spread.mean - deviation).max(0.0), spread.mean + deviation]
    };
    if several {
        let spread = curve.iter();
        let spread = spread.map(|own| (own.attempt as f64, point(&own.spread)));
        plot.bands.push(Band {
            points: spread.collect(),
            color: MEAN,
        });
    }
    let mean = curve.iter();
    let mean = mean.map(|own| (own.attempt as f64, own.spread.mean));
    let name = match course.trainees.as_slice() {
        [only] => only.name.to_owned(),
        all => format!("mean of {} trainees", all.len()),
    };
    plot.series
        .push(Series::new(name, mean.collect(), Style::LineWithDots, MEAN));
    if let Some(experts) = course.of_experts(of) {
        // A margin on both sides, so that a single attempt has a band, too.
        let ends = [0.7, last + 0.3];
        let level = ends.map(|x| (x, experts.mean)).to_vec();
        plot.series
            .push(Series::new("experts", level, Style::DashedLine, EXPERTS));
        plot.bands.push(Band {
            points: ends.map(|x| (x, point(&experts))).to_vec(),
            color: EXPERTS,
        });
    }
    Some(plot)
}
