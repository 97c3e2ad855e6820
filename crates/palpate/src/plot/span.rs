//! The span of an axis. The drawing crate's own choice fails without points, and leaves much room on logarithmic
//! axes.

use super::{Axis, Plot};

/// Margin around markers at the border, as a part of the span [-].
const MARGIN: f64 = 0.03;

/// Lowest and highest value of the x axis.
pub(super) fn x(plot: &Plot) -> (f64, f64) {
    match values(plot, |point| point.0) {
        Some((low, high)) => around(plot, plot.x_axis, low, high),
        None => empty(plot.x_axis),
    }
}

/// Lowest and highest value of the y axis; none for lines whose span the drawing rounds well.
pub(super) fn y(plot: &Plot) -> Option<(f64, f64)> {
    match values(plot, |point| point.1) {
        None => Some(empty(plot.y_axis)),
        Some((low, high)) => {
            let rounded = plot.y_axis != Axis::Logarithmic && !has_markers(plot) && low < high;
            (!rounded).then(|| around(plot, plot.y_axis, low, high))
        }
    }
}

/// The span of an axis without data.
fn empty(axis: Axis) -> (f64, f64) {
    match axis {
        Axis::Linear | Axis::Counted => (0.0, 1.0),
        Axis::Logarithmic => (1.0, 10.0),
    }
}

/// Lowest and highest of the data.
fn values(plot: &Plot, of: fn((f64, f64)) -> f64) -> Option<(f64, f64)> {
    let of_bands = plot.bands.iter().flat_map(|band| band.drawable(plot));
    let edges = of_bands.flat_map(|(x, y)| y.map(|y| (x, y)));
    let values = plot.series.iter().flat_map(|series| series.drawable(plot));
    let both = values.chain(edges).map(of).map(|value| (value, value));
    both.reduce(|(low, high), (_, value)| (low.min(value), high.max(value)))
}

fn around(plot: &Plot, axis: Axis, low: f64, high: f64) -> (f64, f64) {
    let margin = match (low < high, has_markers(plot)) {
        (true, true) => MARGIN * (high - low),
        (true, false) => 0.0,
        // A single value stands in the middle.
        (false, _) if low == 0.0 => 1.0,
        (false, _) => 0.5 * low.abs(),
    };
    match axis {
        Axis::Linear | Axis::Counted => (low - margin, high + margin),
        Axis::Logarithmic => (1.0 / round_up(1.0 / low), round_up(high)),
    }
}

fn has_markers(plot: &Plot) -> bool {
    plot.series.iter().any(|series| series.style.has_markers())
}

/// Tick spacing for counts over such a span: 1, 2, 5, 10 …, about eight ticks.
pub(super) fn step(span: f64) -> f64 {
    match span > 8.0 {
        true => round_up(span / 8.0),
        false => 1.0,
    }
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

    #[test]
    fn what_is_counted_has_whole_ticks() {
        let steps = [0.0, 1.0, 7.9, 9.0, 14.0, 30.0, 300.0].map(step);
        assert_eq!(steps, [1.0, 1.0, 1.0, 2.0, 2.0, 5.0, 50.0]);
    }

    #[test]
    fn no_span_is_empty() {
        let plot = Plot::default();
        for (low, high) in [(0.0, 0.0), (-2.0, -2.0), (3.0, 3.0)] {
            let (low, high) = around(&plot, Axis::Linear, low, high);
            assert!(low < high);
        }
        assert_eq!((x(&plot), y(&plot)), ((0.0, 1.0), Some((0.0, 1.0))));
    }
}
