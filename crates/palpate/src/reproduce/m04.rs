//! M4, local enhancement: the interpolation functions of section 4.3 in one dimension.
//!
//! Shepard's functions are φ_i = w_i / Σ w; moving least squares with the basis {1, x} correct them to
//! reproduce a line: φ_i = w_i (m₂ − m₁ d_i) / (m₀ m₂ − m₁²), d_i = x_i − x, m_k = Σ w_i d_iᵏ.

use palpate_mechanics::finite_spheres::quartic;

use super::row::Value;
use super::{Item, Rows};
use crate::failure::Failure;
use crate::plot::{Plot, Series, Style};

pub(crate) const FIGURE_4_5: Item = Item {
    name: "figure-4-5",
    title: "interpolation functions in one dimension",
    run,
};

/// Radii of influence in spacings of the nodes [h].
const RADII: [f64; 2] = [1.5, 3.0];

/// Values at the nodes 0, 1, 2 … for the curves; any will do, the source prints none.
const NODAL: [f64; 11] = [0.2, 0.5, 0.3, 0.9, 1.0, 0.4, 0.6, 0.1, 0.0, 0.5, 0.7];

/// Points of a curve.
const SAMPLES: usize = 1000;

/// The node in the middle.
const MIDDLE: usize = 5;

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

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    for (method, name, _) in METHODS {
        for radius in RADII {
            let sums = samples().map(|x| functions(method, radius, x).iter().sum::<f64>());
            let error = sums.map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max);
            let row = format!("partition_of_unity_error/{name}/radius_{radius}_h");
            rows.add(
                &row,
                own(error),
                "largest |sum of all functions - 1| over the nodes' range",
            );
        }
    }
    for (method, name, _) in METHODS {
        for radius in RADII {
            let values = samples().map(|x| functions(method, radius, x)[MIDDLE]);
            let row = format!("peak/{name}/radius_{radius}_h");
            let note =
                "largest value of the function of the node in the middle; 1 would interpolate";
            rows.add(&row, own(values.fold(0.0, f64::max)), note);
        }
    }
    let note =
        "equally spaced nodes with arbitrary values; the curves of the source carry no numbers";
    rows.add_figure(None, &plot_of_curves(), note)?;
    let note = "functions of the node in the middle; at equal spacing both methods are close there, \
        and differ towards the ends, where Shepard's do not reproduce a line";
    rows.add_figure(Some("functions"), &plot_of_functions(), note)
}

fn own(ours: f64) -> Value {
    Value {
        published: None,
        ours: Some(ours),
        unit: "1",
    }
}

/// The functions of all nodes at `x` [h], for the `radius` of influence [h].
fn functions(method: Method, radius: f64, x: f64) -> [f64; NODAL.len()] {
    let away: [f64; NODAL.len()] = std::array::from_fn(|node| node as f64 - x);
    let weights = away.map(|d| quartic(d.abs() / radius));
    let moment = |power: i32| -> f64 {
        let terms = away.iter().zip(&weights).map(|(d, w)| w * d.powi(power));
        terms.sum()
    };
    let [m0, m1, m2] = [0, 1, 2].map(moment);
    std::array::from_fn(|node| match method {
        Method::Shepard => weights[node] / m0,
        Method::MovingLeastSquares => weights[node] * (m2 - m1 * away[node]) / (m0 * m2 - m1 * m1),
    })
}

fn samples() -> impl Iterator<Item = f64> {
    let last = (NODAL.len() - 1) as f64;
    (0..=SAMPLES).map(move |sample| last * sample as f64 / SAMPLES as f64)
}

fn curve(value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    samples().map(|x| (x, value(x))).collect()
}

fn plot_of_curves() -> Plot {
    let nodes = NODAL
        .iter()
        .enumerate()
        .map(|(node, value)| (node as f64, *value));
    let mut series = vec![Series {
        name: "nodes".to_owned(),
        points: nodes.collect(),
        style: Style::Dots,
        color: 5,
    }];
    for (color, radius) in RADII.into_iter().enumerate() {
        for (method, _, name) in METHODS {
            let value = |x| -> f64 {
                let functions = functions(method, radius, x);
                functions
                    .iter()
                    .zip(&NODAL)
                    .map(|(f, value)| f * value)
                    .sum()
            };
            series.push(Series {
                name: format!("{name}, r = {radius} h"),
                points: curve(value),
                style: style(method),
                color,
            });
        }
    }
    Plot {
        title: "Curves through nodal values in one dimension".to_owned(),
        x_label: "position x [h]".to_owned(),
        y_label: "value [-]".to_owned(),
        series,
        ..Plot::default()
    }
}

fn plot_of_functions() -> Plot {
    let mut series = Vec::new();
    for (color, radius) in RADII.into_iter().enumerate() {
        for (method, _, name) in METHODS {
            series.push(Series {
                name: format!("{name}, r = {radius} h"),
                points: curve(|x| functions(method, radius, x)[MIDDLE]),
                style: style(method),
                color,
            });
        }
        series.push(Series {
            name: format!("quartic weight, r = {radius} h"),
            points: curve(|x| quartic((MIDDLE as f64 - x).abs() / radius)),
            style: Style::DottedLine,
            color,
        });
    }
    Plot {
        title: "Weight and interpolation functions of a node".to_owned(),
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
