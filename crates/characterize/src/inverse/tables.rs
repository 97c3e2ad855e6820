//! Forces under a bonded punch that need no run, found by `tables::…` (the tests that make them again).

use palpate_mechanics::IndentationCurve;

use super::body::Body;
use super::curves::UnitCurve;
use super::law::CandidateLaw;

/// Shapes C₀₁/(C₁₀ + C₀₁) of the columns [-]; the first is neo-Hookean.
pub const SHAPES: [f64; 6] = [0.0, 0.1, 0.25, 0.5, 0.75, 0.9];

/// Depth [radii]; force of neo-Hookean tissue, over C₁₀ a² [-], extrapolated to elements of no size from the
/// coarsest mesh and the one with every element halved; force over (C₁₀ + C₀₁) a² for each of [`SHAPES`] on
/// the coarsest mesh.
pub const PUNCH: [(f64, f64, [f64; 6]); 19] = [
    (0.1, 1.586, [1.589, 1.591, 1.595, 1.601, 1.607, 1.611]),
    (0.25, 3.915, [3.912, 3.928, 3.952, 3.990, 4.028, 4.050]),
    (0.5, 7.750, [7.739, 7.803, 7.896, 8.044, 8.185, 8.266]),
    (
        0.75,
        11.443,
        [11.506, 11.650, 11.858, 12.187, 12.496, 12.673],
    ),
    (
        1.0,
        15.176,
        [15.176, 15.433, 15.801, 16.372, 16.910, 17.217],
    ),
    (
        1.5,
        22.478,
        [22.569, 23.156, 23.977, 25.226, 26.366, 27.006],
    ),
    (
        2.0,
        29.829,
        [30.033, 31.095, 32.543, 34.687, 36.599, 37.662],
    ),
    (
        2.5,
        37.438,
        [37.633, 39.322, 41.553, 44.781, 47.623, 49.183],
    ),
    (
        3.0,
        45.230,
        [45.491, 47.976, 51.148, 55.611, 59.461, 61.564],
    ),
    (
        3.5,
        53.200,
        [53.703, 57.177, 61.415, 67.263, 72.259, 74.934],
    ),
    (
        4.0,
        61.644,
        [62.299, 66.974, 72.430, 79.742, 85.890, 89.027],
    ),
    (
        4.5,
        70.505,
        [71.365, 77.341, 84.165, 93.157, 100.621, 104.290],
    ),
    (
        5.0,
        79.719,
        [80.718, 88.355, 96.555, 107.285, 116.166, 120.384],
    ),
    (
        5.5,
        89.185,
        [90.711, 100.289, 109.901, 122.326, 132.636, 137.429],
    ),
    (
        6.0,
        99.889,
        [100.526, 112.629, 123.877, 138.178, 150.061, 155.556],
    ),
    (
        6.5,
        110.128,
        [111.370, 125.539, 138.606, 154.820, 168.137, 174.322],
    ),
    (
        7.0,
        121.021,
        [123.012, 139.201, 154.060, 172.265, 186.239, 193.961],
    ),
    (
        7.5,
        132.636,
        [134.945, 152.931, 170.463, 190.855, 205.563, 214.430],
    ),
    (
        8.0,
        144.105,
        [146.873, 167.722, 187.354, 210.168, 226.475, 236.039],
    ),
];

/// How much too stiff the coarsest mesh is per radius of depth [-], at the shapes of the columns: the trend relative to meshes
/// with every element halved, extrapolated (`tables::the_columns_are_too_stiff_by_their_trends`; the last is that of
/// the one before).
const TOO_STIFF: [f64; SHAPES.len()] = [0.0022, 0.0014, 0.0015, 0.0012, 0.0012, 0.0012];
/// The same for other laws: the middle of the columns.
const TOO_STIFF_OTHERS: f64 = 0.0017;
/// Remaining error of that [-], taken as a bound: about the trends 0.2 % in the mean, 0.4 % in the second column.
const LEFT: f64 = 0.005;

/// Whether the first curve of `law` on `body`, down to `deepest` [m], needs no run of finite elements.
pub(crate) fn has_curve(body: &Body, law: CandidateLaw, deepest: f64) -> bool {
    curve(body, law, &law.start(), deepest).is_some()
}

/// The tabulated curve of `law` in `body` down to `deepest` [m]; none where there is none.
pub(super) fn curve(
    body: &Body,
    law: CandidateLaw,
    shape: &[f64],
    deepest: f64,
) -> Option<UnitCurve> {
    let radius = body.radius();
    let last = PUNCH[PUNCH.len() - 1].0;
    if !body.is_tabulated() || deepest > last * radius {
        return None;
    }
    let depths: Vec<f64> = PUNCH.iter().map(|row| row.0 * radius).collect();
    let through = |values: Vec<f64>| {
        let forces: Vec<f64> = values.iter().map(|value| value * radius * radius).collect();
        IndentationCurve::through(&depths, &forces)
    };
    let (force, by_shape) = match (law, shape) {
        (CandidateLaw::NeoHookean, []) => {
            let force = PUNCH.iter().map(|row| row.1);
            (through(force.collect()), Vec::new())
        }
        (CandidateLaw::MooneyRivlin, &[shape]) => {
            let of = |row: &(f64, f64, [f64; SHAPES.len()])| {
                let right = |place: usize| row.2[place] * (1.0 - TOO_STIFF[place] * row.0);
                between(&std::array::from_fn(right), shape)
            };
            let (forces, slopes) = PUNCH.iter().map(of).unzip();
            (through(forces), vec![through(slopes)])
        }
        _ => return None,
    };
    Some(UnitCurve {
        shape: shape.to_vec(),
        force,
        by_shape,
        discretisation: LEFT,
        base: None,
    })
}

/// By what a force on the coarsest mesh at `depth` [m] under a punch on a large piece has to be multiplied [-].
pub(super) fn correction(body: &Body, depth: f64) -> f64 {
    1.0 - TOO_STIFF_OTHERS * depth / body.radius()
}

/// Remaining error on the coarsest mesh after that [-].
pub(super) const fn discretisation() -> f64 {
    LEFT
}

/// The curve through `values` at the shapes w of [`SHAPES`], even in ln(1 + 2w), and its slope in w: force rises steeply
/// from no C₀₁ and then evenly. A polynomial would waver at the ends, where a fit could end.
fn between(values: &[f64; SHAPES.len()], shape: f64) -> (f64, f64) {
    let even = |shape: f64| (1.0 + 2.0 * shape).ln();
    let rises: Vec<f64> = values[1..].iter().map(|value| value - values[0]).collect();
    let curve = IndentationCurve::through(
        &SHAPES[1..].iter().copied().map(even).collect::<Vec<_>>(),
        &rises,
    );
    let at = even(shape);
    (
        values[0] + curve.force(at),
        curve.stiffness(at) * 2.0 / (1.0 + 2.0 * shape),
    )
}
