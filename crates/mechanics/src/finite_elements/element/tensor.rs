//! Products of quadratic Lagrange polynomials.

fn line(x: f64) -> [f64; 3] {
    [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)]
}

fn line_slope(x: f64) -> [f64; 3] {
    [x - 0.5, -2.0 * x, x + 0.5]
}

fn place(node: usize) -> [usize; 3] {
    [node % 3, node / 3 % 3, node / 9]
}

pub(super) fn node(dimension: usize, node: usize) -> [f64; 3] {
    let mut at = [0.0; 3];
    for (x, i) in at.iter_mut().zip(place(node)).take(dimension) {
        *x = i as f64 - 1.0;
    }
    at
}

pub(super) fn shape(dimension: usize, at: [f64; 3], values: &mut [f64]) {
    let lines = at.map(line);
    for (node, value) in values.iter_mut().enumerate() {
        let place = place(node);
        *value = (0..dimension).map(|d| lines[d][place[d]]).product();
    }
}

pub(super) fn corner_shape(dimension: usize, at: [f64; 3], values: &mut [f64]) {
    for (corner, value) in values.iter_mut().enumerate() {
        let side = |d: usize| if corner >> d & 1 == 0 { -1.0 } else { 1.0 };
        *value = (0..dimension)
            .map(|d| 0.5 * (1.0 + side(d) * at[d]))
            .product();
    }
}

pub(super) fn gradients(dimension: usize, at: [f64; 3], gradients: &mut [[f64; 3]]) {
    let (lines, slopes) = (at.map(line), at.map(line_slope));
    for (node, gradient) in gradients.iter_mut().enumerate() {
        let place = place(node);
        *gradient = [0.0; 3];
        for (along, slope) in gradient.iter_mut().enumerate().take(dimension) {
            let factor = |d: usize| if d == along { &slopes } else { &lines }[d][place[d]];
            *slope = (0..dimension).map(factor).product();
        }
    }
}
