//! From where to where an axis goes.

use super::{Axis, Plot};

/// What is left free beside markers at the border, as a part of the span [-].
const MARGIN: f64 = 0.03;

/// Lowest and highest value of the x axis; none without two different values.
pub(super) fn x(plot: &Plot) -> Option<(f64, f64)> {
    span(plot, plot.x_axis, |point| point.0)
}

/// Lowest and highest value of the y axis; none without two different values, or where the drawing
/// chooses better.
pub(super) fn y(plot: &Plot) -> Option<(f64, f64)> {
    match plot.y_axis {
        Axis::Linear => None,
        Axis::Logarithmic => span(plot, plot.y_axis, |point| point.1),
    }
}

fn span(plot: &Plot, axis: Axis, of: fn((f64, f64)) -> f64) -> Option<(f64, f64)> {
    let values = plot.series.iter().flat_map(|series| series.drawable(plot));
    let nothing = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values
        .map(of)
        .fold(nothing, |(low, high), v| (low.min(v), high.max(v)));
    if low >= high {
        return None;
    }
    let markers = plot.series.iter().any(|series| series.style.has_markers());
    let margin = if markers { MARGIN * (high - low) } else { 0.0 };
    Some(match axis {
        Axis::Linear => (low - margin, high + margin),
        Axis::Logarithmic => (1.0 / round_up(1.0 / low), round_up(high)),
    })
}

/// The next of 1, 2, 5, 10 … that is clearly above `value`.
fn round_up(value: f64) -> f64 {
    let decade = 10f64.powf(value.log10().floor());
    let steps = [2.0, 5.0, 10.0, 20.0].map(|step| step * decade);
    let above = steps.into_iter().find(|step| *step > 1.05 * value);
    above.unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_spans_end_at_round_numbers() {
        assert_eq!(round_up(300.0), 500.0);
        assert_eq!(round_up(999.0), 2000.0);
        assert_eq!(1.0 / round_up(1.0 / 20.0), 10.0);
    }
}
