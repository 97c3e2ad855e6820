use nalgebra::Vector2;
use palpate_jobs::plot::{Series, Style};
use palpate_mechanics::enhance::{moving_least_squares, shepard};
use palpate_mechanics::finite_spheres::quartic;

use crate::Error;
use crate::row::Rows;

/// Radii of influence in spacings of the nodes [h].
const RADII: [f64; 2] = [1.5, 3.0];

/// Values at the nodes 0, 1, 2 … for the curves; any will do, the source prints none.
const NODAL: [f64; 11] = [0.2, 0.5, 0.3, 0.9, 1.0, 0.4, 0.6, 0.1, 0.0, 0.5, 0.7];

/// Points of a curve.
const SAMPLES: usize = 1000;

/// The node in the middle.
const MIDDLE: usize = 5;

/// The node next to the end, where the methods differ.
const SECOND: usize = 1;

/// How a function is made of the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Method {
    Shepard,
    MovingLeastSquares,
}

const METHODS: [(Method, &str, &str); 2] = [
    (Method::Shepard, "shepard", "Shepard"),
    (
        Method::MovingLeastSquares,
        "moving_least_squares",
        "moving least squares",
    ),
];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (method, name, _) in METHODS {
        for radius in RADII {
            let sums = samples().map(|x| functions(method, radius, x).iter().sum::<f64>());
            let error = sums.map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max);
            let row = format!("partition_of_unity_error/{name}/radius_{radius}_h");
            rows.add(&row, error);
        }
    }
    for (method, name, _) in METHODS {
        for radius in RADII {
            let values = samples().map(|x| functions(method, radius, x)[MIDDLE]);
            let row = format!("peak/{name}/radius_{radius}_h");
            rows.add(&row, values.fold(0.0, f64::max));
        }
    }
    rows.figure("").draw(curves())?;
    rows.figure("functions").draw(functions_of_second())
}

/// Curves through the nodal values.
fn curves() -> Vec<Series> {
    let mut series = Vec::new();
    for (method, _, name) in METHODS {
        for (color, radius) in RADII.into_iter().enumerate() {
            let value = |x| -> f64 {
                let functions = functions(method, radius, x);
                let terms = functions.iter().zip(&NODAL).map(|(f, value)| f * value);
                terms.sum()
            };
            let name = format!("{name}, r = {radius} h");
            series.push(Series::new(name, curve(value), style(method), color));
        }
    }
    let nodes = NODAL.iter().enumerate();
    let nodes = nodes.map(|(node, value)| (node as f64, *value));
    series.push(Series::new("nodes", nodes.collect(), Style::Dots, 5));
    series
}

/// The functions of a node next to the end, with the weight they are made of.
fn functions_of_second() -> Vec<Series> {
    // Beyond, all of them vanish.
    let near = |mut points: Vec<(f64, f64)>| {
        points.retain(|(x, _)| *x <= SECOND as f64 + RADII[1]);
        points
    };
    let mut series = Vec::new();
    for (method, _, name) in METHODS {
        for (color, radius) in RADII.into_iter().enumerate() {
            let name = format!("{name}, r = {radius} h");
            let points = near(curve(|x| functions(method, radius, x)[SECOND]));
            series.push(Series::new(name, points, style(method), color));
        }
    }
    for (color, radius) in RADII.into_iter().enumerate() {
        let name = format!("quartic weight, r = {radius} h");
        let points = near(curve(|x| quartic((SECOND as f64 - x).abs() / radius)));
        series.push(Series::new(name, points, Style::DottedLine, color));
    }
    series
}

fn curve(value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    samples().map(|x| (x, value(x))).collect()
}

fn style(method: Method) -> Style {
    match method {
        Method::Shepard => Style::Line,
        Method::MovingLeastSquares => Style::DashedLine,
    }
}

/// The functions of all nodes at `x` [h], for the `radius` of influence [h].
fn functions(method: Method, radius: f64, x: f64) -> [f64; NODAL.len()] {
    let away = |node: usize| node as f64 - x;
    let mut functions = std::array::from_fn(|node| quartic(away(node).abs() / radius));
    match method {
        Method::Shepard => shepard(&mut functions),
        Method::MovingLeastSquares => {
            moving_least_squares(&mut functions, |node| Vector2::new(away(node), 0.0));
        }
    }
    functions
}

/// Positions from the first node to the last [h].
fn samples() -> impl Iterator<Item = f64> {
    let last = (NODAL.len() - 1) as f64;
    (0..=SAMPLES).map(move |sample| last * sample as f64 / SAMPLES as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moving_least_squares_reproduce_a_line_also_at_the_ends() {
        for radius in RADII {
            for x in samples() {
                let functions = functions(Method::MovingLeastSquares, radius, x);
                let line: f64 = functions
                    .iter()
                    .enumerate()
                    .map(|(i, f)| i as f64 * f)
                    .sum();
                // Rounding.
                assert!((line - x).abs() < 1e-12, "{radius} {x}: {line}");
            }
        }
    }
}
