//! M4, local enhancement (`palpate_mechanics::enhance`): the interpolation functions of section 4.3 in one
//! dimension, as the library makes them of the weights, and a cube that it makes finer and smooths.

mod figure_4_4;
mod figure_4_6;
mod plots;

pub(super) use figure_4_4::FIGURE_4_4;
pub(super) use figure_4_6::FIGURE_4_6;

use nalgebra::Vector2;
use palpate_mechanics::enhance::{moving_least_squares, shepard};
use palpate_mechanics::finite_spheres::quartic;

use crate::Error;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const FIGURE_4_5: Item = Item {
    name: "figure-4-5",
    title: "interpolation functions in one dimension",
    seconds: 0.41,
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

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
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
    rows.add_figure(None, &plots::of_curves(), note)?;
    let note = "functions of the node beside the end; between equally spaced nodes away from the ends \
        both methods are nearly the same, at the ends Shepard's do not reproduce a line";
    rows.add_figure(Some("functions"), &plots::of_functions(), note)
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
