//! Line plots, as PNG pictures and as SVG for pages.

mod drawing;
mod retouch;
mod span;
mod svg;
mod thinned;

use std::path::Path;

pub(crate) use thinned::kept;

use crate::failure::Failure;

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
    /// In the order of the legend; a single one needs no name.
    pub(crate) series: Vec<Series>,
    /// Behind the series.
    pub(crate) bands: Vec<Band>,
    /// Behind everything.
    pub(crate) shades: Vec<Shade>,
}

/// What lies between two curves.
#[derive(Debug, Clone)]
pub(crate) struct Band {
    /// x, and the lower and the upper y; what is not finite is left out.
    pub(crate) points: Vec<(f64, [f64; 2])>,
    /// As of a series.
    pub(crate) color: usize,
}

/// A part of the x axis.
#[derive(Debug, Clone)]
pub(crate) struct Shade {
    /// From where to where.
    pub(crate) span: [f64; 2],
    /// As of a series.
    pub(crate) color: usize,
}

/// How an axis divides.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Axis {
    #[default]
    Linear,
    /// By whole numbers, for what is counted.
    Counted,
    /// By decades; values that are not positive are left out.
    Logarithmic,
}

/// Points that belong together.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// In the legend; one without a name is not in it.
    pub(crate) name: String,
    /// x and y; what is not finite is left out.
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) style: Style,
    /// Which of the six colors, counted from zero and beginning again after the last; series that
    /// belong together may have the same one.
    pub(crate) color: usize,
}

/// How the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    Line,
    /// Of what trembles.
    FineLine,
    /// Of what others lie on; it has no color of its own.
    BroadLine,
    DashedLine,
    DottedLine,
    Dots,
    LineWithDots,
    DashedLineWithSquares,
}

impl Plot {
    /// The picture, 1200 by 800 pixels.
    pub(crate) fn png(&self) -> Result<Vec<u8>, Failure> {
        drawing::png(self).map_err(|cause| {
            let title = &self.title;
            Failure::failed(format!(
                "the plot `{title}` cannot be drawn ({cause}); please report this"
            ))
        })
    }

    /// The picture for a page, 560 units wide, in the page's own colors: `--series-0` to `--series-5`, `--ink`,
    /// `--muted`, `--pale`, `--grid`. Its title is left to the page.
    pub(crate) fn svg(&self) -> String {
        svg::svg(self)
    }

    /// Writes the picture to `path`.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        Ok(palpate_files::write_whole(path, &self.png()?)?)
    }
}

/// Writes a picture of two plots beside one another to `path`, 1792 by 640 pixels.
pub(crate) fn write_pair(plots: [&Plot; 2], path: &Path) -> Result<(), Failure> {
    let png = drawing::png_of_two(plots).map_err(|cause| {
        let title = &plots[0].title;
        Failure::failed(format!(
            "the plots beside `{title}` cannot be drawn ({cause}); please report this"
        ))
    })?;
    Ok(palpate_files::write_whole(path, &png)?)
}

impl Series {
    pub(crate) fn new(
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
    fn drawable(&self, plot: &Plot) -> Vec<(f64, f64)> {
        let both = |(x, y): &(f64, f64)| plot.x_axis.shows(*x) && plot.y_axis.shows(*y);
        self.points.iter().copied().filter(both).collect()
    }
}

impl Band {
    /// The points that the axes of `plot` can show.
    fn drawable(&self, plot: &Plot) -> Vec<(f64, [f64; 2])> {
        let all = |(x, y): &(f64, [f64; 2])| {
            plot.x_axis.shows(*x) && y.iter().all(|y| plot.y_axis.shows(*y))
        };
        self.points.iter().copied().filter(all).collect()
    }
}

impl Axis {
    fn shows(self, value: f64) -> bool {
        value.is_finite() && (self != Self::Logarithmic || value > 0.0)
    }
}

impl Style {
    fn has_markers(self) -> bool {
        matches!(
            self,
            Self::Dots | Self::LineWithDots | Self::DashedLineWithSquares
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: Vec<(f64, f64)>) -> Plot {
        Plot {
            title: "Force against depth".to_owned(),
            x_label: "depth [mm]".to_owned(),
            y_label: "force [N]".to_owned(),
            y_axis: Axis::Logarithmic,
            series: vec![Series {
                name: "liver".to_owned(),
                points,
                style: Style::DashedLineWithSquares,
                color: 7,
            }],
            ..Plot::default()
        }
    }

    #[test]
    fn a_plot_is_a_png_of_the_promised_size() {
        let png = plot(vec![(0.0, 0.0), (1.0, 0.1), (2.0, 0.4), (3.0, f64::NAN)]).png();
        let png = png.unwrap();
        assert!(png.starts_with(b"\x89PNG"));
        let sides = [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()));
        assert_eq!(sides, [1200, 800]);
    }

    /// An organ that was not touched has a force of zero all along.
    #[test]
    fn a_plot_of_nothing_or_of_a_constant_is_still_drawn() {
        for y_axis in [Axis::Linear, Axis::Counted, Axis::Logarithmic] {
            for points in [vec![], vec![(1.0, 0.1)], vec![(0.0, 0.0), (1.0, 0.0)]] {
                for style in [Style::Line, Style::Dots] {
                    let mut plot = plot(points.clone());
                    plot.y_axis = y_axis;
                    plot.series[0].style = style;
                    assert!(plot.png().is_ok());
                }
            }
        }
        assert!(Plot::default().png().is_ok());
    }
}
