//! Series of plots, shared by all kinds of problems.

use crate::plot::{Series, Style};

/// A line through `points`.
pub(crate) fn line(name: &str, points: impl Iterator<Item = (f64, f64)>) -> Series {
    Series {
        name: name.to_owned(),
        points: points.collect(),
        style: Style::Line,
        color: 0,
    }
}

/// Through the origin and `points`, which may be in any order.
pub(crate) fn dotted_line(name: &str, points: impl Iterator<Item = (f64, f64)>) -> Series {
    let mut points: Vec<_> = points.chain([(0.0, 0.0)]).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.dedup();
    Series {
        style: Style::LineWithDots,
        ..line(name, points.into_iter())
    }
}

/// A line from theory, without finite elements.
pub(crate) fn closed_form(name: &str, points: impl Iterator<Item = (f64, f64)>) -> Series {
    Series {
        style: Style::DashedLine,
        color: 1,
        ..line(name, points)
    }
}

/// A number of a heading, to four digits, without zeros at its end.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    format!("{rounded}")
}
