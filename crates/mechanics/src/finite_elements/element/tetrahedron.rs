//! The quadratic tetrahedron with corners at the origin and the ends of the three axes.

/// Corners at the two ends of each middle node.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];

/// Gradients of the barycentric coordinates.
const SLOPES: [[f64; 3]; 4] = [
    [-1.0, -1.0, -1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
];

pub(super) fn barycentric(at: [f64; 3]) -> [f64; 4] {
    [1.0 - at[0] - at[1] - at[2], at[0], at[1], at[2]]
}

pub(super) fn node(node: usize) -> [f64; 3] {
    let corner = |c: usize| std::array::from_fn(|i| f64::from(u8::from(c == i + 1)));
    if node < 4 {
        return corner(node);
    }
    let [a, b]: [[f64; 3]; 2] = EDGES[node - 4].map(corner);
    std::array::from_fn(|i| 0.5 * (a[i] + b[i]))
}

pub(super) fn shape(at: [f64; 3], values: &mut [f64]) {
    let l = barycentric(at);
    for (value, l) in values.iter_mut().zip(l) {
        *value = l * (2.0 * l - 1.0);
    }
    for (value, [a, b]) in values[4..].iter_mut().zip(EDGES) {
        *value = 4.0 * l[a] * l[b];
    }
}

pub(super) fn gradients(at: [f64; 3], gradients: &mut [[f64; 3]]) {
    let l = barycentric(at);
    for corner in 0..4 {
        gradients[corner] = SLOPES[corner].map(|slope| (4.0 * l[corner] - 1.0) * slope);
    }
    for (gradient, [a, b]) in gradients[4..].iter_mut().zip(EDGES) {
        *gradient = std::array::from_fn(|i| 4.0 * (l[a] * SLOPES[b][i] + l[b] * SLOPES[a][i]));
    }
}
