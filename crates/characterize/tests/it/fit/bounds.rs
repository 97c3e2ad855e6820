//! Bounds, fixed parameters and residuals that cannot be found. Judge: closed forms.

use nalgebra::DMatrix;
use palpate_characterize::Error;
use palpate_characterize::fit::{
    Parameter, Settings, Stop, correlated_uncertainty, least_squares, least_squares_with_jacobian,
    uncertainty,
};

use super::parameters;

/// y = 2 e^(−x/3) + 1 at twenty places, less a model of it.
fn decay(values: &[f64], residuals: &mut [f64]) -> Option<()> {
    for (i, residual) in residuals.iter_mut().enumerate() {
        let x = i as f64 * 0.5;
        let y = 2.0 * (-x / 3.0).exp() + 1.0;
        *residual = values[0] * (-x / values[1]).exp() + values[2] - y;
    }
    Some(())
}

/// The residuals [p₁ − 3, p₂ + 1, p₁ + p₂ − 5]: free, the least sum of squares is at (4, 0).
fn plane(values: &[f64], residuals: &mut [f64]) -> Option<()> {
    residuals[0] = values[0] - 3.0;
    residuals[1] = values[1] + 1.0;
    residuals[2] = values[0] + values[1] - 5.0;
    Some(())
}

/// With p₁ ≤ 2 the sum is least where (p₂ + 1) + (p₂ − 3) = 0; with p₂ ≥ 3 as well, in the corner.
#[test]
fn what_would_leave_its_bounds_ends_on_them() {
    let [a, b] = [0.0, 0.5].map(|value| Parameter::new("p", value));
    let one = [a.clone().within(-1.0, 2.0), b.clone()];
    let fit = least_squares(&one, 3, &Settings::default(), plane).unwrap();
    assert_eq!(fit.stop, Stop::Converged);
    assert_eq!(fit.parameters[0].value, 2.0, "exactly on its bound");
    // Differences have half of all digits.
    assert!((fit.parameters[1].value - 1.0).abs() < 1e-7);
    assert_eq!(fit.chosen(), [1]);
    let known = uncertainty(&fit);
    assert_eq!(known.standard_error(0), None, "a bound is not an estimate");
    assert!(known.standard_error(1).is_some());

    let corner = [
        a.within(-1.0, 2.0),
        Parameter { value: 4.0, ..b }.within(3.0, 9.0),
    ];
    let fit = least_squares(&corner, 3, &Settings::default(), plane).unwrap();
    assert_eq!(fit.stop, Stop::Converged);
    assert_eq!(
        [fit.parameters[0].value, fit.parameters[1].value],
        [2.0, 3.0]
    );
    assert!(fit.chosen().is_empty());
}

/// A bound that is met on the way is left again: the answer is that without bounds.
#[test]
fn a_bound_on_the_way_is_left_again() {
    let start = parameters(&[9.0, 0.4, -3.0]);
    let bounds = [[0.0, 9.0], [0.4, 50.0], [-3.0, 9.0]];
    let bounded: Vec<_> = start
        .into_iter()
        .zip(bounds)
        .map(|(p, [lower, upper])| p.within(lower, upper))
        .collect();
    let fit = least_squares(&bounded, 20, &Settings::default(), decay).unwrap();
    assert_eq!(fit.stop, Stop::Converged);
    for (parameter, truth) in fit.parameters.iter().zip([2.0, 3.0, 1.0]) {
        assert!((parameter.value - truth).abs() < 1e-6, "{parameter:?}");
    }
    let outside = fit.iterations.iter().any(|iteration| {
        let inside = |(&value, [lower, upper]): (&f64, [f64; 2])| (lower..=upper).contains(&value);
        !iteration.values.iter().zip(bounds).all(inside)
    });
    assert!(!outside, "every place on the way lies between the bounds");
}

/// A fixed parameter stays, and the others are those of the problem without it.
#[test]
fn a_fixed_parameter_stays() {
    let mut start = parameters(&[1.0, 1.0, 1.0]);
    start[2] = start[2].clone().fixed();
    let fit = least_squares(&start, 20, &Settings::default(), decay).unwrap();
    assert_eq!(fit.parameters[2].value, 1.0);
    assert!((fit.parameters[0].value - 2.0).abs() < 1e-6);
    assert!((fit.parameters[1].value - 3.0).abs() < 1e-6);
    assert_eq!(uncertainty(&fit).chosen, [0, 1]);
}

/// √p = 1 and √p = 1.1 from p = 100: Newton's first step leads to −79, where there is no root. Shorter ones lead
/// to p = 1.05². Where nothing can be found at the start there is an error.
#[test]
fn residuals_that_fail_shorten_the_step() {
    let mut failures = 0;
    let root = |values: &[f64], residuals: &mut [f64]| {
        failures += usize::from(values[0] < 0.0);
        residuals[0] = values[0].sqrt() - 1.0;
        residuals[1] = values[0].sqrt() - 1.1;
        (values[0] >= 0.0).then_some(())
    };
    let fit = least_squares(&parameters(&[100.0]), 2, &Settings::default(), root).unwrap();
    assert!(failures > 0, "the test must meet the failing region");
    assert_eq!(fit.stop, Stop::Converged);
    assert!((fit.parameters[0].value - 1.1025).abs() < 1e-7);

    let refused = least_squares(
        &parameters(&[1.0, 2.0, 0.0]),
        20,
        &Settings::default(),
        |_, _| None,
    );
    assert!(matches!(refused, Err(Error::NoStart { .. })));
    let outside = [Parameter::new("p", 3.0).within(0.0, 1.0)];
    let refused = least_squares(&outside, 3, &Settings::default(), plane);
    assert!(matches!(refused, Err(Error::BadParameter { .. })));
}

/// With its own derivatives a problem ends where differences lead it, with fewer evaluations.
#[test]
fn given_derivatives_lead_to_the_same_place() {
    let both = |values: &[f64], residuals: &mut [f64], jacobian: &mut DMatrix<f64>| {
        for i in 0..residuals.len() {
            let x = i as f64 * 0.5;
            let fallen = (-x / values[1]).exp();
            jacobian[(i, 0)] = fallen;
            jacobian[(i, 1)] = values[0] * fallen * x / values[1].powi(2);
            jacobian[(i, 2)] = 1.0;
        }
        decay(values, residuals)
    };
    let start = parameters(&[1.0, 1.0, 0.0]);
    let given = least_squares_with_jacobian(&start, 20, &Settings::default(), both).unwrap();
    let found = least_squares(&start, 20, &Settings::default(), decay).unwrap();
    for (a, b) in given.parameters.iter().zip(&found.parameters) {
        assert!((a.value - b.value).abs() < 1e-7, "{a:?} {b:?}");
    }
    assert!(given.evaluations < found.evaluations / 2);
    let again = least_squares(&start, 20, &Settings::default(), decay).unwrap();
    assert_eq!(again, found, "the same bits twice");
}

/// Noise may leave every parameter on a bound; nothing is known of any then, and that is no panic.
#[test]
fn when_all_end_on_bounds_nothing_is_known() {
    let start = [Parameter::new("slope", 1.0).within(1.0, 1.0)];
    let fit = least_squares(&start, 4, &Settings::default(), |values, residuals| {
        residuals.iter_mut().for_each(|r| *r = values[0] - 3.0);
        Some(())
    })
    .unwrap();
    assert!(fit.chosen().is_empty());
    assert_eq!(correlated_uncertainty(&fit, &[4]).standard_error(0), None);
}
