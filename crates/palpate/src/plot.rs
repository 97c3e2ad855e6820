//! Line plots as PNG pictures.

use std::path::Path;

use kuva::plot::{LegendPosition, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot as Drawn;
use kuva::{TickFormat, render_to_png};
use std::sync::Arc;

use crate::failure::Failure;

/// Pixels of a picture per unit of its layout.
const PIXELS: f32 = 1.6;

/// Width and height of the layout; the picture is about 1200 by 800.
const SIZE: [f64; 2] = [640.0, 400.0];

/// Colors that are told apart by everybody, also in grey [Okabe and Ito 2008].
const COLORS: [&str; 6] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000",
];

/// What is drawn.
#[derive(Debug, Clone, Default)]
pub(crate) struct Plot {
    pub(crate) title: String,
    /// With its unit in brackets.
    pub(crate) x_label: String,
    /// With its unit in brackets.
    pub(crate) y_label: String,
    pub(crate) x_axis: Axis,
    pub(crate) y_axis: Axis,
    /// In the order of the legend.
    pub(crate) series: Vec<Series>,
}

/// How an axis divides.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Axis {
    #[default]
    Linear,
    /// By decades; values that are not positive are left out.
    Logarithmic,
}

/// Points that belong together.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// In the legend.
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) style: Style,
    /// Which of the colors, counted from zero and beginning again after the last; series that belong
    /// together may have the same one.
    pub(crate) color: usize,
}

/// How the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    Line,
    DashedLine,
    DottedLine,
    Dots,
    LineWithDots,
    DashedLineWithDots,
}

impl Plot {
    /// The picture.
    pub(crate) fn png(&self) -> Result<Vec<u8>, Failure> {
        let drawn: Vec<Drawn> = self.series.iter().flat_map(|s| self.draw(s)).collect();
        let layout = self.layout(&drawn);
        render_to_png(drawn, layout, PIXELS).map_err(|cause| {
            Failure::failed(format!(
                "the plot `{}` cannot be drawn ({cause}); please report this",
                self.title
            ))
        })
    }

    /// Writes the picture to `path`.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        Ok(palpate_files::write_whole(path, &self.png()?)?)
    }

    fn layout(&self, drawn: &[Drawn]) -> Layout {
        let mut layout = Layout::auto_from_plots(drawn)
            .with_width(SIZE[0])
            .with_height(SIZE[1])
            .with_title(&*self.title)
            .with_x_label(&*self.x_label)
            .with_y_label(&*self.y_label)
            .with_title_size(17)
            .with_label_size(14)
            .with_tick_size(12)
            .with_body_size(12)
            .with_box_axes()
            .with_legend_position(LegendPosition::OutsideRightTop);
        if self.x_axis == Axis::Logarithmic {
            layout = layout.with_log_x().with_x_tick_format(plain());
        }
        if self.y_axis == Axis::Logarithmic {
            layout = layout.with_log_y().with_y_tick_format(plain());
        }
        layout
    }

    fn draw(&self, series: &Series) -> Vec<Drawn> {
        let color = COLORS[series.color % COLORS.len()];
        let points: Vec<(f64, f64)> = self.drawable(&series.points);
        let line = LinePlot::new().with_data(points.clone()).with_color(color);
        let dots = ScatterPlot::new()
            .with_data(points)
            .with_color(color)
            .with_size(3.5);
        let named = series.name.clone();
        match series.style {
            Style::Line => vec![line.with_legend(named).into()],
            Style::DashedLine => vec![line.with_dashed().with_legend(named).into()],
            Style::DottedLine => vec![line.with_dotted().with_legend(named).into()],
            Style::Dots => vec![dots.with_legend(named).into()],
            Style::LineWithDots => vec![line.with_legend(named).into(), dots.into()],
            Style::DashedLineWithDots => {
                let dots = dots.with_marker(MarkerShape::Square);
                vec![line.with_dashed().with_legend(named).into(), dots.into()]
            }
        }
    }

    /// The points that the axes can show.
    fn drawable(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let shows =
            |axis: Axis, value: f64| value.is_finite() && (axis == Axis::Linear || value > 0.0);
        let both = points
            .iter()
            .filter(|(x, y)| shows(self.x_axis, *x) && shows(self.y_axis, *y));
        both.copied().collect()
    }
}

/// Ticks as plain numbers.
fn plain() -> TickFormat {
    TickFormat::Custom(Arc::new(|value| format!("{value}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_is_a_png_also_when_a_logarithm_cannot_show_a_point() {
        let plot = Plot {
            title: "Force against depth".to_owned(),
            y_axis: Axis::Logarithmic,
            series: vec![Series {
                name: "liver".to_owned(),
                points: vec![(0.0, 0.0), (1.0, 0.1), (2.0, 0.4), (3.0, f64::NAN)],
                style: Style::LineWithDots,
                color: 7,
            }],
            ..Plot::default()
        };
        assert!(plot.png().unwrap().starts_with(b"\x89PNG"));
    }
}
