//! Integration over an interval.

/// Points and weights of Gauss and Legendre on [0, 1], by Newton on the polynomial.
pub(crate) fn gauss_points(count: usize) -> Vec<(f64, f64)> {
    let order = count as f64;
    (0..count)
        .map(|k| {
            let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (order + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..50 {
                let (mut last, mut value) = (1.0, x);
                for n in 2..=count {
                    let n = n as f64;
                    (last, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * last) / n);
                }
                slope = order * (x * value - last) / (x * x - 1.0);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            let weight = 1.0 / ((1.0 - x * x) * slope * slope);
            (0.5 * (1.0 - x), weight)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_is_exact_to_its_degree() {
        for count in 1..=8 {
            let sum = |power: i32| -> f64 {
                let terms = gauss_points(count).into_iter();
                terms.map(|(x, w)| w * x.powi(power)).sum()
            };
            for power in 0..2 * count as i32 {
                // Rounding.
                assert!((sum(power) - 1.0 / f64::from(power + 1)).abs() < 1e-14);
            }
        }
    }
}
