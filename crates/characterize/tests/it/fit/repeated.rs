//! What repetition tells: profiles, other noise, other subjects, other starts. Judge: linear models, for
//! which the answers are closed forms, and certified values.

use palpate_characterize::Error;
use palpate_characterize::fit::{
    Draws, Fit, Parameter, Random, Settings, block_bootstrap, information_criterion, least_squares,
    multi_start, noise_study, profile, uncertainty,
};

use super::parameters;

/// A polynomial through noise of standard deviation 0.1 about 1 + 2 x, at 200 places.
fn polynomial(values: &[f64], residuals: &mut [f64]) -> Option<()> {
    let mut random = Random::new(1);
    for (i, residual) in residuals.iter_mut().enumerate() {
        let x = i as f64 / 100.0 - 1.0;
        let curve = values.iter().rev().fold(0.0, |sum, value| sum * x + value);
        *residual = curve - (1.0 + 2.0 * x + 0.1 * random.normal());
    }
    Some(())
}

/// The same with its derivatives, the powers of x.
fn with_powers(
    values: &[f64],
    residuals: &mut [f64],
    jacobian: &mut nalgebra::DMatrix<f64>,
) -> Option<()> {
    for (i, mut row) in jacobian.row_iter_mut().enumerate() {
        let x = i as f64 / 100.0 - 1.0;
        row.iter_mut()
            .zip(0..)
            .for_each(|(by, power)| *by = x.powi(power));
    }
    polynomial(values, residuals)
}

const SETTINGS: Settings = Settings {
    tolerance: 1e-8,
    iterations: 100,
    differences: palpate_characterize::fit::Differences::Forward,
    precision: f64::EPSILON,
};

fn fitted(parameters: &[Parameter]) -> Result<Fit, Error> {
    least_squares(parameters, 200, &SETTINGS, polynomial)
}

/// The profile of a linear model is a parabola, whose interval is that of the covariance; differences have
/// half of all digits.
#[test]
fn the_profile_of_a_linear_model_is_its_interval() {
    let fit = fitted(&parameters(&[0.5, 0.5])).unwrap();
    let known = uncertainty(&fit);
    for parameter in 0..2 {
        let profile = profile(&fit, parameter, &known, 0.95, fitted).unwrap();
        let interval = known.interval(&fit, parameter, 0.95).unwrap();
        let width = interval[1] - interval[0];
        for (found, exact) in profile.interval.iter().zip(interval) {
            assert!(
                (found.unwrap() - exact).abs() < 1e-5 * width,
                "{profile:?} {interval:?}"
            );
        }
        let ascending = profile
            .points
            .windows(2)
            .all(|pair| pair[0][0] < pair[1][0]);
        assert!(ascending);
    }
    let mut held = fit.clone();
    held.parameters[0].fixed = true;
    let refused = profile(&held, 0, &uncertainty(&held), 0.95, fitted);
    assert!(matches!(refused, Err(Error::BadParameter { .. })));
}

/// Noise drawn anew, and runs of independent residuals, spread a linear model's parameters by their standard
/// errors. Of 400 draws a standard deviation is known to 3.5 %; four times this is allowed.
#[test]
fn repetition_spreads_as_the_covariance_says() {
    let fit = fitted(&parameters(&[0.5, 0.5])).unwrap();
    let known = uncertainty(&fit);
    let draws = Draws {
        count: 400,
        seed: 7,
    };
    let noise = (fit.sum_of_squares() / 198.0).sqrt();
    let drawn = noise_study(&fit, noise, draws, &SETTINGS, with_powers);
    let blocks = block_bootstrap(&fit, &[120, 80], 5, draws, &SETTINGS, with_powers);
    for spread in [&drawn, &blocks] {
        assert_eq!(spread.failed, 0);
        for parameter in 0..2 {
            let values = spread.values.iter().map(|values| values[parameter]);
            let count = spread.values.len() as f64;
            let mean = values.clone().sum::<f64>() / count;
            let squares: f64 = values.map(|value| (value - mean).powi(2)).sum();
            let deviation = (squares / (count - 1.0)).sqrt();
            let ratio = deviation / known.standard_error(parameter).unwrap();
            assert!((ratio - 1.0).abs() < 0.14, "{parameter}: {ratio}");
            let [low, high] = spread.interval(parameter, 0.95);
            assert!((low..high).contains(&fit.parameters[parameter].value));
        }
    }
    let again = block_bootstrap(&fit, &[120, 80], 5, draws, &SETTINGS, with_powers);
    assert_eq!(again, blocks, "the same seed gives the same");
}

/// Data on a line: a constant is refused, and a cubic is not worth its parameters.
#[test]
fn the_criterion_prefers_the_line() {
    let criterion = |count: usize| {
        let fit = fitted(&parameters(&vec![0.5; count])).unwrap();
        information_criterion(&fit, 200.0)
    };
    let [constant, line, cubic] = [1, 2, 4].map(criterion);
    assert!(line < constant && line < cubic, "{constant} {line} {cubic}");
}

/// The oxygen demand of NIST's BoxBOD, whose first start leads to a plateau: from several starts the certified
/// minimum is found first, and the plateau among the others.
#[test]
fn several_starts_find_the_better_minimum() {
    let data = [
        (1.0, 109.0),
        (2.0, 149.0),
        (3.0, 149.0),
        (5.0, 191.0),
        (7.0, 213.0),
        (10.0, 224.0),
    ];
    let residuals = |b: &[f64], residuals: &mut [f64]| {
        for (residual, (x, y)) in residuals.iter_mut().zip(data) {
            *residual = b[0] * (1.0 - (-b[1] * x).exp()) - y;
        }
        Some(())
    };
    let start = [
        Parameter::new("b1", 1.0).within(1.0, 1000.0),
        Parameter::new("b2", 1.0).within(0.01, 100.0),
    ];
    let fit = |parameters: &[Parameter]| least_squares(parameters, 6, &SETTINGS, residuals);
    let minima = multi_start(&start, 12, 5, fit).unwrap();
    let sums: Vec<f64> = minima
        .iter()
        .map(|minimum| minimum.fit.sum_of_squares())
        .collect();
    assert!((sums[0] / 1.168_008_876_6e3 - 1.0).abs() < 1e-8, "{sums:?}");
    assert!((2..=4).contains(&minima.len()), "{sums:?}");
    assert_eq!(
        minima.iter().map(|minimum| minimum.starts).sum::<usize>(),
        13
    );
}

/// Two minima of equal sums: the square of a parameter is known and its sign is not. Judge: p = ±1 by hand.
#[test]
fn minima_of_equal_sums_are_told_apart() {
    let square = |p: &[f64], residuals: &mut [f64]| {
        for (place, residual) in residuals.iter_mut().enumerate() {
            let wrong = if place % 2 == 0 { 0.1 } else { -0.1 };
            *residual = p[0] * p[0] - 1.0 + wrong;
        }
        Some(())
    };
    let start = [Parameter::new("p", 0.5).within(-3.0, 3.0)];
    let fit = |start: &[Parameter]| least_squares(start, 10, &SETTINGS, square);
    let minima = multi_start(&start, 8, 1, fit).unwrap();
    let mut values: Vec<f64> = minima
        .iter()
        .map(|minimum| minimum.fit.parameters[0].value)
        .collect();
    values.sort_by(f64::total_cmp);
    assert_eq!(values.len(), 2, "{values:?}");
    assert!(
        (values[0] + 1.0).abs() < 1e-6 && (values[1] - 1.0).abs() < 1e-6,
        "{values:?}"
    );
}
