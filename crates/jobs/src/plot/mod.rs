//! Plots of an answer, as plain data; the caller draws them.

mod thinned;

use serde::Serialize;

pub use thinned::thinned_indices;

/// A plot.
#[derive(Debug, Serialize, Clone, Default)]
pub struct Plot {
    /// The title.
    pub title: String,
    /// Label of the x axis, with its unit in brackets.
    pub x_label: String,
    /// Label of the y axis, with its unit in brackets.
    pub y_label: String,
    /// Scale of the x axis.
    pub x_axis: Axis,
    /// Scale of the y axis.
    pub y_axis: Axis,
    /// In the order of the legend; a single one needs no name.
    pub series: Vec<Series>,
    /// Behind the series.
    pub bands: Vec<Band>,
    /// Behind everything.
    pub shades: Vec<Shade>,
}

/// The area between two curves.
#[derive(Debug, Serialize, Clone)]
pub struct Band {
    /// x, and the lower and the upper y; what is not finite is left out.
    pub points: Vec<(f64, [f64; 2])>,
    /// As of a series.
    pub color: usize,
}

/// A part of the x axis.
#[derive(Debug, Serialize, Clone)]
pub struct Shade {
    /// From where to where.
    pub span: [f64; 2],
    /// As of a series.
    pub color: usize,
}

/// The scale of an axis.
#[derive(Debug, Serialize, Clone, Copy, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Evenly.
    #[default]
    Linear,
    /// By whole numbers, for counts.
    Counted,
    /// By decades; values that are not positive are left out.
    Logarithmic,
}

/// Points that belong together.
#[derive(Debug, Serialize, Clone)]
pub struct Series {
    /// In the legend; one without a name is not in it.
    pub name: String,
    /// x and y; what is not finite is left out.
    pub points: Vec<(f64, f64)>,
    /// How they are drawn.
    pub style: Style,
    /// Which of the six colors, counted from zero and beginning again after the last; series that
    /// belong together may have the same one.
    pub color: usize,
}

/// How the points of a series are drawn.
#[derive(Debug, Serialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Style {
    /// A solid line.
    Line,
    /// For noisy data.
    FineLine,
    /// For data under other lines; it has no color of its own.
    BroadLine,
    /// A broken line.
    DashedLine,
    /// A line of points.
    DottedLine,
    /// The points alone.
    Dots,
    /// A line, and the points on it.
    LineWithDots,
    /// A broken line, and squares on it.
    DashedLineWithSquares,
}

impl Series {
    /// `points` under a `name`.
    pub fn new(
        name: impl Into<String>,
        points: Vec<(f64, f64)>,
        style: Style,
        color: usize,
    ) -> Self {
        Self {
            name: name.into(),
            points,
            style,
            color,
        }
    }

    /// The points that the axes of `plot` can show.
    pub fn drawable(&self, plot: &Plot) -> Vec<(f64, f64)> {
        let both = |(x, y): &(f64, f64)| plot.x_axis.shows(*x) && plot.y_axis.shows(*y);
        self.points.iter().copied().filter(both).collect()
    }
}

impl Band {
    /// The points that the axes of `plot` can show.
    pub fn drawable(&self, plot: &Plot) -> Vec<(f64, [f64; 2])> {
        let all = |(x, y): &(f64, [f64; 2])| {
            plot.x_axis.shows(*x) && y.iter().all(|y| plot.y_axis.shows(*y))
        };
        self.points.iter().copied().filter(all).collect()
    }
}

impl Axis {
    /// Whether the scale can show a value.
    pub fn shows(self, value: f64) -> bool {
        value.is_finite() && (self != Self::Logarithmic || value > 0.0)
    }
}

impl Style {
    /// Whether its points are marked.
    pub fn has_markers(self) -> bool {
        matches!(
            self,
            Self::Dots | Self::LineWithDots | Self::DashedLineWithSquares
        )
    }
}
