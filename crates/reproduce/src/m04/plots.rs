use palpate_mechanics::finite_spheres::quartic;

use super::{METHODS, Method, NODAL, RADII, functions, samples};
use palpate_jobs::plot::{Plot, Series, Style};

/// The node beside the end, where the methods differ.
const SECOND: usize = 1;

fn curve(value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    samples().map(|x| (x, value(x))).collect()
}

/// Curves through the nodal values.
pub(super) fn of_curves() -> Plot {
    let mut series = Vec::new();
    for (method, _, name) in METHODS {
        for (color, radius) in RADII.into_iter().enumerate() {
            let value = |x| -> f64 {
                let functions = functions(method, radius, x);
                let terms = functions.iter().zip(&NODAL).map(|(f, value)| f * value);
                terms.sum()
            };
            series.push(Series {
                name: format!("{name}, r = {radius} h"),
                points: curve(value),
                style: style(method),
                color,
            });
        }
    }
    let nodes = NODAL.iter().enumerate();
    series.push(Series {
        name: "nodes".to_owned(),
        points: nodes.map(|(node, value)| (node as f64, *value)).collect(),
        style: Style::Dots,
        color: 5,
    });
    Plot {
        title: "Curves through nodal values in one dimension".to_owned(),
        x_label: "position x [h]".to_owned(),
        y_label: "value [-]".to_owned(),
        series,
        ..Plot::default()
    }
}

/// The functions of a node beside the end, with the weight they are made of.
pub(super) fn of_functions() -> Plot {
    // Beyond, all of them vanish.
    let near = |mut points: Vec<(f64, f64)>| {
        points.retain(|(x, _)| *x <= SECOND as f64 + RADII[1]);
        points
    };
    let mut series = Vec::new();
    for (method, _, name) in METHODS {
        for (color, radius) in RADII.into_iter().enumerate() {
            series.push(Series {
                name: format!("{name}, r = {radius} h"),
                points: near(curve(|x| functions(method, radius, x)[SECOND])),
                style: style(method),
                color,
            });
        }
    }
    for (color, radius) in RADII.into_iter().enumerate() {
        series.push(Series {
            name: format!("quartic weight, r = {radius} h"),
            points: near(curve(|x| quartic((SECOND as f64 - x).abs() / radius))),
            style: Style::DottedLine,
            color,
        });
    }
    Plot {
        title: "Weight and interpolation functions of the second node".to_owned(),
        x_label: "position x [h]".to_owned(),
        y_label: "function [-]".to_owned(),
        series,
        ..Plot::default()
    }
}

fn style(method: Method) -> Style {
    match method {
        Method::Shepard => Style::Line,
        Method::MovingLeastSquares => Style::DashedLine,
    }
}
