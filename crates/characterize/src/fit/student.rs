//! Quantiles of Student's distribution.

use std::f64::consts::FRAC_PI_2;

/// The t [-] that a variable of so many degrees of freedom stays within, up or down, with the probability
/// `level`.
///
/// With t = √ν tan θ the density is that of cos^(ν − 1) θ, which is summed until `level` of it is reached.
pub(crate) fn student_quantile(degrees_of_freedom: f64, level: f64) -> f64 {
    const PARTS: usize = 4000;
    let freedom = degrees_of_freedom.clamp(1.0, 1e9);
    // Beyond twelve standard deviations nothing is left, but for few degrees of freedom, which reach π/2.
    let end = FRAC_PI_2.min(12.0 / freedom.sqrt());
    let width = end / PARTS as f64;
    let density = |part: usize| ((part as f64 + 0.5) * width).cos().powf(freedom - 1.0);
    let wanted = level * (0..PARTS).map(density).sum::<f64>();
    let mut sum = 0.0;
    for part in 0..PARTS {
        let next = sum + density(part);
        if next >= wanted {
            let angle = (part as f64 + (wanted - sum) / (next - sum)) * width;
            return freedom.sqrt() * angle.tan();
        }
        sum = next;
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: tables. The sums have about seven digits, tan near its pole fewer.
    #[test]
    fn quantiles_are_those_of_the_tables() {
        let table = [
            (1.0, 0.95, 12.706_204_7),
            (2.0, 0.95, 4.302_652_7),
            (2.0, 0.99, 9.924_843_2),
            (10.0, 0.95, 2.228_138_9),
            (30.0, 0.95, 2.042_272_5),
            (1e9, 0.95, 1.959_964_0),
        ];
        for (freedom, level, quantile) in table {
            let ratio = student_quantile(freedom, level) / quantile;
            assert!((ratio - 1.0).abs() < 1e-5, "{freedom} {level}: {ratio}");
        }
    }
}
