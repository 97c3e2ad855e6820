//! Line plots, as PNG pictures and as SVG for pages.

mod drawing;
mod span;
mod svg;
mod svg_corrections;

use std::path::Path;

use palpate_files::printable;

pub(crate) use palpate_jobs::plot::{Axis, Band, Plot, Series, Shade, Style, thinned_indices};

use crate::failure::Failure;

/// How a plot is drawn.
pub(crate) trait Draw {
    /// The picture, 1200 by 800 pixels.
    fn png(&self) -> Result<Vec<u8>, Failure>;

    /// The picture for a page, 560 units wide, in the page's own colors: `--series-0` to `--series-5`, `--ink`,
    /// `--muted`, `--pale`, `--grid`. Its title is left to the page.
    fn svg(&self) -> String;

    /// Writes the picture to `path`.
    fn write(&self, path: &Path) -> Result<(), Failure> {
        Ok(palpate_files::write_atomically(path, &self.png()?)?)
    }
}

impl Draw for Plot {
    fn png(&self) -> Result<Vec<u8>, Failure> {
        drawing::png(&printable_plot(self)).map_err(|cause| {
            let title = &self.title;
            Failure::failed(format!(
                "the plot `{title}` cannot be drawn ({cause}); please report this"
            ))
        })
    }

    fn svg(&self) -> String {
        svg::svg(&printable_plot(self))
    }
}

/// The plot with texts that can be shown.
fn printable_plot(plot: &Plot) -> Plot {
    let mut plot = plot.clone();
    let names = plot.series.iter_mut().map(|series| &mut series.name);
    let titles = [&mut plot.title, &mut plot.x_label, &mut plot.y_label];
    for text in names.chain(titles) {
        *text = printable(text).into_owned();
    }
    plot
}

/// Writes a picture of two plots side by side to `path`, 1792 by 640 pixels.
pub(crate) fn write_pair(plots: [&Plot; 2], path: &Path) -> Result<(), Failure> {
    let printable = plots.map(printable_plot);
    let png = drawing::png_of_two(printable.each_ref()).map_err(|cause| {
        let title = &plots[0].title;
        Failure::failed(format!(
            "the plots of `{title}` cannot be drawn ({cause}); please report this"
        ))
    })?;
    Ok(palpate_files::write_atomically(path, &png)?)
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
