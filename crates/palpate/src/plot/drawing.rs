//! Converts a plot to the drawing crate's form.

use std::sync::Arc;

use kuva::backend::png::PngBackend;
use kuva::plot::{BandPlot, LegendPosition, LinePlot, LineStyle, MarkerShape, ScatterPlot};
use kuva::render::annotations::ShadedRegion;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot as Drawn;
use kuva::render::render::{Primitive, Scene, render_multiple};
use kuva::{Theme, TickAlign, TickFormat};

use super::svg_corrections::{self, SIZE};
use super::{Axis, Band, Plot, Series, Shade, Style, span};

/// Pixels of the picture per unit of the layout.
const PIXELS: f32 = 1.6;

/// What stays free at the right and below, in units of the layout.
const MARGIN: f64 = 16.0;

/// Colors that everybody can tell apart, in grey as well [Okabe and Ito 2008].
const COLORS: [&str; 6] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000",
];

/// How a picture looks, whatever is drawn.
pub(super) struct Look {
    /// Width and height, in units of the layout.
    pub(super) size: [f64; 2],
    /// Of titles, names of axes, and numbers, in units of the layout.
    pub(super) letters: [u32; 3],
    /// Of the dots.
    pub(super) dots: f64,
    pub(super) theme: Theme,
    /// Of series, bands and shades.
    pub(super) colors: [&'static str; 6],
    /// Of broad lines.
    pub(super) pale: &'static str,
}

/// The size of each of two plots side by side.
const HALF: [f64; 2] = [560.0, 400.0];

/// How a picture of a `size` looks.
fn printed(size: [f64; 2]) -> Look {
    Look {
        size,
        letters: [18, 14, 13],
        dots: 4.0,
        theme: Theme::light(),
        colors: COLORS,
        pale: "#BBBBBB",
    }
}

/// The picture of `plot`.
pub(super) fn png(plot: &Plot) -> Result<Vec<u8>, String> {
    let mut scene = scene(plot, &printed(SIZE));
    svg_corrections::dash(&mut scene);
    PngBackend::new().with_scale(PIXELS).render_scene(&scene)
}

/// The picture of two plots side by side.
pub(super) fn png_of_two([left, right]: [&Plot; 2]) -> Result<Vec<u8>, String> {
    let look = printed(HALF);
    let mut both = scene(left, &look);
    both.width += look.size[0];
    both.elements.push(Primitive::GroupStart {
        transform: Some(format!("translate({},0)", look.size[0])),
        title: None,
        extra_attrs: None,
    });
    both.elements.extend(scene(right, &look).elements);
    both.elements.push(Primitive::GroupEnd);
    svg_corrections::dash(&mut both);
    PngBackend::new().with_scale(PIXELS).render_scene(&both)
}

/// The drawing of `plot`, all of whose height is used.
pub(super) fn scene(plot: &Plot, look: &Look) -> Scene {
    let [width, height] = look.size;
    // The number of lines of the legend is known only after drawing, so it is drawn twice.
    let unused = height - MARGIN - lowest(&drawn(plot, look, height));
    let mut scene = drawn(plot, look, height + unused);
    (scene.width, scene.height) = (width, height);
    svg_corrections::titles(&mut scene, plot);
    scene
}

fn drawn(plot: &Plot, look: &Look, height: f64) -> Scene {
    let bands = plot.bands.iter().map(|band| fill(plot, band, look));
    let series = plot.series.iter();
    let series = series.flat_map(|series| draw(plot, series, look));
    let drawn: Vec<Drawn> = bands.chain(series).collect();
    let layout = layout(plot, &drawn, look);
    let layout = layout.with_width(look.size[0] - MARGIN).with_height(height);
    render_multiple(drawn, layout)
}

/// Position of the lowest text.
fn lowest(scene: &Scene) -> f64 {
    let heights = scene.elements.iter().map(|element| match element {
        Primitive::Text { y, .. } => *y,
        _ => 0.0,
    });
    heights.fold(0.0, f64::max)
}

fn layout(plot: &Plot, drawn: &[Drawn], look: &Look) -> Layout {
    let [title, label, number] = look.letters;
    let mut layout = Layout::auto_from_plots(drawn)
        .with_theme(look.theme.clone())
        .with_title(&*plot.title)
        // A word that stands upright is hard to read; see `retouch`.
        .with_subtitle(&*plot.y_label)
        .with_x_label(&*plot.x_label)
        .with_title_size(title)
        .with_subtitle_size(label)
        .with_label_size(label)
        .with_tick_size(number)
        .with_body_size(number)
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
    if plot.x_axis == Axis::Counted {
        layout = layout.with_x_tick_step(span::step(high - low));
    }
    for shade in &plot.shades {
        layout = shaded(layout, shade, look);
    }
    if let Some((low, high)) = span::y(plot) {
        layout.y_range = (low, high);
        layout = layout.with_y_axis_min(low).with_y_axis_max(high);
        if plot.y_axis == Axis::Counted {
            layout = layout.with_y_tick_step(span::step(high - low));
        }
    }
    layout
}

fn shaded(layout: Layout, shade: &Shade, look: &Look) -> Layout {
    let [from, to] = shade.span;
    let color = look.colors[shade.color % look.colors.len()];
    let region = ShadedRegion::vertical(from, to);
    layout.with_shaded_region(region.with_color(color).with_opacity(0.12))
}

fn fill(plot: &Plot, band: &Band, look: &Look) -> Drawn {
    let points = band.drawable(plot);
    let of = |y: fn(&[f64; 2]) -> f64| points.iter().map(|(_, both)| y(both)).collect::<Vec<_>>();
    let x: Vec<f64> = points.iter().map(|(x, _)| *x).collect();
    BandPlot::new(x, of(|y| y[0]), of(|y| y[1]))
        .with_color(look.colors[band.color % look.colors.len()])
        .with_opacity(0.25)
        .into()
}

fn draw(plot: &Plot, series: &Series, look: &Look) -> Vec<Drawn> {
    let color = look.colors[series.color % look.colors.len()];
    let points = series.drawable(plot);
    let mut line = LinePlot::new().with_data(points.clone()).with_color(color);
    let mut dots = ScatterPlot::new()
        .with_data(points)
        .with_color(color)
        .with_size(look.dots);
    let is_named = plot.series.len() > 1 && !series.name.is_empty();
    match series.style {
        Style::FineLine => line.stroke_width = 1.0,
        Style::BroadLine => {
            line.stroke_width = 5.0;
            line = line.with_color(look.pale);
        }
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
