//! A plot as the drawing crate has it.

use std::sync::Arc;

use kuva::backend::png::PngBackend;
use kuva::plot::{LegendPosition, LinePlot, LineStyle, MarkerShape, ScatterPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot as Drawn;
use kuva::render::render::{Primitive, Scene, render_multiple};
use kuva::{TickAlign, TickFormat};

use super::retouch::{self, SIZE};
use super::{Axis, Plot, Series, Style, span};

/// Pixels of the picture per unit of the layout.
const PIXELS: f32 = 1.6;

/// What stays free at the right and below, in units of the layout.
const MARGIN: f64 = 16.0;

/// Colors that everybody can tell apart, in grey as well [Okabe and Ito 2008].
const COLORS: [&str; 6] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000",
];

/// The picture of `plot`.
pub(super) fn png(plot: &Plot) -> Result<Vec<u8>, String> {
    // How many lines the legend takes shows only in the drawing, so it is made twice.
    let unused = SIZE[1] - MARGIN - lowest(&scene(plot, SIZE[1]));
    let mut scene = scene(plot, SIZE[1] + unused);
    (scene.width, scene.height) = (SIZE[0], SIZE[1]);
    retouch::retouch(&mut scene, plot);
    PngBackend::new().with_scale(PIXELS).render_scene(&scene)
}

fn scene(plot: &Plot, height: f64) -> Scene {
    let series = plot.series.iter();
    let drawn: Vec<Drawn> = series.flat_map(|series| draw(plot, series)).collect();
    let layout = layout(plot, &drawn);
    let layout = layout.with_width(SIZE[0] - MARGIN).with_height(height);
    render_multiple(drawn, layout)
}

/// Where the lowest text stands.
fn lowest(scene: &Scene) -> f64 {
    let heights = scene.elements.iter().map(|element| match element {
        Primitive::Text { y, .. } => *y,
        _ => 0.0,
    });
    heights.fold(0.0, f64::max)
}

fn layout(plot: &Plot, drawn: &[Drawn]) -> Layout {
    let mut layout = Layout::auto_from_plots(drawn)
        .with_title(&*plot.title)
        // A word that stands upright is hard to read; see `retouch`.
        .with_subtitle(&*plot.y_label)
        .with_x_label(&*plot.x_label)
        .with_title_size(18)
        .with_subtitle_size(14)
        .with_label_size(14)
        .with_tick_size(13)
        .with_body_size(13)
        .with_tick_align(TickAlign::Outside)
        .with_legend_box(false)
        .with_legend_position(LegendPosition::OutsideBottomColumns);
    if plot.x_axis == Axis::Logarithmic {
        layout = layout.with_log_x().with_x_tick_format(plain());
    }
    if plot.y_axis == Axis::Logarithmic {
        layout = layout.with_log_y().with_y_tick_format(plain());
    }
    let (low, high) = span::x(plot);
    layout.x_range = (low, high);
    layout = layout.with_x_axis_min(low).with_x_axis_max(high);
    if let Some((low, high)) = span::y(plot) {
        layout.y_range = (low, high);
        layout = layout.with_y_axis_min(low).with_y_axis_max(high);
    }
    layout
}

fn draw(plot: &Plot, series: &Series) -> Vec<Drawn> {
    let color = COLORS[series.color % COLORS.len()];
    let points = series.drawable(plot);
    let mut line = LinePlot::new().with_data(points.clone()).with_color(color);
    let mut dots = ScatterPlot::new()
        .with_data(points)
        .with_color(color)
        .with_size(4.0);
    let is_named = plot.series.len() > 1 && !series.name.is_empty();
    match series.style {
        Style::DashedLine | Style::DashedLineWithSquares => line.line_style = LineStyle::Dashed,
        Style::DottedLine => line.line_style = LineStyle::Dotted,
        Style::Line | Style::LineWithDots | Style::Dots => {}
    }
    if series.style == Style::DashedLineWithSquares {
        dots = dots.with_marker(MarkerShape::Square);
    }
    if series.style == Style::Dots {
        let dots = if is_named {
            dots.with_legend(&*series.name)
        } else {
            dots
        };
        return vec![dots.into()];
    }
    if is_named {
        line = line.with_legend(&*series.name);
    }
    match series.style.has_markers() {
        true => vec![line.into(), dots.into()],
        false => vec![line.into()],
    }
}

/// Ticks as plain numbers.
fn plain() -> TickFormat {
    TickFormat::Custom(Arc::new(|value| {
        // The ticks are powers of ten, computed: 0.20000000000000001.
        let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
        format!("{rounded}")
    }))
}
