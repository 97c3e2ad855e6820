//! Rules of integration over the reference elements.

use super::QuadraturePoint;

/// Three points of Gauss along each of `dimension` axes.
pub(super) fn gauss(dimension: usize) -> Vec<QuadraturePoint> {
    let outer = 0.6_f64.sqrt();
    let line = [(-outer, 5.0 / 9.0), (0.0, 8.0 / 9.0), (outer, 5.0 / 9.0)];
    (0..3_usize.pow(dimension as u32))
        .map(|point| {
            let (mut at, mut weight) = ([0.0; 3], 1.0);
            for (d, x) in at.iter_mut().enumerate().take(dimension) {
                let (place, share) = line[point / 3_usize.pow(d as u32) % 3];
                *x = place;
                weight *= share;
            }
            QuadraturePoint { at, weight }
        })
        .collect()
}

/// Fourteen points, exact to degree five [Walkington 2000].
pub(super) fn tetrahedron() -> Vec<QuadraturePoint> {
    let mut points = Vec::with_capacity(14);
    // Four points (a, a, a, 1 − 3 a), twice, and six of (b, b, ½ − b, ½ − b).
    for (a, weight) in [
        (0.310_885_919_263_300_6, 0.112_687_925_718_015_8),
        (0.092_735_250_310_891_2, 0.073_493_043_116_361_9),
    ] {
        for one in 0..4 {
            let l: [f64; 4] = std::array::from_fn(|i| if i == one { 1.0 - 3.0 * a } else { a });
            points.push((l, weight));
        }
    }
    let b = 0.454_496_295_874_350_4;
    for [i, j] in [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] {
        let l = std::array::from_fn(|k| if k == i || k == j { b } else { 0.5 - b });
        points.push((l, 0.042_546_020_777_081_5));
    }
    points
        .into_iter()
        .map(|([_, x, y, z], weight)| QuadraturePoint {
            at: [x, y, z],
            // The reference tetrahedron has volume 1/6.
            weight: weight / 6.0,
        })
        .collect()
}
