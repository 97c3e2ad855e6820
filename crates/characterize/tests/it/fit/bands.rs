//! How well a fit knows the curve it drew.

use palpate_characterize::fit::{
    Fit, Parameter, Random, Settings, correlated_uncertainty, least_squares, uncertainty,
};

/// Judge: the textbooks' standard error of a line through n places, s √(1/n + (x − x̄)²/Σ (x − x̄)²). Tolerance:
/// derivatives by differences.
#[test]
fn a_line_is_known_as_the_textbooks_say() {
    let mut random = Random::new(5);
    let places: Vec<f64> = (0..40).map(|i| 0.3 * f64::from(i)).collect();
    let values: Vec<f64> = places
        .iter()
        .map(|x| 2.0 - 0.7 * x + 0.2 * random.normal())
        .collect();
    let parameters = [Parameter::new("a", 1.0), Parameter::new("b", 1.0)];
    let fit = least_squares(&parameters, 40, &Settings::default(), |p, residuals| {
        for ((residual, x), y) in residuals.iter_mut().zip(&places).zip(&values) {
            *residual = p[0] + p[1] * x - y;
        }
        Some(())
    })
    .unwrap();
    let mean = places.iter().sum::<f64>() / 40.0;
    let spread: f64 = places.iter().map(|x| (x - mean).powi(2)).sum();
    let deviation = (fit.sum_of_squares() / 38.0).sqrt();
    // Of 38 degrees of freedom, from tables.
    let quantile = 2.024_394;
    let reach = uncertainty(&fit).prediction_half_widths(&fit, 0.95);
    for (x, reach) in places.iter().zip(reach) {
        let error: f64 = reach / quantile;
        let known = deviation * (1.0 / 40.0 + (x - mean).powi(2) / spread).sqrt();
        assert!((error / known - 1.0).abs() < 1e-5, "{x}: {error} {known}");
    }
}

/// A line through what is no line: the residuals are one long wave, as those of a law that misses the shape of
/// a recording. Judge: Cauchy and Schwarz; with the derivatives orthonormal no combination of N residuals varies by
/// more than all of them together, √Σ r². Three times as much is left for what the fit took away.
#[test]
fn a_law_that_misses_the_shape_has_errors_of_its_size() {
    for power in [2, 3, 5] {
        let shape = |x: f64| x.powi(power);
        let places: Vec<f64> = (0..170).map(|i| f64::from(i) / 170.0).collect();
        let parameters = [Parameter::new("a", 1.0), Parameter::new("b", 1.0)];
        let fit: Fit = least_squares(&parameters, 170, &Settings::default(), |p, residuals| {
            for (residual, x) in residuals.iter_mut().zip(&places) {
                *residual = p[0] + p[1] * x - shape(*x);
            }
            Some(())
        })
        .unwrap();
        let known = correlated_uncertainty(&fit, &[170]);
        for place in 0..2 {
            let bound = 3.0 * fit.sum_of_squares().sqrt() * known.unit_error(place).unwrap();
            let error = known.standard_error(place).unwrap();
            assert!(error > 0.0 && error <= bound, "{power}: {error} {bound}");
        }
        let correlation = known.correlation();
        assert!(
            correlation.iter().all(|own| own.abs() <= 1.0 + 1e-9),
            "{correlation}"
        );
    }
}
