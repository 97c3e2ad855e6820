use kuva::Theme;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::{Primitive, Scene};

use super::Plot;
use super::drawing::{Look, scene};

/// Width and height of the layout.
const SIZE: [f64; 2] = [560.0, 350.0];

/// Of the uppermost text, above the line it stands on.
const ABOVE: f64 = 14.0;

/// The page's colors, each with the fallback for a picture outside its page.
const COLORS: [&str; 6] = [
    "var(--series-0, #0072B2)",
    "var(--series-1, #D55E00)",
    "var(--series-2, #009E73)",
    "var(--series-3, #CC79A7)",
    "var(--series-4, #56B4E9)",
    "var(--series-5, #555555)",
];
const INK: &str = "var(--ink, #1b1f24)";
const MUTED: &str = "var(--muted, #57606a)";
const PALE: &str = "var(--pale, #c2c9d1)";
const GRID: &str = "var(--grid, #e3e6ea)";

/// The picture of `plot`, as wide as its place in a page.
pub(super) fn svg(plot: &Plot) -> String {
    let theme = Theme {
        background: "none".to_owned(),
        axis_color: MUTED.to_owned(),
        grid_color: GRID.to_owned(),
        tick_color: MUTED.to_owned(),
        text_color: INK.to_owned(),
        font_family: Some("inherit".to_owned()),
        ..Theme::light()
    };
    let look = Look {
        size: SIZE,
        letters: [15, 13, 12],
        dots: 3.0,
        theme,
        colors: COLORS,
        pale: PALE,
    };
    let untitled = Plot {
        title: String::new(),
        ..plot.clone()
    };
    let scene = scene(&untitled, &look);
    let drawn = SvgBackend::new().render_scene(&scene);
    let [width, height] = SIZE;
    let fixed = format!(r#"width="{width}" height="{height}""#);
    // The room that is left for a title is cut off.
    let top = (highest(&scene) - ABOVE).floor();
    let visible = height - top;
    let flowing = format!(r#"viewBox="0 {top} {width} {visible}" role="img""#);
    drawn.replacen(&fixed, &flowing, 1)
}

/// Where the uppermost text stands.
fn highest(scene: &Scene) -> f64 {
    let texts = scene.elements.iter().filter_map(|element| match element {
        Primitive::Text { y, content, .. } if !content.is_empty() => Some(*y),
        _ => None,
    });
    texts.fold(SIZE[1], f64::min)
}
